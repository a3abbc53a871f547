//! Which assets a rule file names.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::code::{Arg, Body, Cell, Code, Expr, ExprKind, Operation, Step};

/// What `i` and `insertAlongUV` are given in a program.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AssetNames {
    /// Names that stand in the rules as they are, or in constants.
    pub written: BTreeSet<Arc<str>>,
    /// Whether there are others, which only a derivation shows.
    pub computed: bool,
}

/// The assets that the rules name.
pub fn asset_names(code: &Code) -> AssetNames {
    let mut found = AssetNames::default();
    for rule in &code.rules {
        in_body(&rule.body, &mut |operation| {
            let place = operation.id.asset_argument();
            match place.and_then(|place| operation.args.get(place)) {
                Some(Arg::Value(_, expr)) => in_expr(expr, code, 0, &mut found),
                Some(Arg::Word(word)) => {
                    found.written.insert(word.clone());
                }
                None => {}
            }
        });
    }
    found
}

fn in_body(body: &Body, seen: &mut impl FnMut(&Operation)) {
    match body {
        Body::Steps(steps) => in_steps(steps, seen),
        Body::Choice(choice) => {
            for (_, branch) in &choice.branches {
                in_body(branch, seen);
            }
            if let Some(otherwise) = &choice.otherwise {
                in_body(otherwise, seen);
            }
        }
    }
}

fn in_steps(steps: &[Step], seen: &mut impl FnMut(&Operation)) {
    for step in steps {
        match step {
            Step::Push(inner) => in_body(inner, seen),
            Step::Operation(operation) => {
                seen(operation);
                in_cells(&operation.cells, seen);
            }
            Step::Rule { .. } | Step::Leaf { .. } | Step::Broken { .. } => {}
        }
    }
}

fn in_cells(cells: &[Cell], seen: &mut impl FnMut(&Operation)) {
    for cell in cells {
        match cell {
            Cell::Part { body, .. } => in_body(body, seen),
            Cell::Repeat(inner) => in_cells(inner, seen),
        }
    }
}

/// Constants may be made of constants; this deep is looked.
const DEEPEST: usize = 8;

fn in_expr(expr: &Expr, code: &Code, depth: usize, found: &mut AssetNames) {
    match &expr.kind {
        ExprKind::Text(text) => {
            found.written.insert(text.clone());
        }
        ExprKind::Choice(choice) => {
            let branches = choice.branches.iter().map(|(_, value)| value);
            for value in branches.chain(&choice.otherwise) {
                in_expr(value, code, depth, found);
            }
        }
        ExprKind::Global(index) if depth < DEEPEST => {
            let global = &code.globals[*index];
            found.computed |= global.is_attribute;
            in_expr(&global.value, code, depth + 1, found);
        }
        _ => found.computed = true,
    }
}
