//! `split`: a shape to parts along an axis.

use super::super::code::{Body, Cell, Operation, Selector, Sizing};
use super::super::fault::Fault;
use super::super::run::{Frame, Run};
use super::super::state::Place;
use super::{axes, word};
use crate::shape::{self, cells, Pattern, Size};

/// `split(x) { 'size : A | ~size : B | { ... }* }`
pub fn split(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let axis = axes(op, &word(run, op, 0, frame)?)?[0];
    let adjust = op.args.len() < 2 || word(run, op, 1, frame)?.as_ref() != "noAdjust";
    let mut bodies = Vec::new();
    let mut patterns = patterns(run, op, &op.cells, &mut bodies, frame)?;
    if op.repeat {
        patterns = vec![Pattern::Repeat(patterns)];
    }
    let whole = frame.state.clone();
    let most = run.options.limits.parts;
    let found = cells(&patterns, whole.form.scope.size[axis], most)
        .map_err(|many| Fault::at(op.span, format!("a split into {} parts", many.parts)))?;
    let parts = shape::split(&whole.form, axis, &found, adjust);
    let total = parts.len();
    for (index, (cell, form)) in parts.into_iter().enumerate() {
        let mut state = whole.with_form(form);
        state.split = Place { index, total };
        run.run_cell(bodies[cell.part], state, frame)?;
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

/// The sizes of the cells as they are now; the bodies in the order in which parts are numbered.
fn patterns<'o>(
    run: &mut Run<'_>,
    op: &Operation,
    cells: &'o [Cell],
    bodies: &mut Vec<&'o Body>,
    frame: &mut Frame,
) -> Result<Vec<Pattern>, Fault> {
    let mut found = Vec::with_capacity(cells.len());
    for cell in cells {
        found.push(match cell {
            Cell::Part { selector, body, .. } => {
                bodies.push(body);
                Pattern::Part(size(run, op, selector, frame)?)
            }
            Cell::Repeat(inner) => Pattern::Repeat(patterns(run, op, inner, bodies, frame)?),
        });
    }
    Ok(found)
}

fn size(
    run: &mut Run<'_>,
    op: &Operation,
    selector: &Selector,
    frame: &mut Frame,
) -> Result<Size, Fault> {
    let Selector::Value(sizing, expr) = selector else {
        return Err(Fault::at(op.span, "a cell of a split begins with its size"));
    };
    let number = run.evaluate_number(expr, frame)?;
    if !number.is_finite() {
        return Err(Fault::at(expr.span, format!("a size of {number} m")));
    }
    let whole = || match op.args.first() {
        Some(super::Arg::Word(word)) => axes(op, word).map(|axes| axes[0]),
        _ => Ok(0),
    };
    Ok(match sizing {
        Sizing::Absolute => Size::Absolute(number),
        Sizing::Relative => Size::Relative(number),
        Sizing::Floating => Size::Floating(number),
        Sizing::FloatingRelative => Size::Floating(number * frame.state.form.scope.size[whole()?]),
    })
}
