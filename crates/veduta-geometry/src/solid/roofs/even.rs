//! Roofs with all ridges at one height.

use glam::DVec3;

use crate::solid::Mesh;
use crate::{triangulate, PolygonSet};

/// A solid with all its points above the floor at the height of the highest. Faces that are no
/// longer planar are cut in triangles, as seen from above.
pub fn levelled(solid: &Mesh) -> Mesh {
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
    whole
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
