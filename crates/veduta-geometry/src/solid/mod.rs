//! Solids and sheets made of planar faces with holes: what a grammar's operations work on.

mod cut;
mod extrude;
mod loops;
mod mesh;
mod primitives;
mod roofs;

pub use cut::{cut, Piece, Sides};
pub use extrude::extrude;
pub use mesh::{Face, Mesh};
pub use primitives::{cube, quad};
pub use roofs::{roofed, RoofKind};
