//! The plane of a polygon and its shadow on a coordinate plane.

use std::ops::Range;

use crate::{PolygonError, PolygonSet};

/// Newell's area vector of a ring: along the normal, as long as the enclosed area (m2).
/// It is exact for planar rings of any shape and a least-squares plane for others.
pub fn area_vector(set: &PolygonSet<'_>, ring: Range<usize>) -> [f64; 3] {
    let origin = set.position_m(ring.start);
    let mut sum = [0.0; 3];
    for vertex in ring.start + 1..ring.end - 1 {
        let a = minus(set.position_m(vertex), origin);
        let b = minus(set.position_m(vertex + 1), origin);
        let c = cross(a, b);
        for axis in 0..3 {
            sum[axis] += 0.5 * c[axis];
        }
    }
    sum
}

/// The plane of one polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal; the outline runs counter-clockwise around it.
    pub normal: [f64; 3],
    origin_m: [f64; 3],
    kept: [usize; 2],
}

impl Plane {
    /// Fails when the outline encloses nothing or a vertex is off the plane by more than
    /// `tolerance_m`.
    pub fn of(
        set: &PolygonSet<'_>,
        polygon: usize,
        tolerance_m: f64,
    ) -> Result<Self, PolygonError> {
        let Some(outline) = set.rings(polygon).next() else {
            return Err(PolygonError::NoArea {
                polygon,
                area_m2: 0.0,
            });
        };
        let origin_m = set.position_m(outline.start);
        let vector = area_vector(set, outline);
        let area_m2 = length(vector);
        if !(area_m2 > 0.0 && area_m2.is_finite()) {
            return Err(PolygonError::NoArea { polygon, area_m2 });
        }
        let normal = vector.map(|c| c / area_m2);
        let plane = Self {
            normal,
            origin_m,
            kept: kept_axes(normal),
        };
        for vertex in set.rings(polygon).flatten() {
            let deviation_m = dot(minus(set.position_m(vertex), origin_m), normal).abs();
            if deviation_m > tolerance_m {
                return Err(PolygonError::NotPlanar {
                    polygon,
                    deviation_m,
                    tolerance_m,
                });
            }
        }
        Ok(plane)
    }

    /// Drops the coordinate that the normal leans to most. The coordinates that stay are not
    /// rounded, so that collinear stays collinear on axis-parallel walls, and the order of the
    /// two keeps a counter-clockwise outline counter-clockwise.
    pub fn flatten(&self, point_m: [f64; 3]) -> [f64; 2] {
        let local = minus(point_m, self.origin_m);
        [local[self.kept[0]], local[self.kept[1]]]
    }
}

fn kept_axes(normal: [f64; 3]) -> [usize; 2] {
    let size = normal.map(f64::abs);
    let dropped = if size[0] >= size[1] && size[0] >= size[2] {
        0
    } else if size[1] >= size[2] {
        1
    } else {
        2
    };
    let (u, v) = ((dropped + 1) % 3, (dropped + 2) % 3);
    if normal[dropped] > 0.0 {
        [u, v]
    } else {
        [v, u]
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
