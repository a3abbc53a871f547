//! Start shapes from building lots.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::Mesh;

use super::pack::from_place;
use crate::shape::Form;

/// A lot as the shape that a derivation starts from: one face that looks up, with x of its scope
/// along the first edge. `rings` are in the frame of places (m), the outline first; None where
/// they enclose nothing.
pub fn lot_form(rings: &[Vec<[f64; 3]>]) -> Option<Form> {
    let own: Vec<Vec<DVec3>> = rings
        .iter()
        .map(|ring| ring.iter().map(|&point| from_place(point)).collect())
        .collect();
    let outline = own.first().filter(|outline| outline.len() >= 3)?;
    let along = outline[1] - outline[0];
    let x = DVec3::new(along.x, 0.0, along.z).try_normalize()?;
    let mesh = Mesh::polygon(&own);
    let up = mesh.face(0).area_vector().y;
    if !up.is_finite() || up == 0.0 {
        return None;
    }
    let mesh = if up > 0.0 { mesh } else { mesh.reversed() };
    let axes = DMat3::from_cols(x, DVec3::Y, x.cross(DVec3::Y));
    Some(Form::around(mesh, axes, false))
}
