//! Formats rule files.
//!
//! The house style:
//!
//! - Lines have at most 100 columns where that is possible; four spaces per level.
//! - A rule stands on one line if it fits; if not, each of its operations has its own line below
//!   `-->`. Alternatives of a rule always have their own lines; those of values and cells have them
//!   where one line is too short.
//! - A block stands on one line if it fits; if not, each cell has its own line, and the bar is
//!   before the cell.
//! - Annotations stand on the line before their statement, or each on one if they do not fit.
//! - One space around operators, `:`, `=` and bars, after commas and inside braces; none inside
//!   parentheses and brackets, after signs and size prefixes, and before `%` of a chance.
//! - At most one empty line follows another; rules of several lines have one around them.
//! - Comments stay at the word after which, or before which, they stand. One on a line of its own
//!   keeps a line of its own.
//!
//! Words are never changed: numbers and strings keep their spelling.

mod doc;
mod expression;
mod operation;
mod statement;
mod words;

use crate::ast::ItemKind;
use crate::{parse, Diagnostic, Names};
use doc::Doc;
use words::Words;

/// Formats the text of a rule file. A file that does not parse is refused with its faults.
pub fn format(text: &str) -> Result<String, Vec<Diagnostic>> {
    let parse = parse(text, &mut Names::new());
    if parse.has_errors() {
        return Err(parse.diagnostics);
    }
    let mut words = Words::new(text, &parse.tokens);
    let mut formatted = String::new();
    let mut after_tall_rule = false;
    for item in &parse.file.items {
        let (blank, mut parts) = words.statement_comments();
        parts.push(statement::statement(&mut words, item));
        let lines = doc::write(&Doc::Concat(parts));
        let is_tall = matches!(item.kind, ItemKind::Rule(_)) && lines.lines().count() > 1;
        if !formatted.is_empty() && (blank || is_tall || after_tall_rule) {
            formatted.push('\n');
        }
        formatted.push_str(&lines);
        after_tall_rule = is_tall;
    }
    let (blank, parts) = words.statement_comments();
    let lines = doc::write(&Doc::Concat(parts));
    if !formatted.is_empty() && !lines.is_empty() && (blank || after_tall_rule) {
        formatted.push('\n');
    }
    formatted.push_str(&lines);
    Ok(with_one_end(&formatted))
}

/// Without empty lines at the end, which groups without words leave there: formatted again they
/// would be others.
fn with_one_end(text: &str) -> String {
    match text.trim_end() {
        "" => String::new(),
        kept => [kept, "\n"].concat(),
    }
}
