//! What goes in: the polygons of a building as columns.

use std::ops::Range;

use glam::DVec3;

/// Columns of one building; the columns by polygon are equally long.
#[derive(Debug, Clone, Copy)]
pub struct Building<'a> {
    /// Vertices (m), z up, about `offset`; each belongs to one ring.
    pub positions: &'a [[f64; 3]],
    pub ring_offsets: &'a [i64],
    pub polygon_offsets: &'a [i64],
    /// The surface of each polygon, by its number in the tile.
    pub feature: &'a [u32],
    /// The material of each polygon, by its number in the tile.
    pub material: &'a [u32],
    /// Polygons that are perhaps repeated together; of one surface and one material.
    pub piece: &'a [u32],
    /// The same, finer: tried where a piece is not repeated.
    pub part: &'a [u32],
    /// Texture coordinates of each vertex, from the lower left; empty where nothing has a texture.
    pub uv: &'a [[f32; 2]],
    /// Whether a material has a texture, by its number; none has beyond the end.
    pub mapped: &'a [bool],
    /// What stands for a material with a texture where a face is too narrow to show it, by its
    /// number; the material itself beyond the end.
    pub plain: &'a [u32],
    /// Where the building stands in the tile (m), z up.
    pub offset: [f64; 3],
}

impl Building<'_> {
    /// The vertices of a polygon, of all its rings.
    pub(crate) fn vertices(&self, polygon: usize) -> Range<usize> {
        let ring = |polygon: usize| self.polygon_offsets[polygon] as usize;
        let vertex = |ring: usize| self.ring_offsets[ring] as usize;
        vertex(ring(polygon))..vertex(ring(polygon + 1))
    }

    /// The vertices of each ring of a polygon.
    pub(crate) fn ranges(&self, polygon: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        let first = self.polygon_offsets[polygon] as usize;
        let last = self.polygon_offsets[polygon + 1] as usize;
        let vertex = |ring: usize| self.ring_offsets[ring] as usize;
        (first..last).map(move |ring| vertex(ring)..vertex(ring + 1))
    }

    /// The rings of a polygon in the tile, z up.
    pub(crate) fn rings(&self, polygon: usize) -> impl Iterator<Item = Vec<DVec3>> + '_ {
        let offset = DVec3::from_array(self.offset);
        self.ranges(polygon).map(move |range| {
            let points = self.positions[range].iter();
            points.map(|&p| DVec3::from_array(p) + offset).collect()
        })
    }
}
