//! Functions of arrays.

use std::cmp::Ordering;
use std::sync::Arc;

use super::functions::{array, number, text, Function};
use super::indexing;
use super::value::{Array, Kind, Value};

/// Names, functions, and the fewest and most arguments.
pub const TABLE: &[(&str, Function, usize, usize)] = {
    use Function::Of;
    &[
        ("boolArray", Of(truths), 0, 1),
        ("findFirst", Of(find_first), 2, 3),
        ("floatArray", Of(numbers), 0, 1),
        ("setElems", Of(indexing::set_elements), 3, 4),
        ("sortIndices", Of(sort_indices), 1, 1),
        ("sortRowIndices", Of(sort_row_indices), 1, 1),
        ("stringArray", Of(texts), 0, 1),
        ("transpose", Of(transpose), 1, 1),
    ]
};

/// `floatArray()` is empty, and `floatArray(array)` the array with its elements as `float` gives them.
fn numbers(args: &[Value]) -> Result<Value, String> {
    converted(args, Function::ToFloat, Kind::Numbers)
}

fn truths(args: &[Value]) -> Result<Value, String> {
    converted(args, Function::ToBool, Kind::Truths)
}

fn texts(args: &[Value]) -> Result<Value, String> {
    converted(args, Function::ToText, Kind::Texts)
}

fn converted(args: &[Value], to: Function, kind: Kind) -> Result<Value, String> {
    if args.is_empty() {
        return Ok(Value::Array(Arc::new(Array::default().or(kind))));
    }
    let from = array(args)?;
    let values = from.values.iter();
    let values: Result<_, _> = values
        .map(|value| to.call(std::slice::from_ref(value), || 0.0))
        .collect();
    let all = Array::new(from.columns, values?).or(kind);
    Ok(Value::Array(Arc::new(all)))
}

/// `findFirst(array, value)`, `findFirst(array, value, epsilon)`: its number, row by row, and how far
/// off a number may be; `findFirst(text, part)`: the place of the first. -1 where it is not there.
fn find_first(args: &[Value]) -> Result<Value, String> {
    if let Value::Text(all) = &args[0] {
        let place = all.find(text(args, 1)?);
        let characters = |at: usize| all[..at].chars().count() as f64;
        return Ok(Value::Number(place.map_or(-1.0, characters)));
    }
    let epsilon = match args.len() {
        2 => 0.0,
        _ => number(args, 2)?,
    };
    let is_meant = |one: &Value| match (one, &args[1]) {
        (Value::Number(one), Value::Number(wanted)) => (one - wanted).abs() <= epsilon,
        (one, wanted) => one == wanted,
    };
    let place = array(args)?.values.iter().position(is_meant);
    Ok(Value::Number(place.map_or(-1.0, |place| place as f64)))
}

/// `sortIndices(array)`: the numbers of the elements of each row from the least on.
fn sort_indices(args: &[Value]) -> Result<Value, String> {
    let given = array(args)?;
    let values = &given.values;
    let mut order: Vec<usize> = (0..values.len()).collect();
    for row in order.chunks_mut(given.columns.max(1)) {
        row.sort_by(|&a, &b| compared(&values[a], &values[b]));
    }
    let numbers = order.into_iter().map(|at| Value::Number(at as f64));
    Ok(Value::Array(Arc::new(Array::new(
        given.columns,
        numbers.collect(),
    ))))
}

/// `sortRowIndices(array)`: the numbers of its rows, in the order of their first elements, where
/// these are alike of their second ones, and so on.
fn sort_row_indices(args: &[Value]) -> Result<Value, String> {
    let given = array(args)?;
    let columns = given.columns;
    let row = |at: usize| &given.values[at * columns..(at + 1) * columns];
    let mut order: Vec<usize> = (0..given.rows()).collect();
    order.sort_by(|&a, &b| {
        let pairs = row(a).iter().zip(row(b));
        pairs.fold(Ordering::Equal, |so_far, (a, b)| {
            so_far.then_with(|| compared(a, b))
        })
    });
    let numbers = order.into_iter().map(|at| Value::Number(at as f64));
    Ok(Value::list(numbers.collect()))
}

/// The order of two values: of strings by their letters, of others as numbers.
fn compared(a: &Value, b: &Value) -> Ordering {
    match (a, b) {
        (Value::Text(a), Value::Text(b)) => a.cmp(b),
        (a, b) => {
            let number = |value: &Value| value.number().unwrap_or(f64::NAN);
            number(a).total_cmp(&number(b))
        }
    }
}

/// `transpose(array)`: rows as columns.
fn transpose(args: &[Value]) -> Result<Value, String> {
    let given = array(args)?;
    let (rows, columns) = (given.rows(), given.columns);
    let mut values = Vec::with_capacity(given.values.len());
    for column in 0..columns {
        for row in 0..rows {
            values.push(given.values[row * columns + column].clone());
        }
    }
    let turned = Array::new(rows, values).or(given.kind);
    Ok(Value::Array(Arc::new(turned)))
}
