//! `shapeL`, `shapeU` and `shapeO`: faces to wings along their sides and what is between.

use super::super::code::{Operation, Selector};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::components::selectors;
use super::positive;
use super::setbacks::Edges;
use crate::shape::Direction;

/// `shapeL(front, left) { shape : A | remainder : B }`: wings of these depths (m) along the edges
/// that look to the front and to the left in the scope.
pub fn l(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    build(run, op, frame, &[Direction::Front, Direction::Left])
}

/// `shapeU(front, right, left) { shape : A | remainder : B }`
pub fn u(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    build(
        run,
        op,
        frame,
        &[Direction::Front, Direction::Right, Direction::Left],
    )
}

/// `shapeO(front, right, back, left) { shape : A | remainder : B }`
pub fn o(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    use Direction::{Back, Front, Left, Right};
    build(run, op, frame, &[Front, Right, Back, Left])
}

/// Wings that touch are one face.
fn build(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    sides: &[Direction],
) -> Result<(), Fault> {
    let mut depths = Vec::with_capacity(sides.len());
    for index in 0..sides.len() {
        depths.push(positive(run, op, index, frame)?);
    }
    let is_shape =
        |selector: &Selector| matches!(selector, Selector::Word(word) if word.as_ref() == "shape");
    let cell = selectors(op).position(is_shape);
    let edges = Edges::in_one(run, cell, frame);
    let mut distances = vec![0.0; edges.count()];
    for edge in &edges.choosing.found {
        let side = sides.iter().position(|side| edge.direction == Some(*side));
        distances[edge.index] = side.map_or(0.0, |side| depths[side]);
    }
    let pieces = edges.moved(run, op, &distances)?;
    edges.finish(run, op, &pieces, frame)
}
