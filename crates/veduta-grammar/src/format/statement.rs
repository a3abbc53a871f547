//! Statements.

use super::doc::Doc;
use super::expression::{annotation_args, bracketed, expression};
use super::operation::{body, branches, tall_body};
use super::words::Words;
use crate::ast::{
    Annotation, Body, ExprKind, Ident, Import, Item, ItemKind, Local, Override, Rule, RuleKeyword,
    Value, ValueKeyword,
};
use crate::token::TokenKind;

pub(super) fn statement(words: &mut Words, item: &Item) -> Doc {
    let mut parts = annotations(words, &item.annotations);
    match &item.kind {
        ItemKind::Version(_) | ItemKind::Style(_) => {
            parts.push(words.take());
            while words.is_before(item.span.end) {
                parts.push(Doc::text(" "));
                parts.push(words.take());
            }
        }
        ItemKind::Import(one) => import(words, one, &mut parts),
        ItemKind::Value(one) => value(words, one, &mut parts),
        ItemKind::Rule(one) => rule(words, one, &mut parts),
    }
    Doc::Concat(parts)
}

fn annotations(words: &mut Words, list: &[Annotation]) -> Vec<Doc> {
    if list.is_empty() {
        return Vec::new();
    }
    let mut parts = Vec::new();
    for annotation in list {
        if !parts.is_empty() {
            parts.push(Doc::Line);
        }
        parts.push(words.take()); // @
        parts.push(words.take());
        if annotation.args.is_some() {
            parts.push(annotation_args(words));
        }
    }
    vec![Doc::group(parts), Doc::Hard]
}

fn import(words: &mut Words, import: &Import, parts: &mut Vec<Doc>) {
    parts.extend([words.take(), Doc::text(" "), words.take(), Doc::text(" ")]);
    if import.styles.is_some() {
        parts.extend([bracketed(words, Doc::Soft), Doc::text(" ")]);
    }
    parts.extend([words.take(), Doc::text(" "), words.take()]);
    let Some(overrides) = &import.overrides else {
        return;
    };
    parts.push(Doc::text(" "));
    if overrides.is_empty() {
        return parts.push(bracketed(words, Doc::Soft));
    }
    let open = words.take();
    let mut inside = vec![Doc::Soft];
    for (index, one) in overrides.iter().enumerate() {
        if index > 0 {
            inside.extend([words.take(), Doc::Line]);
        }
        inside.push(override_(words, one));
    }
    parts.push(Doc::group(vec![
        open,
        Doc::Indented(inside),
        Doc::Soft,
        words.take(),
    ]));
}

fn override_(words: &mut Words, one: &Override) -> Doc {
    let mut parts = vec![words.take()];
    match one {
        Override::Protect(_) => {}
        Override::Value { value, .. } => {
            parts.extend([Doc::text(" "), words.take(), Doc::text(" ")]);
            parts.push(expression(words, value.span.end));
        }
        Override::Rule {
            params, body: does, ..
        } => {
            params_of(words, params, &mut parts);
            parts.extend([Doc::text(" "), words.take()]);
            parts.push(right_side(words, does));
        }
    }
    Doc::Concat(parts)
}

fn value(words: &mut Words, value: &Value, parts: &mut Vec<Doc>) {
    if value.keyword != ValueKeyword::Function {
        parts.extend([words.take(), Doc::text(" ")]);
    }
    parts.push(words.take());
    params_of(words, &value.params, parts);
    locals(words, &value.locals, parts);
    parts.extend([Doc::text(" "), words.take()]);
    match &value.value.kind {
        ExprKind::Branches(all) if words.kind() != TokenKind::OpenParen => {
            let choice = branches(words, all, |words, one| expression(words, one.span.end));
            parts.push(Doc::group(vec![Doc::Indented(vec![Doc::Line, choice])]));
        }
        _ => parts.extend([Doc::text(" "), expression(words, value.value.span.end)]),
    }
}

fn rule(words: &mut Words, rule: &Rule, parts: &mut Vec<Doc>) {
    if rule.keyword != RuleKeyword::None {
        parts.extend([words.take(), Doc::text(" ")]);
    }
    parts.push(words.take());
    params_of(words, &rule.params, parts);
    locals(words, &rule.locals, parts);
    parts.extend([Doc::text(" "), words.take()]);
    if !is_empty(&rule.body) {
        let inside = vec![Doc::Line, tall_body(words, &rule.body)];
        parts.push(Doc::group(vec![Doc::Indented(inside)]));
    }
}

fn is_empty(does: &Body) -> bool {
    matches!(does, Body::Operations(list) if list.is_empty())
}

/// What follows the `:` of a cell, or `-->` in an import.
pub(super) fn right_side(words: &mut Words, does: &Body) -> Doc {
    if is_empty(does) {
        return Doc::Concat(Vec::new());
    }
    Doc::group(vec![Doc::Indented(vec![Doc::Line, body(words, does)])])
}

/// Parameters; also the empty parentheses of none.
fn params_of(words: &mut Words, params: &[Ident], parts: &mut Vec<Doc>) {
    if !params.is_empty() || words.kind() == TokenKind::OpenParen {
        parts.push(bracketed(words, Doc::Soft));
    }
}

/// `with (a := 1 b := 2)`
fn locals(words: &mut Words, list: &[Local], parts: &mut Vec<Doc>) {
    if words.kind() != TokenKind::With {
        return;
    }
    parts.extend([Doc::text(" "), words.take(), Doc::text(" ")]);
    let open = words.take();
    let mut inside = Vec::new();
    for local in list {
        inside.push(if inside.is_empty() {
            Doc::Soft
        } else {
            Doc::Line
        });
        inside.extend([words.take(), Doc::text(" "), words.take(), Doc::text(" ")]);
        inside.push(expression(words, local.value.span.end));
    }
    let close = words.take();
    parts.push(Doc::group(vec![
        open,
        Doc::Indented(inside),
        Doc::Soft,
        close,
    ]));
}
