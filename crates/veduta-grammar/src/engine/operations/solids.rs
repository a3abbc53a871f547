//! Solids from faces, and primitive shapes.

use glam::{DMat3, DVec3};
use veduta_geometry::solid;

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::marks::Maker;
use super::super::run::Run;
use super::extruding::{by_corners, by_faces, of_edge, to_level, Extruded};
use super::primitives::{filled, lies_across};
use super::standing::upright;
use super::{length, word};
use crate::shape::{Form, Geometry, Instance, Scope};

/// `extrude(height)`, `extrude(direction, height)`: faces to prisms, each along its normal
/// (`face.normal`); with `vertex.normal` faces stay together and corners move along the mean of the
/// normals; `world.up` (also `world.y`), `world.up.flatTop` up to a level top so high above the lowest
/// corner; or another axis of the world or the scope. Of an edge it makes a wall. The scope holds the solid afterwards,
/// with y along the direction and x as it was, as far as it can be; along its own axes (Veduta's own
/// `x`, `y` and `z`) it stays as it is turned. A height of 0 leaves the faces as they are.
pub fn extrude(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let last = op.args.len() - 1;
    let height = length(run, op, last, frame.state.form.scope.size.y, frame)?;
    let direction = if last == 1 {
        Some(word(run, op, 0, frame)?)
    } else {
        None
    };
    if let Some(made) = otherwise(&frame.state.form, direction.as_deref(), height) {
        frame.state.form = made.form;
        if run.code.tags {
            frame
                .state
                .made(Maker::Extrude, made.along * height.signum());
        }
        frame.changed();
        return Ok(());
    }
    let form = &frame.state.form;
    let axes = form.scope.axes;
    let along = match direction.as_deref() {
        None | Some("face.normal" | "vertex.normal") => normal(form),
        Some("world.up" | "world.up.flatTop" | "world.y") => DVec3::Y,
        Some("world.x") => DVec3::X,
        Some("world.z") => DVec3::Z,
        Some("x") => axes.x_axis,
        Some("y") => axes.y_axis,
        Some("z") => axes.z_axis,
        Some(other) => {
            let message = format!("`{other}` is no direction: face.normal, world.up, x, y or z");
            return Err(Fault::at(op.span, message));
        }
    };
    if height == 0.0 || form.geometry == Geometry::Nothing {
        return Ok(());
    }
    // Along an axis of its own the scope stays as it is turned.
    let keeps = matches!(direction.as_deref(), Some("x" | "y" | "z"));
    let turned = if keeps { axes } else { upright(form, along) };
    let Some(prism) = extruded(form, along, height, turned) else {
        let message = "the faces lie along the direction in which they are to be extruded";
        return Err(Fault::at(op.span, message));
    };
    frame.state.form = prism;
    if run.code.tags {
        frame.state.made(Maker::Extrude, along * height.signum());
    }
    frame.changed();
    Ok(())
}

/// What is no prism over faces that look in one direction; None where it is.
fn otherwise(form: &Form, direction: Option<&str>, height: f64) -> Option<Extruded> {
    match (&form.geometry, direction) {
        (Geometry::Nothing, _) if height == 0.0 => None,
        (Geometry::Nothing, None | Some("face.normal" | "vertex.normal")) => {
            of_edge(form, None, height)
        }
        (Geometry::Nothing, Some("world.up" | "world.up.flatTop" | "world.y")) => {
            of_edge(form, Some(DVec3::Y), height)
        }
        (Geometry::Nothing, _) => None,
        (_, Some("world.up.flatTop")) => to_level(form, height),
        (Geometry::Rectangle(_), _) => None,
        _ if height == 0.0 => None,
        (_, None | Some("face.normal")) => by_faces(form, height),
        (_, Some("vertex.normal")) => by_corners(form, height),
        _ => None,
    }
}

