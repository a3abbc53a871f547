//! Outlines to build roofs over, and what a roof is measured by.

use std::collections::{HashMap, HashSet};

use proptest::prelude::*;
use veduta_geometry::skeleton::Roof;

pub type Rings = Vec<Vec<[f64; 2]>>;

/// Turned, scaled and shifted.
pub fn moved(rings: &Rings, turn_rad: f64, scale: f64, [x, y]: [f64; 2]) -> Rings {
    let (sine, cosine) = turn_rad.sin_cos();
    let place = |[u, v]: [f64; 2]| {
        [
            x + scale * (cosine * u - sine * v),
            y + scale * (sine * u + cosine * v),
        ]
    };
    let ring = |ring: &Vec<[f64; 2]>| ring.iter().map(|&point| place(point)).collect();
    rings.iter().map(ring).collect()
}

pub fn regular(corners: usize, radius_m: f64) -> Rings {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / corners as f64;
        [radius_m * angle.cos(), radius_m * angle.sin()]
    };
    vec![(0..corners).map(corner).collect()]
}

prop_compose! {
    /// A star-shaped outline, and in half of the cases a star-shaped courtyard.
    pub fn star()(
        outer in prop::collection::vec(4.0..9.0f64, 3..40),
        inner in prop::option::of(prop::collection::vec(0.5..2.5f64, 3..12)),
    ) -> Rings {
        let ring = |radii: &[f64], sign: f64| {
            let corner = |(k, radius): (usize, &f64)| {
                let angle = sign * std::f64::consts::TAU * k as f64 / radii.len() as f64;
                [radius * angle.cos(), radius * angle.sin()]
            };
            radii.iter().enumerate().map(corner).collect::<Vec<_>>()
        };
        // Triangles reach in to half of their radius; quadrangles of these radii do not cross.
        let outer: Vec<f64> = outer.iter().map(|r| if outer.len() < 5 { r + 6.0 } else { *r }).collect();
        let mut rings = vec![ring(&outer, 1.0)];
        rings.extend(inner.map(|radii| ring(&radii, -1.0)));
        rings
    }
}

prop_compose! {
    /// Corners on a circle at random angles: a convex outline.
    pub fn convex()(
        steps in prop::collection::vec(0.05..1.0f64, 3..25),
        flatness in 0.3..1.0f64,
    ) -> Rings {
        let all: f64 = steps.iter().sum();
        let mut angle = 0.0;
        let corner = |step: &f64| {
            angle += std::f64::consts::TAU * step / all;
            [10.0 * f64::cos(angle), 10.0 * flatness * f64::sin(angle)]
        };
        vec![steps.iter().map(corner).collect()]
    }
}

prop_compose! {
    /// Rectilinear outlines with courtyards: cells of a grid that hang together.
    pub fn rectilinear()(
        columns in 2..8usize,
        cells in prop::collection::vec(prop::bool::weighted(0.75), 12..56),
        straight in prop::bool::weighted(0.3),
    ) -> Option<Rings> {
        of_cells(columns, &cells, straight)
    }
}

type Cell = (i32, i32);

/// The outline of the cells that hang together with the first full one; nothing where it touches
/// itself at a corner. `straight` keeps some of the points on straight walls.
fn of_cells(columns: usize, cells: &[bool], straight: bool) -> Option<Rings> {
    let place = |k: usize| ((k % columns) as i32, (k / columns) as i32);
    let full: HashSet<Cell> = (0..cells.len()).filter(|&k| cells[k]).map(place).collect();
    let mut open: Vec<Cell> = full.iter().min().copied().into_iter().collect();
    let mut kept: HashSet<Cell> = open.iter().copied().collect();
    while let Some((x, y)) = open.pop() {
        for next in [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)] {
            if full.contains(&next) && kept.insert(next) {
                open.push(next);
            }
        }
    }
    let mut next: HashMap<Cell, Cell> = HashMap::new();
    for &(x, y) in &kept {
        let corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
        for (k, beyond) in [(x, y - 1), (x + 1, y), (x, y + 1), (x - 1, y)]
            .iter()
            .enumerate()
        {
            let (from, to) = (corners[k], corners[(k + 1) % 4]);
            if !kept.contains(beyond) && next.insert(from, to).is_some() {
                return None;
            }
        }
    }
    let mut starts: Vec<Cell> = next.keys().copied().collect();
    starts.sort_unstable();
    let mut rings = Vec::new();
    for start in starts {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            ring.push(at);
            at = to;
        }
        if !ring.is_empty() {
            rings.push(corners_of(&ring, straight));
        }
    }
    (!rings.is_empty()).then_some(rings)
}

fn corners_of(ring: &[Cell], straight: bool) -> Vec<[f64; 2]> {
    let count = ring.len();
    let stays = |k: &usize| {
        let (a, b, c) = (
            ring[(k + count - 1) % count],
            ring[*k],
            ring[(k + 1) % count],
        );
        let is_corner = (b.0 - a.0) * (c.1 - b.1) != (b.1 - a.1) * (c.0 - b.0);
        is_corner || (straight && (b.0 + b.1) % 3 == 0)
    };
    let point = |k: usize| [f64::from(ring[k].0), f64::from(ring[k].1)];
    (0..count).filter(stays).map(point).collect()
}

/// The height of a roof over a point, from the face whose outline is around it; none on a side.
pub fn height_m(roof: &Roof, [x, y]: [f64; 2]) -> Option<f64> {
    let around = |ring: &Vec<u32>| {
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        let crossed = sides.filter(|&(&a, &b)| {
            let (p, q) = (roof.nodes_m[a as usize], roof.nodes_m[b as usize]);
            (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
        });
        crossed.count() % 2 == 1
    };
    let face = roof
        .faces
        .iter()
        .find(|face| face.rings.iter().filter(|ring| around(ring)).count() % 2 == 1)?;
    let place = |k: usize| roof.nodes_m[face.rings[0][k] as usize];
    // The plane through the largest triangle with the first side of the face.
    let (a, b) = (place(0), place(1));
    let twice = |c: [f64; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let c = (2..face.rings[0].len())
        .map(place)
        .max_by(|p, q| twice(*p).abs().total_cmp(&twice(*q).abs()))?;
    let whole = twice(c);
    let along = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / whole;
    let up = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / whole;
    Some(a[2] + along * (b[2] - a[2]) + up * (c[2] - a[2]))
}
