//! The functions of the language that need no shape. Angles are in degrees.

use std::sync::Arc;

use super::operators::binary;
use super::value::{or_zero, Array, Kind, Value, MAX_ELEMENTS};
use super::{arrays, colours, lists, strings};
use crate::ast::BinaryOp;

/// A built-in function.
#[derive(Debug, Clone, Copy)]
pub enum Function {
    Math(fn(f64) -> f64),
    Math2(fn(f64, f64) -> f64),
    Test(fn(f64) -> bool),
    /// Of all arguments, or of the elements of one array; of two texts or arrays the one that stands
    /// so to the other.
    Fold(fn(f64, f64) -> f64, BinaryOp),
    Random,
    Chance,
    ToBool,
    ToFloat,
    ToText,
    Length,
    Count,
    Find,
    Part,
    Replace,
    Size,
    Rows,
    Columns,
    Sum,
    /// Of the values alone.
    Of(fn(&[Value]) -> Result<Value, String>),
    /// An element of a list at random.
    Pick,
    /// Its value, which is also written.
    Print,
}

/// Names, functions, and the fewest and most arguments.
const TABLE: &[(&str, Function, usize, usize)] = {
    use Function as F;
    &[
        ("abs", F::Math(f64::abs), 1, 1),
        ("acos", F::Math(|x| x.acos().to_degrees()), 1, 1),
        ("asin", F::Math(|x| x.asin().to_degrees()), 1, 1),
        ("atan", F::Math(|x| x.atan().to_degrees()), 1, 1),
        ("ceil", F::Math(f64::ceil), 1, 1),
        ("cos", F::Math(|x| x.to_radians().cos()), 1, 1),
        ("exp", F::Math(f64::exp), 1, 1),
        ("floor", F::Math(f64::floor), 1, 1),
        ("ln", F::Math(f64::ln), 1, 1),
        ("log10", F::Math(f64::log10), 1, 1),
        ("rint", F::Math(f64::round), 1, 1),
        ("sin", F::Math(|x| x.to_radians().sin()), 1, 1),
        ("sqrt", F::Math(f64::sqrt), 1, 1),
        ("tan", F::Math(|x| x.to_radians().tan()), 1, 1),
        ("atan2", F::Math2(|y, x| y.atan2(x).to_degrees()), 2, 2),
        ("pow", F::Math2(f64::powf), 2, 2),
        ("isinf", F::Test(f64::is_infinite), 1, 1),
        ("isnan", F::Test(f64::is_nan), 1, 1),
        ("max", F::Fold(f64::max, BinaryOp::Greater), 1, usize::MAX),
        ("min", F::Fold(f64::min, BinaryOp::Less), 1, usize::MAX),
        ("rand", F::Random, 0, 2),
        ("p", F::Chance, 1, 1),
        ("bool", F::ToBool, 1, 1),
        ("float", F::ToFloat, 1, 1),
        ("str", F::ToText, 1, 1),
        ("len", F::Length, 1, 1),
        ("count", F::Count, 2, 2),
        ("find", F::Find, 3, 3),
        ("substring", F::Part, 3, 3),
        ("replace", F::Replace, 3, 3),
        ("size", F::Size, 1, 1),
        ("nRows", F::Rows, 1, 1),
        ("nColumns", F::Columns, 1, 1),
        ("sum", F::Sum, 1, 1),
        ("clamp", F::Of(clamped), 3, 3),
        ("listRandom", F::Pick, 1, 1),
        ("print", F::Print, 1, 1),
    ]
};

fn table() -> impl Iterator<Item = &'static (&'static str, Function, usize, usize)> {
    let more = [lists::TABLE, arrays::TABLE, colours::TABLE, strings::TABLE];
    TABLE.iter().chain(more.into_iter().flatten())
}

impl Function {
    /// The function of this name, with its fewest and most arguments.
    pub fn named(name: &str) -> Option<(Self, usize, usize)> {
        let found = table().find(|entry| entry.0 == name)?;
        Some((found.1, found.2, found.3))
    }

