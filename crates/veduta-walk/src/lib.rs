//! How one view of a landscape becomes the next one along a path.
//!
//! Komodakis et al., "morphable 3D-mosaics", section 3.4.1: a label of a node is where it lies in the
//! other view and at which of a few scales (`costs`); the labels together minimise a Potts energy
//! (`potts`: Besag's ICM, and Kolmogorov 2006's sequential tree-reweighted message passing, which
//! also says how much lower no labelling can be). `raster` draws what morphs, for judging it.

pub mod costs;
pub mod error;
pub mod grid;
pub mod image;
pub mod potts;
pub mod raster;

pub use error::WalkError;
