// Disparities of a rectified pair, in whole numbers: veduta_stereo's `pair` and `path`.

struct Rule {
    width: u32,
    there: u32,
    height: u32,
    // The first row of the band, and its rows.
    first: u32,
    band: u32,
    low: i32,
    count: u32,
    // Words of sixteen disparities.
    groups: u32,
    rows: u32,
    most: u32,
    step: u32,
    jump: u32,
}

const WHOLE = 256u;
const NOWHERE = 32768u;
const PADDED = 65535u;

@group(0) @binding(0) var<storage, read> rule: Rule;
// Red, green and blue from the lowest byte, and 1 where there is a pixel.
@group(0) @binding(1) var<storage, read> own: array<u32>;
@group(0) @binding(2) var<storage, read> other: array<u32>;
@group(0) @binding(3) var<storage, read> weights: array<u32>;
// For each pixel of the band each disparity, two to a word.
@group(0) @binding(4) var<storage, read_write> costs: array<u32>;

fn difference(a: u32, b: u32) -> u32 {
    var sum = 0u;
    for (var shift = 0u; shift < 24u; shift += 8u) {
        let x = i32(a >> shift & 255u);
        let y = i32(b >> shift & 255u);
        sum += u32(abs(x - y));
    }
    return sum * 85u >> 8u;
}

// A thread for sixteen disparities of a pixel: the weighted differences of its column (3.1, 3.2).
@compute @workgroup_size(64)
fn gather(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
) {
    let at = id.x + id.y * grid.x * 64u;
    let pixel = at / rule.groups;
    if (pixel >= rule.width * rule.band) {
        return;
    }
    let group = at % rule.groups;
    let x = pixel % rule.width;
    let y = rule.first + pixel / rule.width;
    let half = rule.rows / 2u;
    let centre = own[y * rule.width + x];
    var column: array<u32, 63>;
    var sum = 0u;
    for (var tap = 0u; tap < rule.rows; tap++) {
        let row = y + tap;
        column[tap] = 0u;
        if (row >= half && row - half < rule.height) {
            let beside = own[(row - half) * rule.width + x];
            column[tap] = weights[tap * 256u + difference(centre, beside)];
        }
        sum += column[tap];
    }
    var left = WHOLE;
    for (var tap = 0u; tap < rule.rows; tap++) {
        column[tap] = column[tap] * WHOLE / max(sum, 1u);
        left -= column[tap];
    }
    column[half] += left;
    var sums: array<u32, 16>;
    let begin = i32(x) + rule.low + i32(group * 16u);
    for (var tap = 0u; tap < rule.rows; tap++) {
        let weight = column[tap];
        if (weight == 0u) {
            continue;
        }
        let row = y + tap - half;
        let colour = own[row * rule.width + x];
        for (var d = 0u; d < 16u; d++) {
            let to = begin + i32(d);
            var cost = rule.most;
            if (colour >> 24u == 1u && to >= 0 && to < i32(rule.there)) {
                let seen = other[row * rule.there + u32(to)];
                if (seen >> 24u == 1u) {
                    cost = min(cost, difference(colour, seen));
                }
            }
            sums[d] += weight * cost;
        }
    }
    for (var d = 0u; d < 16u; d += 2u) {
        let place = group * 16u + d;
        let low = select(sums[d], PADDED, place >= rule.count);
        let high = select(sums[d + 1u], PADDED, place + 1u >= rule.count);
        costs[at * 8u + d / 2u] = low | (high << 16u);
    }
}

@group(0) @binding(1) var<storage, read> given: array<u32>;
@group(0) @binding(2) var<storage, read_write> chosen: array<u32>;

fn cost_of(pixel: u32, d: u32) -> u32 {
    return given[(pixel * rule.groups * 16u + d) / 2u] >> (16u * (d % 2u)) & 65535u;
}

// A thread for each pixel: the least cost.
@compute @workgroup_size(64)
fn least(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
) {
    let pixel = id.x + id.y * grid.x * 64u;
    if (pixel >= rule.width * rule.band) {
        return;
    }
    var best = PADDED;
    var at = 0u;
    for (var d = 0u; d < rule.count; d++) {
        let cost = cost_of(pixel, d);
        if (cost < best) {
            best = cost;
            at = d;
        }
    }
    chosen[pixel] = at;
}

@group(0) @binding(3) var<storage, read_write> came: array<u32>;
@group(0) @binding(4) var<storage, read_write> jumps: array<u32>;

const MOST_GROUPS = 64u;
// Of each sixteen disparities, of this pixel and the one before in turn.
var<workgroup> leasts: array<u32, 128>;
var<workgroup> places: array<u32, 128>;
var<workgroup> firsts: array<u32, 128>;
var<workgroup> lasts: array<u32, 128>;