    /// The names of all functions that need no shape.
    pub fn names() -> impl Iterator<Item = &'static str> {
        table().map(|entry| entry.0)
    }

    /// The value for these arguments; Err says what is wrong with them. `random` gives the next
    /// number of the shape's stream.
    pub fn call(self, args: &[Value], mut random: impl FnMut() -> f64) -> Result<Value, String> {
        match self {
            Self::Math(map) => mapped(&args[0], Kind::Numbers, |value| {
                Ok(Value::Number(map(finite(value)?)))
            }),
            Self::Math2(map) => Ok(Value::Number(map(finite(&args[0])?, finite(&args[1])?))),
            Self::Test(test) => mapped(&args[0], Kind::Truths, |value| {
                Ok(Value::Bool(test(number(std::slice::from_ref(value), 0)?)))
            }),
            Self::Fold(fold, wanted) => match args {
                [a, b] if !is_numeric(a) || !is_numeric(b) => chosen(a, b, wanted),
                _ => folded(args, fold),
            },
            Self::Random => {
                let (low, high) = match args.len() {
                    0 => (0.0, 1.0),
                    1 => (0.0, number(args, 0)?),
                    _ => (number(args, 0)?, number(args, 1)?),
                };
                Ok(Value::Number(low + (high - low) * random()))
            }
            Self::Chance => Ok(Value::Bool(random() < number(args, 0)?)),
            Self::ToBool => {
                let truth = args[0].converted_truth();
                truth.map(Value::Bool).ok_or_else(|| no(&args[0]))
            }
            Self::ToFloat => Ok(Value::Number(read_number(&args[0]))),
            Self::ToText => Ok(Value::text(&args[0].written()?)),
            Self::Sum => summed(args),
            Self::Of(work) => work(args),
            Self::Pick => lists::random(args, random()),
            Self::Print => Ok(args[0].clone()),
            Self::Size => Ok(Value::Number(array(args)?.values.len() as f64)),
            Self::Rows => Ok(Value::Number(array(args)?.rows() as f64)),
            Self::Columns => Ok(Value::Number(array(args)?.columns as f64)),
            Self::Length | Self::Count | Self::Find | Self::Part | Self::Replace => {
                self.of_text(args)
            }
        }
    }

    /// The functions of strings. Places count characters from 0.
    fn of_text(self, args: &[Value]) -> Result<Value, String> {
        let all = text(args, 0)?;
        Ok(match self {
            Self::Length => Value::Number(all.chars().count() as f64),
            Self::Count => {
                let part = text(args, 1)?;
                let times = if part.is_empty() {
                    0
                } else {
                    all.matches(part).count()
                };
                Value::Number(times as f64)
            }
            Self::Find => {
                let nth = number(args, 2)?.max(0.0) as usize;
                let found = all.match_indices(text(args, 1)?).nth(nth);
                let place = found.map(|(at, _)| all[..at].chars().count() as f64);
                Value::Number(place.unwrap_or(-1.0))
            }
            Self::Part => {
                let (from, to) = (number(args, 1)?.max(0.0), number(args, 2)?.max(0.0));
                let length = (to - from).max(0.0) as usize;
                let part: String = all.chars().skip(from as usize).take(length).collect();
                Value::text(&part)
            }
            _ => {
                let (part, other) = (text(args, 1)?, text(args, 2)?);
                let longest = all.len() + all.matches(part).count() * other.len();
                if longest > 2 * MAX_ELEMENTS {
                    return Err(format!("a string of up to {longest} bytes"));
                }
                Value::text(&all.replace(part, other))
            }
        })
    }
}

