//! The operations that shapes are made with; each is a function of the run and the frame.

mod appearance;
mod components;
mod dividing;
mod solids;
mod speech;
mod transform;

use std::sync::Arc;

use super::fault::Fault;
use super::program::{Arg, Operation, Sizing};
use super::run::{Frame, Run};

/// An operation: its place in the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OperationId(usize);

type Work = fn(&mut Run<'_>, &Operation, &mut Frame) -> Result<(), Fault>;

/// What the table says of an operation.
#[derive(Clone, Copy)]
pub struct Entry {
    name: &'static str,
    work: Work,
    /// The fewest and most arguments.
    pub args: (usize, usize),
    /// How many of the first arguments are words, not values, where there are as many arguments
    /// as the operation can have, and where there are fewer.
    words: (usize, usize),
}

const fn entry(
    name: &'static str,
    work: Work,
    args: (usize, usize),
    words: (usize, usize),
) -> Entry {
    Entry {
        name,
        work,
        args,
        words,
    }
}

const TABLE: &[Entry] = &[
    entry("NIL", appearance::nothing, (0, 0), (0, 0)),
    entry("alignScopeToAxes", transform::align_to_axes, (0, 1), (1, 0)),
    entry("center", transform::center, (1, 1), (1, 0)),
    entry("color", appearance::colour, (1, 4), (0, 0)),
    entry("comp", components::components, (1, 1), (1, 0)),
    entry("extrude", solids::extrude, (1, 2), (1, 0)),
    entry("primitiveCube", solids::cube, (0, 3), (0, 0)),
    entry("primitiveQuad", solids::quad, (0, 2), (0, 0)),
    entry("print", speech::print, (1, 1), (0, 0)),
    entry("r", transform::turn_scope, (3, 4), (1, 0)),
    entry("report", speech::report, (2, 2), (0, 0)),
    entry("rotate", transform::rotate, (5, 5), (2, 0)),
    entry("s", transform::resize, (3, 3), (0, 0)),
    entry("set", appearance::set, (2, 2), (1, 0)),
    entry("split", dividing::split, (1, 2), (2, 1)),
    entry("t", transform::move_scope, (3, 3), (0, 0)),
    entry("texture", appearance::texture, (1, 1), (0, 0)),
    entry("translate", transform::translate, (5, 5), (2, 0)),
];

impl OperationId {
    /// The operation of this name.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().position(|entry| entry.name == name).map(Self)
    }

    pub fn entry(self) -> Entry {
        TABLE[self.0]
    }
}

impl Entry {
    /// Whether the argument at `index` of `count` is a word.
    pub fn is_word(&self, index: usize, count: usize) -> bool {
        let words = if count == self.args.1 {
            self.words.0
        } else {
            self.words.1
        };
        index < words
    }
}

/// The names of all operations that derive.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|entry| entry.name)
}

pub(super) fn run(
    run: &mut Run<'_>,
    operation: &Operation,
    frame: &mut Frame,
) -> Result<(), Fault> {
    (operation.id.entry().work)(run, operation, frame)
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
