//! Directions in which points of a surface look.

use glam::DVec3;

use super::mesh::Mesh;

/// For each point the mean of the normals of the faces around it, as a unit vector; zero for a point
/// without faces, or where the mean is none.
pub fn point_normals(mesh: &Mesh) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; mesh.points.len()];
    for face in mesh.faces() {
        let normal = face.normal();
        for &point in face.rings().flatten() {
            sums[point as usize] += normal;
        }
    }
    sums.into_iter().map(DVec3::normalize_or_zero).collect()
}
