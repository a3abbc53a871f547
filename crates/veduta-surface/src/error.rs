use thiserror::Error;

/// Why there is no surface, or no distance from one.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum SurfaceError {
    #[error("a grid of {size:?} needs {needed} values, not {given}")]
    Size {
        size: [usize; 3],
        needed: usize,
        given: usize,
    },
    #[error("the level is no number: {level}")]
    Level { level: f32 },
    #[error("the surface has {count} vertices, more than an index of 32 bits can name")]
    Vertices { count: usize },
    #[error("a grid of {size:?} has an axis longer than {most}")]
    Axis { size: [usize; 3], most: usize },
    #[error("a coordinate is no finite number")]
    NotFinite,
    #[error("a triangle has the corner {index}, and there are {count} vertices")]
    Corner { index: u32, count: usize },
    #[error("the mesh has no triangle with an area")]
    NoTriangle,
}
