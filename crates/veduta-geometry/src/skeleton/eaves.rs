//! Where a roof begins: a simple polygon with holes, and how fast each edge moves inwards.

use super::simple::{crossing, rings_nested};
use super::tolerance::{LARGEST_COORDINATE_M, LARGEST_SPEED, MOST_VERTICES, SHORTEST_EDGE_SHARE};
use super::SkeletonError;

/// Checked eaves: the outline counter-clockwise, the holes clockwise, x east and y north (m).
///
/// Vertices are numbered through all rings, and edge `e` runs from vertex `e` to the next vertex
/// of its ring. The speed of an edge is metres of ground per unit of time; in the roof, time is
/// height. A speed of 1 is a slope of 45 degrees, 2 a flatter one, 0 a vertical gable.
#[derive(Debug, Clone, PartialEq)]
pub struct Eaves {
    points_m: Vec<[f64; 2]>,
    ring_starts: Vec<usize>,
    next: Vec<u32>,
    previous: Vec<u32>,
    speeds: Vec<f64>,
    diagonal_m: f64,
    centre_m: [f64; 2],
}

impl Eaves {
    /// The outline first, then the holes; `speeds` has one entry per edge, through all rings.
    ///
    /// Rings may not cross or touch themselves or each other; [`super::clean()`] mends what can be
    /// mended.
    pub fn new(rings: &[Vec<[f64; 2]>], speeds: &[f64]) -> Result<Self, SkeletonError> {
        let eaves = Self::counted(rings, speeds)?;
        eaves.check_edges()?;
        if let Some((first, second)) = crossing(&eaves.points_m, &eaves.next) {
            return Err(SkeletonError::Crossing { first, second });
        }
        for ring in 0..eaves.ring_count() {
            let area_m2 = ring_area_m2(eaves.ring(ring));
            if (area_m2 > 0.0) != (ring == 0) || area_m2 == 0.0 {
                return Err(SkeletonError::WrongWinding { ring, area_m2 });
            }
        }
        if let Some(ring) = rings_nested(rings) {
            return Err(SkeletonError::HoleOutside { ring });
        }
        Ok(eaves)
    }

    /// Eaves whose edges all move at the same speed of 1: those of a hip roof.
    pub fn even(rings: &[Vec<[f64; 2]>]) -> Result<Self, SkeletonError> {
        let edges = rings.iter().map(Vec::len).sum();
        Self::new(rings, &vec![1.0; edges])
    }

    /// The same polygon with other speeds.
    pub fn with_speeds(&self, speeds: &[f64]) -> Result<Self, SkeletonError> {
        check_speeds(speeds, self.len())?;
        Ok(Self {
            speeds: speeds.to_vec(),
            ..self.clone()
        })
    }

    /// Number of vertices, and of edges.
    pub fn len(&self) -> usize {
        self.points_m.len()
    }

    pub fn is_empty(&self) -> bool {
        self.points_m.is_empty()
    }

    pub fn points_m(&self) -> &[[f64; 2]] {
        &self.points_m
    }

    pub fn ring_count(&self) -> usize {
        self.ring_starts.len() - 1
    }

    /// The vertices of a ring; ring 0 is the outline.
    pub fn ring(&self, ring: usize) -> &[[f64; 2]] {
        &self.points_m[self.ring_starts[ring]..self.ring_starts[ring + 1]]
    }

    /// The vertex after this one, round its ring.
    pub fn next(&self, vertex: usize) -> usize {
        self.next[vertex] as usize
    }

    /// The vertex before this one, round its ring.
    pub fn previous(&self, vertex: usize) -> usize {
        self.previous[vertex] as usize
    }

    pub fn speeds(&self) -> &[f64] {
        &self.speeds
    }

    /// The area within the outline and outside of the holes (m2).
    pub fn area_m2(&self) -> f64 {
        (0..self.ring_count())
            .map(|ring| ring_area_m2(self.ring(ring)))
            .sum()
    }

    /// The diagonal of the bounding box (m), to which tolerances are relative.
    pub fn diagonal_m(&self) -> f64 {
        self.diagonal_m
    }

