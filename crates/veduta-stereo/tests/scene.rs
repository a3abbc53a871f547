//! A wall with a pattern, seen by cameras that stand side by side.

use veduta_stereo::camera::Vector;
use veduta_stereo::{Camera, Grey};

pub const WIDTH: usize = 96;
pub const HEIGHT: usize = 72;
const FOCAL: f64 = 90.0;

/// A camera at a point that looks along +z, turned by `yaw` about the upright axis.
pub fn camera(at: Vector, yaw: f64) -> Camera {
    let (s, c) = yaw.sin_cos();
    let turn = [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]];
    let shift = std::array::from_fn(|i| -(0..3).map(|j| turn[i][j] * at[j]).sum::<f64>());
    let centre = [WIDTH as f64 / 2.0, HEIGHT as f64 / 2.0];
    Camera::new([FOCAL, FOCAL], centre, turn, shift).unwrap()
}

/// The depth of the wall z = 4 + slant * x along a pixel's ray.
pub fn wall_depth(camera: &Camera, px: [f64; 2], slant: f64) -> f64 {
    let eye = camera.eye();
    let far = camera.point(px, 1.0);
    let ray: Vector = std::array::from_fn(|i| far[i] - eye[i]);
    (4.0 + slant * eye[0] - eye[2]) / (ray[2] - slant * ray[0])
}

/// A pattern without repetition, smooth at the size of a pixel.
fn pattern(x: f64, y: f64) -> f64 {
    let waves = (7.1 * x).sin() * (6.3 * y + 1.0).cos()
        + (13.7 * x + 4.0 * y).sin()
        + (11.0 * y - 3.3 * x).cos()
        + 0.6 * (23.0 * x + 17.0 * y).sin();
    128.0 + 30.0 * waves
}

pub fn picture(camera: &Camera, slant: f64) -> Grey {
    let mut values = Vec::with_capacity(WIDTH * HEIGHT);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let px = [x as f64 + 0.5, y as f64 + 0.5];
            let point = camera.point(px, wall_depth(camera, px, slant));
            values.push(pattern(point[0], point[1]).clamp(0.0, 255.0).round() as u8);
        }
    }
    Grey::new(WIDTH, HEIGHT, &values).unwrap()
}

pub fn depths(camera: &Camera, slant: f64) -> Vec<f32> {
    (0..WIDTH * HEIGHT)
        .map(|i| {
            let px = [(i % WIDTH) as f64 + 0.5, (i / WIDTH) as f64 + 0.5];
            wall_depth(camera, px, slant) as f32
        })
        .collect()
}
