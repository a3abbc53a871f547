//! What expressions give.

use std::fmt;
use std::sync::Arc;

/// A value of the language. Arrays hold values of one kind; the checker sees to that.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Number(f64),
    Bool(bool),
    Text(Arc<str>),
    Array(Arc<Array>),
}

/// A table of values, row by row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Array {
    pub columns: usize,
    pub values: Vec<Value>,
}

impl Array {
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
        Self::Array(Arc::new(Array { columns, values }))
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

/// As the function `str` writes it: no zeros after the last digit, elements between brackets.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
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
