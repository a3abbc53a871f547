// Colour consistency with visibility (4.3.2): how far the photos disagree on a voxel's colour, and
// whether a voxel alone holds an outline up. Voxels are known by their order in the cube, x slowest.

struct Rule {
    voxel: f32,
    // A voxel covers what a ball of this radius covers, and hides what lies so much behind it.
    cover: f32,
    slack: f32,
    least_cosine: f32,
    rim: f32,
    step: f32,
    along: u32,
    views: u32,
    voxels: u32,
    least_views: u32,
    most_views: u32,
    pixels: u32,
    first: u32,
    spare_a: u32,
    spare_b: u32,
    spare_c: u32,
}

@group(0) @binding(0) var<storage, read> rule: Rule;
// clear, cover
@group(0) @binding(1) var<storage, read_write> cleared: array<u32>;
@group(0) @binding(2) var<storage, read_write> covered: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read> voxels: array<u32>;
// look, in the photos
@group(0) @binding(2) var<storage, read> depths: array<u32>;
@group(0) @binding(4) var<storage, read> pixels: array<u32>;
@group(0) @binding(5) var<storage, read> solid: array<u32>;
// Of each voxel the views that see it straightest: the cosine, which is -1 where there is none, and
// the colour.
@group(0) @binding(6) var<storage, read_write> seen: array<vec4<f32>>;
// spread
@group(0) @binding(1) var<storage, read> best: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> spreads: array<f32>;
// hold
@group(0) @binding(4) var<storage, read> left: array<u32>;
@group(0) @binding(5) var<storage, read_write> held: array<u32>;

const FAR = 3.0e38;

fn place_of(voxel: u32) -> vec3<i32> {
    let along = rule.along;
    return vec3<i32>(vec3<u32>(voxel / along / along, voxel / along % along, voxel % along));
}

fn middle_of(voxel: u32) -> vec3<f32> {
    return (vec3<f32>(place_of(voxel)) + 0.5) * rule.voxel;
}

fn inside(place: vec3<i32>) -> bool {
    return all(place >= vec3<i32>(0)) && all(place < vec3<i32>(i32(rule.along)));
}

fn order_of(place: vec3<i32>) -> u32 {
    return (u32(place.x) * rule.along + u32(place.y)) * rule.along + u32(place.z);
}

@compute @workgroup_size(64)
fn clear(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let at = id.x + id.y * groups.x * 64u;
    if (at < rule.pixels) {
        cleared[at] = bitcast<u32>(FAR);
    }
}

// The first and the last pixel whose middle is in reach; the last before the first where there is none.
fn reached(at: f32, half: f32, size: u32) -> vec2<i32> {
    let first = clamp(ceil(at - half - 0.5), -1.0, f32(size) + 1.0);
    let last = clamp(floor(at + half - 0.5), -2.0, f32(size));
    return vec2<i32>(max(i32(first), 0), min(i32(last), i32(size) - 1));
}

// A thread for each voxel of the shell and each view: the least depth in each pixel that it covers.
@compute @workgroup_size(64)
fn cover(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let at = id.x + id.y * groups.x * 64u;
    if (at >= rule.voxels * rule.views) {
        return;
    }
    let view = at % rule.views;
    let found = projected(view, middle_of(voxels[at / rule.views]));
    if (found.z <= rule.cover) {
        return;
    }
    let half = max(views[view].focal * rule.cover / found.z, 0.5);
    let across = reached(found.x, half, views[view].size.x);
    let down = reached(found.y, half, views[view].size.y);
    for (var y = down.x; y <= down.y; y++) {
        let row = views[view].offset + u32(y) * views[view].size.x;
        for (var x = across.x; x <= across.y; x++) {
            // The bits of numbers above zero are in the order of the numbers.
            atomicMin(&covered[row + u32(x)], bitcast<u32>(found.z));
        }
    }
}

// The way out of the solid, from how full the neighbourhood is.
fn normal_of(voxel: u32) -> vec3<f32> {
    let own = place_of(voxel);
    var out = vec3<i32>(0);
    for (var x = -2; x <= 2; x++) {
        for (var y = -2; y <= 2; y++) {
            for (var z = -2; z <= 2; z++) {
                let step = vec3<i32>(x, y, z);
                var full = false;
                if (inside(own + step)) {
                    let order = order_of(own + step);
                    full = (solid[order / 32u] >> (order % 32u) & 1u) == 1u;
                }
                out += select(step, vec3<i32>(0), full);
            }
        }
    }
    let length_out = length(vec3<f32>(out));
    return select(vec3<f32>(0.0), vec3<f32>(out) / length_out, length_out > 0.0);
}

