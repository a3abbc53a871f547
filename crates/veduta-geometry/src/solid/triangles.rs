//! A face of a mesh as triangles over its own points.

use super::mesh::{Face, Mesh};
use crate::{triangulate, PolygonError, PolygonSet};

/// The triangles of a face, as numbers of the mesh's points. `tolerance` is how far its points may
/// lie off its plane, in the unit of the mesh.
pub fn triangles(
    mesh: &Mesh,
    face: Face<'_>,
    tolerance: f64,
) -> Result<Vec<[u32; 3]>, PolygonError> {
    let corners: Vec<u32> = face.rings().flatten().copied().collect();
    let places: Vec<[f64; 3]> = corners
        .iter()
        .map(|&point| mesh.points[point as usize].to_array())
        .collect();
    let mut rings = vec![0];
    for ring in face.rings() {
        rings.push(rings[rings.len() - 1] + ring.len() as i64);
    }
    let polygons = [0, rings.len() as i64 - 1];
    let set = PolygonSet::new(&places, &rings, &polygons)?;
    let found = triangulate(&set, tolerance)?;
    let named = |triangle: [u32; 3]| triangle.map(|corner| corners[corner as usize]);
    Ok(found.triangles.into_iter().map(named).collect())
}
