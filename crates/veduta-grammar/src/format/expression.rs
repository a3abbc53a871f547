//! Expressions, laid out by their words: the tree does not keep parentheses.

use super::doc::Doc;
use super::words::Words;
use crate::token::TokenKind;

/// The words up to `end`, as one group.
pub(super) fn expression(words: &mut Words, end: u32) -> Doc {
    let mut run = Run::default();
    while words.is_before(end) {
        run.step(words);
    }
    Doc::group(vec![Doc::Indented(run.parts)])
}

/// Words between two brackets.
struct Run {
    parts: Vec<Doc>,
    /// The next word begins a value: a sign before it belongs to it, a bracket is its own.
    starts_value: bool,
    /// No space goes around `=`: arguments of annotations.
    is_tight: bool,
}

impl Default for Run {
    fn default() -> Self {
        Self {
            parts: Vec::new(),
            starts_value: true,
            is_tight: false,
        }
    }
}

impl Run {
    fn push(&mut self, words: &mut Words) {
        let word = words.take();
        self.parts.push(word);
    }

    fn step(&mut self, words: &mut Words) {
        let kind = words.kind();
        match kind {
            TokenKind::OpenParen | TokenKind::OpenBracket => self.bracket(words),
            TokenKind::OpenBrace => {
                if !self.starts_value {
                    self.parts.push(Doc::text(" "));
                }
                let block = bracketed(words, Doc::Line);
                self.parts.push(block);
                self.starts_value = false;
            }
            TokenKind::Comma | TokenKind::Semicolon => {
                if kind == TokenKind::Semicolon {
                    self.parts.push(Doc::text(" "));
                }
                self.push(words);
                self.parts.push(Doc::Line);
                self.starts_value = true;
            }
            TokenKind::Bar | TokenKind::Case | TokenKind::Else => {
                if !self.starts_value {
                    self.parts.push(Doc::Line);
                }
                self.push(words);
                if kind != TokenKind::Else {
                    self.parts.push(Doc::text(" "));
                }
                self.starts_value = true;
            }
            TokenKind::Percent if words.kind_after() == TokenKind::Colon => {
                self.push(words);
                self.starts_value = false;
            }
            TokenKind::Assign if self.is_tight => {
                self.push(words);
                self.starts_value = true;
            }
            TokenKind::Colon | TokenKind::Assign | TokenKind::AssignEach | TokenKind::Define => {
                self.parts.push(Doc::text(" "));
                self.push(words);
                self.parts.push(Doc::text(" "));
                self.starts_value = true;
            }
            TokenKind::Quote | TokenKind::Tilde => {
                self.push(words);
                self.starts_value = true;
            }
            _ if is_operator(kind) => self.operator(words),
            _ => {
                // Two values in a row: the next percentage of a choice.
                if !self.starts_value {
                    self.parts.push(Doc::Line);
                }
                self.push(words);
                self.starts_value = false;
            }
        }
    }

    fn operator(&mut self, words: &mut Words) {
        if self.starts_value {
            return self.push(words);
        }
        self.parts.push(Doc::Line);
        self.push(words);
        self.parts.push(Doc::text(" "));
        self.starts_value = true;
    }

    fn bracket(&mut self, words: &mut Words) {
        let bracket = bracketed(words, Doc::Soft);
        self.parts.push(bracket);
        self.starts_value = false;
    }
}

/// From an opening bracket to the one that closes it.
pub(super) fn bracketed(words: &mut Words, inner: Doc) -> Doc {
    inside_brackets(words, inner, Run::default())
}

/// The arguments of an annotation, in which no space goes around `=`.
pub(super) fn annotation_args(words: &mut Words) -> Doc {
    let run = Run {
        is_tight: true,
        ..Run::default()
    };
    inside_brackets(words, Doc::Soft, run)
}

fn inside_brackets(words: &mut Words, inner: Doc, mut run: Run) -> Doc {
    let open = words.take();
    while !words.kind().is_close() && words.kind() != TokenKind::EndOfFile {
        run.step(words);
    }
    if run.parts.is_empty() {
        return Doc::Concat(vec![open, words.take()]);
    }
    run.parts.insert(0, inner.clone());
    let close = words.take();
    Doc::group(vec![open, Doc::Indented(run.parts), inner, close])
}

fn is_operator(kind: TokenKind) -> bool {
    matches!(
        kind,
        TokenKind::Not
            | TokenKind::Plus
            | TokenKind::Minus
            | TokenKind::Star
            | TokenKind::Slash
            | TokenKind::Percent
            | TokenKind::And
            | TokenKind::Or
            | TokenKind::Equal
            | TokenKind::NotEqual
            | TokenKind::Less
            | TokenKind::LessEqual
            | TokenKind::Greater
            | TokenKind::GreaterEqual
            | TokenKind::Each(_)
    )
}
