//! `set`: attributes of the rule file and of the shape.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::super::code::{Arg, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::materials;
use super::super::run::Run;
use super::super::shape_attributes::pivot;
use super::super::value::Value;
use super::transform::place;
use super::word;
use crate::builtins::attributes;
use crate::shape::{degrees_of, turn, Scope};

/// `set(name, value)`: a material's property, the place, turn or size of the scope, or an attribute of
/// the rule file for this shape and its children; what chances are drawn from, here and in the shapes
/// made of this one (`seedian`); `material.name` says what the surface is in the
/// model.
pub fn set(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let name = word(run, op, 0, frame)?;
    let is_own = run.code.globals.iter().any(|global| global.name == name);
    if matches!(op.args[0], Arg::Value(..)) && !is_own && !attributes::is_settable(&name) {
        let message = format!("`{name}` is no attribute that can be set");
        return Err(Fault::at(op.span, message));
    }
    let Arg::Value(_, expr) = &op.args[1] else {
        return Err(Fault::at(op.span, "a value is needed"));
    };
    let mut value = run.evaluate(expr, frame)?;
    let attribute = run
        .code
        .globals
        .iter()
        .position(|global| global.name == name);
    if let (Value::Number(number), None) = (&value, attribute) {
        value = Value::Number(run.without_bounds(*number, expr.span)?);
    }
    match (name.as_ref(), attribute) {
        (_, Some(index)) => {
            let mut set = frame.state.set.take().map(Arc::unwrap_or_clone);
            set.get_or_insert_with(BTreeMap::new).insert(index, value);
            frame.state.set = set.map(Arc::new);
        }
        ("seedian", _) => {
            let wanted = || Fault::at(expr.span, format!("`seedian` is a number, not `{value}`"));
            frame.reseed(value.number().ok_or_else(wanted)?);
        }
        ("trim.horizontal", _) => {
            frame.state.extra_mut().trims_level = value.truth().unwrap_or(false);
        }
        ("trim.vertical", _) => {
            frame.state.extra_mut().keeps_steep = !value.truth().unwrap_or(true);
        }
        (scope, _) if scope.starts_with("scope.") => {
            let pivot = pivot(&frame.state, run.first());
            set_scope(scope, &value, pivot, frame)
                .map_err(|message| Fault::at(expr.span, message))?
        }
        (property, _) => {
            let look = Arc::make_mut(&mut frame.state.look);
            materials::set(look, property, &value, &run.options.textures)
                .map_err(|message| Fault::at(expr.span, message))?;
        }
    }
    frame.changed();
    Ok(())
}

/// `scope.tx`, `scope.rx`, `scope.sx` and their like: what is in the scope goes with it. Places and
/// turns are about the pivot.
fn set_scope(
    name: &str,
    value: &Value,
    (origin, axes): (DVec3, DMat3),
    frame: &mut Frame,
) -> Result<(), String> {
    let number = value.number().filter(|number| number.is_finite());
    let number = number.ok_or_else(|| format!("`{name}` is a finite number, not `{value}`"))?;
    let known = |text: &str| ["x", "y", "z"].iter().position(|one| *one == text);
    let parts = name
        .strip_prefix("scope.")
        .and_then(|rest| rest.split_at_checked(1));
    let Some((kind, axis)) = parts.and_then(|(kind, axis)| Some((kind, known(axis)?))) else {
        return Err(format!("`{name}` cannot be set"));
    };
    let mut scope: Scope = frame.state.form.scope;
    match kind {
        "s" => scope.size[axis] = number.max(0.0),
        "t" => {
            let mut local = axes.transpose() * (scope.origin - origin);
            local[axis] = number;
            scope.origin = origin + axes * local;
        }
        _ => {
            let mut degrees = degrees_of(axes.transpose() * scope.axes);
            degrees[axis] = number;
            scope.axes = axes * turn(degrees);
        }
    }
    place(frame, scope);
    Ok(())
}
