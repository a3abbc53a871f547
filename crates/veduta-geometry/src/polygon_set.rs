//! The columnar view of many polygons, checked once.

use std::ops::Range;

use crate::PolygonError;

/// Borrowed columns; every range in it has been checked against the buffers.
#[derive(Debug, Clone, Copy)]
pub struct PolygonSet<'a> {
    positions_m: &'a [[f64; 3]],
    ring_offsets: &'a [i64],
    polygon_offsets: &'a [i64],
}

impl<'a> PolygonSet<'a> {
    /// `ring_offsets` holds the first vertex of each ring and, last, the number of vertices;
    /// `polygon_offsets` the first ring of each polygon and, last, the number of rings.
    pub fn new(
        positions_m: &'a [[f64; 3]],
        ring_offsets: &'a [i64],
        polygon_offsets: &'a [i64],
    ) -> Result<Self, PolygonError> {
        let set = Self::of_any_rings(positions_m, ring_offsets, polygon_offsets)?;
        for polygon in 0..set.len() {
            set.check_rings(polygon)?;
        }
        Ok(set)
    }

    /// The same for polygons that may be none: [`Self::check_rings`] tells of each.
    pub fn of_any_rings(
        positions_m: &'a [[f64; 3]],
        ring_offsets: &'a [i64],
        polygon_offsets: &'a [i64],
    ) -> Result<Self, PolygonError> {
        check_offsets("ring", ring_offsets, positions_m.len())?;
        check_offsets("polygon", polygon_offsets, ring_offsets.len() - 1)?;
        Ok(Self {
            positions_m,
            ring_offsets,
            polygon_offsets,
        })
    }

    /// Number of polygons.
    pub fn len(&self) -> usize {
        self.polygon_offsets.len() - 1
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn position_m(&self, vertex: usize) -> [f64; 3] {
        self.positions_m[vertex]
    }

    /// The vertex ranges of a polygon's rings, the outline first.
    pub fn rings(&self, polygon: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        let first = self.polygon_offsets[polygon] as usize;
        let last = self.polygon_offsets[polygon + 1] as usize;
        (first..last)
            .map(|ring| self.ring_offsets[ring] as usize..self.ring_offsets[ring + 1] as usize)
    }

    /// Whether the rings of a polygon have three vertices or more, none repeated, all finite.
    pub fn check_rings(&self, polygon: usize) -> Result<(), PolygonError> {
        let is_wild = |p: &[f64; 3]| p.iter().any(|c| !c.is_finite() || c.abs() > 1e12);
        let mut rings = 0;
        for (ring, range) in self.rings(polygon).enumerate() {
            rings += 1;
            let vertices = range.len();
            if vertices < 3 {
                return Err(PolygonError::RingTooShort {
                    polygon,
                    ring,
                    vertices,
                });
            }
            for vertex in range.clone() {
                if is_wild(&self.positions_m[vertex]) {
                    return Err(PolygonError::NotFinite { vertex });
                }
                let next = if vertex + 1 == range.end {
                    range.start
                } else {
                    vertex + 1
                };
                if self.positions_m[vertex] == self.positions_m[next] {
                    return Err(PolygonError::RepeatedVertex {
                        polygon,
                        ring,
                        vertex,
                    });
                }
            }
        }
        if rings == 0 {
            return Err(PolygonError::RingTooShort {
                polygon,
                ring: 0,
                vertices: 0,
            });
        }
        Ok(())
    }
}

fn check_offsets(what: &'static str, offsets: &[i64], end: usize) -> Result<(), PolygonError> {
    let fault = |index: usize, value: i64| PolygonError::BadOffsets {
        what,
        index,
        value,
        end,
    };
    let (Some(&first), Some(&last)) = (offsets.first(), offsets.last()) else {
        return Err(fault(0, -1));
    };
    if first != 0 {
        return Err(fault(0, first));
    }
    if let Some(index) = offsets.windows(2).position(|pair| pair[0] > pair[1]) {
        return Err(fault(index + 1, offsets[index + 1]));
    }
    if usize::try_from(last) != Ok(end) {
        return Err(fault(offsets.len() - 1, last));
    }
    Ok(())
}
