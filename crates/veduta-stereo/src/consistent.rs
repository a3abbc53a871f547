//! Which depths the other views agree with, and how many do.

use rayon::prelude::*;

use crate::camera::Camera;

/// A depth map: metres along z, NaN where unknown, row by row.
#[derive(Clone, Copy)]
pub struct Depths<'a> {
    pub camera: Camera,
    pub width: usize,
    pub height: usize,
    pub depths: &'a [f32],
}

/// When two views agree about a point.
#[derive(Clone, Copy, Debug)]
pub struct Agreement {
    /// Pixels by which the way there and back may miss.
    pub most_px: f64,
    /// Share by which the depths may differ, where half a pixel of the two views' parallax is less.
    pub most_share: f64,
}

/// The share by which depths may differ at most, however small the parallax.
const LOOSEST: f64 = 0.05;

impl Depths<'_> {
    /// Column and row of a point in the camera's frame; None outside.
    pub fn cell(&self, seen: [f64; 3]) -> Option<(usize, usize)> {
        if seen[2] <= 0.0 {
            return None;
        }
        let [u, v] = self.camera.pixel(seen);
        let inside = u >= 0.0 && v >= 0.0 && u < self.width as f64 && v < self.height as f64;
        inside.then_some((u as usize, v as usize))
    }

    pub fn depth(&self, x: usize, y: usize) -> Option<f64> {
        let depth = f64::from(self.depths[y * self.width + x]);
        (depth > 0.0).then_some(depth)
    }

    pub fn centre(x: usize, y: usize) -> [f64; 2] {
        [x as f64 + 0.5, y as f64 + 0.5]
    }
}

impl Agreement {
    /// The pixel of the other view that shows the same point, where it does.
    pub fn seen_by(
        &self,
        own: &Depths<'_>,
        at: (usize, usize),
        depth: f64,
        other: &Depths<'_>,
    ) -> Option<(usize, usize)> {
        let px = Depths::centre(at.0, at.1);
        let seen = other.camera.seen(own.camera.point(px, depth));
        let (u, v) = other.cell(seen)?;
        let there = other.depth(u, v)?;
        if (there - seen[2]).abs() > self.share(own, other, seen[2]) * seen[2] {
            return None;
        }
        // The other depth is taken along the ray of the point itself: a slanted wall differs
        // between the point and the middle of the pixel.
        let back = own
            .camera
            .seen(other.camera.point(other.camera.pixel(seen), there));
        if back[2] <= 0.0 {
            return None;
        }
        let [x, y] = own.camera.pixel(back);
        let away = (x - px[0]).hypot(y - px[1]);
        (away <= self.most_px).then_some((u, v))
    }

    /// What half a pixel of parallax is at a depth, but within bounds.
    fn share(&self, own: &Depths<'_>, other: &Depths<'_>, depth: f64) -> f64 {
        let (first, second) = (own.camera.eye(), other.camera.eye());
        let apart: [f64; 3] = std::array::from_fn(|i| first[i] - second[i]);
        let baseline = crate::camera::dot(apart, apart).sqrt();
        let half = 0.5 * depth / (other.camera.focal[0] * baseline).max(1e-12);
        half.clamp(self.most_share, LOOSEST.max(self.most_share))
    }

    /// For each pixel the number of other views that agree with its depth.
    pub fn counts(&self, own: &Depths<'_>, others: &[Depths<'_>]) -> Vec<u8> {
        (0..own.width * own.height)
            .into_par_iter()
            .map(|i| {
                let at = (i % own.width, i / own.width);
                let Some(depth) = own.depth(at.0, at.1) else {
                    return 0;
                };
                let agree = others
                    .iter()
                    .filter(|other| self.seen_by(own, at, depth, other).is_some());
                agree.count().min(255) as u8
            })
            .collect()
    }
}
