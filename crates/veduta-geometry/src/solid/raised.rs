//! Closed solids that stand on a sheet: pyramids, and what a height over each point gives.

use std::collections::HashSet;

use glam::DVec3;

use super::loops::close_in_plane;
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

/// The closed solid between a planar sheet and its faces raised along `up` by the height over each
/// of its points. Where the height is no more than `tolerance` the two meet. Heights must keep the
/// faces planar; faces that share edges stand without a wall between them.
pub fn raised(sheet: &Mesh, up: DVec3, height: impl Fn(DVec3) -> f64, tolerance: f64) -> Mesh {
    let mut solid = Mesh::with_points(sheet.points.clone());
    let mut upper = Vec::with_capacity(sheet.points.len());
    for (number, &point) in sheet.points.iter().enumerate() {
        let rise = height(point);
        upper.push(if rise > tolerance {
            solid.push_point(point + up * rise)
        } else {
            number as u32
        });
    }
    let rings: Vec<Vec<u32>> = sheet
        .faces()
        .flat_map(Face::rings)
        .map(<[u32]>::to_vec)
        .collect();
    for face in sheet.faces() {
        let lifted = |ring: &[u32]| ring.iter().map(|&p| upper[p as usize]).collect();
        let top: Vec<Vec<u32>> = face.rings().map(lifted).collect();
        solid.push_face(&top);
    }
    let floor = close_in_plane(&sheet.points, rings.iter(), |_| true, -up);
    for face in &floor {
        solid.push_face(face);
    }
    let edges: HashSet<(u32, u32)> = sheet.faces().flat_map(Face::edges).collect();
    for (a, b) in sheet.faces().flat_map(Face::edges) {
        if edges.contains(&(b, a)) {
            continue;
        }
        let mut wall = vec![a, b, upper[b as usize], upper[a as usize]];
        wall.dedup();
        if wall.len() > 1 && wall.first() == wall.last() {
            wall.pop();
        }
        if wall.len() >= 3 {
            solid.push_face(&[wall]);
        }
    }
    solid.compact()
}
