//! Animals in footage: how well the tapered capsules of a posed figure cover its silhouettes, and how
//! that changes with every joint and thickness.

pub mod cover;
pub mod error;

pub use cover::{cover, Capsules, Cover, Looked};
pub use error::CoverError;
