//! Objects carved out of a volume by calibrated photos: chapter 4 of Moslah's thesis.
//!
//! `hull` sorts the cubes of an octree into those outside of a silhouette, those inside of all, and
//! those on a boundary, which it divides (4.3.2); what is left are blocks of signed evidence, less
//! than zero inside. `colours` and `sweep` look at what the photos show of the surface.

pub mod colours;
mod deepen;
mod error;
pub mod hull;
pub mod judging;
pub mod raster;
pub mod sweep;
mod view;
mod visibility;
mod volume;

pub use error::CarveError;
pub use view::{Photo, Projection, View};
pub use volume::{Root, Volume, BLOCK, IN_BLOCK};
