//! What expressions give.

use std::fmt::{self, Write};
use std::sync::Arc;

/// The most elements of an array, and of a string in bytes.
pub const MAX_ELEMENTS: usize = 100_000;

/// A value of the language. Arrays hold values of one kind; the checker sees to that.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Number(f64),
    Bool(bool),
    Text(Arc<str>),
    Array(Arc<Array>),
}

/// What an array holds, which is told where it has no elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    #[default]
    Numbers,
    Truths,
    Texts,
}

impl Kind {
    /// What an array holds that holds this.
    pub fn of(value: &Value) -> Self {
        match value {
            Value::Text(_) => Self::Texts,
            Value::Bool(_) => Self::Truths,
            _ => Self::Numbers,
        }
    }
}

/// The number; 0 for what is none or has no bounds, as CityEngine takes it by default.
pub fn or_zero(number: f64) -> f64 {
    if number.is_finite() {
        number
    } else {
        0.0
    }
}

/// A table of values, row by row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Array {
    pub columns: usize,
    pub values: Vec<Value>,
    pub kind: Kind,
}

impl Array {
    /// An array that holds what its first element is; numbers, where it has none.
    pub fn new(columns: usize, values: Vec<Value>) -> Self {
        let kind = values.first().map_or(Kind::default(), Kind::of);
        Self {
            columns,
            values,
            kind,
        }
    }

    /// The array, which holds that where it has no elements.
    pub fn or(self, kind: Kind) -> Self {
        let kind = if self.values.is_empty() {
            kind
        } else {
            self.kind
        };
        Self { kind, ..self }
    }

    /// What stands where it has no element.
    pub fn none(&self) -> Value {
        match self.kind {
            Kind::Numbers => Value::Number(0.0),
            Kind::Truths => Value::Bool(false),
            Kind::Texts => Value::text(""),
        }
    }

    pub fn rows(&self) -> usize {
        self.values.len().checked_div(self.columns).unwrap_or(0)
    }
}

impl Value {
    pub fn text(text: &str) -> Self {
        Self::Text(text.into())
    }

    /// An array of one row.
    pub fn list(values: Vec<Value>) -> Self {
        let columns = values.len();
        Self::Array(Arc::new(Array::new(columns, values)))
    }

    /// An array of one row that holds texts, if any.
    pub fn texts(values: Vec<Self>) -> Self {
        let columns = values.len();
        Self::Array(Arc::new(Array::new(columns, values).or(Kind::Texts)))
    }

    /// The elements of an array, the bytes of a string, 1 of others.
    pub fn element_count(&self) -> usize {
        match self {
            Self::Text(text) => text.len(),
            Self::Array(array) => array.values.len(),
            _ => 1,
        }
    }

    /// The value as the function `str` writes it; Err where that is too long. An array may hold
    /// the same long array many times.
    pub fn written(&self) -> Result<String, String> {
        let mut text = Bounded(String::new());
        match write!(text, "{self}") {
            Ok(()) => Ok(text.0),
            Err(_) => Err(format!("a string of more than {MAX_ELEMENTS} bytes")),
        }
    }

    /// The value as `print` writes it: arrays with their size, those of several rows as a table
    /// whose columns end below each other.
    pub fn printed(&self) -> Result<String, String> {
        let Self::Array(array) = self else {
            return self.written();
        };
        if array.rows() <= 1 {
            return Ok(format!("({}){}", array.values.len(), self.written()?));
        }
        let cells: Vec<String> = array.values.iter().map(Self::to_string).collect();
        let mut widths = vec![0; array.columns];
        for (at, cell) in cells.iter().enumerate() {
            let width = &mut widths[at % array.columns];
            *width = cell.chars().count().max(*width);
        }
        let mut text = Bounded(String::new());
        let mut written = write!(text, "({}x{})", array.rows(), array.columns);
        for row in cells.chunks(array.columns) {
            written = written.and_then(|()| writeln!(text));
            for (cell, width) in row.iter().zip(&widths) {
                written = written.and_then(|()| write!(text, "   {cell:>width$}"));
            }
        }
        let long = |_| format!("a string of more than {MAX_ELEMENTS} bytes");
        written.map(|()| text.0).map_err(long)
    }

    /// The name of the kind, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Bool(_) => "true or false",
            Self::Text(_) => "a string",
            Self::Array(_) => "an array",
        }
    }

    /// The value as a number: strings as they are read, true as 1; None where there is none.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Bool(is) => Some(f64::from(u8::from(*is))),
            Self::Text(text) => text.trim().parse().ok(),
            Self::Array(_) => None,
        }
    }

    /// What `bool` makes of the value: of strings, `f`, `false` and what reads as 0 are false.
    pub fn converted_truth(&self) -> Option<bool> {
        let Self::Text(text) = self else {
            return self.truth();
        };
        let is_false = matches!(text.as_ref(), "f" | "false") || self.number() == Some(0.0);
        Some(!is_false)
    }

    /// The value as a condition: numbers other than 0 hold, and so does the string "true".
    pub fn truth(&self) -> Option<bool> {
        match self {
            Self::Number(number) => Some(*number != 0.0),
            Self::Bool(is) => Some(*is),
            Self::Text(text) => Some(text.as_ref() == "true"),
            Self::Array(_) => None,
        }
    }
}

/// A text that refuses to become too long.
struct Bounded(String);

impl fmt::Write for Bounded {
    fn write_str(&mut self, part: &str) -> fmt::Result {
        if self.0.len() + part.len() > MAX_ELEMENTS {
            return Err(fmt::Error);
        }
        self.0.push_str(part);
        Ok(())
    }
}

/// As the function `str` writes it: no zeros after the last digit, elements between brackets.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) if number.is_nan() => write!(f, "nan"),
            Self::Number(number) => write!(f, "{}", rounded(*number)),
            Self::Bool(is) => write!(f, "{is}"),
            Self::Text(text) => write!(f, "{text}"),
            Self::Array(array) => {
                write!(f, "[")?;
                for (index, value) in array.values.iter().enumerate() {
                    let gap = match index {
                        0 => "",
                        _ if index % array.columns == 0 => ";",
                        _ => ",",
                    };
                    write!(f, "{gap}{value}")?;
                }
                write!(f, "]")
            }
        }
    }
}

/// Without the noise of sums in the last digits, and without the sign of 0.
fn rounded(number: f64) -> f64 {
    let nearest = (number * 1e9).round() / 1e9 + 0.0;
    if nearest.is_finite() {
        nearest
    } else {
        number
    }
}
