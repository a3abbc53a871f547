use thiserror::Error;

/// Why a graphics card cannot be used, or not any more.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum GpuError {
    #[error("there is no graphics card that can compute")]
    None,
    #[error("the only adapter, {0}, is software: it is no faster than the processor")]
    Software(String),
    #[error("the graphics card {name} cannot be opened: {why}")]
    Closed { name: String, why: String },
    #[error("the graphics card vanished: {0}")]
    Lost(String),
    #[error("{needed} bytes are needed at once, and the graphics card takes {most}")]
    TooLarge { needed: u64, most: u64 },
    #[error("{0}")]
    Given(String),
}
