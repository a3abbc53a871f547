//! Words to a syntax tree: recursive descent, a few words of look-ahead, time linear in the text.
//!
//! An error ends its statement; parsing goes on with the next, so that several are reported.

mod annotation;
mod boundary;
mod branches;
mod cursor;
mod expression;
mod item;
mod operation;

use crate::ast::File;
use crate::diagnostic::Diagnostics;
use crate::lexer::lex;
use crate::limits::MAX_BYTES;
use crate::token::{TokenKind, Tokens};
use crate::{Diagnostic, Names, Span};
use cursor::Parser;

/// What parsing a file gives. The tree holds all statements without errors.
#[derive(Debug, Default)]
pub struct Parse {
    pub file: File,
    /// In the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    /// The words and comments, for the formatter.
    pub tokens: Tokens,
}

impl Parse {
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Parses the text of a rule file. Names go into `names`, which files that belong together share.
pub fn parse(text: &str, names: &mut Names) -> Parse {
    let mut diagnostics = Diagnostics::default();
    if text.len() > MAX_BYTES {
        let message = format!(
            "the file has {} bytes; {MAX_BYTES} are the most",
            text.len()
        );
        diagnostics.error(Span::default(), message);
        return Parse {
            diagnostics: diagnostics.into_sorted(),
            ..Parse::default()
        };
    }
    let tokens = lex(text, &mut diagnostics);
    let file = Parser::new(text, &tokens, names, &mut diagnostics).file();
    Parse {
        file,
        diagnostics: diagnostics.into_sorted(),
        tokens,
    }
}

impl Parser<'_> {
    fn file(&mut self) -> File {
        let mut items = Vec::new();
        while !self.is(TokenKind::EndOfFile) && !self.diagnostics.is_full() {
            let start = self.at();
            match self.item() {
                Ok(item) => {
                    items.push(item);
                    self.expect_item_end();
                }
                Err(_) if self.at() > start && self.resumes(self.at()) => {}
                Err(_) => self.skip_until(Self::resumes),
            }
        }
        File { items }
    }

    /// After a statement the next must begin; what else is there is reported once and passed.
    fn expect_item_end(&mut self) {
        if self.is(TokenKind::EndOfFile) || self.starts_item(self.at()) {
            return;
        }
        let (expected, hint) = match self.kind() {
            TokenKind::Case => (
                "expected the next statement",
                Some("operations cannot go before `case`: move the cases to a rule of their own"),
            ),
            TokenKind::Else => (
                "expected the next statement",
                Some("there is no open `case` or percentage for this `else`"),
            ),
            TokenKind::Number | TokenKind::Percent => (
                "expected the next statement",
                Some("operations cannot go before percentages: move these to a rule of their own"),
            ),
            kind if kind.is_close() => ("nothing is open here", None),
            _ => ("expected an operation or the next statement", None),
        };
        let _ = self.fail_with_hint::<()>(expected.to_string(), hint.map(str::to_string));
        self.skip_until(Self::resumes);
    }
}
