//! A grey picture, with the four pixels around each corner side by side for quick sampling.

use crate::error::StereoError;

#[derive(Clone, Debug)]
pub struct Grey {
    pub width: usize,
    pub height: usize,
    /// Row by row: the pixel, those right of it, below it, and below to the right.
    fours: Vec<[u8; 4]>,
}

impl Grey {
    pub fn new(width: usize, height: usize, values: &[u8]) -> Result<Self, StereoError> {
        if width < 2 || height < 2 || values.len() != width * height {
            return Err(StereoError::Size {
                width,
                height,
                given: values.len(),
            });
        }
        let mut fours = Vec::with_capacity(values.len());
        for y in 0..height {
            let below = (y + 1).min(height - 1);
            for x in 0..width {
                let right = (x + 1).min(width - 1);
                fours.push([
                    values[y * width + x],
                    values[y * width + right],
                    values[below * width + x],
                    values[below * width + right],
                ]);
            }
        }
        Ok(Self {
            width,
            height,
            fours,
        })
    }

    /// The pixels, row by row.
    pub fn values(&self) -> impl Iterator<Item = u8> + '_ {
        self.fours.iter().map(|four| four[0])
    }

    #[inline]
    pub fn at(&self, x: usize, y: usize) -> f32 {
        f32::from(self.fours[y * self.width + x][0])
    }

    /// Bilinear value at a point from (0.5, 0.5) on, the first pixel's centre; clamped to the border.
    #[inline]
    pub fn sample(&self, x: f32, y: f32) -> f32 {
        let u = (x - 0.5).clamp(0.0, (self.width - 1) as f32);
        let v = (y - 0.5).clamp(0.0, (self.height - 1) as f32);
        // Both are positive: a cast through i32 is one instruction where one through usize is many.
        let (column, row) = (u as i32, v as i32);
        let (a, b) = (u - column as f32, v - row as f32);
        let four = self.fours[row as usize * self.width + column as usize].map(f32::from);
        let upper = four[0] + a * (four[1] - four[0]);
        let lower = four[2] + a * (four[3] - four[2]);
        upper + b * (lower - upper)
    }

    /// As `sample` at many points; in steps that the compiler makes of several points at once, where
    /// `sample` looks at one after the other.
    #[inline]
    pub fn samples<const N: usize>(&self, xs: &[f32; N], ys: &[f32; N]) -> [f32; N] {
        let (right, low) = ((self.width - 1) as f32, (self.height - 1) as f32);
        let (mut columns, mut rows) = ([0i32; N], [0i32; N]);
        let (mut across, mut down) = ([0.0f32; N], [0.0f32; N]);
        for i in 0..N {
            let (u, v) = (
                (xs[i] - 0.5).max(0.0).min(right),
                (ys[i] - 0.5).max(0.0).min(low),
            );
            columns[i] = u as i32;
            rows[i] = v as i32;
            across[i] = u - columns[i] as f32;
            down[i] = v - rows[i] as f32;
        }
        let mut fours = [0u32; N];
        for i in 0..N {
            let at = rows[i] as usize * self.width + columns[i] as usize;
            fours[i] = u32::from_le_bytes(self.fours[at]);
        }
        std::array::from_fn(|i| {
            let value = |place: u32| (fours[i] >> (8 * place) & 255) as i32 as f32;
            let upper = value(0) + across[i] * (value(1) - value(0));
            let lower = value(2) + across[i] * (value(3) - value(2));
            upper + down[i] * (lower - upper)
        })
    }
}
