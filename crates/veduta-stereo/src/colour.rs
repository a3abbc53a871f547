//! The colours that views show of points of a surface.

use rayon::prelude::*;

use crate::consistent::Depths;

/// What the views so far show of a point: weighted colours (of 255), their weight, and how many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    pub colour: [f32; 3],
    pub weight: f32,
    pub views: f32,
}

/// Adds what a view shows of each point that its depths say it sees; where it faces the surface and
/// is near, it counts most. normals: unit, in the world. within_m: how far a depth may lie off.
pub fn add_colours(
    points: &[[f64; 3]],
    normals: &[[f32; 3]],
    view: &Depths<'_>,
    colours: &[[u8; 3]],
    within_m: f64,
    sums: &mut [Sum],
) {
    let eye = view.camera.eye();
    points
        .par_iter()
        .zip(normals)
        .zip(sums)
        .for_each(|((point, normal), sum)| {
            let seen = view.camera.seen(*point);
            let Some((u, v)) = view.cell(seen) else {
                return;
            };
            let depth = view.depth(u, v);
            if !depth.is_some_and(|depth| (depth - seen[2]).abs() <= within_m) {
                return;
            }
            let ray: [f64; 3] = std::array::from_fn(|i| eye[i] - point[i]);
            let length = crate::camera::dot(ray, ray).sqrt().max(1e-9);
            let facing = crate::camera::dot(ray, normal.map(f64::from)) / length;
            let weight = (facing.max(0.02) / length).powi(2) as f32;
            let own = colours[v * view.width + u];
            for axis in 0..3 {
                sum.colour[axis] += weight * f32::from(own[axis]);
            }
            sum.weight += weight;
            sum.views += 1.0;
        });
}
