//! A lopsided body seen from a ring: the volume of the shader is that of the loops.

use veduta_carve::{hull, Projection, Root, View};
use veduta_gpu::carve::Carver;

use crate::card;

const SIZE: usize = 96;
const FOCAL: f64 = 120.0;
const AWAY: f64 = 3.0;

fn camera(angle: f64) -> Projection {
    let (s, c) = angle.sin_cos();
    let half = SIZE as f64 / 2.0;
    let (right, forward) = ([-s, c, 0.0, 0.0], [-c, -s, 0.0, AWAY]);
    let down = [0.0, 0.0, -1.0, 0.0];
    let lens = |axis: [f64; 4]| std::array::from_fn(|n| FOCAL * axis[n] + half * forward[n]);
    Projection {
        rows: [lens(right), lens(down), forward],
        focal_px: FOCAL,
        centre_m: [AWAY * c, AWAY * s, 0.0],
    }
}

/// Signed distances to an ellipse's outline, near enough: what matters is that both look at the same.
fn field(wide: f64) -> Vec<f32> {
    let middle = SIZE as f64 / 2.0;
    let of = |n: usize| {
        let x = ((n % SIZE) as f64 + 0.5 - middle) / wide;
        let y = (n / SIZE) as f64 + 0.5 - middle - 4.0;
        (x.hypot(y) - 25.0) as f32
    };
    (0..SIZE * SIZE).map(of).collect()
}

#[test]
fn the_shader_carves_what_the_loops_carve() {
    let Some(card) = card() else { return };
    let fields: Vec<Vec<f32>> = (0..40).map(|n| field(0.7 + 0.01 * f64::from(n))).collect();
    let view = |(n, field): (usize, &Vec<f32>)| View {
        projection: camera(n as f64 * 0.157),
        corner_px: [0.0; 2],
        width: SIZE,
        height: SIZE,
        distances_px: Box::leak(field.clone().into_boxed_slice()),
    };
    let views: Vec<View<'_>> = fields.iter().enumerate().map(view).collect();
    let root = Root {
        low_m: [-1.0, -0.9, -1.1],
        side_m: 2.0,
        levels: 6,
    };
    let wanted = hull::carve(&views, root).unwrap();
    let found = Carver::new(&card).carve(&card, &views, root).unwrap();
    assert!(wanted.inside() > 10_000);
    let side = root.voxels();
    let (mut most, mut turned) = (0.0_f32, 0);
    for at in 0..side.pow(3) {
        let voxel = [at / side / side, at / side % side, at % side];
        let (one, other) = (found.value(voxel), wanted.value(voxel));
        if (one < 0.0) != (other < 0.0) {
            turned += 1;
        }
        // Where one has values and the other a whole block, the block's stand for them.
        if other.abs() < 0.02 {
            most = most.max((one - other).abs());
        }
    }
    assert!(most < 1e-4, "{most}");
    assert!(turned <= 2, "{turned} voxels changed sides");
}
