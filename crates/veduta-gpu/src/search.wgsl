// PatchMatch over planes: veduta_stereo's `search` and `patch`. The constants SIDE, SAMPLES, WORST,
// MOST_VIEWS, GROUPS, STARTS and OFFSETS stand before this, as that crate has them.

struct Rule {
    width: u32,
    height: u32,
    views: u32,
    // Views whose costs are averaged.
    best: u32,
    sweep: u32,
    colour: u32,
    seed_low: u32,
    seed_high: u32,
    step_px: f32,
    gamma_grey: f32,
    gamma_px: f32,
    noise_grey: f32,
    // Inverse depths.
    low: f32,
    high: f32,
    consistency: f32,
    most_px: f32,
    // Of this sweep.
    vary_depth: f32,
    vary_normal: f32,
    focal: vec2<f32>,
    centre: vec2<f32>,
    // Planes are one that differ by less: inverse depth, and slope.
    same_inverse: f32,
    same_slope: f32,
}

// Rows: (x, y, 1, inverse depth) of the reference to there, and back.
struct View {
    there: array<vec4<f32>, 3>,
    back: array<vec4<f32>, 3>,
    width: u32,
    height: u32,
    // Where its pixels begin (bytes), and its depths; those are none where `known` is 0.
    image: u32,
    depths: u32,
    known: u32,
}

@group(0) @binding(0) var<storage, read> rule: Rule;
// Four pixels to a word, the reference's first.
@group(0) @binding(1) var<storage, read> pixels: array<u32>;
@group(0) @binding(2) var<storage, read> views: array<View>;
// Not positive where unknown.
@group(0) @binding(3) var<storage, read> depths: array<f32>;
// Inverse depth, its slopes along x and y, the cost.
@group(0) @binding(4) var<storage, read_write> planes: array<vec4<f32>>;

var<private> weights: array<f32, SAMPLES>;
var<private> centred: array<f32, SAMPLES>;
var<private> own_variance: f32;
var<private> chance: u32;

fn grey(at: u32) -> f32 {
    return f32(pixels[at / 4u] >> (8u * (at % 4u)) & 255u);
}

// Bilinear; the first pixel's centre is (0.5, 0.5), and beyond the border is the border.
fn sample(image: u32, width: u32, height: u32, x: f32, y: f32) -> f32 {
    let u = clamp(x - 0.5, 0.0, f32(width - 1u));
    let v = clamp(y - 0.5, 0.0, f32(height - 1u));
    let column = min(u32(u), width - 1u);
    let row = min(u32(v), height - 1u);
    let right = min(column + 1u, width - 1u);
    let below = min(row + 1u, height - 1u);
    let a = u - f32(column);
    let b = v - f32(row);
    let upper = mix(grey(image + row * width + column), grey(image + row * width + right), a);
    let lower = mix(grey(image + below * width + column), grey(image + below * width + right), a);
    return mix(upper, lower, b);
}

fn offset(i: u32) -> vec2<f32> {
    return vec2<f32>(f32(i % SIDE), f32(i / SIDE)) - vec2<f32>(f32(SIDE / 2u));
}

// The window around a pixel of the reference, weighted by (3.2).
fn look_at(x: u32, y: u32) {
    let middle = vec2<f32>(f32(x) + 0.5, f32(y) + 0.5);
    let own = grey(y * rule.width + x);
    var values: array<f32, SAMPLES>;
    var whole = 0.0;
    for (var i = 0u; i < SAMPLES; i++) {
        let at = middle + offset(i) * rule.step_px;
        values[i] = sample(0u, rule.width, rule.height, at.x, at.y);
        let away = length(offset(i)) * rule.step_px;
        weights[i] = exp(-(abs(values[i] - own) / rule.gamma_grey + away / rule.gamma_px));
        whole += weights[i];
    }
    var mean = 0.0;
    for (var i = 0u; i < SAMPLES; i++) {
        weights[i] /= whole;
        mean += weights[i] * values[i];
    }
    own_variance = 0.0;
    for (var i = 0u; i < SAMPLES; i++) {
        centred[i] = weights[i] * (values[i] - mean);
        own_variance += centred[i] * (values[i] - mean);
    }
}

