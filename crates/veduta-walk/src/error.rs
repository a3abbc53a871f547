//! What callers can do wrong.

use thiserror::Error;

/// Shapes that do not belong together, with their numbers.
#[derive(Debug, Error, Clone, PartialEq, Eq)]
pub enum WalkError {
    #[error("{what} must have {wanted} values, not {given}")]
    Length {
        what: &'static str,
        wanted: usize,
        given: usize,
    },
    #[error("there is no label, or none of the images of the scales")]
    Nothing,
    #[error("{what} {value} is not one of {count}")]
    Index {
        what: &'static str,
        value: i64,
        count: usize,
    },
}

/// An error unless a column has the length that it should have.
pub fn want(what: &'static str, given: usize, wanted: usize) -> Result<(), WalkError> {
    if given == wanted {
        return Ok(());
    }
    Err(WalkError::Length {
        what,
        wanted,
        given,
    })
}
