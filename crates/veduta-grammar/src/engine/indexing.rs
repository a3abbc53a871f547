//! Elements of arrays by their numbers, and arrays that are made of others.

use std::sync::Arc;

use super::value::MAX_ELEMENTS;
use super::value::{Array, Value};

/// What one index asks for.
enum Index {
    One(f64),
    /// Several numbers, in rows of so many.
    Many(Vec<f64>, usize),
}

impl Index {
    fn of(value: &Value) -> Result<Self, String> {
        let Value::Array(array) = value else {
            let number = value.number();
            return number
                .map(Self::One)
                .ok_or_else(|| format!("an index is a number, not {}", value.kind()));
        };
        if let Some(Value::Bool(_)) = array.values.first() {
            let all = array.values.iter().zip(0u32..);
            let taken = all.filter(|(value, _)| value.truth() == Some(true));
            let numbers: Vec<f64> = taken.map(|(_, at)| f64::from(at)).collect();
            let columns = numbers.len();
            return Ok(Self::Many(numbers, columns));
        }
        let numbers: Option<Vec<f64>> = array.values.iter().map(Value::number).collect();
        let numbers = numbers.ok_or("an array of indexes has numbers, or true and false")?;
        Ok(Self::Many(numbers, array.columns))
    }

    fn numbers(&self) -> &[f64] {
        match self {
            Self::One(number) => std::slice::from_ref(number),
            Self::Many(numbers, _) => numbers,
        }
    }
}

/// `array[index]`, `array[row, column]`: an element, or, where an index is an array, an array of
/// elements; true and false say for each number whether it is meant. A single index counts row by
/// row. Beyond the ends there is 0, false or the empty text.
pub fn indexed(array: &Array, indices: &[Value]) -> Result<Value, String> {
    let indices: Vec<Index> = indices.iter().map(Index::of).collect::<Result<_, _>>()?;
    let (values, columns) = match &indices[..] {
        [all] => {
            let at = |&number: &f64| array.at(0.0, number, array.values.len());
            let columns = match all {
                Index::One(_) => 1,
                Index::Many(_, columns) => *columns,
            };
            (all.numbers().iter().map(at).collect(), columns)
        }
        [rows, columns] => {
            let (rows, columns) = (rows.numbers(), columns.numbers());
            if rows.len().saturating_mul(columns.len()) > MAX_ELEMENTS {
                let count = rows.len().saturating_mul(columns.len());
                return Err(format!("an array of {count} elements"));
            }
            let row = |&row: &f64| {
                let at = move |&column: &f64| array.at(row, column, array.columns);
                columns.iter().map(at)
            };
            let values: Vec<Value> = rows.iter().flat_map(row).collect();
            (values, columns.len())
        }
        _ => return Err("an index has one number or two".into()),
    };
    if indices.iter().all(|index| matches!(index, Index::One(_))) {
        return Ok(values.into_iter().next().unwrap_or(Value::Number(0.0)));
    }
    Ok(Value::Array(Arc::new(Array { columns, values })))
}

impl Array {
    /// The element at a place in rows of `width`; what stands for none where there is none.
    fn at(&self, row: f64, column: f64, width: usize) -> Value {
        let (row, column, wide) = (row.floor(), column.floor(), width as f64);
        let is_inside = row >= 0.0 && (0.0..wide).contains(&column);
        let found = is_inside.then(|| self.values.get((row * wide + column) as usize));
        found
            .flatten()
            .cloned()
            .unwrap_or_else(|| match self.values.first() {
                Some(Value::Text(_)) => Value::text(""),
                Some(Value::Bool(_)) => Value::Bool(false),
                _ => Value::Number(0.0),
            })
    }
}

/// Arrays beside each other as one; arrays without elements do not count.
pub fn beside(parts: Vec<Array>) -> Result<Array, String> {
    let mut parts: Vec<Array> = parts
        .into_iter()
        .filter(|part| !part.values.is_empty())
        .collect();
    if parts.len() <= 1 {
        return Ok(parts.pop().unwrap_or_default());
    }
    let rows = parts[0].rows();
    if let Some(other) = parts.iter().find(|part| part.rows() != rows) {
        return Err(format!(
            "arrays of {rows} and of {} rows beside each other",
            other.rows()
        ));
    }
    let columns = parts.iter().map(|part| part.columns).sum();
    let mut values = Vec::with_capacity(rows * columns);
    for row in 0..rows {
        for part in &parts {
            values.extend_from_slice(&part.values[row * part.columns..(row + 1) * part.columns]);
        }
    }
    Ok(Array { columns, values })
}
