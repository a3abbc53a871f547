//! Solids that stand on the faces of a shape, and `taper`.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{pyramids, Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::marks::Maker;
use super::super::run::Run;
use super::length;
use crate::shape::Form;

/// `taper(height)`: a pyramid over the centre of gravity of each face; below zero it points down.
/// CityEngine takes the first face alone.
pub fn taper(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let height = length(run, op, 0, frame.state.form.scope.size.y, frame)?;
    let sheet = sheet_of(&frame.state.form);
    if sheet.is_empty() || height == 0.0 {
        return Ok(());
    }
    let solid = pyramids(&sheet, |face| {
        centre_of_gravity(&sheet, face) + face.normal() * height
    });
    let solid = if height < 0.0 {
        solid.reversed()
    } else {
        solid
    };
    let up = sheet.face(0).normal();
    stand(frame, solid, up);
    if run.code.tags {
        frame.state.made(Maker::Taper, up * height.signum());
    }
    Ok(())
}

/// The faces of a shape that have an area, in the world.
pub fn sheet_of(form: &Form) -> Mesh {
    let mesh = form.world_mesh();
    let has_area = |&face: &usize| mesh.face(face).normal() != DVec3::ZERO;
    if (0..mesh.face_count()).all(|face| has_area(&face)) {
        return mesh;
    }
    mesh.of_faces((0..mesh.face_count()).filter(has_area))
}

/// The closed solid as the shape, with y of its scope along `up`.
pub fn stand(frame: &mut Frame, solid: Mesh, up: DVec3) {
    let axes = upright(&frame.state.form, up);
    frame.state.form = Form::around(solid, axes, true);
    frame.changed();
}

/// The scope's axes with y along the normal.
pub fn upright(form: &Form, normal: DVec3) -> DMat3 {
    let axes = form.scope.axes;
    let x = (axes.x_axis - normal * axes.x_axis.dot(normal)).normalize_or({
        let z = axes.z_axis - normal * axes.z_axis.dot(normal);
        z.normalize_or(DVec3::X)
    });
    DMat3::from_cols(x, normal, x.cross(normal))
}

fn centre_of_gravity(mesh: &Mesh, face: Face<'_>) -> DVec3 {
    let place = |point: u32| mesh.points[point as usize];
    let origin = place(face.outline()[0]);
    let normal = face.normal();
    let (mut sum, mut area) = (DVec3::ZERO, 0.0);
    for (a, b) in face.edges() {
        let (a, b) = (place(a) - origin, place(b) - origin);
        let own = 0.5 * a.cross(b).dot(normal);
        sum += own * (a + b) / 3.0;
        area += own;
    }
    if area > 0.0 {
        origin + sum / area
    } else {
        origin
    }
}
