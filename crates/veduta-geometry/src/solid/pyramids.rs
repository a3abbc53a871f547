//! Pyramids over the faces of a sheet.

use glam::DVec3;

use super::mesh::{Face, Mesh};

/// A closed pyramid over each face of a sheet; `apex` gives its top.
pub fn pyramids(sheet: &Mesh, apex: impl Fn(Face<'_>) -> DVec3) -> Mesh {
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let top = solid.push_point(apex(face));
        let mut floor = Vec::with_capacity(face.ring_count());
        for ring in face.rings() {
            let base: Vec<u32> = ring
                .iter()
                .map(|&point| solid.push_point(sheet.points[point as usize]))
                .collect();
            for k in 0..base.len() {
                solid.push_face(&[[base[k], base[(k + 1) % base.len()], top]]);
            }
            floor.push(base.into_iter().rev().collect::<Vec<_>>());
        }
        solid.push_face(&floor);
    }
    solid
}
