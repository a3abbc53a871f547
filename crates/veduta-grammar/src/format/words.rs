//! The words of a file in their order, each with its comments.

use super::doc::Doc;
use crate::token::{Token, TokenKind, Tokens};
use crate::Span;

/// Hands out the words of a file one after the other. Every word is taken once, so that none and
/// no comment is lost, whatever the layout.
pub(super) struct Words<'a> {
    text: &'a str,
    tokens: &'a Tokens,
    at: usize,
    comment: usize,
}

impl<'a> Words<'a> {
    pub fn new(text: &'a str, tokens: &'a Tokens) -> Self {
        Self {
            text,
            tokens,
            at: 0,
            comment: 0,
        }
    }

    fn token(&self, ahead: usize) -> Option<Token> {
        self.tokens.tokens.get(self.at + ahead).copied()
    }

    pub fn kind(&self) -> TokenKind {
        self.token(0).map_or(TokenKind::EndOfFile, |one| one.kind)
    }

    pub fn kind_after(&self) -> TokenKind {
        self.token(1).map_or(TokenKind::EndOfFile, |one| one.kind)
    }

    /// Whether the next word begins before `end`.
    pub fn is_before(&self, end: u32) -> bool {
        let next = self.token(0);
        next.is_some_and(|one| one.kind != TokenKind::EndOfFile && one.span.start < end)
    }

    /// The next word: comments on lines before it, itself, comments on its line after it.
    pub fn take(&mut self) -> Doc {
        let mut parts = self.comments_before();
        if let Some(token) = self.token(0) {
            if token.kind != TokenKind::EndOfFile {
                self.at += 1;
                parts.push(Doc::text(self.slice(token.span)));
                self.comments_after(token.span, &mut parts);
            }
        }
        match parts.len() {
            1 => parts.remove(0),
            _ => Doc::Concat(parts),
        }
    }

    /// Comments between the last word and the next that have lines of their own.
    pub fn comments_before(&mut self) -> Vec<Doc> {
        let until = self.token(0).map_or(u32::MAX, |one| one.span.start);
        let mut parts = Vec::new();
        while let Some(span) = self.comment_before(until) {
            parts.push(Doc::Own(self.slice(span).to_string()));
        }
        parts
    }

    /// As [`comments_before`](Self::comments_before), with the empty lines around them: those of a
    /// statement. Says whether an empty line was before all.
    pub fn statement_comments(&mut self) -> (bool, Vec<Doc>) {
        let until = self.token(0).map_or(u32::MAX, |one| one.span.start);
        let mut last = self.last_end();
        let mut parts = Vec::new();
        let mut first_blank = None;
        while let Some(span) = self.comment_before(until) {
            let blank = self.has_blank(last, span.start);
            if first_blank.is_none() {
                first_blank = Some(blank);
            } else if blank {
                parts.push(Doc::Blank);
            }
            parts.push(Doc::Own(self.slice(span).to_string()));
            last = span.end;
        }
        let blank = self.has_blank(last, until);
        if first_blank.is_some() && blank && self.kind() != TokenKind::EndOfFile {
            parts.push(Doc::Blank);
        }
        (first_blank.unwrap_or(blank), parts)
    }

    /// The end of the last word or comment that has been taken.
    fn last_end(&self) -> u32 {
        let word = self
            .at
            .checked_sub(1)
            .and_then(|at| self.tokens.tokens.get(at));
        let comment = self.comment.checked_sub(1);
        let comment = comment.and_then(|at| self.tokens.comments.get(at));
        let word = word.map_or(0, |one| one.span.end);
        word.max(comment.map_or(0, |one| one.span.end))
    }

    fn comment_before(&mut self, until: u32) -> Option<Span> {
        let comment = self.tokens.comments.get(self.comment)?;
        (comment.span.start < until).then(|| {
            self.comment += 1;
            comment.span
        })
    }

    fn comments_after(&mut self, word: Span, parts: &mut Vec<Doc>) {
        let mut last = word.end;
        while let Some(comment) = self.tokens.comments.get(self.comment) {
            let next = self.token(0).map_or(u32::MAX, |one| one.span.start);
            let gap = self.gap(last, comment.span.start);
            if comment.span.start >= next || gap.contains('\n') {
                return;
            }
            self.comment += 1;
            last = comment.span.end;
            parts.push(Doc::Trailing {
                text: self.slice(comment.span).to_string(),
                to_line_end: comment.to_line_end,
            });
        }
    }

    fn has_blank(&self, from: u32, to: u32) -> bool {
        self.gap(from, to).matches('\n').count() > 1
    }

    fn gap(&self, from: u32, to: u32) -> &'a str {
        self.text.get(from as usize..to as usize).unwrap_or("")
    }

    fn slice(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }
}
