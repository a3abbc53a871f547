//! Depth from calibrated views.
//!
//! `pair` and `path` match two rectified pictures and `link` takes the matches along a sequence to
//! depths (chapter 3 of Moslah's thesis).
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
pub mod link;
pub mod nets;
pub mod pair;
pub mod patch;
pub mod path;
pub mod planes;
pub mod search;
pub mod volume;

pub use camera::Camera;
pub use error::StereoError;
pub use grey::Grey;
