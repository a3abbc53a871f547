//! What callers can do wrong.

use thiserror::Error;

/// What a filter or a flood cannot be made of.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum DriveError {
    #[error("a map of {width} by {height} cells needs as many distances, not {given}")]
    Size {
        width: usize,
        height: usize,
        given: usize,
    },
    #[error("a foreground point in column {column}, row {row} is outside of the image")]
    Seed { column: usize, row: usize },
    #[error("the side of a cell is no length: {cell_m}")]
    Cell { cell_m: f64 },
    #[error("{particles} particles: there must be 1 to {most}")]
    Particles { particles: usize, most: usize },
    #[error("{what} must be more than 0, not {value}")]
    Setting { what: &'static str, value: f64 },
}
