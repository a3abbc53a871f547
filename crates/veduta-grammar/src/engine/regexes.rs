//! Regular expressions of `splitString`: with groups, classes, and looks ahead and behind.

use fancy_regex::{Regex, RegexBuilder};

use super::value::MAX_ELEMENTS;

/// The most letters of an expression.
const LONGEST: usize = 1000;
/// The most steps back of one search.
const STEPS_BACK: usize = 100_000;

/// The parts of a text between what an expression matches; Err says what is wrong with it.
pub fn split<'t>(text: &'t str, expression: &str) -> Result<Vec<&'t str>, String> {
    let regex = compiled(expression)?;
    let mut parts = Vec::new();
    let mut from = 0;
    for found in regex.find_iter(text) {
        let found = found.map_err(|why| told(expression, &why))?;
        parts.push(&text[from..found.start()]);
        from = found.end();
        if parts.len() > MAX_ELEMENTS {
            return Err(format!("an array of more than {MAX_ELEMENTS} elements"));
        }
    }
    parts.push(&text[from..]);
    Ok(parts)
}

fn compiled(expression: &str) -> Result<Regex, String> {
    if expression.len() > LONGEST {
        return Err(format!("a regular expression of more than {LONGEST} bytes"));
    }
    let mut builder = RegexBuilder::new(expression);
    builder.backtrack_limit(STEPS_BACK);
    builder.build().map_err(|why| told(expression, &why))
}

fn told(expression: &str, why: &fancy_regex::Error) -> String {
    format!("`{expression}` is no regular expression that can be read: {why}")
}
