//! Operators on values and arrays, and element by element on arrays.

use std::cmp::Ordering;
use std::sync::Arc;

use crate::ast::{BinaryOp, UnaryOp};

use super::value::{Array, Kind, Value};

pub fn unary(op: UnaryOp, value: Value) -> Result<Value, String> {
    if let Value::Array(array) = &value {
        let values: Result<_, _> = array.values.iter().map(|v| unary(op, v.clone())).collect();
        let kind = match op {
            UnaryOp::Not | UnaryOp::EachNot => Kind::Truths,
            _ => Kind::Numbers,
        };
        let found = Array::new(array.columns, values?).or(kind);
        return Ok(Value::Array(Arc::new(found)));
    }
    let unusable = || format!("{} has no `{}`", value.kind(), op.sign());
    match op {
        UnaryOp::Not | UnaryOp::EachNot => value
            .truth()
            .map(|is| Value::Bool(!is))
            .ok_or_else(unusable),
        UnaryOp::Minus | UnaryOp::EachMinus => value
            .number()
            .map(|number| Value::Number(-number))
            .ok_or_else(unusable),
        UnaryOp::Plus | UnaryOp::EachPlus => value.number().map(Value::Number).ok_or_else(unusable),
    }
}

pub fn binary(op: BinaryOp, a: &Value, b: &Value) -> Result<Value, String> {
    use BinaryOp as B;
    if matches!(a, Value::Array(_)) || matches!(b, Value::Array(_)) {
        return match (op, a, b) {
            (B::Add, Value::Text(_), _) | (B::Add, _, Value::Text(_)) => {
                let texts = [a.written()?, b.written()?];
                Ok(Value::text(&texts.concat()))
            }
            (_, Value::Array(left), Value::Array(right)) if is_comparison(op) => {
                Ok(Value::Bool(holds(op, ordered_arrays(left, right))))
            }
            _ => each(op, a, b),
        };
    }
    if let (B::Add | B::EachAdd, Value::Text(_), _) | (B::Add | B::EachAdd, _, Value::Text(_)) =
        (op, a, b)
    {
        return Ok(Value::text(&format!("{a}{b}")));
    }
    let truth = |value: &Value| value.truth().unwrap_or(false);
    let number = |value: &Value| {
        let needed = || format!("`{}` needs numbers, not {}", op.sign(), value.kind());
        value.number().ok_or_else(needed)
    };
    Ok(match op {
        B::Or | B::EachOr => Value::Bool(truth(a) || truth(b)),
        B::And | B::EachAnd => Value::Bool(truth(a) && truth(b)),
        B::Equal
        | B::NotEqual
        | B::Less
        | B::LessEqual
        | B::Greater
        | B::GreaterEqual
        | B::EachEqual
        | B::EachNotEqual
        | B::EachLess
        | B::EachLessEqual
        | B::EachGreater
        | B::EachGreaterEqual => Value::Bool(holds(op, ordered(a, b))),
        B::Add | B::EachAdd => Value::Number(number(a)? + number(b)?),
        B::Subtract | B::EachSubtract => Value::Number(number(a)? - number(b)?),
        B::Multiply | B::EachMultiply => Value::Number(number(a)? * number(b)?),
        B::Divide | B::EachDivide => Value::Number(number(a)? / number(b)?),
        B::Remainder | B::EachRemainder => Value::Number(number(a)? % number(b)?),
    })
}

/// Whether an operator compares arrays as wholes.
fn is_comparison(op: BinaryOp) -> bool {
    use BinaryOp as B;
    matches!(
        op,
        B::Equal | B::NotEqual | B::Less | B::LessEqual | B::Greater | B::GreaterEqual
    )
}

/// Whether a comparison holds for values of this order; what has no order is unequal.
fn holds(op: BinaryOp, order: Option<Ordering>) -> bool {
    use BinaryOp as B;
    match op {
        B::Equal | B::EachEqual => order.is_some_and(Ordering::is_eq),
        B::NotEqual | B::EachNotEqual => !order.is_some_and(Ordering::is_eq),
        B::Less | B::EachLess => order.is_some_and(Ordering::is_lt),
        B::LessEqual | B::EachLessEqual => order.is_some_and(Ordering::is_le),
        B::Greater | B::EachGreater => order.is_some_and(Ordering::is_gt),
        _ => order.is_some_and(Ordering::is_ge),
    }
}

fn ordered(a: &Value, b: &Value) -> Option<Ordering> {
    match (a, b) {
        (Value::Text(a), Value::Text(b)) => Some(a.cmp(b)),
        _ => a.number()?.partial_cmp(&b.number()?),
    }
}

/// Row by row; where rows are equal as far as they go, fewer columns are less, and then fewer rows.
fn ordered_arrays(a: &Array, b: &Array) -> Option<Ordering> {
    for row in 0..a.rows().min(b.rows()) {
        let of = |array: &'_ Array| row * array.columns..(row + 1) * array.columns;
        for (a, b) in a.values[of(a)].iter().zip(&b.values[of(b)]) {
            let order = ordered(a, b)?;
            if order.is_ne() {
                return Some(order);
            }
        }
        if a.columns != b.columns {
            return Some(a.columns.cmp(&b.columns));
        }
    }
    Some(a.rows().cmp(&b.rows()))
}

/// The most bytes of all strings of an array.
const MOST_BYTES: usize = 10_000_000;

/// The values, as long as they are not too many bytes together.
fn bounded(values: impl Iterator<Item = Result<Value, String>>) -> Result<Vec<Value>, String> {
    let mut bytes = 0;
    let mut all = Vec::with_capacity(values.size_hint().0);
    for value in values {
        let value = value?;
        bytes += value.element_count();
        if bytes > MOST_BYTES {
            return Err(format!("an array of more than {MOST_BYTES} bytes"));
        }
        all.push(value);
    }
    Ok(all)
}

/// Element by element; a single value goes with each element of the other side.
fn each(op: BinaryOp, a: &Value, b: &Value) -> Result<Value, String> {
    let (columns, values) = match (a, b) {
        (Value::Array(a), Value::Array(b)) => {
            if a.columns != b.columns || a.values.len() != b.values.len() {
                return Err(format!("`{}` needs arrays of the same size", op.sign()));
            }
            let pairs = a.values.iter().zip(&b.values);
            (a.columns, bounded(pairs.map(|(a, b)| binary(op, a, b))))
        }
        (Value::Array(a), b) => (
            a.columns,
            bounded(a.values.iter().map(|a| binary(op, a, b))),
        ),
        (a, Value::Array(b)) => (
            b.columns,
            bounded(b.values.iter().map(|b| binary(op, a, b))),
        ),
        _ => return Err(format!("`{}` needs an array", op.sign())),
    };
    let found = Array::new(columns, values?).or(kind_of(op, a, b));
    Ok(Value::Array(Arc::new(found)))
}

/// What an operator makes of elements of these.
fn kind_of(op: BinaryOp, a: &Value, b: &Value) -> Kind {
    use BinaryOp as B;
    let holds_texts = |value: &Value| match value {
        Value::Array(array) => array.kind == Kind::Texts,
        other => Kind::of(other) == Kind::Texts,
    };
    match op {
        B::Add | B::EachAdd if holds_texts(a) || holds_texts(b) => Kind::Texts,
        B::Add | B::EachAdd | B::Subtract | B::EachSubtract | B::Multiply | B::EachMultiply => {
            Kind::Numbers
        }
        B::Divide | B::EachDivide | B::Remainder | B::EachRemainder => Kind::Numbers,
        _ => Kind::Truths,
    }
}
