//! What can be wrong with the input of a solver.

use thiserror::Error;

/// An input that a chain cannot be built from.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ChainError {
    /// A buffer does not have the size that the others ask for.
    #[error("{name} has {got} values, {expected} are needed")]
    Size {
        /// Which buffer.
        name: &'static str,
        /// Its length.
        got: usize,
        /// The length that it must have.
        expected: usize,
    },
    /// A list of labels is empty, or holds a zero.
    #[error("{name} must hold at least one value, and none of them may be zero")]
    Labels {
        /// Which list.
        name: &'static str,
    },
}

/// Checks the length of one buffer.
pub(crate) fn expect_len(
    name: &'static str,
    got: usize,
    expected: usize,
) -> Result<(), ChainError> {
    if got == expected {
        Ok(())
    } else {
        Err(ChainError::Size {
            name,
            got,
            expected,
        })
    }
}
