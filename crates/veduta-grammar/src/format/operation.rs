//! Operations, blocks and alternatives.

use super::doc::Doc;
use super::expression::{bracketed, expression};
use super::statement::right_side;
use super::words::Words;
use crate::ast::{Block, Body, Branches, Call, Cell, Operation, Test};
use crate::token::TokenKind;

pub(super) fn body(words: &mut Words, does: &Body) -> Doc {
    match does {
        Body::Operations(list) => operations(words, list),
        Body::Branches(all) => branches(words, all, body),
    }
}

/// The right side of a rule: alternatives have lines of their own, those within them too.
pub(super) fn tall_body(words: &mut Words, does: &Body) -> Doc {
    match does {
        Body::Operations(list) => operations(words, list),
        Body::Branches(all) => Doc::Concat(vec![Doc::Tall, branches(words, all, tall_body)]),
    }
}

fn operations(words: &mut Words, list: &[Operation]) -> Doc {
    let mut parts = Vec::new();
    for (index, one) in list.iter().enumerate() {
        if index > 0 {
            parts.push(Doc::Line);
        }
        parts.push(operation(words, one));
    }
    Doc::Concat(parts)
}

fn operation(words: &mut Words, one: &Operation) -> Doc {
    match one {
        Operation::Call(call) => call_of(words, call),
        Operation::Push { body: inside, .. } => {
            let open = words.take();
            let inside = vec![Doc::Line, body(words, inside)];
            Doc::group(vec![open, Doc::Indented(inside), Doc::Line, words.take()])
        }
    }
}

fn call_of(words: &mut Words, call: &Call) -> Doc {
    let mut parts = vec![words.take()];
    if call.args.is_some() {
        parts.push(bracketed(words, Doc::Soft));
    }
    for one in call.block.iter().chain(&call.rest) {
        parts.push(Doc::text(" "));
        parts.push(block(words, one));
    }
    Doc::Concat(parts)
}

fn block(words: &mut Words, block: &Block) -> Doc {
    match block {
        Block::Cells {
            cells: list,
            repeat,
            ..
        } => cells(words, list, *repeat),
        Block::Body { body: does, .. } if words.kind() == TokenKind::OpenBrace => {
            let open = words.take();
            let inside = vec![Doc::Line, body(words, does)];
            Doc::group(vec![open, Doc::Indented(inside), Doc::Line, words.take()])
        }
        Block::Body { body: does, .. } => body(words, does),
        Block::Operands { first, second, .. } => {
            let mut parts = vec![words.take()];
            let mut inside = vec![Doc::Line, body(words, first), Doc::Line];
            inside.extend([words.take(), Doc::text(" "), body(words, second)]);
            parts.extend([Doc::Indented(inside), Doc::Line, words.take()]);
            Doc::group(parts)
        }
    }
}

/// `{ cell | cell }`, and `*` if it is repeated.
fn cells(words: &mut Words, list: &[Cell<Body>], repeat: bool) -> Doc {
    let mut parts = vec![words.take()];
    let mut inside = Vec::new();
    for one in list {
        inside.push(Doc::Line);
        if inside.len() > 1 {
            inside.extend([words.take(), Doc::text(" ")]);
        }
        inside.push(cell(words, one));
    }
    parts.extend([Doc::Indented(inside), Doc::Line, words.take()]);
    if repeat {
        parts.push(words.take());
    }
    Doc::group(parts)
}

fn cell(words: &mut Words, cell: &Cell<Body>) -> Doc {
    match cell {
        Cell::Group {
            cells: list,
            repeats,
            ..
        } => cells(words, list, *repeats),
        Cell::Part {
            selector,
            body: does,
            ..
        } if selector.span.range().is_empty() => body(words, does),
        Cell::Part {
            selector,
            depth,
            body: does,
            ..
        } => {
            let mut parts = vec![expression(words, selector.span.end)];
            parts.extend([Doc::text(" "), words.take()]);
            if let Some(depth) = depth {
                parts.extend([Doc::text(" "), expression(words, depth.span.end)]);
                parts.extend([Doc::text(" "), words.take()]);
            }
            parts.push(right_side(words, does));
            Doc::Concat(parts)
        }
    }
}

/// Each alternative on a line of its own, unless all of them fit on one.
pub(super) fn branches<T>(
    words: &mut Words,
    all: &Branches<T>,
    part: fn(&mut Words, &T) -> Doc,
) -> Doc {
    let mut parts = Vec::new();
    for (index, branch) in all.branches.iter().enumerate() {
        if index > 0 {
            parts.push(Doc::Line);
        }
        let mut test = Vec::new();
        if all.test == Test::Case {
            test.extend([words.take(), Doc::text(" ")]);
        }
        test.push(expression(words, branch.test.span.end));
        if all.test == Test::Chance {
            test.push(words.take()); // %
        }
        parts.push(alternative(words, test, &branch.then, part));
    }
    if let Some(otherwise) = &all.otherwise {
        parts.push(Doc::Line);
        let test = vec![words.take()];
        parts.push(alternative(words, test, otherwise.as_ref(), part));
    }
    Doc::Concat(parts)
}

/// `test : what to do`
fn alternative<T>(
    words: &mut Words,
    mut test: Vec<Doc>,
    then: &T,
    part: fn(&mut Words, &T) -> Doc,
) -> Doc {
    test.extend([Doc::text(" "), words.take()]);
    let inside = vec![Doc::Line, part(words, then)];
    test.push(Doc::group(vec![Doc::Indented(inside)]));
    Doc::Concat(test)
}
