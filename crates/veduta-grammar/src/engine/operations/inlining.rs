//! Rules whose shapes become the current shape, and booleans with them.

use glam::DVec3;
use veduta_geometry::solid::{boolean_within, joined, Boolean, Mesh};

use super::super::code::{Cell, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::marks::Mark;
use super::super::run::Run;
use super::super::state::State;
use super::word;
use crate::shape::{Form, Geometry, TOLERANCE};

/// `inline Rule`, `inline { operations }`, `inline(append | unify | recompose) ...`: the shapes that
/// the rule leaves become the current shape. `append` puts their faces beside each other, `unify`
/// is their union, `recompose` joins corners at one place.
///
/// One shape is taken as it is. Of several, looks and attributes are those of the current shape,
/// where they are not all alike: other than in CityEngine a shape has one material.
pub fn inline(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let how = match op.args.len() {
        0 => "append".into(),
        _ => word(run, op, 0, frame)?,
    };
    let left = left_by(run, op, 0, frame)?;
    let seed = frame.state.seed;
    frame.state = together(run, op, left, &how, &frame.state)?;
    frame.state.seed = seed;
    frame.changed();
    Ok(())
}

/// `union Rule`, `union { operations }`, `union(swap) ...`: the current shape and what the rule
/// leaves, as one. `union { operations | operations }`: what the two leave of the current shape. With `swap` looks and attributes are those of what the rule leaves.
pub fn union(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    combine(run, op, Boolean::Union, frame)
}

/// `subtract Rule`: the current shape without what the rule leaves; with `swap` the other way
/// round.
pub fn subtract(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    combine(run, op, Boolean::Subtract, frame)
}

/// `intersect Rule`: what the current shape and what the rule leaves have in common.
pub fn intersect(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    combine(run, op, Boolean::Intersect, frame)
}

fn combine(
    run: &mut Run<'_>,
    op: &Operation,
    how: Boolean,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let (first, second) = if let [_, _] = op.cells[..] {
        (operand(run, op, 0, frame)?, operand(run, op, 1, frame)?)
    } else {
        let swapped = !op.args.is_empty() && word(run, op, 0, frame)?.as_ref() == "swap";
        let other = operand(run, op, 0, frame)?;
        if swapped {
            (other, frame.state.clone())
        } else {
            (frame.state.clone(), other)
        }
    };
    let marks = if run.code.tags {
        let mut marks = first.marked(Some("bool.A"));
        marks.extend(second.marked(Some("bool.B")));
        marks
    } else {
        Vec::new()
    };
    let seed = frame.state.seed;
    frame.state = combined(run, op, first, &second, how)?;
    frame.state.seed = seed;
    if run.code.tags {
        // What both had is a tag of single faces now.
        frame.state.extra_mut().tags.clear();
        put_together_of(&mut frame.state, marks);
    }
    frame.changed();
    Ok(())
}

/// What a rule or a block of an operation leaves of the current shape, united.
fn operand(
    run: &mut Run<'_>,
    op: &Operation,
    cell: usize,
    frame: &mut Frame,
) -> Result<State, Fault> {
    let left = left_by(run, op, cell, frame)?;
    together(run, op, left, "unify", &frame.state)
}

fn left_by(
    run: &mut Run<'_>,
    op: &Operation,
    cell: usize,
    frame: &mut Frame,
) -> Result<Vec<State>, Fault> {
    let Some(Cell::Part { body, .. }) = op.cells.get(cell) else {
        return Err(Fault::at(op.span, "a rule or a block is needed"));
    };
    run.inlined(body, frame.state.clone(), op.span, frame)
}

/// Several shapes as one, of which `current` says what they do not agree about.
fn together(
    run: &Run<'_>,
    op: &Operation,
    mut shapes: Vec<State>,
    how: &str,
    current: &State,
) -> Result<State, Fault> {
    if shapes.len() == 1 {
        return Ok(shapes.remove(0));
    }
    let Some(first) = shapes.first().cloned() else {
        return Ok(emptied(current.clone()));
    };
    if how == "unify" {
        let mut whole = first;
        for shape in &shapes[1..] {
            run.check_time(op.span)?;
            whole = combined(run, op, whole, shape, Boolean::Union)?;
        }
        return Ok(agreed(run, &shapes, current.with_form(whole.form)));
    }
    let meshes: Vec<Mesh> = shapes.iter().map(|shape| shape.form.world_mesh()).collect();
    let solid = shapes.iter().all(|shape| shape.form.geometry.is_solid());
    let parts: Vec<&Mesh> = meshes.iter().collect();
    let axes = current.form.scope.axes;
    let form = if how == "recompose" {
        let mesh = recomposed(&parts);
        let solid = mesh.is_closed();
        Form::around(mesh, axes, solid)
    } else {
        let mut all = Mesh::new();
        parts.iter().for_each(|part| all.append(part));
        Form::around(all, axes, solid)
    };
    Ok(agreed(run, &shapes, current.with_form(form)))
}

/// Meshes as one with corners at one place as one.
pub fn recomposed(parts: &[&Mesh]) -> Mesh {
    let bounds = parts.iter().filter_map(|part| part.bounds());
    let around = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let extent = around.map_or(0.0, |(low, high)| low.distance(high));
    joined(parts, extent * TOLERANCE)
}

/// The shape with the look that all of `shapes` have, and with their tags where their faces are.
fn agreed(run: &Run<'_>, shapes: &[State], mut whole: State) -> State {
    if run.code.tags {
        let marks = shapes.iter().flat_map(|shape| shape.marked(None)).collect();
        put_together_of(&mut whole, marks);
    }
    let same = shapes.windows(2).all(|pair| pair[0].look == pair[1].look);
    if let (true, Some(first)) = (same, shapes.first()) {
        whole.look = first.look.clone();
    }
    whole
}

/// Says which tagged surfaces a shape is made of, and that it is nothing else as a whole.
fn put_together_of(whole: &mut State, marks: Vec<Mark>) {
    let extra = whole.extra_mut();
    extra.made = None;
    extra.marks = marks;
}

fn emptied(mut state: State) -> State {
    state.form.geometry = Geometry::Nothing;
    state
}

/// Two shapes as one, with what the first has besides its geometry.
fn combined(
    run: &Run<'_>,
    op: &Operation,
    first: State,
    second: &State,
    how: Boolean,
) -> Result<State, Fault> {
    let (a, b) = (first.form.world_mesh(), second.form.world_mesh());
    if b.is_empty() || a.is_empty() {
        return Ok(match how {
            Boolean::Union if a.is_empty() => first.with_form(second.form.clone()),
            Boolean::Intersect => emptied(first),
            _ => first,
        });
    }
    let closed = [&first, second].map(|shape| shape.form.geometry.is_solid());
    let works = match closed {
        [_, true] => true,
        [true, false] => how == Boolean::Union,
        [false, false] => is_level(&a, &b),
    };
    if !works {
        let message = "open shapes can be combined where they lie in one plane, or with a closed \
                       one that cuts them";
        return Err(Fault::at(op.span, message));
    }
    run.check_time(op.span)?;
    let found = boolean_within(&a, &b, how, run.budget());
    let found = found.map_err(|error| run.failed(op.span, error))?;
    if found.mesh.is_empty() {
        return Ok(emptied(first));
    }
    let axes = first.form.scope.axes;
    let form = Form::around(found.mesh, axes, closed == [true; 2]);
    Ok(first.with_form(form))
}

/// Whether all faces of two meshes lie in one plane.
fn is_level(a: &Mesh, b: &Mesh) -> bool {
    let normal = a.faces().next().map_or(DVec3::ZERO, |face| face.normal());
    let heights = a
        .points
        .iter()
        .chain(&b.points)
        .map(|point| point.dot(normal));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
        (low.min(h), high.max(h))
    });
    let extent = a
        .points
        .iter()
        .chain(&b.points)
        .map(|p| p.abs().max_element());
    let extent = extent.fold(0.0, f64::max);
    normal != DVec3::ZERO && high - low <= TOLERANCE * extent.max(1.0)
}
