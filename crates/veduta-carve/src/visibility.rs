//! Which points of a surface a camera sees: what is nearer hides what is behind it.

use crate::view::Projection;

/// The least depth (m) in each pixel; infinite where there is nothing.
#[derive(Debug, Clone)]
pub struct DepthMap {
    width: usize,
    height: usize,
    depths_m: Vec<f32>,
}

impl DepthMap {
    /// Every point covers what a ball of `radius_m` about it covers.
    pub fn of_points(
        projection: &Projection,
        [width, height]: [usize; 2],
        points: &[[f64; 3]],
        radius_m: f64,
    ) -> Self {
        let mut depths_m = vec![f32::INFINITY; width * height];
        for point in points {
            let ([x, y], depth) = projection.project(*point);
            if depth <= radius_m {
                continue;
            }
            let half = (projection.focal_px * radius_m / depth).max(0.5);
            let Some((left, right)) = covered(x, half, width) else {
                continue;
            };
            let Some((top, low)) = covered(y, half, height) else {
                continue;
            };
            for row in top..=low {
                for at in &mut depths_m[row * width + left..=row * width + right] {
                    *at = at.min(depth as f32);
                }
            }
        }
        Self {
            width,
            height,
            depths_m,
        }
    }

    /// Whether nothing lies more than `slack_m` before the depth.
    pub fn sees(&self, [x, y]: [f64; 2], depth_m: f64, slack_m: f64) -> bool {
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
        inside && {
            let nearest = self.depths_m[y as usize * self.width + x as usize];
            depth_m <= f64::from(nearest) + slack_m
        }
    }
}

/// The first and last pixel whose middle is in reach; None outside of the picture.
fn covered(at: f64, half: f64, size: usize) -> Option<(usize, usize)> {
    let (first, last) = ((at - half - 0.5).ceil(), (at + half - 0.5).floor());
    let seen = last >= 0.0 && first < size as f64 && first <= last;
    seen.then(|| (first.max(0.0) as usize, (last as usize).min(size - 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearer_of_two_points_hides_the_other() {
        let projection = Projection {
            rows: [
                [100.0, 0.0, 50.0, 0.0],
                [0.0, 100.0, 50.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
            ],
            focal_px: 100.0,
            centre_m: [0.0; 3],
        };
        let points = [[0.0, 0.0, 2.0], [0.0, 0.0, 3.0], [0.5, 0.0, 3.0]];
        let map = DepthMap::of_points(&projection, [100, 100], &points, 0.01);
        let seen = |point: [f64; 3]| {
            let (at, depth) = projection.project(point);
            map.sees(at, depth, 0.1)
        };
        assert_eq!(points.map(seen), [true, false, true]);
        assert!(!map.sees([-1.0, 5.0], 1.0, 0.1), "outside of the picture");
    }
}
