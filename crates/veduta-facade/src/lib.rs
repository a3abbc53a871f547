//! Hot loops of facade reading.
//!
//! Every solver here is an exact minimiser of a chain Markov random field (max-product, that is
//! Viterbi, in the min-sum form): the skyline over image columns, the floors over image rows and
//! the window stripes over image columns. Sources: Koutsourakis et al. 2009, sections 3.1 to 3.4.

pub mod columns;
pub mod error;
pub mod floors;
pub mod skyline;
pub mod sums;

pub use error::ChainError;