    /// The centre of the bounding box.
    pub(super) fn centre_m(&self) -> [f64; 2] {
        self.centre_m
    }

    fn counted(rings: &[Vec<[f64; 2]>], speeds: &[f64]) -> Result<Self, SkeletonError> {
        let vertices = rings.iter().map(Vec::len).sum();
        if vertices > MOST_VERTICES {
            return Err(SkeletonError::TooMany {
                vertices,
                most: MOST_VERTICES,
            });
        }
        if rings.is_empty() {
            return Err(SkeletonError::RingTooShort {
                ring: 0,
                vertices: 0,
            });
        }
        check_speeds(speeds, vertices)?;
        let points_m = rings.concat();
        let is_wild = |p: &[f64; 2]| {
            p.iter()
                .any(|c| !c.is_finite() || c.abs() > LARGEST_COORDINATE_M)
        };
        if let Some(vertex) = points_m.iter().position(is_wild) {
            return Err(SkeletonError::NotFinite { vertex });
        }
        let (mut ring_starts, mut next, mut previous) = (vec![0], Vec::new(), Vec::new());
        for (ring, vertices) in rings.iter().map(Vec::len).enumerate() {
            if vertices < 3 {
                return Err(SkeletonError::RingTooShort { ring, vertices });
            }
            let start = next.len() as u32;
            let count = vertices as u32;
            next.extend((0..count).map(|k| start + (k + 1) % count));
            previous.extend((0..count).map(|k| start + (k + count - 1) % count));
            ring_starts.push(next.len());
        }
        let (low, high) = bounds(&points_m);
        Ok(Self {
            ring_starts,
            next,
            previous,
            speeds: speeds.to_vec(),
            diagonal_m: (high[0] - low[0]).hypot(high[1] - low[1]),
            centre_m: [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])],
            points_m,
        })
    }

    fn check_edges(&self) -> Result<(), SkeletonError> {
        let least_m = SHORTEST_EDGE_SHARE * self.diagonal_m;
        for edge in 0..self.len() {
            let [dx, dy] = self.along(edge);
            let length_m = dx.hypot(dy);
            if length_m <= least_m {
                return Err(SkeletonError::EdgeTooShort {
                    edge,
                    length_m,
                    least_m,
                });
            }
            let [px, py] = self.along(self.previous(edge));
            let sine = (px * dy - py * dx) / (length_m * px.hypot(py));
            if px * dx + py * dy < 0.0 && sine.abs() < 1e-9 {
                return Err(SkeletonError::Spike { vertex: edge });
            }
        }
        Ok(())
    }

    /// From the start of an edge to its end (m).
    pub(super) fn along(&self, edge: usize) -> [f64; 2] {
        let (a, b) = (self.points_m[edge], self.points_m[self.next(edge)]);
        [b[0] - a[0], b[1] - a[1]]
    }
}

fn check_speeds(speeds: &[f64], edges: usize) -> Result<(), SkeletonError> {
    if speeds.len() != edges {
        return Err(SkeletonError::SpeedCount {
            speeds: speeds.len(),
            edges,
        });
    }
    let is_bad = |speed: &f64| !(0.0..=LARGEST_SPEED).contains(speed);
    match speeds.iter().position(is_bad) {
        Some(edge) => Err(SkeletonError::BadSpeed {
            edge,
            speed: speeds[edge],
            most: LARGEST_SPEED,
        }),
        None => Ok(()),
    }
}

fn bounds(points: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in points {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    (low, high)
}

/// The area of a ring, above zero where it runs counter-clockwise (m2).
pub(super) fn ring_area_m2(ring: &[[f64; 2]]) -> f64 {
    let origin = ring[0];
    let twice: f64 = ring
        .windows(2)
        .map(|pair| {
            let a = [pair[0][0] - origin[0], pair[0][1] - origin[1]];
            let b = [pair[1][0] - origin[0], pair[1][1] - origin[1]];
            a[0] * b[1] - a[1] * b[0]
        })
        .sum();
    0.5 * twice
}
