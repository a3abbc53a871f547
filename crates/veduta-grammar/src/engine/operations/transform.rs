//! Moving, turning and sizing the scope with what is in it.

use glam::{DMat3, DVec3};

use super::super::code::{Arg, Operation};
use super::super::converting::frame_named;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::shape_attributes::pivot;
use super::scopes::mirror_along;
use super::solids::reverse;
use super::{axes, length, number, word};
use crate::shape::{turn, Scope};

/// `t(x, y, z)`: along the scope's axes.
pub fn move_scope(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let by = lengths(run, op, 0, frame)?;
    place(frame, frame.state.form.scope.moved(by));
    Ok(())
}

/// `s(x, y, z)`: the size of the scope; what is in it grows with it. Along axes with a size below zero
/// it is mirrored at the scope's origin, inside out where they are one or three.
pub fn resize(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let given = lengths(run, op, 0, frame)?;
    let scope = frame.state.form.scope;
    let size = given.abs();
    place(frame, Scope { size, ..scope });
    if given.min_element() < 0.0 {
        let signs = DVec3::select(given.cmplt(DVec3::ZERO), DVec3::NEG_ONE, DVec3::ONE);
        mirror_along(frame, signs);
        if signs.element_product() < 0.0 {
            reverse(run, op, frame)?;
        }
        place(frame, frame.state.form.scope.moved(given.min(DVec3::ZERO)));
    }
    Ok(())
}

/// `r(x, y, z)`, `r(center, x, y, z)`: degrees about the pivot's axes, x first; the scope's origin
/// stays (`scopeOrigin`), or its middle (`scopeCenter`).
pub fn turn_scope(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let first = op.args.len() - 3;
    let about_centre = first == 1 && word(run, op, 0, frame)?.as_ref() == "scopeCenter";
    let mut degrees = DVec3::ZERO;
    for axis in 0..3 {
        degrees[axis] = number(run, op, first + axis, frame)?;
    }
    let fixed = DVec3::splat(if about_centre { 0.5 } else { 0.0 });
    let scope = frame.state.form.scope;
    let (_, axes) = pivot(&frame.state, run.first());
    place(frame, scope.turned(turn_in(&scope, axes, degrees), fixed));
    Ok(())
}

/// The turn of a scope, in its own frame, by degrees about the axes of another.
pub fn turn_in(scope: &Scope, axes: DMat3, degrees: DVec3) -> DMat3 {
    if scope.axes == axes {
        return turn(degrees); // to the last digit
    }
    let own = scope.axes.transpose() * axes;
    own * turn(degrees) * own.transpose()
}

/// `translate(mode, frame, x, y, z)`: `rel` by this much along the frame's axes, `abs` to this place in the
/// frame: `scope`, `pivot`, `object` (the start shape's scope) or `world`.
pub fn translate(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let mode = word(run, op, 0, frame)?;
    let (from, axes) = named(run, op, 1, frame)?;
    let given = lengths(run, op, 2, frame)?;
    let scope = frame.state.form.scope;
    let origin = match mode.as_ref() {
        "abs" => from + axes * given,
        _ => scope.origin + axes * given,
    };
    place(frame, Scope { origin, ..scope });
    Ok(())
}

/// `rotate(mode, frame, x, y, z)`: degrees about the frame's axes, x first; the scope's origin stays.
/// `rel` turns the scope by this much, `abs` so that it stands in the frame as told.
pub fn rotate(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let mode = word(run, op, 0, frame)?;
    let (_, axes) = named(run, op, 1, frame)?;
    let mut degrees = DVec3::ZERO;
    for axis in 0..3 {
        degrees[axis] = number(run, op, 2 + axis, frame)?;
    }
    let scope = frame.state.form.scope;
    let by = match mode.as_ref() {
        "abs" => scope.axes.transpose() * axes * turn(degrees),
        _ => turn_in(&scope, axes, degrees),
    };
    place(frame, scope.turned(by, DVec3::ZERO));
    Ok(())
}

/// Origin and axes of the frame that an argument names.
fn named(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<(DVec3, DMat3), Fault> {
    let name = word(run, op, index, frame)?;
    frame_named(&name, &frame.state, run.first()).map_err(|message| fault(op, message))
}

/// `center(axes)`: the middle of the scope to the middle of that of the shape the rule began with.
pub fn center(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let word = word(run, op, 0, frame)?;
    let around = run.start_of(frame).form.scope;
    let middle = around.world(DVec3::splat(0.5));
    let scope = frame.state.form.scope;
    let away = scope.axes.transpose() * (middle - scope.world(DVec3::splat(0.5)));
    let mut by = DVec3::ZERO;
    for axis in axes(op, &word)? {
        by[axis] = away[axis];
    }
    place(frame, scope.moved(by));
    Ok(())
}

/// Moves the scope with what is in it; textures that lie on the shape go with it.
pub fn place(frame: &mut Frame, scope: Scope) {
    let before = std::mem::replace(&mut frame.state.form.scope, scope);
    frame
        .state
        .carry_textures(|map| map.carried(&before, &scope));
    frame
        .state
        .carry_marks(|point| scope.world(before.unit(point)));
    frame.changed();
}

fn lengths(
    run: &mut Run<'_>,
    op: &Operation,
    first: usize,
    frame: &mut Frame,
) -> Result<DVec3, Fault> {
    let size = frame.state.form.scope.size;
    let mut found = DVec3::ZERO;
    for axis in 0..3 {
        found[axis] = length(run, op, first + axis, size[axis], frame)?;
    }
    Ok(found)
}

fn fault(op: &Operation, message: impl Into<String>) -> Fault {
    let span = match op.args.first() {
        Some(Arg::Value(_, expr)) => expr.span,
        _ => op.span,
    };
    Fault::at(span, message)
}
