//! Shapes: an oriented box, and geometry in shares of that box.

mod components;
mod form;
mod scope;
mod sizes;
mod splitting;

pub use components::{components, is_selected, Component, Direction, Kind};
pub use form::{rectangle, Form, Geometry, TOLERANCE};
pub use scope::{over, Scope};
pub use sizes::{cells, Cell, Pattern, Size, TooManyParts, SHORTEST_M};
pub use splitting::split;
