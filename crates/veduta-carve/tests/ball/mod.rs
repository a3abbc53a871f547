//! A ball about the origin, seen from a ring of cameras.

use veduta_carve::{Photo, Projection, Root, View};

pub const SIZE: usize = 120;
pub const FOCAL: f64 = 150.0;
pub const AWAY: f64 = 3.0;

/// A camera on the ring about z that looks at the origin.
pub fn camera(angle: f64, height: f64) -> Projection {
    let (across, up) = (height.cos(), height.sin());
    let back = [angle.cos() * across, angle.sin() * across, up];
    let right = [-angle.sin(), angle.cos(), 0.0];
    let forward = back.map(|one| -one);
    let down = [
        forward[1] * right[2] - forward[2] * right[1],
        forward[2] * right[0] - forward[0] * right[2],
        forward[0] * right[1] - forward[1] * right[0],
    ];
    let centre = back.map(|one| one * AWAY);
    let row = |axis: [f64; 3]| {
        let shift: f64 = (0..3).map(|n| axis[n] * centre[n]).sum();
        [axis[0], axis[1], axis[2], -shift]
    };
    let (x, y, z) = (row(right), row(down), row(forward));
    let half = SIZE as f64 / 2.0;
    Projection {
        rows: [
            std::array::from_fn(|n| FOCAL * x[n] + half * z[n]),
            std::array::from_fn(|n| FOCAL * y[n] + half * z[n]),
            z,
        ],
        focal_px: FOCAL,
        centre_m: centre,
    }
}

pub fn ring() -> Vec<Projection> {
    let height = |n: u32| if n % 2 == 0 { 0.2 } else { -0.4 };
    let angle = |n: u32| f64::from(n) * std::f64::consts::PI / 6.0;
    (0..12).map(|n| camera(angle(n), height(n))).collect()
}

/// The distances to the circle that a ball about the origin shows.
pub fn distances(radius: f64) -> Vec<f32> {
    let shown = FOCAL * radius / (AWAY * AWAY - radius * radius).sqrt();
    let middle = SIZE as f64 / 2.0;
    let place = |n: usize| [n % SIZE, n / SIZE].map(|one| one as f64 + 0.5 - middle);
    let of = |n: usize| (place(n)[0].hypot(place(n)[1]) - shown) as f32;
    (0..SIZE * SIZE).map(of).collect()
}

pub fn views<'a>(cameras: &[Projection], distances_px: &'a [f32]) -> Vec<View<'a>> {
    let of = |projection: &Projection| View {
        projection: *projection,
        corner_px: [0.0; 2],
        width: SIZE,
        height: SIZE,
        distances_px,
    };
    cameras.iter().map(of).collect()
}

pub fn root(levels: u32) -> Root {
    Root {
        low_m: [-1.0, -1.1, -0.9],
        side_m: 2.0,
        levels,
    }
}

/// What a camera sees of a ball about the origin.
pub fn photo(camera: &Projection, radius: f64) -> Vec<u8> {
    let (half, forward) = (SIZE as f64 / 2.0, camera.centre_m.map(|one| -one / AWAY));
    let axis = |n: usize| -> [f64; 3] {
        std::array::from_fn(|k| (camera.rows[n][k] - half * forward[k]) / FOCAL)
    };
    let (right, down) = (axis(0), axis(1));
    let colour = |n: usize| {
        let [x, y] = [n % SIZE, n / SIZE].map(|one| (one as f64 + 0.5 - half) / FOCAL);
        let ray: [f64; 3] = std::array::from_fn(|k| forward[k] + x * right[k] + y * down[k]);
        let a: f64 = ray.iter().map(|one| one * one).sum();
        let b: f64 = (0..3).map(|k| ray[k] * camera.centre_m[k]).sum();
        let root = b * b - a * (AWAY * AWAY - radius * radius);
        if root < 0.0 {
            return [0; 3];
        }
        let t = (-b - root.sqrt()) / a;
        [0, 1, 2].map(|k| (128.0 + 120.0 * (9.0 * (camera.centre_m[k] + t * ray[k])).sin()) as u8)
    };
    (0..SIZE * SIZE).flat_map(colour).collect()
}

/// The photos with what they show.
pub fn photos<'a>(cameras: &[Projection], pixels: &'a [Vec<u8>]) -> Vec<Photo<'a>> {
    let of = |(projection, pixels): (&Projection, &'a Vec<u8>)| Photo {
        projection: *projection,
        width: SIZE,
        height: SIZE,
        pixels,
    };
    cameras.iter().zip(pixels).map(of).collect()
}