fn moved(rows: array<vec4<f32>, 3>, at: vec2<f32>, inverse: f32) -> vec3<f32> {
    let from_px = vec4<f32>(at, 1.0, inverse);
    return vec3<f32>(dot(rows[0], from_px), dot(rows[1], from_px), dot(rows[2], from_px));
}

// 1 - NCC between the window and where a plane takes it in a view.
fn unlike(view: u32, at: vec2<f32>, plane: vec3<f32>) -> f32 {
    let rows = views[view].there;
    let width = views[view].width;
    let height = views[view].height;
    let middle = moved(rows, at, plane.x);
    if (middle.z <= 1e-6) {
        return WORST;
    }
    let seen = middle.xy / middle.z;
    if (!(seen.x >= 0.0 && seen.y >= 0.0 && seen.x < f32(width) && seen.y < f32(height))) {
        return WORST;
    }
    let near = vec3<f32>(rows[0].w, rows[1].w, rows[2].w);
    let right = rule.step_px * (vec3<f32>(rows[0].x, rows[1].x, rows[2].x) + near * plane.y);
    let down = rule.step_px * (vec3<f32>(rows[0].y, rows[1].y, rows[2].y) + near * plane.z);
    var mean = 0.0;
    var square = 0.0;
    var shared_part = 0.0;
    for (var i = 0u; i < SAMPLES; i++) {
        let step = offset(i);
        let there = middle + step.x * right + step.y * down;
        let px = there.xy / there.z;
        let value = sample(views[view].image, width, height, px.x, px.y);
        mean += weights[i] * value;
        square += weights[i] * value * value;
        shared_part += centred[i] * value;
    }
    let least = rule.noise_grey * rule.noise_grey;
    let variance = max(square - mean * mean, 0.0) + least;
    return 1.0 - shared_part / sqrt((own_variance + least) * variance);
}

// How far the depth that a view has there leads back beside the pixel, as a cost.
fn inconsistency(view: u32, at: vec2<f32>, inverse: f32) -> f32 {
    let most = rule.consistency * rule.most_px;
    let width = views[view].width;
    let height = views[view].height;
    let seen = moved(views[view].there, at, inverse);
    let px = seen.xy / seen.z;
    let inside = seen.z > 0.0 && px.x >= 0.0 && px.y >= 0.0
        && px.x < f32(width) && px.y < f32(height);
    if (!inside) {
        return most;
    }
    let depth = depths[views[view].depths + u32(px.y) * width + u32(px.x)];
    if (!(depth > 0.0)) {
        return most;
    }
    let back = moved(views[view].back, px, 1.0 / depth);
    if (back.z <= 0.0) {
        return most;
    }
    return rule.consistency * min(distance(back.xy / back.z, at), rule.most_px);
}

// What the best views say against a plane at a pixel.
fn cost(x: u32, y: u32, plane: vec3<f32>) -> f32 {
    if (!(plane.x >= rule.low && plane.x <= rule.high)) {
        return WORST * 2.0;
    }
    let at = vec2<f32>(f32(x) + 0.5, f32(y) + 0.5);
    var costs: array<f32, MOST_VIEWS>;
    for (var view = 0u; view < rule.views; view++) {
        var one = unlike(view, at, plane);
        if (views[view].known == 1u) {
            one += inconsistency(view, at, plane.x);
        }
        // In order, the least first.
        var place = view;
        while (place > 0u && costs[place - 1u] > one) {
            costs[place] = costs[place - 1u];
            place -= 1u;
        }
        costs[place] = one;
    }
    var sum = 0.0;
    for (var view = 0u; view < rule.best; view++) {
        sum += costs[view];
    }
    return sum / f32(rule.best);
}

fn same(one: vec3<f32>, other: vec3<f32>) -> bool {
    let apart = abs(one - other);
    return apart.x < rule.same_inverse && max(apart.y, apart.z) < rule.same_slope;
}

fn mixed(given: u32) -> u32 {
    let first = (given ^ (given >> 16u)) * 0x7feb352du;
    let second = (first ^ (first >> 15u)) * 0x846ca68bu;
    return second ^ (second >> 16u);
}

fn between(low: f32, high: f32) -> f32 {
    chance += 0x9e3779b9u;
    return low + (high - low) * (f32(mixed(chance) >> 8u) / 16777216.0);
}

