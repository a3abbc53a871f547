//! A map as the distance of each cell to its nearest edge.

use crate::error::DriveError;

/// Distances (m) to the nearest edge, row by row from the lower left; `low` is the outer corner there.
/// Where something stands that a scan cannot look through they are negative.
#[derive(Debug, Clone)]
pub struct EdgeField {
    distance_m: Vec<f32>,
    width: usize,
    height: usize,
    low: [f64; 2],
    cell_m: f64,
}

impl EdgeField {
    /// NaN: nothing is known of a cell.
    pub fn new(
        distance_m: Vec<f32>,
        width: usize,
        height: usize,
        low: [f64; 2],
        cell_m: f64,
    ) -> Result<Self, DriveError> {
        let given = distance_m.len();
        if width == 0 || height == 0 || width.checked_mul(height) != Some(given) {
            return Err(DriveError::Size {
                width,
                height,
                given,
            });
        }
        if !(cell_m > 0.0 && cell_m.is_finite()) {
            return Err(DriveError::Cell { cell_m });
        }
        Ok(Self {
            distance_m,
            width,
            height,
            low,
            cell_m,
        })
    }

    /// The distance at a place; None outside of the map and where nothing is known.
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> Option<f32> {
        let column = (x - self.low[0]) / self.cell_m;
        let row = (y - self.low[1]) / self.cell_m;
        if !(column >= 0.0 && row >= 0.0) {
            return None;
        }
        let (column, row) = (column as usize, row as usize);
        if column >= self.width || row >= self.height {
            return None;
        }
        let found = self.distance_m[row * self.width + column];
        (!found.is_nan()).then_some(found)
    }
}
