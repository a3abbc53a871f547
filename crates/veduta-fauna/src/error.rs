//! What callers can do wrong.

use thiserror::Error;

/// What cannot be compared.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum CoverError {
    #[error("{what} has {given} numbers, not {wanted}")]
    Size {
        what: &'static str,
        given: usize,
        wanted: usize,
    },
    #[error("a segment has no joint of number {joint}: there are {count}")]
    Joint { joint: usize, count: usize },
    #[error("an edge must be wider than 0, not {soft}")]
    Soft { soft: f32 },
}
