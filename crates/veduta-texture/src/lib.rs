//! Which photo textures which cell of a face.
//!
//! A Markov random field over a grid of cells, a label per photo: how well a photo shows a cell,
//! and how far two photos disagree where a seam would run between them. Kwatra et al. 2003
//! (Graphcut textures) for the cost of seams, Waechter et al. 2014 (Let there be color!) for
//! views as labels, Kolmogorov 2006 (Convergent tree-reweighted message passing) for the solver.

pub mod error;
pub mod grid;
pub mod solve;

pub use error::LabelError;
pub use grid::{Grid, Seam};
pub use solve::label;