fn extruded(form: &Form, along: DVec3, height: f64, axes: DMat3) -> Option<Form> {
    let by = along * height;
    if let Geometry::Rectangle(axis) = form.geometry {
        if height > 0.0 && along.abs_diff_eq(form.scope.axes.col(axis), 1e-12) {
            let mut scope = form.scope;
            scope.size[axis] = height;
            return Some(Form {
                scope: along_axes(&scope, axes),
                geometry: Geometry::Box,
            });
        }
    }
    let prism = solid::extrude(&form.world_mesh(), by);
    (!prism.is_empty()).then(|| Form::around(prism, axes, true))
}

/// The same box with its axes in another order or turned round.
fn along_axes(scope: &Scope, axes: DMat3) -> Scope {
    if axes == scope.axes {
        return *scope;
    }
    let local = axes.transpose();
    let corners = [scope.world(DVec3::ZERO), scope.world(DVec3::ONE)].map(|corner| local * corner);
    let low = corners[0].min(corners[1]);
    Scope {
        origin: axes * low,
        axes,
        size: (corners[0] - corners[1]).abs(),
    }
}

/// The direction of the faces: that of the sum of their area vectors.
fn normal(form: &Form) -> DVec3 {
    match form.geometry {
        Geometry::Rectangle(axis) => form.scope.axes.col(axis),
        _ => {
            let mesh = form.world_mesh();
            let sum: DVec3 = mesh.faces().map(|face| face.area_vector()).sum();
            sum.normalize_or(form.scope.axes.y_axis)
        }
    }
}

/// `reverseNormals()`: the same faces seen from the other side. A closed shape is then a hollow.
pub fn reverse(_: &mut Run<'_>, _: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let form = &frame.state.form;
    frame.state.form.geometry = match &form.geometry {
        Geometry::Nothing => Geometry::Nothing,
        Geometry::Instance(instance) => Geometry::Instance(Instance {
            inside_out: !instance.inside_out,
            ..instance.clone()
        }),
        other => Geometry::of(other.mesh().reversed(), other.is_solid()),
    };
    frame.changed();
    Ok(())
}

/// `primitiveCube()`: a box that fills the scope, where a size of 0 is first made the mean of the
/// others; `primitiveCube(x, y, z)` of this size, in the middle of the scope's floor.
pub fn cube(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let now = frame.state.form.scope;
    let mut size = filled(now.size, [true; 3]);
    for axis in 0..op.args.len().min(3) {
        size[axis] = length(run, op, axis, now.size[axis], frame)?;
    }
    let aside = match op.args.len() {
        0 => DVec3::ZERO,
        _ => DVec3::new(0.5, 0.0, 0.5) * (now.size - size),
    };
    frame.state.form.scope = Scope {
        size,
        ..now.moved(aside)
    };
    frame.state.form.geometry = Geometry::Box;
    frame.state.replaced();
    frame.changed();
    Ok(())
}

/// A direction without its part along an axis.
fn beside(mut direction: DVec3, axis: usize) -> DVec3 {
    direction[axis] = 0.0;
    direction
}

/// `primitiveQuad()`: a rectangle that fills the scope, level, or upright where the scope is;
/// `primitiveQuad(width, length)` of this size, in the middle of the scope's floor or of the flat scope.
pub fn quad(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let now = frame.state.form.scope;
    let across = lies_across(now.size);
    let axes = (0..3).filter(|&axis| axis != across);
    let mut size = filled(now.size, [0, 1, 2].map(|axis| axis != across));
    for (index, axis) in axes.enumerate().take(op.args.len()) {
        size[axis] = length(run, op, index, now.size[axis], frame)?;
    }
    let aside = match op.args.len() {
        0 => DVec3::ZERO,
        _ => beside(0.5 * (now.size - size), across),
    };
    frame.state.form.scope = Scope {
        size,
        ..now.moved(aside)
    };
    frame.state.form.geometry = Geometry::Rectangle(across);
    frame.state.replaced();
    frame.changed();
    Ok(())
}
