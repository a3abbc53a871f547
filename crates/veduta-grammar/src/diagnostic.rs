//! What is wrong with a rule file, said so that its author finds the place and the remedy.

use std::fmt::Write;
use std::ops::Range;

use crate::limits::MAX_DIAGNOSTICS;
use crate::{Position, Source, Span};

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    Warning,
    Error,
}

impl Severity {
    pub fn word(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// One fault of one file. `hint` says what to do about it, where that is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    pub severity: Severity,
    pub span: Span,
    pub message: String,
    pub hint: Option<String>,
}

impl Diagnostic {
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, span, message.into())
    }

    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, span, message.into())
    }

    fn new(severity: Severity, span: Span, message: String) -> Self {
        Self {
            severity,
            span,
            message,
            hint: None,
        }
    }

    pub fn with_hint(mut self, hint: impl Into<Option<String>>) -> Self {
        self.hint = hint.into();
        self
    }

    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    pub fn position(&self, source: &Source) -> Position {
        source.position(self.span.start)
    }

    /// The fault as text of several lines: place and message, the line of the file, a caret
    /// under the span, the hint.
    pub fn render(&self, source: &Source) -> String {
        let Position { line, column } = self.position(source);
        let mut text = format!(
            "{}:{line}:{column}: {}: {}\n",
            source.name(),
            self.severity.word(),
            self.message
        );
        let (shown, marks) = self.excerpt(source);
        let number = line.to_string();
        let margin = " ".repeat(number.len());
        // Writing to a String cannot fail.
        let _ = writeln!(text, " {number} | {shown}\n {margin} | {marks}");
        if let Some(hint) = &self.hint {
            let _ = writeln!(text, " {margin} = {hint}");
        }
        text
    }

    /// The line with tabs as one space and at most 100 characters, and the carets under it.
    fn excerpt(&self, source: &Source) -> (String, String) {
        const WIDTH: usize = 100;
        let line = source.line_text(self.span.start);
        let before = self.position(source).column - 1;
        let skipped = before.saturating_sub(WIDTH / 2);
        let marked = source.slice(self.span).lines().next().unwrap_or("");
        let shown = line.chars().skip(skipped).take(WIDTH);
        let shown: String = shown
            .map(|c| if c.is_control() { ' ' } else { c })
            .collect();
        let room = WIDTH - (before - skipped);
        let carets = marked.chars().count().clamp(1, room);
        let marks = " ".repeat(before - skipped) + &"^".repeat(carets);
        (shown, marks)
    }
}

/// Collects the faults of one file. Of many, [`MAX_DIAGNOSTICS`] are told, errors before warnings:
/// which are errors is known when all are there.
#[derive(Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    pub fn add(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    pub fn error(&mut self, span: Span, message: impl Into<String>) {
        self.add(Diagnostic::error(span, message));
    }

    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Makes warnings of the errors among some, in the order in which they were added, and says
    /// why; each as it was and as it is.
    pub fn soften(&mut self, some: Range<usize>, why: &str) -> Vec<(Diagnostic, Diagnostic)> {
        let some = self.list.get_mut(some).unwrap_or_default();
        let errors = some.iter_mut().filter(|one| one.is_error());
        let softened = errors.map(|one| {
            let before = one.clone();
            one.severity = Severity::Warning;
            one.message = format!("{}; {why}", one.message);
            (before, one.clone())
        });
        softened.collect()
    }

    /// Whether there are as many as are told: more need no hints.
    pub fn is_full(&self) -> bool {
        self.list.len() >= MAX_DIAGNOSTICS
    }

    /// The faults that are told, in the order of the file.
    pub fn into_sorted(mut self) -> Vec<Diagnostic> {
        self.list.sort_by_key(|one| (!one.is_error(), one.span));
        self.list.truncate(MAX_DIAGNOSTICS);
        self.list.sort_by_key(|one| one.span);
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_shows_its_line_caret_and_hint() {
        let source = Source::new("lot.cga", "Lot -->\n\tcmop(f) { all : A }\n");
        let fault = Diagnostic::error(Span::new(9, 13), "there is no operation `cmop`")
            .with_hint("did you mean `comp`?".to_string());
        let lines = [
            "lot.cga:2:2: error: there is no operation `cmop`",
            " 2 |  cmop(f) { all : A }",
            "   |  ^^^^",
            "   = did you mean `comp`?",
        ];
        assert_eq!(fault.render(&source), lines.join("\n") + "\n");
    }

    #[test]
    fn a_long_line_is_cut_around_the_fault() {
        let text = format!("{}X{}", "a ".repeat(300), "b ".repeat(300));
        let source = Source::new("a.cga", text);
        let fault = Diagnostic::error(Span::new(600, 601), "bad");
        let lines: Vec<String> = fault.render(&source).lines().map(String::from).collect();
        let caret = lines[2].find('^').unwrap();
        assert_eq!(lines[1].chars().nth(caret), Some('X'));
        assert!(lines[1].len() < 120);
    }
}
