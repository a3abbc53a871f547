use thiserror::Error;

/// What cannot be carved.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum CarveError {
    #[error("view {view}: {width} by {height} pixels need {needed} values, not {given}")]
    Size {
        view: usize,
        width: usize,
        height: usize,
        needed: usize,
        given: usize,
    },
    #[error("there is no view")]
    NoViews,
    #[error("{levels} levels: there must be {least} to {most}")]
    Levels { levels: u32, least: u32, most: u32 },
    #[error("a field of {levels} levels needs {needed} values, not {given}")]
    Field {
        levels: u32,
        needed: usize,
        given: usize,
    },
    #[error("the volume's side is no length: {side}")]
    Side { side: f64 },
    #[error("the graphics card did not answer")]
    Engine,
}
