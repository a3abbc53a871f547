//! Where statements and alternatives begin. The language has no sign between them: what comes
//! next is known from a few words ahead.

use super::cursor::Parser;
use crate::token::TokenKind;

impl Parser<'_> {
    /// Whether a statement begins at a word: an annotation, a keyword, or a name with what only
    /// the left side of a definition has after it.
    pub fn starts_item(&self, index: usize) -> bool {
        match self.kind_at(index) {
            TokenKind::At => true,
            TokenKind::Name | TokenKind::Leaf => {
                self.starts_keyword_item(index) || self.starts_definition(index)
            }
            _ => false,
        }
    }

    /// `attr x`, `import x`, `version "x"`, … `start` and `extension` are also names of rules:
    /// they are keywords only before the left side of a rule.
    fn starts_keyword_item(&self, index: usize) -> bool {
        let next = self.kind_at(index + 1);
        match self.slice(self.token(index).span) {
            "attr" | "const" | "import" | "style" => next == TokenKind::Name,
            "version" => next == TokenKind::Text,
            "start" | "extension" => self.starts_definition(index + 1),
            _ => false,
        }
    }

    /// `name -->`, `name =`, `name with`, or the same with parameters.
    fn starts_definition(&self, index: usize) -> bool {
        let ends_left_side =
            |kind| matches!(kind, TokenKind::Arrow | TokenKind::Assign | TokenKind::With);
        if !matches!(self.kind_at(index), TokenKind::Name | TokenKind::Leaf) {
            return false;
        }
        match self.kind_at(index + 1) {
            TokenKind::OpenParen => self
                .after_partner(index + 1)
                .is_some_and(|after| ends_left_side(self.kind_at(after))),
            next => ends_left_side(next),
        }
    }

    /// Whether parsing can go on at a word after an error: a statement that is not part of a
    /// block (`{ front = A | …`) or of an import's list.
    pub fn resumes(&self, index: usize) -> bool {
        let before = |words| self.kind_at(index.saturating_sub(words));
        let in_list = match before(1) {
            TokenKind::OpenBrace | TokenKind::Bar | TokenKind::Comma => true,
            TokenKind::OpenParen => before(2) == TokenKind::Text,
            _ => false,
        };
        self.starts_item(index) && self.starts_line(index) && !in_list
    }

    /// Whether a chance (`30% :`) begins at a word where an operation or a further value would
    /// be: neither begins with a number, or is followed by an operator.
    pub fn starts_chance(&self, index: usize) -> bool {
        let after = match self.kind_at(index) {
            TokenKind::Number => return true,
            TokenKind::OpenParen => self.after_partner(index),
            TokenKind::Name if self.kind_at(index + 1) == TokenKind::OpenParen => {
                self.after_partner(index + 1)
            }
            TokenKind::Name => Some(index + 1),
            _ => None,
        };
        after.is_some_and(|after| {
            matches!(
                self.kind_at(after),
                TokenKind::Percent
                    | TokenKind::Plus
                    | TokenKind::Minus
                    | TokenKind::Star
                    | TokenKind::Slash
            )
        })
    }

    /// Whether the block that opens at `open` has cells (`{ selector : … | … }`) rather than
    /// plain operations. The first sign between its own words tells.
    pub fn holds_cells(&self, open: usize) -> bool {
        let mut index = open + 1;
        let first = self.kind_at(index);
        if first == TokenKind::OpenBrace {
            return true;
        }
        loop {
            match self.kind_at(index) {
                TokenKind::Colon => return self.kind_at(index - 1) != TokenKind::Percent,
                TokenKind::Assign
                | TokenKind::AssignEach
                | TokenKind::Bar
                | TokenKind::Tilde
                | TokenKind::Quote => return true,
                TokenKind::Case
                | TokenKind::CloseBrace
                | TokenKind::Arrow
                | TokenKind::EndOfFile => return first == TokenKind::Number,
                kind if kind.is_open() => match self.after_partner(index) {
                    Some(after) => index = after,
                    None => return true,
                },
                _ => index += 1,
            }
        }
    }

    /// Whether the block at `open` parts operations by `|` before anything that cells have.
    pub fn holds_operands(&self, open: usize) -> bool {
        let mut index = open + 1;
        loop {
            match self.kind_at(index) {
                TokenKind::Bar => return true,
                TokenKind::Colon
                | TokenKind::Assign
                | TokenKind::AssignEach
                | TokenKind::CloseBrace
                | TokenKind::Arrow
                | TokenKind::EndOfFile => return false,
                kind if kind.is_open() => match self.after_partner(index) {
                    Some(after) => index = after,
                    None => return false,
                },
                _ => index += 1,
            }
        }
    }
}
