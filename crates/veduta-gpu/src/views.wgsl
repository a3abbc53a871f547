// Views of an object: where a point lies in each, and how far that is from the silhouette's outline.

struct View {
    // (4.1), (4.2): pixels and depth of a point; the fourth column counts from the root's corner.
    row_x: vec4<f32>,
    row_y: vec4<f32>,
    row_z: vec4<f32>,
    centre: vec3<f32>,
    focal: f32,
    corner: vec2<f32>,
    size: vec2<u32>,
    offset: u32,
    spare_a: u32,
    spare_b: u32,
    spare_c: u32,
}

@group(0) @binding(1) var<storage, read> views: array<View>;
@group(0) @binding(2) var<storage, read> distances: array<f32>;

fn value(view: u32, column: u32, row: u32) -> f32 {
    return distances[views[view].offset + row * views[view].size.x + column];
}

// Between the four pixels around; beyond the border that of the border.
fn distance_px(view: u32, at: vec2<f32>) -> f32 {
    let most = vec2<f32>(views[view].size - vec2<u32>(1u));
    let place = clamp(at - views[view].corner - 0.5, vec2<f32>(0.0), most);
    let low = vec2<u32>(place);
    let high = min(low + 1u, views[view].size - vec2<u32>(1u));
    let part = place - vec2<f32>(low);
    let upper = value(view, low.x, low.y) * (1.0 - part.x) + value(view, high.x, low.y) * part.x;
    let lower = value(view, low.x, high.y) * (1.0 - part.x) + value(view, high.x, high.y) * part.x;
    return upper * (1.0 - part.y) + lower * part.y;
}

// (4.1), (4.2), (4.3): the pixel, and the depth.
fn projected(view: u32, place: vec3<f32>) -> vec3<f32> {
    let point = vec4<f32>(place, 1.0);
    let depth = dot(views[view].row_z, point);
    let across = vec2<f32>(dot(views[view].row_x, point), dot(views[view].row_y, point));
    return vec3<f32>(across / depth, depth);
}
