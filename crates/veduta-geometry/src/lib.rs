//! Planar polygons in space, stored as columns: normals, areas and triangles.
//!
//! A set of polygons is three flat buffers ([`PolygonSet`]): vertex positions, the first vertex
//! of each ring, and the first ring of each polygon. The first ring of a polygon is its outline,
//! counter-clockwise seen from outside; the others are its holes. Nothing is allocated per
//! surface by the caller, so that a part of a million faces stays a handful of arrays.
//!
//! [`skeleton`] makes roofs over outlines. What may take long has a [`Budget`].

mod budget;
mod error;
mod plane;
mod polygon_set;
pub mod skeleton;
pub mod solid;
mod triangulate;

pub use budget::{Budget, Spent, Unlimited};
pub use error::PolygonError;
pub use glam;
pub use plane::{area_vector, Plane};
pub use polygon_set::PolygonSet;
pub use triangulate::{triangulate, triangulate_sound, SoundTriangulation, Triangulation};
