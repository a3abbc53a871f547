//! `comp`: a shape to its faces, edges or vertices.

use std::sync::Arc;

use glam::DMat3;
use veduta_geometry::solid::Mesh;

use super::super::code::{Body, Cell, Operation, Selector};
use super::super::fault::Fault;
use super::super::run::{Frame, Run};
use super::super::state::{Place, State};
use super::word;
use crate::shape::{self, is_selected, Component, Form, Kind};

/// `comp(f) { front : A | side : B | all = C }`: each component goes to the first cell that
/// selects it. After `:` each is a shape of its own, after `=` those of the cell are one.
pub fn components(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let kind = match word(run, op, 0, frame)?.as_ref() {
        "f" => Kind::Faces,
        "e" | "fe" => Kind::Edges,
        "v" => Kind::Vertices,
        other => {
            let message = format!("`{other}` is no component: f, e or v");
            return Err(Fault::at(op.span, message));
        }
    };
    let found = shape::components(&frame.state.form, kind);
    let chosen = assigned(run, op, &found, frame)?;
    let whole = frame.state.clone();
    for (cell, picked) in op.cells.iter().zip(chosen) {
        let Cell::Part {
            selector,
            combined,
            body,
        } = cell
        else {
            return Err(Fault::at(op.span, "components do not repeat"));
        };
        let name: Arc<str> = match selector {
            Selector::Word(word) => word.clone(),
            Selector::Value(..) => "".into(),
        };
        let shapes = if *combined {
            combine(&whole, &picked, &found)
        } else {
            picked.iter().map(|&at| found[at].form.clone()).collect()
        };
        run_shapes(run, body, shapes, &picked, &whole, &name, frame)?;
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

fn run_shapes(
    run: &mut Run<'_>,
    body: &Body,
    shapes: Vec<Form>,
    picked: &[usize],
    whole: &State,
    name: &Arc<str>,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let total = shapes.len();
    for (form, index) in shapes.into_iter().zip(picked) {
        let mut state = whole.with_form(form);
        state.comp = Place {
            index: *index,
            total,
        };
        state.selector = name.clone();
        run.run_cell(body, state, frame)?;
    }
    Ok(())
}

/// The components of each cell.
fn assigned(
    run: &mut Run<'_>,
    op: &Operation,
    found: &[Component],
    frame: &mut Frame,
) -> Result<Vec<Vec<usize>>, Fault> {
    let mut free = vec![true; found.len()];
    let mut chosen = Vec::with_capacity(op.cells.len());
    for cell in &op.cells {
        let mut picked = Vec::new();
        if let Cell::Part { selector, .. } = cell {
            for (at, component) in found.iter().enumerate() {
                if free[at] && selects(run, op, selector, component, frame)? {
                    free[at] = false;
                    picked.push(at);
                }
            }
        }
        chosen.push(picked);
    }
    Ok(chosen)
}

fn selects(
    run: &mut Run<'_>,
    op: &Operation,
    selector: &Selector,
    component: &Component,
    frame: &mut Frame,
) -> Result<bool, Fault> {
    match selector {
        Selector::Word(word) => is_selected(word, component.direction)
            .ok_or_else(|| Fault::at(op.span, format!("`{word}` selects no component"))),
        Selector::Value(_, expr) => {
            let index = run.evaluate_number(expr, frame)?;
            Ok(index == component.index as f64)
        }
    }
}

/// The picked components as one shape along the axes of the whole; none where nothing is picked.
fn combine(whole: &State, picked: &[usize], found: &[Component]) -> Vec<Form> {
    if picked.is_empty() {
        return Vec::new();
    }
    let mut all = Mesh::new();
    for &at in picked {
        all.append(&found[at].form.world_mesh());
    }
    let axes: DMat3 = whole.form.scope.axes;
    vec![Form::around(all, axes, false)]
}
