//! Faces to prisms.

use glam::DVec3;

use super::Mesh;

/// Sine of the angle between a face and a direction below which the face lies along it.
const ALONG: f64 = 1e-9;

/// The closed solid between a sheet and its copy moved by `by`.
///
/// Every face becomes a prism of its own, so faces that share an edge keep the wall between them.
/// The sheet's faces must look along `by` or against it, each as a whole: one against it is
/// turned round, and one that lies along it gives nothing. Holes become shafts.
pub fn extrude(sheet: &Mesh, by: DVec3) -> Mesh {
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let area = face.area_vector();
        let towards = area.dot(by);
        if towards.abs() <= ALONG * area.length() * by.length() {
            continue;
        }
        let rings: Vec<Vec<DVec3>> = face
            .rings()
            .map(|ring| {
                let points = ring.iter().map(|&p| sheet.points[p as usize]);
                if towards > 0.0 {
                    points.collect()
                } else {
                    points.rev().collect()
                }
            })
            .collect();
        add_prism(&mut solid, &rings, by);
    }
    solid
}

fn add_prism(solid: &mut Mesh, rings: &[Vec<DVec3>], by: DVec3) {
    let mut lower = Vec::with_capacity(rings.len());
    let mut upper = Vec::with_capacity(rings.len());
    for ring in rings {
        let bottom: Vec<u32> = ring.iter().map(|&p| solid.push_point(p)).collect();
        let top: Vec<u32> = ring.iter().map(|&p| solid.push_point(p + by)).collect();
        lower.push(bottom);
        upper.push(top);
    }
    let floor: Vec<Vec<u32>> = lower
        .iter()
        .map(|ring| ring.iter().rev().copied().collect())
        .collect();
    solid.push_face(&floor);
    solid.push_face(&upper);
    for (bottom, top) in lower.iter().zip(&upper) {
        for k in 0..bottom.len() {
            let next = (k + 1) % bottom.len();
            solid.push_face(&[[bottom[k], bottom[next], top[next], top[k]]]);
        }
    }
}
