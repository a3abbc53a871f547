//! Roofs over the faces of a shape.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{roofed, RoofKind};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::run::{Frame, Run};
use super::{number, word};
use crate::shape::Form;

/// Slopes steeper than this are walls (degrees).
const STEEPEST: f64 = 89.0;

/// `roofHip(angle)`, `roofHip(byAngle | byHeight, value)`: a slope over every edge.
pub fn hip(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    build(run, op, frame, RoofKind::Hip)
}

/// `roofGable(angle)`, `roofGable(byAngle | byHeight, value)`: upright ends where a hip roof has
/// triangles.
pub fn gable(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    build(run, op, frame, RoofKind::Gable)
}

/// The scope has y where the roof rises afterwards, and holds the closed roof.
fn build(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    kind: RoofKind,
) -> Result<(), Fault> {
    let by_height = op.args.len() == 2 && word(run, op, 0, frame)?.as_ref() == "byHeight";
    let value = number(run, op, op.args.len() - 1, frame)?;
    let form = &frame.state.form;
    let sheet = form.world_mesh();
    if sheet.is_empty() {
        return Ok(());
    }
    let axes = upright(form, sheet.face(0).normal());
    let build = |slope: f64| {
        let told = |error| Fault::at(op.span, format!("no roof here: {error}"));
        let solid = roofed(&sheet, kind, slope).map_err(told)?;
        Ok(Form::around(solid, axes, true))
    };
    let slope = if by_height {
        value / build(1.0)?.scope.size.y.max(f64::MIN_POSITIVE)
    } else {
        value.to_radians().tan()
    };
    if !(slope > 0.0 && slope <= STEEPEST.to_radians().tan()) {
        let message = format!("a slope from 0 to {STEEPEST} degrees is needed, not {value}");
        return Err(Fault::at(op.span, message));
    }
    frame.state.form = build(slope)?;
    frame.changed();
    Ok(())
}

/// The scope's axes with y along the normal.
fn upright(form: &Form, normal: DVec3) -> DMat3 {
    let axes = form.scope.axes;
    let x = (axes.x_axis - normal * axes.x_axis.dot(normal))
        .normalize_or(normal.any_orthonormal_vector());
    DMat3::from_cols(x, normal, x.cross(normal))
}
