//! What can be wrong with the matches of two photos.

use thiserror::Error;

/// Matches that no geometry can be found from.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MatchError {
    /// The two photos have different numbers of matched points.
    #[error("{first} points of the first photo, {second} of the second")]
    Unequal {
        /// Points of the first photo.
        first: usize,
        /// Points of the second photo.
        second: usize,
    },
    /// A coordinate is not a number.
    #[error("match {at} is not finite")]
    NotFinite {
        /// Its place in the list.
        at: usize,
    },
    /// A linear method asks for more.
    #[error("{got} matches, {needed} are needed")]
    TooFew {
        /// How many there are.
        got: usize,
        /// How many there must be.
        needed: usize,
    },
    /// The matches do not determine the matrix.
    #[error("the matches do not determine the matrix: they lie together, or one lies in another")]
    Degenerate,
}
