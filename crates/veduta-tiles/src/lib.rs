//! Many buildings as the buffers of one tile.
//!
//! Rules repeat themselves: a street has a few kinds of windows, hundreds of times. [`batch`] finds
//! pieces that are congruent (equal but for a motion), keeps one of each kind with the motions of all
//! (instances), and merges what is left by material. Positions are whole numbers of a millimetre or
//! so, vertices of one surface are shared, and there are no normals: all faces are flat. For what is
//! seen from farther away [`batch_whole`] makes faces without cracks between them.
//!
//! Frames: buildings come with x east, y north, z up (m); buffers are y-up, (x, z, -y), as glTF.

mod batch;
mod building;
mod compress;
mod mapping;
mod merge;
mod piece;
mod repeats;
mod standing;
mod whole;

pub use batch::{batch, batch_whole, Batch};
pub use building::Building;
pub use compress::{compress_attributes, compress_indices};
pub use merge::Merged;
pub use repeats::Repeated;
pub use standing::Standing;
