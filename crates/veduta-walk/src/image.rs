//! A grey image, sampled between its pixels.

use crate::error::{want, WalkError};

/// Rows of a grey image; the centre of the upper left pixel is (0.5, 0.5).
#[derive(Debug, Clone)]
pub struct Grey {
    pub width: usize,
    pub height: usize,
    values: Vec<f32>,
}

impl Grey {
    pub fn new(width: usize, height: usize, values: Vec<f32>) -> Result<Self, WalkError> {
        want("an image", values.len(), width * height)?;
        if values.is_empty() {
            return Err(WalkError::Nothing);
        }
        Ok(Self {
            width,
            height,
            values,
        })
    }

    /// The value at a point, linear between the four pixels around it; None beyond their centres.
    #[inline]
    pub fn at(&self, x: f32, y: f32) -> Option<f32> {
        let (x, y) = (x - 0.5, y - 0.5);
        let inside = x >= 0.0 && y >= 0.0;
        if !inside || x > (self.width - 1) as f32 || y > (self.height - 1) as f32 {
            return None;
        }
        let (left, top) = (x as usize, y as usize);
        let (right, below) = (
            (left + 1).min(self.width - 1),
            (top + 1).min(self.height - 1),
        );
        let (u, v) = (x - left as f32, y - top as f32);
        let pixel = |column: usize, row: usize| self.values[row * self.width + column];
        let upper = pixel(left, top) * (1.0 - u) + pixel(right, top) * u;
        let lower = pixel(left, below) * (1.0 - u) + pixel(right, below) * u;
        Some(upper * (1.0 - v) + lower * v)
    }

    /// The patch of `2 radius + 1` squared samples about a point, one pixel apart; None where a
    /// sample lies outside.
    pub fn patch(&self, x: f32, y: f32, radius: i32, into: &mut [f32]) -> Option<()> {
        let mut next = 0;
        for row in -radius..=radius {
            for column in -radius..=radius {
                into[next] = self.at(x + column as f32, y + row as f32)?;
                next += 1;
            }
        }
        Some(())
    }
}
