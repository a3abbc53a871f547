//! The hot loops of street drives. Where a vehicle drives in a map of edges: Monte-Carlo
//! localisation. Which pixels of an image show what stands before the facades: [`flood`].
//!
//! Frueh and Zakhor 2001 (3D model generation for cities using aerial photographs and ground level
//! laser scans), after Fox et al. 2000: particles are poses that move as the vehicle does, are weighed
//! by how near the points of a horizontal scan come to edges of the map, and drawn anew. The same seed
//! gives the same particles on any number of threads.

pub mod error;
pub mod field;
pub mod filter;
pub mod flood;
pub mod random;

pub use error::DriveError;
pub use field::EdgeField;
pub use filter::{Estimate, Filter, Settings, Start};
pub use flood::{flood, FloodRules, Picture, Seed};
