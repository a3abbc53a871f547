//! What can be wrong with views and depth maps.

use thiserror::Error;

#[derive(Debug, Error, PartialEq)]
pub enum StereoError {
    #[error("a picture of {width} x {height} pixels has {given} values")]
    Size {
        width: usize,
        height: usize,
        given: usize,
    },
    #[error("depths from {near} to {far} are no range")]
    Range { near: f32, far: f32 },
    #[error("a pair cannot be matched so: rows odd and at most 63, 1 to 1024 disparities, the same height")]
    Pair,
    #[error("no neighbour is given")]
    NoNeighbour,
    #[error("a camera's matrix cannot be used: a focal length or an entry is no number above 0")]
    Camera,
    #[error("voxels of {0} m are no size")]
    Voxel(f64),
    #[error("more than {0} blocks of voxels would be needed")]
    TooManyBlocks(usize),
}
