//! Compute shaders (WGSL) on any maker's graphics card, beside the loops for processors.
//!
//! `carve` has the silhouettes' test of chapter 4 of Moslah's thesis (4.1 to 4.3) as an engine for
//! `veduta_carve`'s octree, and `sweep` the colours' consistency for its sweeps; `pair` and `link` have the matching of rectified pairs and the linking of
//! chapter 3; `search` has the PatchMatch of `veduta_stereo`. Each finds what the crate
//! for processors finds; tests hold them against each other.
//! `card` is the graphics card: it may vanish at any moment, and then says so.

pub mod card;
pub mod carve;
mod error;
pub mod link;
pub mod pair;
pub mod search;
pub mod sweep;
mod views;

pub use card::Card;
pub use error::GpuError;
