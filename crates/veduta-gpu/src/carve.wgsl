// The silhouettes' test (4.1 to 4.3): a cube's sphere, or a voxel, in the picture of each view.

struct Grid {
    side: f32,
    voxel: f32,
    far: f32,
    cubes: u32,
    views: u32,
    words: u32,
    spare_a: u32,
    spare_b: u32,
}

@group(0) @binding(0) var<storage, read> grid: Grid;
@group(0) @binding(3) var<storage, read> cubes: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> open: array<u32>;
@group(0) @binding(5) var<storage, read_write> found: array<u32>;
@group(0) @binding(5) var<storage, read_write> values: array<f32>;

const OUTSIDE = 0u;
const INSIDE = 1u;
const BOUNDARY = 2u;
const BLOCK = 8u;

fn judged(view: u32, middle: vec3<f32>, radius: f32) -> u32 {
    let point = vec4<f32>(middle, 1.0);
    let depth = dot(views[view].row_z, point);
    if (depth <= -radius) {
        return OUTSIDE;
    }
    if (depth <= 1.01 * radius) {
        return BOUNDARY;
    }
    // (4.3)
    let pixel = vec2<f32>(dot(views[view].row_x, point), dot(views[view].row_y, point)) / depth;
    let slant = length(middle - views[view].centre) / depth;
    let reach = views[view].focal * slant * radius / (depth - radius) + 0.5;
    let distance = distance_px(view, pixel);
    if (distance > reach) {
        return OUTSIDE;
    }
    return select(BOUNDARY, INSIDE, distance < -reach);
}

// A thread for each cube: which of its open views stay so, and what it is.
@compute @workgroup_size(64)
fn judge(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    let cube = id.x + id.y * groups.x * 64u;
    if (cube >= grid.cubes) {
        return;
    }
    let middle = (vec3<f32>(cubes[cube].xyz) + 0.5) * grid.side;
    let radius = (grid.side / 2.0 + grid.voxel) * sqrt(3.0);
    var outside = false;
    var any = 0u;
    for (var word = 0u; word < grid.words; word++) {
        let given = open[cube * grid.words + word];
        var kept = 0u;
        for (var bit = 0u; bit < 32u; bit++) {
            if ((given >> bit & 1u) == 0u || outside) {
                continue;
            }
            let seen = judged(word * 32u + bit, middle, radius);
            outside = outside || seen == OUTSIDE;
            if (seen == BOUNDARY) {
                kept |= 1u << bit;
            }
        }
        open[cube * grid.words + word] = kept;
        any |= kept;
    }
    found[cube] = select(select(BOUNDARY, INSIDE, any == 0u), OUTSIDE, outside);
}

// A workgroup for each block, a thread for each row of its voxels: the largest distance to the cones.
@compute @workgroup_size(64)
fn measure(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) row: u32,
) {
    let cube = group.x + group.y * groups.x;
    if (cube >= grid.cubes) {
        return;
    }
    let first = cubes[cube].xyz * BLOCK + vec3<u32>(row / BLOCK, row % BLOCK, 0u);
    let start = (vec3<f32>(first) + 0.5) * grid.voxel;
    var most: array<f32, 8>;
    for (var z = 0u; z < BLOCK; z++) {
        most[z] = -grid.far;
    }
    for (var view = 0u; view < grid.views; view++) {
        if ((open[cube * grid.words + view / 32u] >> (view % 32u) & 1u) == 0u) {
            continue;
        }
        for (var z = 0u; z < BLOCK; z++) {
            let point = vec4<f32>(start.xy, start.z + f32(z) * grid.voxel, 1.0);
            let depth = dot(views[view].row_z, point);
            if (depth <= 0.0) {
                most[z] = grid.far;
                continue;
            }
            let across = vec2<f32>(dot(views[view].row_x, point), dot(views[view].row_y, point));
            let metres = distance_px(view, across / depth) * depth / views[view].focal;
            most[z] = max(most[z], min(metres, grid.far));
        }
    }
    for (var z = 0u; z < BLOCK; z++) {
        values[(cube * 64u + row) * BLOCK + z] = most[z];
    }
}
