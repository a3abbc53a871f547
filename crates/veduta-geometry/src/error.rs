//! What can be wrong with a set of polygons, with the values that say where.

use thiserror::Error;

#[derive(Debug, Clone, PartialEq, Error)]
pub enum PolygonError {
    #[error("{what} offsets must start at 0, rise, and end at {end}; entry {index} is {value}")]
    BadOffsets {
        what: &'static str,
        index: usize,
        value: i64,
        end: usize,
    },
    #[error("vertex {vertex} is not finite, or too large to triangulate")]
    NotFinite { vertex: usize },
    #[error("ring {ring} of polygon {polygon} has {vertices} vertices; 3 are the least")]
    RingTooShort {
        polygon: usize,
        ring: usize,
        vertices: usize,
    },
    #[error("polygon {polygon} has vertex {vertex} twice in ring {ring}")]
    RepeatedVertex {
        polygon: usize,
        ring: usize,
        vertex: usize,
    },
    #[error("polygon {polygon} has no area ({area_m2} m2)")]
    NoArea { polygon: usize, area_m2: f64 },
    #[error("polygon {polygon} leaves its plane by {deviation_m} m; {tolerance_m} m are allowed")]
    NotPlanar {
        polygon: usize,
        deviation_m: f64,
        tolerance_m: f64,
    },
    #[error("polygon {polygon} crosses itself at the edge from vertex {from} to vertex {to}")]
    SelfCrossing {
        polygon: usize,
        from: usize,
        to: usize,
    },
}
