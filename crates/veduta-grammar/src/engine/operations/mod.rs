//! The operations that shapes are made with; each is a function of the run and the frame.

mod appearance;
mod components;
mod dividing;
mod roofs;
mod solids;
mod speech;
mod transform;

use std::sync::Arc;

use super::code::{Arg, Operation, Sizing};
use super::fault::Fault;
use super::run::{Frame, Run};

/// An operation: its place in the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OperationId(usize);

type Work = fn(&mut Run<'_>, &Operation, &mut Frame) -> Result<(), Fault>;

/// All operations that derive, and the fewest and most arguments of each.
const TABLE: &[(&str, Work, usize, usize)] = &[
    ("NIL", appearance::nothing, 0, 0),
    ("alignScopeToAxes", transform::align_to_axes, 0, 1),
    ("center", transform::center, 1, 1),
    ("color", appearance::colour, 1, 4),
    ("comp", components::components, 1, 1),
    ("extrude", solids::extrude, 1, 2),
    ("primitiveCube", solids::cube, 0, 3),
    ("primitiveQuad", solids::quad, 0, 2),
    ("print", speech::print, 1, 1),
    ("r", transform::turn_scope, 3, 4),
    ("report", speech::report, 2, 2),
    ("reverseNormals", solids::reverse, 0, 0),
    ("roofGable", roofs::gable, 1, 2),
    ("roofHip", roofs::hip, 1, 2),
    ("rotate", transform::rotate, 5, 5),
    ("s", transform::resize, 3, 3),
    ("set", appearance::set, 2, 2),
    ("split", dividing::split, 1, 2),
    ("t", transform::move_scope, 3, 3),
    ("texture", appearance::texture, 1, 1),
    ("translate", transform::translate, 5, 5),
];

impl OperationId {
    /// The operation of this name.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().position(|entry| entry.0 == name).map(Self)
    }

    /// The fewest and most arguments.
    pub fn arguments(self) -> (usize, usize) {
        (TABLE[self.0].2, TABLE[self.0].3)
    }
}

/// The names of all operations that derive.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|entry| entry.0)
}

pub(super) fn run(
    run: &mut Run<'_>,
    operation: &Operation,
    frame: &mut Frame,
) -> Result<(), Fault> {
    TABLE[operation.id.0].1(run, operation, frame)
}

/// The argument at `index` as metres; `'` takes it of `whole`.
fn length(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    whole: f64,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    match &operation.args[index] {
        Arg::Value(Sizing::Absolute, expr) => run.evaluate_number(expr, frame),
        Arg::Value(Sizing::Relative, expr) => Ok(whole * run.evaluate_number(expr, frame)?),
        Arg::Value(_, expr) => Err(Fault::at(expr.span, "`~` has a meaning in splits alone")),
        Arg::Word(word) => Err(Fault::at(
            operation.span,
            format!("a number is needed, not `{word}`"),
        )),
    }
}

/// The argument at `index` as a number that has nothing to do with the scope's size.
fn number(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    length(run, operation, index, 1.0, frame)
}

/// The argument at `index` as a word: as it is written, or the value of a string.
fn word(
    run: &mut Run<'_>,
    operation: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<Arc<str>, Fault> {
    match &operation.args[index] {
        Arg::Word(word) => Ok(word.clone()),
        Arg::Value(_, expr) => Ok(run.evaluate(expr, frame)?.to_string().into()),
    }
}

/// The axes that a word such as `xz` names.
fn axes(operation: &Operation, word: &str) -> Result<Vec<usize>, Fault> {
    let place = |letter: char| "xyz".find(letter);
    let found: Option<Vec<usize>> = word.chars().map(place).collect();
    found.filter(|axes| !axes.is_empty()).ok_or_else(|| {
        Fault::at(
            operation.span,
            format!("axes are needed (x, y, z), not `{word}`"),
        )
    })
}
