//! `print`, `report` and `label`: what a rule says of a shape.

use super::super::code::{Arg, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::{Run, MOST_MESSAGES};
use super::super::value::Value;
use super::{value, word};

/// `print(value)`
pub fn print(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let value = value(run, op, 0, frame)?;
    run.write(&value, op.span)
}

/// `report(key, value)`
pub fn report(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let key = word(run, op, 0, frame)?;
    let Arg::Value(_, expr) = &op.args[1] else {
        return Err(Fault::at(op.span, "a value is needed"));
    };
    let value = run.evaluate(expr, frame)?;
    if run.tree.reports.len() < MOST_MESSAGES {
        run.hold(
            key.len() + size_of::<Value>() * value.element_count(),
            op.span,
        )?;
        run.tree.reports.push((key, value));
    }
    Ok(())
}

/// `label(name)`: the shape as it is now has this name for questions such as `touches(intra, name)`.
/// An empty name is none.
pub fn label(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let name = word(run, op, 0, frame)?;
    if !name.is_empty() {
        run.record(Some(name), &frame.state, op.span)?;
    }
    Ok(())
}
