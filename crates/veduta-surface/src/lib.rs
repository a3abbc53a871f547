//! Surfaces out of volumes.
//!
//! A volume is sampled values on a grid, less than a level inside. The surface at that level comes as
//! triangles that share their vertices, counter-clockwise seen from outside. Every edge has two
//! triangles and every vertex one ring of them, whatever the values are: where the plain surface nets
//! (Gibson 1998) would let sheets touch in a vertex or an edge, each sheet gets a vertex of its own
//! (dual marching cubes, Nielson 2004; Wenger 2013 for the faces that both neighbours join twice).
//!
//! Beside that: how far points lie from a mesh, and on which side of it; what hangs together in one.

mod active;
mod cell;
mod error;
mod nearest;
mod nets;
mod pieces;
mod quads;
mod samples;
mod tree;
mod triangle;

pub use error::SurfaceError;
pub use nearest::{nearest_on_mesh, Nearest};
pub use nets::{surface_nets, Surface};
pub use pieces::vertex_pieces;
pub use samples::{Grid, Samples};
