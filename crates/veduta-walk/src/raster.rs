//! Triangles drawn into buffers: the depth of each pixel, and what its vertices carry.

use rayon::prelude::*;

use crate::error::{want, WalkError};

/// Vertices as a camera sees them (x and y in pixels, depth in metres) with `width` values each, and
/// triangles of them.
pub struct Scene<'a> {
    pub screen: &'a [[f32; 3]],
    pub carried: &'a [f32],
    pub width: usize,
    pub triangles: &'a [[u32; 3]],
}

/// Row by row: the depth of each pixel (infinite where nothing is), what it carries, and which
/// triangle it is (-1: none).
pub struct Drawn {
    pub depth: Vec<f32>,
    pub carried: Vec<f32>,
    pub triangle: Vec<i32>,
}

const ROWS_AT_ONCE: usize = 32;

/// Draws the nearest surface of each pixel's centre; a triangle with a vertex nearer than `near` is
/// left out.
pub fn rasterise(scene: &Scene<'_>, size: (usize, usize), near: f32) -> Result<Drawn, WalkError> {
    let (width, height) = size;
    want(
        "what vertices carry",
        scene.carried.len(),
        scene.screen.len() * scene.width,
    )?;
    let beyond = scene
        .triangles
        .iter()
        .flatten()
        .find(|&&v| v as usize >= scene.screen.len());
    if let Some(&vertex) = beyond {
        return Err(WalkError::Index {
            what: "a vertex",
            value: vertex.into(),
            count: scene.screen.len(),
        });
    }
    let mut depth = vec![f32::INFINITY; width * height];
    let mut triangle = vec![-1_i32; width * height];
    let mut carried = vec![0.0_f32; width * height * scene.width];
    if width * height == 0 {
        return Ok(Drawn {
            depth,
            carried,
            triangle,
        });
    }
    let bands = band_lists(scene, height, near);
    let cells = ROWS_AT_ONCE * width;
    depth
        .par_chunks_mut(cells)
        .zip(triangle.par_chunks_mut(cells))
        .zip(carried.par_chunks_mut((cells * scene.width).max(1)))
        .zip(&bands)
        .enumerate()
        .for_each(|(number, (((depth, triangle), carried), list))| {
            let mut band = Band {
                top: number * ROWS_AT_ONCE,
                width,
                depth,
                triangle,
            };
            for &which in list {
                band.draw(scene, which);
            }
            band.carry(scene, carried);
        });
    Ok(Drawn {
        depth,
        carried,
        triangle,
    })
}

/// The triangles that touch each band of rows, in their order.
fn band_lists(scene: &Scene<'_>, height: usize, near: f32) -> Vec<Vec<u32>> {
    let mut bands = vec![Vec::new(); height.div_ceil(ROWS_AT_ONCE)];
    for (which, corners) in scene.triangles.iter().enumerate() {
        let points = corners.map(|v| scene.screen[v as usize]);
        if points
            .iter()
            .any(|p| !(p[2] >= near && p[0].is_finite() && p[1].is_finite()))
        {
            continue;
        }
        let low = points.iter().fold(f32::INFINITY, |low, p| low.min(p[1]));
        let high = points
            .iter()
            .fold(f32::NEG_INFINITY, |high, p| high.max(p[1]));
        if high < 0.0 || low >= height as f32 {
            continue;
        }
        let first = low.max(0.0) as usize / ROWS_AT_ONCE;
        let last = (high.min(height as f32 - 0.5)) as usize / ROWS_AT_ONCE;
        for band in &mut bands[first..=last] {
            band.push(which as u32);
        }
    }
    bands
}

struct Band<'a> {
    top: usize,
    width: usize,
    depth: &'a mut [f32],
    triangle: &'a mut [i32],
}

impl Band<'_> {
    fn draw(&mut self, scene: &Scene<'_>, which: u32) {
        let Some(shape) = Shape::of(scene, which) else {
            return;
        };
        let rows = self.depth.len() / self.width;
        let (low, high) = shape.extent(1);
        let first = ((low - 0.5 - self.top as f32).ceil().max(0.0)) as usize;
        let last = (high - 0.5 - self.top as f32)
            .floor()
            .min(rows as f32 - 1.0);
        if last < 0.0 {
            return;
        }
        let (left, right) = shape.extent(0);
        let begin = (left - 0.5).ceil().max(0.0) as usize;
        let end = (right - 0.5).floor().min(self.width as f32 - 1.0);
        if end < 0.0 {
            return;
        }
        for row in first..=last as usize {
            for column in begin..=end as usize {
                let y = (self.top + row) as f32 + 0.5;
                let Some(shares) = shape.shares(column as f32 + 0.5, y) else {
                    continue;
                };
                let nearness: f32 = (0..3).map(|k| shares[k] * shape.nearness[k]).sum();
                let at = row * self.width + column;
                if 1.0 / nearness < self.depth[at] {
                    self.depth[at] = 1.0 / nearness;
                    self.triangle[at] = which as i32;
                }
            }
        }
    }

    /// What the drawn surfaces carry, right in perspective.
    fn carry(&self, scene: &Scene<'_>, into: &mut [f32]) {
        if scene.width == 0 {
            return;
        }
        for (at, values) in into.chunks_mut(scene.width).enumerate() {
            let which = self.triangle[at];
            if which < 0 {
                continue;
            }
            let Some(shape) = Shape::of(scene, which as u32) else {
                continue;
            };
            let x = (at % self.width) as f32 + 0.5;
            let y = (self.top + at / self.width) as f32 + 0.5;
            let Some(shares) = shape.shares(x, y) else {
                continue;
            };
            let corners = scene.triangles[which as usize];
            for k in 0..3 {
                let part = shares[k] * shape.nearness[k] * self.depth[at];
                let own = &scene.carried[corners[k] as usize * scene.width..][..scene.width];
                for (value, carried) in values.iter_mut().zip(own) {
                    *value += part * carried;
                }
            }
        }
    }
}

struct Shape {
    points: [[f32; 3]; 3],
    nearness: [f32; 3],
    area: f32,
}

impl Shape {
    fn of(scene: &Scene<'_>, which: u32) -> Option<Self> {
        let points = scene.triangles[which as usize].map(|v| scene.screen[v as usize]);
        let area = cross(points[0], points[1], points[2][0], points[2][1]);
        (area.abs() > 1e-9).then(|| Self {
            points,
            nearness: points.map(|p| 1.0 / p[2]),
            area,
        })
    }

    fn extent(&self, axis: usize) -> (f32, f32) {
        let of = |k: usize| self.points[k][axis];
        (of(0).min(of(1)).min(of(2)), of(0).max(of(1)).max(of(2)))
    }

    /// The share of each vertex at a point of the picture; None outside.
    fn shares(&self, x: f32, y: f32) -> Option<[f32; 3]> {
        let [a, b, c] = self.points;
        let shares = [
            cross(b, c, x, y) / self.area,
            cross(c, a, x, y) / self.area,
            cross(a, b, x, y) / self.area,
        ];
        shares.iter().all(|share| *share >= -1e-6).then_some(shares)
    }
}

fn cross(a: [f32; 3], b: [f32; 3], x: f32, y: f32) -> f32 {
    (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
}
