//! Roofs over any outline: the weighted straight skeleton.
//!
//! Every edge of the eaves moves inwards at its own speed, and the wavefront of all edges shrinks,
//! splits and vanishes. With time as height, each edge draws a planar face, and the faces are a
//! roof: a hip roof where all speeds are the same, gables where some are 0, a mansard, a setback or
//! a flat top where it stops at a height.
//!
//! ```
//! use veduta_geometry::skeleton::{roof, Eaves};
//!
//! let house = vec![[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]];
//! let hip = roof(&Eaves::even(&[house.clone()])?, None)?;
//! assert_eq!((hip.nodes_m.len(), hip.faces.len()), (6, 4));
//! let gable = roof(&Eaves::new(&[house], &[1.0, 0.0, 1.0, 0.0])?, None)?;
//! assert!((gable.nodes_m[4][2] - 4.0).abs() < 1e-9);
//! # Ok::<(), veduta_geometry::skeleton::SkeletonError>(())
//! ```
//!
//! # How it stays sound
//!
//! Outlines of houses are full of coincidences, and a wavefront in plain doubles breaks where many
//! events happen at one time and place. Three things keep it whole:
//!
//! - Lines are turned and shifted by 3e-14, so that no two events coincide (`planes`); only edges
//!   that share a line coincide still, and those have rules (`events`).
//! - Times and places are computed with 32 digits (`double_double`), so that the order of events
//!   is the true order of the shifted lines.
//! - Nodes that are one in truth are made one after, and put on the true planes (`nodes`). The
//!   roof is then checked against the true eaves (`check`), and tried again with other shifts
//!   where it fails.
//!
//! Wavefront edges that meet on the way, parallel and of different speeds, have no straight skeleton
//! of their own: here the faster takes over. At the eaves a standing step is put between them.
//!
//! Rejected: grouping events by time and place within a tolerance, because no tolerance separates
//! a bay of 1 mm from a coincidence on a regular polygon of 500 edges; and exact rational
//! numbers, because normals of unit length are not rational. Dropping splits that come later than
//! the end of their corner halves the memory, but the searches after every change of a neighbour
//! make roofs of usual size slower by a fifth.

mod check;
mod clean;
mod corner;
mod double_double;
mod eaves;
mod error;
mod events;
mod front;
mod nodes;
mod planes;
mod rings;
mod roof;
mod simple;
mod sweep;
pub mod tolerance;
mod touch;

pub use check::{check, Soundness};
pub use clean::{clean, Cleaned};
pub use eaves::Eaves;
pub use error::{RoofFault, SkeletonError};
pub use roof::{roof, roof_within, FaceOrigin, Level, Roof, RoofFace};
