//! Alternatives: `case … : … else : …` and `30% : … else : …`.

use super::cursor::{Parsed, Parser};
use crate::ast::{Body, Branch, Branches, Expr, Test};
use crate::token::TokenKind;
use crate::Span;

impl Parser<'_> {
    /// The right side of a rule, a cell or an alternative.
    pub fn body(&mut self) -> Parsed<Body> {
        if self.is(TokenKind::Case) {
            return Ok(Body::Branches(self.cases(Self::body)?));
        }
        if self.starts_chance(self.at()) {
            let start = self.span();
            let test = self.arithmetic()?;
            let branches = self.chances(start, test, Self::body)?;
            return Ok(Body::Branches(branches));
        }
        Ok(Body::Operations(self.operations()?))
    }

    /// From `case` to the end of what follows `else`.
    pub fn cases<T>(&mut self, part: fn(&mut Self) -> Parsed<T>) -> Parsed<Branches<T>> {
        let first = self.span();
        let mut branches = Vec::new();
        while self.is(TokenKind::Case) {
            let start = self.advance().span;
            let test = self.arithmetic()?;
            branches.push(self.branch(start, test, part)?);
        }
        if self.starts_chance(self.at()) && !self.starts_item(self.at()) {
            return self.fail_mixed();
        }
        self.finish_branches(Test::Case, first, branches, part)
    }

    /// From the `%` of the first chance, which has been read, to the end of what follows `else`.
    pub fn chances<T>(
        &mut self,
        first: Span,
        chance: Expr,
        part: fn(&mut Self) -> Parsed<T>,
    ) -> Parsed<Branches<T>> {
        self.expect(TokenKind::Percent, "after a chance")?;
        let mut branches = vec![self.branch(first, chance, part)?];
        while self.starts_chance(self.at()) && !self.starts_item(self.at()) {
            let start = self.span();
            let test = self.arithmetic()?;
            self.expect(TokenKind::Percent, "after a chance")?;
            branches.push(self.branch(start, test, part)?);
        }
        if self.is(TokenKind::Case) {
            return self.fail_mixed();
        }
        self.finish_branches(Test::Chance, first, branches, part)
    }

    fn fail_mixed<T>(&mut self) -> Parsed<T> {
        let hint = "put the inner choice with its own `else` into one branch of the other";
        self.fail_with_hint(
            "`case` and percentages cannot be mixed in one choice".to_string(),
            Some(hint.to_string()),
        )
    }

    fn branch<T>(
        &mut self,
        start: Span,
        test: Expr,
        part: fn(&mut Self) -> Parsed<T>,
    ) -> Parsed<Branch<T>> {
        self.expect(TokenKind::Colon, "after the condition of a branch")?;
        let then = self.nested(part)?;
        let span = self.since(start);
        Ok(Branch { test, then, span })
    }

    fn finish_branches<T>(
        &mut self,
        test: Test,
        start: Span,
        branches: Vec<Branch<T>>,
        part: fn(&mut Self) -> Parsed<T>,
    ) -> Parsed<Branches<T>> {
        let mut otherwise = None;
        if self.eat(TokenKind::Else) {
            self.expect(TokenKind::Colon, "after `else`")?;
            otherwise = Some(Box::new(self.nested(part)?));
        }
        Ok(Branches {
            test,
            branches,
            otherwise,
            span: self.since(start),
        })
    }
}
