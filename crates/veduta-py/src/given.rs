//! Values of rule files that come from Python, and go there.

use std::collections::HashMap;

use pyo3::prelude::*;
use veduta_grammar::engine::Value;

/// A value given from outside.
#[derive(FromPyObject)]
pub enum Given {
    Bool(bool),
    Number(f64),
    Text(String),
    Bools(Vec<bool>),
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

impl From<Given> for Value {
    fn from(given: Given) -> Self {
        match given {
            Given::Bool(is) => Value::Bool(is),
            Given::Number(number) => Value::Number(number),
            Given::Text(text) => Value::text(&text),
            Given::Numbers(all) => Value::list(all.into_iter().map(Value::Number).collect()),
            Given::Bools(all) => Value::list(all.into_iter().map(Value::Bool).collect()),
            Given::Texts(all) => Value::list(all.iter().map(|text| Value::text(text)).collect()),
        }
    }
}

pub fn values(given: HashMap<String, Given>) -> HashMap<String, Value> {
    let each = given.into_iter();
    each.map(|(name, value)| (name, value.into())).collect()
}

/// A value for outside; an array is what `str` makes of it.
#[derive(IntoPyObject)]
pub enum GivenBack {
    Bool(bool),
    Number(f64),
    Text(String),
}

impl From<&Value> for GivenBack {
    fn from(value: &Value) -> Self {
        match value {
            Value::Bool(is) => Self::Bool(*is),
            Value::Number(number) => Self::Number(*number),
            Value::Text(_) | Value::Array(_) => Self::Text(value.to_string()),
        }
    }
}
