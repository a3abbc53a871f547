//! `comp`: a shape to its faces, edges, vertices or holes.

use std::sync::Arc;

use glam::DMat3;
use veduta_geometry::solid::{joined, Mesh};

use super::super::code::{Body, Cell, Operation, Selector};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::selection::{kind_named, Choosing};
use super::super::state::{Place, State};
use super::trimming::planes;
use super::word;
use crate::shape::{Component, Form, Kind, TOLERANCE};

/// `comp(f) { front : A | side : B | all = C }`: each component goes to the first cell that
/// selects it. After `:` each is a shape of its own, after `=` those of the cell are one. `f` are
/// faces, `e` edges, each once, `fe` the edges of each face, `v` vertices, `h` what fills holes.
///
/// Selectors are words, numbers (-1 is the last) and conditions, which may be joined by `&&`, `||`
/// and `!`. Other than in CityEngine, `street.front` and its like are always what `object.front`
/// is, and an edge between faces looks along the mean of their normals.
pub fn components(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let kind = word(run, op, 0, frame)?;
    let Some(kind) = kind_named(&kind) else {
        let message = format!("`{kind}` is no component: f, e, fe, v or h");
        return Err(Fault::at(op.span, message));
    };
    run.record(None, &frame.state, op.span)?;
    let whole = frame.state.clone();
    let choosing = Choosing::of(&whole.form, kind, run);
    let mut planes = match kind {
        Kind::Faces if run.code.trims => planes(&choosing.found),
        _ => Vec::new(),
    };
    let chosen = run.chosen(selectors(op), &choosing, op.span, &mut frame.scene())?;
    for (cell, picked) in op.cells.iter().zip(chosen) {
        let Some((selector, combined, body)) = cell.part() else {
            return Err(Fault::at(op.span, "components do not repeat"));
        };
        let shapes = if combined {
            combine(&whole, &picked, &choosing.found)
        } else {
            let form = |&at: &usize| (choosing.found[at].form.clone(), choosing.found[at].index);
            picked.iter().map(form).collect()
        };
        if !planes.is_empty() && !combined {
            for (&at, shape) in picked.iter().zip(shapes) {
                let mut trimmed = whole.clone();
                trimmed.extra_mut().trims = std::mem::take(&mut planes[at]);
                run_shape(
                    run,
                    body,
                    shape,
                    picked.len(),
                    &trimmed,
                    &name_of(selector),
                    frame,
                )?;
            }
            continue;
        }
        run_shapes(run, body, shapes, &whole, &name_of(selector), frame)?;
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

/// The selectors of an operation's cells.
pub fn selectors(op: &Operation) -> impl Iterator<Item = &Selector> {
    op.cells.iter().filter_map(|cell| match cell {
        Cell::Part { selector, .. } => Some(selector),
        Cell::Repeat(_) => None,
    })
}

/// What `comp.sel` is in a cell.
pub fn name_of(selector: &Selector) -> Arc<str> {
    match selector {
        Selector::Word(word) => word.clone(),
        Selector::Value(..) => "".into(),
    }
}

/// Runs a cell's body on each of these shapes, which have their numbers with them.
pub fn run_shapes(
    run: &mut Run<'_>,
    body: &Body,
    shapes: Vec<(Form, usize)>,
    whole: &State,
    name: &Arc<str>,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let total = shapes.len();
    for shape in shapes {
        run_shape(run, body, shape, total, whole, name, frame)?;
    }
    Ok(())
}

/// Runs a cell's body on one of `total` shapes.
fn run_shape(
    run: &mut Run<'_>,
    body: &Body,
    (form, index): (Form, usize),
    total: usize,
    whole: &State,
    name: &Arc<str>,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let mut state = whole.component(form);
    state.comp = Place { index, total };
    state.selector = name.clone();
    run.run_cell(body, state, frame)
}

/// The picked components as one shape along the axes of the whole; none where nothing is picked.
fn combine(whole: &State, picked: &[usize], found: &[Component]) -> Vec<(Form, usize)> {
    let Some(&first) = picked.first() else {
        return Vec::new();
    };
    let parts: Vec<Mesh> = picked
        .iter()
        .map(|&at| found[at].form.world_mesh())
        .collect();
    // What met in a corner still does.
    let near = TOLERANCE * whole.form.scope.size.length();
    let all = joined(&parts.iter().collect::<Vec<_>>(), near);
    let axes: DMat3 = whole.form.scope.axes;
    vec![(Form::around(all, axes, false), found[first].index)]
}
