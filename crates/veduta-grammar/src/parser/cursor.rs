//! The place in the list of words, and what can be seen from there.

use crate::diagnostic::Diagnostics;
use crate::limits::MAX_NESTING;
use crate::token::{Token, TokenKind, Tokens};
use crate::{Diagnostic, Names, Span};

/// Parsing a part has failed; the diagnostic is already filed. The caller that knows where the
/// text makes sense again goes on there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Failed;

pub(super) type Parsed<T> = Result<T, Failed>;

pub(super) struct Parser<'a> {
    pub text: &'a str,
    tokens: &'a [Token],
    /// For an opening bracket the index of the one that closes it.
    partners: Vec<u32>,
    at: usize,
    nesting: usize,
    pub names: &'a mut Names,
    pub diagnostics: &'a mut Diagnostics,
}

const NO_PARTNER: u32 = u32::MAX;

impl<'a> Parser<'a> {
    pub fn new(
        text: &'a str,
        tokens: &'a Tokens,
        names: &'a mut Names,
        diagnostics: &'a mut Diagnostics,
    ) -> Self {
        Self {
            text,
            tokens: &tokens.tokens,
            partners: find_partners(&tokens.tokens),
            at: 0,
            nesting: 0,
            names,
            diagnostics,
        }
    }

    pub fn at(&self) -> usize {
        self.at
    }

    /// The word with an index; the end of the file beyond the last.
    pub fn token(&self, index: usize) -> Token {
        let last = self.tokens.len() - 1;
        self.tokens[index.min(last)]
    }

    pub fn kind_at(&self, index: usize) -> TokenKind {
        self.token(index).kind
    }

    pub fn kind(&self) -> TokenKind {
        self.kind_at(self.at)
    }

    pub fn is(&self, kind: TokenKind) -> bool {
        self.kind() == kind
    }

    pub fn span(&self) -> Span {
        self.token(self.at).span
    }

    /// The span of the word before the present one.
    pub fn last_span(&self) -> Span {
        self.token(self.at.saturating_sub(1)).span
    }

    /// The span from `start` to the word before the present one.
    pub fn since(&self, start: Span) -> Span {
        start.to(self.last_span())
    }

    pub fn slice(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }

    /// The index after the bracket that closes the one at `open`; `None` where none does.
    pub fn after_partner(&self, open: usize) -> Option<usize> {
        let partner = *self.partners.get(open)?;
        (partner != NO_PARTNER).then_some(partner as usize + 1)
    }

    pub fn advance(&mut self) -> Token {
        let token = self.token(self.at);
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        token
    }

    pub fn eat(&mut self, kind: TokenKind) -> bool {
        let found = self.is(kind);
        if found {
            self.advance();
        }
        found
    }

    /// Goes on at the word with an index.
    pub fn go_to(&mut self, index: usize) {
        self.at = index.min(self.tokens.len() - 1);
    }

    /// Runs `part` without filing what is wrong there.
    pub fn quietly<T>(&mut self, part: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        let kept = std::mem::take(self.diagnostics);
        let result = part(self);
        *self.diagnostics = kept;
        result
    }

    /// The word that must come next. `place` says what it belongs to.
    pub fn expect(&mut self, kind: TokenKind, place: &str) -> Parsed<Token> {
        if self.is(kind) {
            return Ok(self.advance());
        }
        self.fail(format!("expected {} {place}", kind.describe()))
    }

    /// Files "`expected`, found …" at the present word.
    pub fn fail<T>(&mut self, expected: String) -> Parsed<T> {
        self.fail_with_hint(expected, None)
    }

    pub fn fail_with_hint<T>(&mut self, expected: String, hint: Option<String>) -> Parsed<T> {
        let (kind, span) = (self.kind(), self.span());
        // The lexer has filed an unknown character already.
        if kind != TokenKind::Unknown {
            let found = match kind {
                TokenKind::EndOfFile => kind.describe().to_string(),
                _ => format!("`{}`", shorten(self.slice(span))),
            };
            let message = format!("{expected}, found {found}");
            self.diagnostics
                .add(Diagnostic::error(span, message).with_hint(hint));
        }
        Err(Failed)
    }

    /// Runs `part` one level deeper.
    pub fn nested<T>(&mut self, part: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.nesting >= MAX_NESTING {
            let message = format!("more than {MAX_NESTING} brackets and blocks within each other");
            self.diagnostics.error(self.span(), message);
            return Err(Failed);
        }
        self.nesting += 1;
        let result = part(self);
        self.nesting -= 1;
        result
    }

    /// Passes words up to the next one that `stop` accepts, at least one.
    pub fn skip_until(&mut self, stop: impl Fn(&Self, usize) -> bool) {
        self.advance();
        while !self.is(TokenKind::EndOfFile) && !stop(self, self.at) {
            self.advance();
        }
    }

    /// Whether a word is the first of its line.
    pub fn starts_line(&self, index: usize) -> bool {
        let Some(before) = index.checked_sub(1) else {
            return true;
        };
        let between = self.token(before).span.end as usize..self.token(index).span.start as usize;
        self.text.get(between).is_some_and(|gap| gap.contains('\n'))
    }
}

/// At most 30 characters of one line.
fn shorten(text: &str) -> String {
    let line = text.lines().next().unwrap_or("");
    if line.chars().count() <= 30 {
        return line.to_string();
    }
    line.chars().take(29).chain(['…']).collect()
}

/// Pairs brackets. A bracket that does not fit the innermost open one closes none.
fn find_partners(tokens: &[Token]) -> Vec<u32> {
    let mut partners = vec![NO_PARTNER; tokens.len()];
    let mut open: Vec<usize> = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        if token.kind.is_open() {
            open.push(index);
        } else if token.kind.is_close() {
            let Some(&start) = open.last() else { continue };
            if tokens[start].kind.partner() == token.kind {
                open.pop();
                partners[start] = u32::try_from(index).unwrap_or(NO_PARTNER);
            }
        }
    }
    partners
}
