//! `comp`: a shape to its faces, edges, vertices or holes.

use std::sync::Arc;

use super::super::code::{Body, Cell, Operation, Selector};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::selection::{kind_named, Choosing};
use super::super::state::{Place, State};
use super::trimming::planes;
use super::word;
use crate::ast::Joining;
use crate::shape::{Form, Kind};

/// `comp(f) { front : A | side : B | all = C }`: each component goes to the first cell that
/// selects it. After `:` each is a shape of its own, after `=` those of the cell are one, after `=:`
/// those of the cell that hang together are one. `f` are faces, `e` edges, each once, `fe` the edges of each face, `v` vertices,
/// `fv` the corners of each face, `h` what fills holes,
/// `g` and `m` the groups and materials of an asset. With `noAlign` the scopes have the axes
/// of the shape, whose pivot stays.
///
/// Selectors are words, numbers (-1 is the last) and conditions, which may be joined by `&&`, `||`
/// and `!`. Other than in CityEngine, `street.front` and its like are always what `object.front`
/// is, and an edge between faces looks along the mean of their normals.
pub fn components(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let kind = word(run, op, 0, frame)?;
    let Some(kind) = kind_named(&kind) else {
        let message = format!("`{kind}` is no component: f, e, fe, v, fv, g, m or h");
        return Err(Fault::at(op.span, message));
    };
    run.record(None, &frame.state, op.span)?;
    let whole = frame.state.clone();
    let choosing = Choosing::of(&whole.form, kind, run).textured(&whole, 0.0);
    let mut choosing = choosing.map_err(|message| Fault::at(op.span, message))?;
    if op.args.len() > 1 && word(run, op, 1, frame)?.as_ref() == "noAlign" {
        choosing = choosing.unaligned();
    }
    let mut planes = match kind {
        Kind::Faces if run.code.trims => planes(&choosing.found),
        _ => Vec::new(),
    };
    let chosen = run.chosen(selectors(op), &choosing, op.span, &mut frame.scene())?;
    for (cell, picked) in op.cells.iter().zip(chosen) {
        let Some((selector, joining, body)) = cell.part() else {
            return Err(Fault::at(op.span, "components do not repeat"));
        };
        let each = joining == Joining::Each;
        let shapes: Vec<Form> = if each {
            let form = |&at: &usize| choosing.found[at].form.clone();
            picked.iter().map(form).collect()
        } else {
            let groups = choosing.together(picked.clone(), joining);
            let forms = groups.iter().map(|group| choosing.combined(group));
            forms.flatten().collect()
        };
        if each && matches!(kind, Kind::Groups | Kind::Materials) {
            let total = picked.len();
            for (index, &at) in picked.iter().enumerate() {
                let place = Place { index, total };
                let form = choosing.found[at].form.clone();
                let mut state = whole.selected(form, place, selector.name());
                choosing.dress(&mut state, at);
                run.run_cell(body, state, frame)?;
            }
            continue;
        }
        if !planes.is_empty() && each {
            let total = picked.len();
            for ((index, &at), shape) in picked.iter().enumerate().zip(shapes) {
                let place = Place { index, total };
                let mut state = whole.selected(shape, place, selector.name());
                state.extra_mut().trims = std::mem::take(&mut planes[at]);
                run_component(run, body, state, choosing.has_pivots(), frame)?;
            }
            continue;
        }
        let total = shapes.len();
        for (index, shape) in shapes.into_iter().enumerate() {
            let place = Place { index, total };
            let state = whole.selected(shape, place, selector.name());
            run_component(run, body, state, choosing.has_pivots(), frame)?;
        }
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

/// Runs a cell's body on each of these shapes. `comp.index` counts those of the cell.
pub fn run_shapes(
    run: &mut Run<'_>,
    body: &Body,
    shapes: Vec<Form>,
    whole: &State,
    name: &Arc<str>,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let total = shapes.len();
    for (index, shape) in shapes.into_iter().enumerate() {
        let place = Place { index, total };
        run.run_cell(body, whole.selected(shape, place, name.clone()), frame)?;
    }
    Ok(())
}

/// Runs a cell's body on a component, which may have a pivot of its own.
fn run_component(
    run: &mut Run<'_>,
    body: &Body,
    mut state: State,
    has_pivot: bool,
    frame: &mut Frame,
) -> Result<(), Fault> {
    if has_pivot && run.code.tells_pivot {
        state.pivot_here();
    }
    run.run_cell(body, state, frame)
}
