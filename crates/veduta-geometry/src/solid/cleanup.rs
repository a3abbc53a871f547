//! Meshes with fewer points, edges and faces that look the same.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::loops::close_in_plane;
use super::mesh::{Face, Mesh};
use super::weld::joined;

/// What may go. Points nearer to each other than `near` become one in any case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cleaning {
    /// Points at which no more than two edges meet, straight to within `angle`.
    pub points: bool,
    /// Edges between faces whose normals are within `angle`.
    pub edges: bool,
    /// Faces up to `area`, and those that are there already.
    pub faces: bool,
    /// In the unit of the mesh.
    pub near: f64,
    /// Radians.
    pub angle: f64,
    /// In the unit of the mesh, squared.
    pub area: f64,
}

/// The mesh without what may go. A closed mesh stays closed where no face is left out.
pub fn cleaned(mesh: &Mesh, cleaning: &Cleaning) -> Mesh {
    let mut clean = joined(&[mesh], cleaning.near);
    if cleaning.faces {
        clean = without_small_faces(&clean, cleaning.area);
    }
    if cleaning.edges {
        clean = without_level_edges(&clean, cleaning.angle);
    }
    if cleaning.points {
        clean = without_idle_points(&clean, cleaning.angle.sin());
    }
    clean.compact()
}

fn without_small_faces(mesh: &Mesh, area: f64) -> Mesh {
    let mut known = HashSet::new();
    let mut kept = Vec::new();
    for face in mesh.faces() {
        let mut corners: Vec<u32> = face.rings().flatten().copied().collect();
        corners.sort_unstable();
        if face.area_vector().length() > area && known.insert(corners) {
            kept.push(face.index());
        }
    }
    mesh.of_faces(kept)
}

/// Faces that share an edge and look the same way as one: each group around its first face.
fn without_level_edges(mesh: &Mesh, angle: f64) -> Mesh {
    let mut beside: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
    for face in mesh.faces() {
        for edge in face.edges() {
            beside.entry(edge).or_default().push(face.index());
        }
    }
    let normals: Vec<DVec3> = mesh.faces().map(Face::normal).collect();
    let mut taken = vec![false; mesh.face_count()];
    let mut whole = Mesh::with_points(mesh.points.clone());
    for first in 0..mesh.face_count() {
        if std::mem::replace(&mut taken[first], true) {
            continue;
        }
        let (mut group, mut next) = (vec![first], 0);
        while next < group.len() {
            for (from, to) in mesh.face(group[next]).edges() {
                // Where more than two faces meet, each keeps its edge.
                let (one, other) = (beside.get(&(from, to)), beside.get(&(to, from)));
                if let (Some([_]), Some(&[face])) =
                    (one.map(Vec::as_slice), other.map(Vec::as_slice))
                {
                    if !taken[face] && normals[first].angle_between(normals[face]) <= angle {
                        taken[face] = true;
                        group.push(face);
                    }
                }
            }
            next += 1;
        }
        push_group(mesh, &group, normals[first], &mut whole);
    }
    whole
}

fn push_group(mesh: &Mesh, group: &[usize], normal: DVec3, whole: &mut Mesh) {
    let rings = |face: &usize| {
        mesh.face(*face)
            .rings()
            .map(<[u32]>::to_vec)
            .collect::<Vec<_>>()
    };
    if let [face] = group {
        whole.push_face(&rings(face));
        return;
    }
    let reversed: Vec<Vec<u32>> = group
        .iter()
        .flat_map(rings)
        .map(|ring| ring.into_iter().rev().collect())
        .collect();
    for rings in close_in_plane(&mesh.points, reversed.iter(), |_| true, normal) {
        whole.push_face(&rings);
    }
}

/// The mesh without points at which no more than two edges meet, straight to within an angle of
/// this sine.
pub fn without_idle_points(mesh: &Mesh, sine: f64) -> Mesh {
    let mut beside: HashMap<u32, HashSet<u32>> = HashMap::new();
    for (from, to) in mesh.faces().flat_map(Face::edges) {
        beside.entry(from).or_default().insert(to);
        beside.entry(to).or_default().insert(from);
    }
    let is_idle = |point: u32| {
        let neighbours: Vec<u32> = beside[&point].iter().copied().collect();
        let [a, b] = neighbours[..] else {
            return false;
        };
        let [here, a, b] = [point, a, b].map(|p| mesh.points[p as usize]);
        let (one, other) = (
            (here - a).normalize_or_zero(),
            (b - here).normalize_or_zero(),
        );
        one.dot(other) > 0.0 && one.cross(other).length() <= sine
    };
    let mut kept = Mesh::with_points(mesh.points.clone());
    for face in mesh.faces() {
        let rings: Vec<Vec<u32>> = face
            .rings()
            .map(|ring| {
                let corners: Vec<u32> = ring.iter().copied().filter(|&p| !is_idle(p)).collect();
                // Of a ring that is round to within the angle, all corners stay.
                if corners.len() >= 3 {
                    corners
                } else {
                    ring.to_vec()
                }
            })
            .collect();
        kept.push_face(&rings);
    }
    kept
}
