//! How much a derivation may cost before it is stopped with the reason.

/// Budgets of one derivation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Rules applied one within another.
    pub depth: usize,
    /// Shapes of the whole tree.
    pub shapes: usize,
    /// Faces of one shape.
    pub faces: usize,
    /// Parts of one split.
    pub parts: usize,
    /// Seconds of one derivation.
    pub seconds: f64,
    /// Steps of work of one derivation. A step is looking at one pair of faces, edges or corners:
    /// some nanoseconds. Other than the time, it is the same on each machine.
    pub work: u64,
    /// Bytes that all shapes together take with their faces, values and messages, counted as they
    /// are made: of what is dropped again, too.
    pub memory: u64,
}

/// What a derivation had too much of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    Depth,
    Shapes,
    Faces,
    Parts,
    Seconds,
    Work,
    Memory,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            depth: 1_000,
            shapes: 5_000_000,
            faces: 1_000_000,
            parts: 100_000,
            seconds: 60.0,
            work: 30_000_000_000,
            memory: 4 << 30,
        }
    }
}
