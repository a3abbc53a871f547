//! Functions of arrays.

use std::cmp::Ordering;
use std::sync::Arc;

use super::functions::{array, number, text, Function};
use super::value::{Array, Value};

/// Names, functions, and the fewest and most arguments.
pub const TABLE: &[(&str, Function, usize, usize)] = {
    use Function::Of;
    &[
        ("boolArray", Of(truths), 0, 1),
        ("findFirst", Of(find_first), 2, 2),
        ("floatArray", Of(numbers), 0, 1),
        ("setElems", Of(set_elements), 3, 4),
        ("sortIndices", Of(sort_indices), 1, 1),
        ("sortRowIndices", Of(sort_row_indices), 1, 1),
        ("stringArray", Of(texts), 0, 1),
        ("transpose", Of(transpose), 1, 1),
    ]
};

/// `floatArray()` is empty, and `floatArray(array)` the array with its elements as `float` gives them.
fn numbers(args: &[Value]) -> Result<Value, String> {
    converted(args, Function::ToFloat)
}

fn truths(args: &[Value]) -> Result<Value, String> {
    converted(args, Function::ToBool)
}

fn texts(args: &[Value]) -> Result<Value, String> {
    converted(args, Function::ToText)
}

fn converted(args: &[Value], to: Function) -> Result<Value, String> {
    if args.is_empty() {
        return Ok(Value::list(Vec::new()));
    }
    let from = array(args)?;
    let values = from.values.iter();
    let values: Result<_, _> = values
        .map(|value| to.call(std::slice::from_ref(value), || 0.0))
        .collect();
    Ok(Value::Array(Arc::new(Array {
        columns: from.columns,
        values: values?,
    })))
}

/// `findFirst(array, value)`: its number, row by row; `findFirst(text, part)`: the place of the
/// first. -1 where it is not there.
fn find_first(args: &[Value]) -> Result<Value, String> {
    if let Value::Text(all) = &args[0] {
        let place = all.find(text(args, 1)?);
        let characters = |at: usize| all[..at].chars().count() as f64;
        return Ok(Value::Number(place.map_or(-1.0, characters)));
    }
    let place = array(args)?.values.iter().position(|one| *one == args[1]);
    Ok(Value::Number(place.map_or(-1.0, |place| place as f64)))
}

/// `setElems(array, index, value)`, `setElems(array, row, column, value)`: a copy with one element
/// changed.
fn set_elements(args: &[Value]) -> Result<Value, String> {
    let mut changed = array(args)?.clone();
    let value = args[args.len() - 1].clone();
    let (row, column) = match args.len() {
        3 => (0.0, number(args, 1)?),
        _ => (number(args, 1)?, number(args, 2)?),
    };
    let columns = changed.columns as f64;
    let is_inside = args.len() == 3 || (0.0..columns).contains(&column);
    let flat = row.floor() * columns + column.floor();
    let place = (is_inside && row >= 0.0 && flat >= 0.0)
        .then(|| changed.values.get_mut(flat as usize))
        .flatten();
    let Some(place) = place else {
        return Err(format!(
            "index {row}, {column} in an array of {}",
            changed.values.len()
        ));
    };
    *place = value;
    Ok(Value::Array(Arc::new(changed)))
}

/// `sortIndices(array)`: the numbers of its elements from the least on.
fn sort_indices(args: &[Value]) -> Result<Value, String> {
    let values = &array(args)?.values;
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| compared(&values[a], &values[b]));
    let numbers = order.into_iter().map(|at| Value::Number(at as f64));
    Ok(Value::list(numbers.collect()))
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
    let turned = Array {
        columns: rows,
        values,
    };
    Ok(Value::Array(Arc::new(turned)))
}
