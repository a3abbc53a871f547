//! Roofs with all ridges at one height.

use glam::DVec3;

use crate::solid::{weld, Face, Mesh};
use crate::{triangulate, PolygonSet};

/// A solid with all its points above the floor at the height of the highest. Faces that are no
/// longer planar are cut in triangles, as seen from above. None where upright faces would fold: a
/// gable may reach beyond its edge higher up, and back again.
pub fn levelled(solid: &Mesh) -> Option<Mesh> {
    let top = solid.points.iter().map(|p| p.z).fold(0.0, f64::max);
    let least = 1e-9 * top;
    let raise = |p: DVec3| {
        if p.z > least {
            DVec3::new(p.x, p.y, top)
        } else {
            p
        }
    };
    let raised = solid.clone().mapped(raise);
    let mut whole = Mesh::with_points(raised.points.clone());
    for face in raised.faces() {
        let rings: Vec<Vec<u32>> = face.rings().map(<[u32]>::to_vec).collect();
        let normal = face.normal();
        let origin = raised.points[rings[0][0] as usize];
        let off = face.points().map(|p| (p - origin).dot(normal).abs());
        if off.fold(0.0, f64::max) <= 1e-9 * top {
            whole.push_face(&rings);
            continue;
        }
        let all = rings.concat();
        match triangles(&raised, &rings) {
            Some(found) => {
                for triangle in found {
                    whole.push_face(&[triangle.map(|corner| all[corner as usize])]);
                }
            }
            None => whole.push_face(&rings),
        }
    }
    let first = weld(&whole.points, least);
    let apart = (0u32..).zip(&first).all(|(point, &first)| point == first);
    (apart && whole.faces().all(|face| is_simple(&whole.points, &face))).then_some(whole)
}

/// Whether a face neither folds back, nor touches or crosses itself.
fn is_simple(points: &[DVec3], face: &Face<'_>) -> bool {
    let mut corners = Vec::new();
    let mut offsets = vec![0i64];
    for ring in face.rings() {
        let at = |index: usize| points[ring[index % ring.len()] as usize];
        for index in 0..ring.len() {
            let (from, to) = (at(index + 1) - at(index), at(index + 2) - at(index + 1));
            let bend = from.cross(to).length();
            if from.dot(to) < 0.0 && bend < 1e-9 * from.length() * to.length() {
                return false;
            }
        }
        corners.extend((0..ring.len()).map(|index| at(index).to_array()));
        offsets.push(corners.len() as i64);
    }
    let polygons = [0, offsets.len() as i64 - 1];
    PolygonSet::new(&corners, &offsets, &polygons).is_ok_and(|set| triangulate(&set, 1e-6).is_ok())
}

/// Triangles of a face seen from above, as numbers of its corners.
fn triangles(mesh: &Mesh, rings: &[Vec<u32>]) -> Option<Vec<[u32; 3]>> {
    let place = |&point: &u32| {
        let p = mesh.points[point as usize];
        [p.x, p.y, 0.0]
    };
    let positions: Vec<[f64; 3]> = rings.iter().flatten().map(place).collect();
    let mut offsets = vec![0i64];
    for ring in rings {
        offsets.push(offsets[offsets.len() - 1] + ring.len() as i64);
    }
    let polygons = [0, rings.len() as i64];
    let set = PolygonSet::new(&positions, &offsets, &polygons).ok()?;
    triangulate(&set, 1e-6).ok().map(|found| found.triangles)
}
