//! The limits of a derivation, from Python.

use pyo3::prelude::*;
use veduta_grammar::engine::{Limit, Limits};

/// What a derivation may cost before it is stopped; see `veduta.grammar.LimitOptions`.
#[pyclass(frozen, module = "veduta._core")]
pub struct GrammarLimits {
    limits: Limits,
}

#[pymethods]
impl GrammarLimits {
    /// `memory`: bytes. `work`: steps, each looking at one pair of faces, edges or corners.
    #[new]
    #[pyo3(signature = (*, depth, shapes, faces, parts, seconds, work, memory))]
    fn new(
        depth: usize,
        shapes: usize,
        faces: usize,
        parts: usize,
        seconds: f64,
        work: u64,
        memory: u64,
    ) -> Self {
        let limits = Limits {
            depth,
            shapes,
            faces,
            parts,
            seconds,
            work,
            memory,
        };
        Self { limits }
    }

    fn __repr__(&self) -> String {
        let Limits {
            depth,
            shapes,
            faces,
            parts,
            seconds,
            work,
            memory,
        } = self.limits;
        format!(
            "GrammarLimits(depth={depth}, shapes={shapes}, faces={faces}, parts={parts}, \
             seconds={seconds}, work={work}, memory={memory})"
        )
    }
}

/// The limits that are given, or those of the engine.
pub fn limits_of(given: Option<&GrammarLimits>) -> Limits {
    given.map_or_else(Limits::default, |given| given.limits)
}

/// The option that raises a limit.
pub fn option_of(limit: Limit) -> &'static str {
    match limit {
        Limit::Depth => "--max-depth",
        Limit::Shapes => "--max-shapes",
        Limit::Faces => "--max-faces",
        Limit::Parts => "--max-parts",
        Limit::Seconds => "--seconds",
        Limit::Work => "--max-work",
        Limit::Memory => "--max-memory",
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<GrammarLimits>()
}
