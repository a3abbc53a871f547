//! The frame that the place and the turn of a scope are told in.

use glam::{DMat3, DVec3};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::{number, word};
use crate::shape::Form;

/// `setPivot(xyz | yzx | zxy, corner)`: the pivot comes to a corner of the scope, and both have axes
/// that point into the scope. The letters say what becomes of x, y and z: with `yzx` the new y lies along
/// the old x, z along y, and x along z, or against them. What is in the scope stays where it is.
///
/// Corners count as in the scope's origin, along x, along x and z, along z, and then the same four at
/// the top.
pub fn set_pivot(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let letters = word(run, op, 0, frame)?;
    let order = match letters.as_ref() {
        "xyz" => [0, 1, 2],
        "yzx" => [2, 0, 1],
        "zxy" => [1, 2, 0],
        other => {
            let message = format!("`{other}` is no order of axes: xyz, yzx or zxy");
            return Err(Fault::at(op.span, message));
        }
    };
    let corner = number(run, op, 1, frame)?;
    let found = (0..8).find(|&known| known as f64 == corner);
    let Some(corner) = found else {
        let message = format!("there is no corner {corner}: 0 to 7");
        return Err(Fault::at(op.span, message));
    };
    let place = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][corner % 4];
    let place = DVec3::new(place[0], (corner / 4) as f64, place[1]);
    let scope = frame.state.form.scope;
    let inward = |axis: usize| scope.axes.col(axis) * (1.0 - 2.0 * place[axis]);
    let [x, y, z] = order.map(inward);
    // Where the three are left-handed, x and z change places.
    let axes = if x.cross(y).dot(z) > 0.0 {
        DMat3::from_cols(x, y, z)
    } else {
        DMat3::from_cols(z, y, x)
    };
    let origin = scope.world(place);
    frame.state.extra_mut().pivot = Some((origin, axes));
    let form = &frame.state.form;
    let solid = form.geometry.is_solid();
    let mesh = form.world_mesh();
    frame.state.form = if mesh.is_empty() {
        let size = (axes.transpose() * (scope.axes * scope.size)).abs();
        let scope = crate::shape::Scope { origin, axes, size };
        Form {
            scope,
            geometry: form.geometry.clone(),
        }
    } else {
        Form::around(mesh, axes, solid)
    };
    frame.changed();
    Ok(())
}
