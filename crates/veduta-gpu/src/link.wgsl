// Chains of correspondences with a filter for each pixel: veduta_stereo's `link`.

struct Step {
    // Rectified from this view's pixels; the next view's pixels from rectified ones; the next view's
    // pixels from the reference's, at no inverse depth, and what an inverse depth of 1 adds.
    rectified: mat3x3<f32>,
    back: mat3x3<f32>,
    far: mat3x3<f32>,
    near: vec3<f32>,
    width: u32,
    height: u32,
    offset: u32,
    spare_a: u32,
    spare_b: u32,
}

struct Rule {
    width: u32,
    height: u32,
    // Steps up the sequence; the others lead down.
    up: u32,
    steps: u32,
    deviation: f32,
    most_deviations: f32,
    most_across: f32,
    near: f32,
    far: f32,
}

@group(0) @binding(0) var<storage, read> rule: Rule;
@group(0) @binding(1) var<storage, read> steps: array<Step>;
@group(0) @binding(2) var<storage, read> disparities: array<f32>;
// Inverse depth, its variance, the number of estimates: 0 where there is none.
@group(0) @binding(3) var<storage, read_write> found: array<vec4<f32>>;

const NONE = -1e8;

fn follow(at: vec2<f32>, first: u32, last: u32, begun: vec3<f32>) -> vec3<f32> {
    var filtered = begun;
    var spot = at;
    for (var number = first; number < last; number++) {
        // (3.3)
        let seen = steps[number].rectified * vec3<f32>(spot, 1.0);
        if (seen.z <= 0.0) {
            return filtered;
        }
        let place = seen.xy / seen.z;
        let size = vec2<f32>(f32(steps[number].width), f32(steps[number].height));
        if (any(place < vec2<f32>(0.0)) || any(place >= size)) {
            return filtered;
        }
        let column = vec2<u32>(place);
        let disparity =
            disparities[steps[number].offset + column.y * steps[number].width + column.x];
        if (disparity < NONE) {
            return filtered;
        }
        let next = steps[number].back * vec3<f32>(place.x + disparity, place.y, 1.0);
        if (next.z <= 0.0) {
            return filtered;
        }
        spot = next.xy / next.z;
        // The inverse depth at which the pixel is seen nearest to the spot.
        let far = steps[number].far * vec3<f32>(at, 1.0);
        let near = steps[number].near;
        let e = far.xy - spot * far.z;
        let g = near.xy - spot * near.z;
        let inverse = -dot(e, g) / dot(g, g);
        let depth = far.z + near.z * inverse;
        if (!(inverse >= 1.0 / rule.far && inverse <= 1.0 / rule.near && depth > 0.0)) {
            return filtered;
        }
        let shown = (far.xy + near.xy * inverse) / depth;
        let off = shown - spot;
        if (dot(off, off) > rule.most_across * rule.most_across) {
            return filtered;
        }
        let pace = length((near.xy - shown * near.z) / depth);
        let deviation = rule.deviation / pace;
        let variance = deviation * deviation * f32(number - first + 1u);
        if (filtered.z == 0.0) {
            filtered = vec3<f32>(inverse, variance, 1.0);
            continue;
        }
        let both = filtered.y + variance;
        let wrong = inverse - filtered.x;
        if (wrong * wrong > rule.most_deviations * rule.most_deviations * both) {
            return filtered;
        }
        let gain = filtered.y / both;
        filtered.x += gain * wrong;
        filtered.y *= 1.0 - gain;
        filtered.z += 1.0;
    }
    return filtered;
}

@compute @workgroup_size(64)
fn link(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
) {
    let pixel = id.x + id.y * grid.x * 64u;
    if (pixel >= rule.width * rule.height) {
        return;
    }
    let at = vec2<f32>(vec2<u32>(pixel % rule.width, pixel / rule.width)) + 0.5;
    let up = follow(at, 0u, rule.up, vec3<f32>(0.0));
    found[pixel] = vec4<f32>(follow(at, rule.up, rule.steps, up), 0.0);
}
