//! Shapes: an oriented box, and geometry in shares of that box.

mod asset;
mod components;
mod connected;
mod distances;
mod form;
mod scope;
mod selecting;
mod sizes;
mod splitting;
mod surroundings;

pub use asset::{Asset, AssetFaces, Instance, Labels, Lies, Slot, SlotTexture, View};
pub use components::{components, direction, is_selected, Component, Direction, Kind};
pub use connected::connected;
pub use distances::box_distance;
pub use form::{rectangle, Form, Geometry, TOLERANCE};
pub use scope::{degrees_of, over, turn, Scope};
pub use selecting::{is_meant, Frames};
pub use sizes::{cells, Cell, Pattern, Size, TooManyParts, SHORTEST_M};
pub use splitting::split;
pub use surroundings::{surroundings, RoofEdge, Surroundings};