// A workgroup for each row, a thread for sixteen disparities: the best path.
@compute @workgroup_size(64)
fn path(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let row = group.x + group.y * grid.x;
    let begin = row * rule.width;
    let works = thread < rule.groups && row < rule.band;
    var sums: array<u32, 16>;
    for (var x = 0u; x < rule.width; x++) {
        let side = (x & 1u) * MOST_GROUPS;
        let before = MOST_GROUPS - side;
        if (works) {
            if (x > 0u) {
                var floor_cost = leasts[before];
                var jump = places[before];
                for (var g = 1u; g < rule.groups; g++) {
                    if (leasts[before + g] < floor_cost) {
                        floor_cost = leasts[before + g];
                        jump = places[before + g];
                    }
                }
                var under = NOWHERE;
                if (thread > 0u) {
                    under = lasts[before + thread - 1u] - floor_cost;
                }
                var over = NOWHERE;
                if (thread + 1u < rule.groups) {
                    over = firsts[before + thread + 1u] - floor_cost;
                }
                if (thread == 0u) {
                    jumps[begin + x] = jump;
                }
                var ways = 0u;
                for (var d = 0u; d < 16u; d++) {
                    let same = sums[d] - floor_cost;
                    var above = over;
                    if (d < 15u) {
                        above = sums[d + 1u] - floor_cost;
                    }
                    var best = same;
                    var way = 0u;
                    if (under + rule.step < best) {
                        best = under + rule.step;
                        way = 1u;
                    }
                    if (above + rule.step < best) {
                        best = above + rule.step;
                        way = 2u;
                    }
                    if (rule.jump < best) {
                        best = rule.jump;
                        way = 3u;
                    }
                    under = same;
                    ways |= way << (2u * d);
                    sums[d] = cost_of(begin + x, thread * 16u + d) + best;
                }
                came[(begin + x) * rule.groups + thread] = ways;
            } else {
                for (var d = 0u; d < 16u; d++) {
                    sums[d] = cost_of(begin, thread * 16u + d);
                }
            }
            var smallest = sums[0];
            var place = 0u;
            for (var d = 1u; d < 16u; d++) {
                if (sums[d] < smallest) {
                    smallest = sums[d];
                    place = d;
                }
            }
            leasts[side + thread] = smallest;
            places[side + thread] = thread * 16u + place;
            firsts[side + thread] = sums[0];
            lasts[side + thread] = sums[15];
        }
        workgroupBarrier();
    }
    storageBarrier();
    if (thread == 0u && row < rule.band) {
        let side = ((rule.width - 1u) & 1u) * MOST_GROUPS;
        var smallest = leasts[side];
        var at = places[side];
        for (var g = 1u; g < rule.groups; g++) {
            if (leasts[side + g] < smallest) {
                smallest = leasts[side + g];
                at = places[side + g];
            }
        }
        for (var back = 0u; back < rule.width; back++) {
            let x = rule.width - 1u - back;
            chosen[begin + x] = at;
            if (x > 0u) {
                let way = came[(begin + x) * rule.groups + at / 16u] >> (2u * (at % 16u)) & 3u;
                switch way {
                    case 1u: { at -= 1u; }
                    case 2u: { at += 1u; }
                    case 3u: { at = jumps[begin + x]; }
                    default: {}
                }
            }
        }
    }
}

@group(0) @binding(3) var<storage, read> shown: array<u32>;
@group(0) @binding(4) var<storage, read_write> disparities: array<f32>;
// What stands for none.
const UNKNOWN = -1e9;

// A thread for each pixel: the fraction that a parabola finds.
@compute @workgroup_size(64)
fn refine(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
) {
    let pixel = id.x + id.y * grid.x * 64u;
    if (pixel >= rule.width * rule.band) {
        return;
    }
    let whole = rule.first * rule.width + pixel;
    let at = chosen[pixel];
    let cost = cost_of(pixel, at);
    if (shown[whole] >> 24u == 0u || cost >= rule.most * WHOLE) {
        disparities[whole] = UNKNOWN;
        return;
    }
    var fraction = 0.0;
    if (at > 0u && at + 1u < rule.count) {
        let below = f32(cost_of(pixel, at - 1u));
        let above = f32(cost_of(pixel, at + 1u));
        let bend = below - 2.0 * f32(cost) + above;
        if (bend > 0.0) {
            fraction = clamp(0.5 * (below - above) / bend, -0.5, 0.5);
        }
    }
    disparities[whole] = f32(rule.low) + f32(at) + fraction;
}