// A direction that faces the ray, even over the half sphere.
fn facing(ray: vec3<f32>) -> vec3<f32> {
    let z = between(-1.0, 1.0);
    let turn = between(0.0, 6.2831855);
    let r = sqrt(max(1.0 - z * z, 0.0));
    let drawn = vec3<f32>(r * cos(turn), r * sin(turn), z);
    return select(drawn, -drawn, dot(drawn, ray) > 0.0);
}

// Through the point on a unit ray; planes count the depth along z.
fn plane_of(ray: vec3<f32>, inverse: f32, normal: vec3<f32>) -> vec3<f32> {
    var along = dot(normal, ray);
    if (abs(along) < 0.087) {
        along = -0.087;
    }
    return vec3<f32>(inverse, normal.xy / along * inverse / rule.focal * ray.z);
}

fn normal_of(plane: vec3<f32>, at: vec2<f32>) -> vec3<f32> {
    let rest = plane.x - dot(plane.yz, at - rule.centre);
    let normal = vec3<f32>(rule.focal * plane.yz, rest);
    let size = length(normal);
    if (size > 0.0) {
        return -normal / size;
    }
    return vec3<f32>(0.0, 0.0, -1.0);
}

// Near the best plane (kinds 0 to 2: depth, normal, both), or any (3).
fn varied(best: vec3<f32>, kind: u32, ray: vec3<f32>, at: vec2<f32>) -> vec3<f32> {
    if (kind == 3u) {
        let drawn = between(rule.low, rule.high);
        return plane_of(ray, drawn, facing(ray));
    }
    var inverse = best.x;
    if (kind != 1u) {
        inverse *= 1.0 + between(-rule.vary_depth, rule.vary_depth);
    }
    var normal = normal_of(best, at);
    if (kind != 0u) {
        normal += rule.vary_normal * facing(ray);
        normal /= max(length(normal), 1e-6);
    }
    return plane_of(ray, inverse, normal);
}

// A thread for each pixel: what its plane costs.
@compute @workgroup_size(64)
fn judge(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
) {
    let i = id.x + id.y * grid.x * 64u;
    if (i >= rule.width * rule.height) {
        return;
    }
    let x = i % rule.width;
    let y = i / rule.width;
    look_at(x, y);
    planes[i].w = cost(x, y, planes[i].xyz);
}

// A thread for each pixel of one colour of the chequerboard; all that it reads are of the other.
@compute @workgroup_size(64)
fn improve(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
) {
    let n = id.x + id.y * grid.x * 64u;
    let half = (rule.width + 1u) / 2u;
    let y = n / half;
    let x = 2u * (n % half) + (y + rule.colour) % 2u;
    if (y >= rule.height || x >= rule.width) {
        return;
    }
    look_at(x, y);
    let i = y * rule.width + x;
    var best = planes[i];
    for (var group = 0u; group < GROUPS; group++) {
        var least = 0.0;
        var candidate = vec3<f32>(0.0);
        var any = false;
        for (var k = STARTS[group]; k < STARTS[group + 1u]; k++) {
            let away = OFFSETS[k];
            let to = vec2<i32>(i32(x), i32(y)) + away;
            if (any_outside(to)) {
                continue;
            }
            let other = planes[u32(to.y) * rule.width + u32(to.x)];
            if (!any || other.w < least) {
                any = true;
                least = other.w;
                let gone = other.x - f32(away.x) * other.y - f32(away.y) * other.z;
                candidate = vec3<f32>(gone, other.yz);
            }
        }
        if (any && !same(candidate, best.xyz)) {
            let said = cost(x, y, candidate);
            if (said < best.w) {
                best = vec4<f32>(candidate, said);
            }
        }
    }
    let seeds = mixed(rule.seed_high ^ mixed(rule.seed_low));
    chance = mixed(i ^ mixed(rule.sweep ^ seeds));
    let at = vec2<f32>(f32(x) + 0.5, f32(y) + 0.5);
    let ray = normalize(vec3<f32>((at - rule.centre) / rule.focal, 1.0));
    for (var kind = 0u; kind < 4u; kind++) {
        let tried = varied(best.xyz, kind, ray, at);
        let said = cost(x, y, tried);
        if (said < best.w) {
            best = vec4<f32>(tried, said);
        }
    }
    planes[i] = best;
}

fn any_outside(at: vec2<i32>) -> bool {
    return at.x < 0 || at.y < 0 || at.x >= i32(rule.width) || at.y >= i32(rule.height);
}