fn folded(args: &[Value], fold: fn(f64, f64) -> f64) -> Result<Value, String> {
    let values = match args {
        [Value::Array(array)] => &array.values[..],
        several => several,
    };
    let mut numbers = values
        .iter()
        .map(|value| value.number().ok_or_else(|| no(value)));
    let first = numbers.next().unwrap_or(Ok(0.0))?;
    let sum = numbers.try_fold(first, |sum, next| Ok::<f64, String>(fold(sum, next?)))?;
    Ok(Value::Number(sum))
}

/// Of each element of an array, and of a single value; `kind` is what an empty array holds then.
pub(super) fn mapped(
    value: &Value,
    kind: Kind,
    map: impl Fn(&Value) -> Result<Value, String>,
) -> Result<Value, String> {
    let Value::Array(array) = value else {
        return map(value);
    };
    let values: Result<_, _> = array.values.iter().map(map).collect();
    let found = Array::new(array.columns, values?).or(kind);
    Ok(Value::Array(Arc::new(found)))
}

fn finite(value: &Value) -> Result<f64, String> {
    number(std::slice::from_ref(value), 0).map(or_zero)
}

/// Whether it counts as a number where two are compared.
fn is_numeric(value: &Value) -> bool {
    matches!(value, Value::Number(_) | Value::Bool(_))
}

/// That of two values which stands so to the other.
fn chosen(a: &Value, b: &Value, wanted: BinaryOp) -> Result<Value, String> {
    let is_first = binary(wanted, a, b)?.truth() == Some(true);
    Ok(if is_first { a } else { b }.clone())
}

/// `sum(array)`: of numbers, of how many are true, or of texts as one text.
fn summed(args: &[Value]) -> Result<Value, String> {
    if let [Value::Array(array)] = args {
        if let Some(Value::Text(_)) = array.values.first() {
            let mut all = String::new();
            for value in &array.values {
                all.push_str(&value.written()?);
                if all.len() > MAX_ELEMENTS {
                    return Err(format!("a string of more than {MAX_ELEMENTS} bytes"));
                }
            }
            return Ok(Value::text(&all));
        }
    }
    folded(args, |a, b| a + b)
}

/// `clamp(value, low, high)`; of texts and arrays in their order.
fn clamped(args: &[Value]) -> Result<Value, String> {
    if !args.iter().all(is_numeric) {
        let low = chosen(&args[0], &args[1], BinaryOp::Greater)?;
        return chosen(&low, &args[2], BinaryOp::Less);
    }
    let (value, low, high) = (number(args, 0)?, number(args, 1)?, number(args, 2)?);
    Ok(Value::Number(value.min(high).max(low)))
}

pub(super) fn number(args: &[Value], index: usize) -> Result<f64, String> {
    args[index]
        .number()
        .ok_or_else(|| format!("a number is needed, not {}", args[index].kind()))
}

pub(super) fn text(args: &[Value], index: usize) -> Result<&str, String> {
    match &args[index] {
        Value::Text(text) => Ok(text),
        other => Err(format!("a string is needed, not {}", other.kind())),
    }
}

pub(super) fn array(args: &[Value]) -> Result<&Array, String> {
    match &args[0] {
        Value::Array(array) => Ok(array),
        other => Err(format!("an array is needed, not {}", other.kind())),
    }
}

fn no(value: &Value) -> String {
    format!("{} cannot be used here", value.kind())
}

/// A value as a number: of a string the number that it begins with, and NaN where it begins with none.
fn read_number(value: &Value) -> f64 {
    if let (Value::Text(text), None) = (value, value.number()) {
        let text = text.trim_start();
        let digits = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
        let end = text
            .find(|c| !digits(c))
            .unwrap_or(text.len())
            .min(LONGEST_NUMBER);
        let beginnings = (1..=end).rev().filter_map(|to| text[..to].parse().ok());
        return beginnings.into_iter().next().unwrap_or(f64::NAN);
    }
    value.number().unwrap_or(f64::NAN)
}

/// The most characters that a number at the beginning of a string is read from.
const LONGEST_NUMBER: usize = 64;