fn pixel_of(view: u32, column: u32, row: u32) -> vec3<f32> {
    let packed = pixels[views[view].offset + row * views[view].size.x + column];
    return vec3<f32>(vec3<u32>(packed, packed >> 8u, packed >> 16u) & vec3<u32>(255u));
}

// Between the four pixels around; `at` is in the picture.
fn colour_of(view: u32, at: vec2<f32>) -> vec3<f32> {
    let low = vec2<u32>(at);
    let high = min(low + 1u, views[view].size - vec2<u32>(1u));
    let part = at - vec2<f32>(low);
    let upper = mix(pixel_of(view, low.x, low.y), pixel_of(view, high.x, low.y), part.x);
    let lower = mix(pixel_of(view, low.x, high.y), pixel_of(view, high.x, high.y), part.x);
    return mix(upper, lower, part.y);
}

// Into the best of a voxel, behind those that are as straight.
fn keep(start: u32, given: vec4<f32>) {
    var moved = given;
    for (var at = start; at < start + rule.most_views; at++) {
        let own = seen[at];
        if (own.x < moved.x) {
            seen[at] = moved;
            moved = own;
        }
    }
}

// A thread for each voxel that is asked for: the colours in the photos that see it straightest.
@compute @workgroup_size(64)
fn look(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let at = id.x + id.y * groups.x * 64u;
    if (at >= rule.voxels) {
        return;
    }
    let start = at * rule.most_views;
    if (rule.first == 1u) {
        for (var one = start; one < start + rule.most_views; one++) {
            seen[one] = vec4<f32>(-1.0, 0.0, 0.0, 0.0);
        }
    }
    let middle = middle_of(voxels[at]);
    let out = normal_of(voxels[at]);
    for (var view = 0u; view < rule.views; view++) {
        let found = projected(view, middle);
        let way = views[view].centre - middle;
        let cosine = dot(way, out) / max(length(way), 1e-30);
        let size = vec2<f32>(views[view].size);
        let at_middle = found.xy - 0.5;
        if (found.z <= 0.0 || cosine < rule.least_cosine
            || any(at_middle < vec2<f32>(0.0)) || any(at_middle > size - 1.0)) {
            continue;
        }
        let own = vec2<u32>(found.xy);
        let nearest = depths[views[view].offset + own.y * views[view].size.x + own.x];
        if (found.z <= bitcast<f32>(nearest) + rule.slack) {
            keep(start, vec4<f32>(cosine, colour_of(view, at_middle)));
        }
    }
}

// A thread for each voxel: the root mean square distance of its colours from their mean, per channel;
// -1 where too few views see it.
@compute @workgroup_size(64)
fn spread(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let at = id.x + id.y * groups.x * 64u;
    if (at >= rule.voxels) {
        return;
    }
    let start = at * rule.most_views;
    var sum = vec3<f32>(0.0);
    var count = 0u;
    for (; count < rule.most_views && best[start + count].x > -1.0; count++) {
        sum += best[start + count].yzw;
    }
    if (count < rule.least_views || count == 0u) {
        spreads[at] = -1.0;
        return;
    }
    let mean = sum / f32(count);
    var squares = 0.0;
    for (var one = start; one < start + count; one++) {
        let off = best[one].yzw - mean;
        squares += dot(off, off);
    }
    spreads[at] = sqrt(squares / (3.0 * f32(count)));
}

// Whether something is left on the ray of a view through a voxel, farther off than the rim, one way.
fn backed(voxel: u32, way: vec3<f32>) -> bool {
    if (all(way == vec3<f32>(0.0))) {
        return false;
    }
    let own = vec3<f32>(place_of(voxel)) + 0.5;
    for (var number = 1.0; ; number += 1.0) {
        let place = vec3<i32>(floor(own + way * (rule.rim + rule.step * number)));
        if (!inside(place)) {
            return false;
        }
        let order = order_of(place);
        if ((left[order / 32u] >> (order % 32u) & 1u) == 1u) {
            return true;
        }
    }
    return false;
}

// A thread for each voxel that shall go.
@compute @workgroup_size(64)
fn hold(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let at = id.x + id.y * groups.x * 64u;
    if (at >= rule.voxels) {
        return;
    }
    let middle = middle_of(voxels[at]);
    var holds = false;
    for (var view = 0u; view < rule.views && !holds; view++) {
        let found = projected(view, middle);
        if (found.z <= 0.0) {
            continue;
        }
        let near = rule.rim * views[view].focal * rule.voxel / found.z;
        if (abs(distance_px(view, found.xy)) >= near) {
            continue;
        }
        let way = middle - views[view].centre;
        let unit = way / max(length(way), 1e-30);
        holds = !backed(voxels[at], unit) && !backed(voxels[at], -unit);
    }
    held[at] = select(0u, 1u, holds);
}
