//! Solids and sheets made of planar faces with holes: what a grammar's operations work on.

mod boolean;
mod cleanup;
mod cut;
mod dissolve;
mod envelope;
mod extrude;
mod inner_rectangle;
mod inset;
mod laid;
mod level;
mod loops;
mod mesh;
mod normals;
mod points_near;
mod primitives;
mod pyramids;
mod roofs;
mod triangles;
mod weld;

pub use boolean::{boolean, boolean_within, relation, Boolean, BooleanError, Combined, Relation};
pub use cleanup::{cleaned, Cleaning};
pub use cut::{cut, Piece, Sides};
pub use dissolve::{dissolve, Corner, Sheet};
pub use envelope::{envelope, envelope_within, Bound};
pub use extrude::extrude;
pub use inner_rectangle::inner_rectangle;
pub use inset::{inset, inset_within, merged, outset, outset_within, Outset, Pieces};
pub use laid::{laid_together, patches, Patch, Rise};
pub use mesh::{Face, Mesh};
pub use normals::point_normals;
pub use primitives::{cone, cube, cylinder, disk, quad, sphere};
pub use pyramids::pyramids;
pub use roofs::{roofed, roofed_over, roofed_within, Along, Gables, Overhang, RoofKind};
pub use triangles::triangles;
pub use weld::{joined, weld};
