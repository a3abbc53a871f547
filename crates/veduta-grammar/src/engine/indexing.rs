//! Elements of arrays by their numbers, and arrays that are made of others.

use std::sync::Arc;

use super::value::MAX_ELEMENTS;
use super::value::{Array, Kind, Value};

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
            check_crossed(rows, columns)?;
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
        return Ok(values.into_iter().next().unwrap_or_else(|| array.none()));
    }
    let found = Array::new(columns, values).or(array.kind);
    Ok(Value::Array(Arc::new(found)))
}

/// `setElems(array, indices, values)`, `setElems(array, rows, columns, values)`: a copy with other
/// elements at these places. Places beyond its ends make it larger, those below 0 do not count; of
/// several values for one place the last stays.
pub fn set_elements(args: &[Value]) -> Result<Value, String> {
    let Value::Array(given) = &args[0] else {
        return Err(format!("an array is needed, not {}", args[0].kind()));
    };
    let indices: Vec<Index> = args[1..args.len() - 1]
        .iter()
        .map(Index::of)
        .collect::<Result<_, _>>()?;
    let places = match &indices[..] {
        [all] => {
            let numbers: Vec<f64> = all.numbers().iter().map(|at| at.floor()).collect();
            let last = greatest(&numbers);
            let wide = given.columns.max(1) as f64;
            match given.rows() {
                0 | 1 => Places::of(&[0.0], &numbers, last + 1.0),
                _ => Places {
                    all: numbers
                        .iter()
                        .map(|at| ((at / wide).floor(), at % wide))
                        .collect(),
                    rows: (last / wide).floor() + 1.0,
                    columns: wide,
                },
            }
        }
        [rows, columns] => {
            let floor = |index: &Index| index.numbers().iter().map(|at| at.floor()).collect();
            let (rows, columns): (Vec<f64>, Vec<f64>) = (floor(rows), floor(columns));
            check_crossed(&rows, &columns)?;
            Places::of(&rows, &columns, greatest(&columns) + 1.0)
        }
        _ => return Err("an index has one number or two".into()),
    };
    let value = &args[args.len() - 1];
    if let Value::Array(values) = value {
        if values.values.len() != places.all.len() {
            let (count, wanted) = (values.values.len(), places.all.len());
            return Err(format!("{count} values for {wanted} elements"));
        }
    }
    let mut changed = enlarged(given, value, &places)?;
    for (at, &(row, column)) in places.all.iter().enumerate() {
        if row >= 0.0 && column >= 0.0 {
            changed.values[row as usize * changed.columns + column as usize] = match value {
                Value::Array(values) => values.values[at].clone(),
                one => one.clone(),
            };
        }
    }
    Ok(Value::Array(Arc::new(changed)))
}

/// Rows and columns of elements, and how many there must be of both.
struct Places {
    all: Vec<(f64, f64)>,
    rows: f64,
    columns: f64,
}

impl Places {
    fn of(rows: &[f64], columns: &[f64], wide: f64) -> Self {
        let row = |&row: &f64| columns.iter().map(move |&column| (row, column));
        Self {
            all: rows.iter().flat_map(row).collect(),
            rows: greatest(rows) + 1.0,
            columns: wide,
        }
    }
}

/// Every row with every column: so many places must fit in an array.
fn check_crossed(rows: &[f64], columns: &[f64]) -> Result<(), String> {
    let count = rows.len().saturating_mul(columns.len());
    if count > MAX_ELEMENTS {
        return Err(format!("an array of {count} elements"));
    }
    Ok(())
}

fn greatest(numbers: &[f64]) -> f64 {
    numbers.iter().copied().fold(-1.0, f64::max)
}

/// The array with all places in it; what was not there is 0, false or the empty text.
fn enlarged(given: &Array, value: &Value, places: &Places) -> Result<Array, String> {
    let columns = places.columns.max(given.columns as f64);
    let rows = places.rows.max(given.rows() as f64);
    if rows * columns > MAX_ELEMENTS as f64 {
        return Err(format!("an array of {} elements", rows * columns));
    }
    let (rows, columns) = (rows as usize, columns as usize);
    if (rows, columns) == (given.rows(), given.columns) {
        return Ok(given.clone());
    }
    let kind = match value {
        _ if !given.values.is_empty() => given.kind,
        Value::Array(values) => values.kind,
        one => Kind::of(one),
    };
    let none = Array::default().or(kind).none();
    let mut values = vec![none; rows * columns];
    for (at, value) in given.values.iter().enumerate() {
        values[at / given.columns * columns + at % given.columns] = value.clone();
    }
    Ok(Array::new(columns, values))
}

impl Array {
    /// The element at a place in rows of `width`; what stands for none where there is none.
    fn at(&self, row: f64, column: f64, width: usize) -> Value {
        let (row, column, wide) = (row.floor(), column.floor(), width as f64);
        let is_inside = row >= 0.0 && (0.0..wide).contains(&column);
        let found = is_inside.then(|| self.values.get((row * wide + column) as usize));
        found.flatten().cloned().unwrap_or_else(|| self.none())
    }
}

/// Arrays beside each other as one; arrays without elements do not count.
pub fn beside(parts: Vec<Array>) -> Result<Array, String> {
    let kind = parts.first().map_or(Kind::default(), |first| first.kind);
    let mut parts: Vec<Array> = parts
        .into_iter()
        .filter(|part| !part.values.is_empty())
        .collect();
    if parts.len() <= 1 {
        return Ok(parts.pop().unwrap_or_default().or(kind));
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
    Ok(Array::new(columns, values))
}
