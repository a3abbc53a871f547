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
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            depth: 1_000,
            shapes: 5_000_000,
            faces: 1_000_000,
            parts: 100_000,
            seconds: 60.0,
        }
    }
}
