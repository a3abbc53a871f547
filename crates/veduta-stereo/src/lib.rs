//! Depth from calibrated views.
//!
//! `search` finds a plane for each pixel by PatchMatch, `consistent` keeps the depths on which views
//! agree, `fuse` makes them one cloud, `volume` and `nets` a surface, `colour` its colours.

pub mod camera;
pub mod chance;
pub mod colour;
pub mod consistent;
pub mod error;
pub mod fuse;
pub mod grey;
pub mod nets;
pub mod patch;
pub mod planes;
pub mod search;
pub mod volume;

pub use camera::Camera;
pub use error::StereoError;
pub use grey::Grey;
