//! Expressions: precedence climbing.

use super::cursor::{Failed, Parsed, Parser};
use super::operation::Sizes;
use crate::ast::{BinaryOp, Expr, ExprKind, Size, UnaryOp};
use crate::lexer::unescape;
use crate::limits::MAX_HEIGHT;
use crate::token::{EachOperator, TokenKind};
use crate::{Diagnostic, Span};

impl Parser<'_> {
    /// A whole value: an expression, or chances (`30% : 1 else : 2`).
    pub fn value(&mut self) -> Parsed<Expr> {
        let start = self.span();
        let value = self.arithmetic()?;
        if !self.is_chance_sign() {
            return Ok(value);
        }
        let branches = self.nested(|parser| parser.chances(start, value, Self::value))?;
        self.expr(ExprKind::Branches(Box::new(branches)), start)
    }

    /// An argument of an operation or function: a value that may have a size prefix.
    pub fn argument(&mut self) -> Parsed<Expr> {
        self.sized(Self::value)
    }

    /// What stands before the `:` or `=` of a cell.
    pub fn selector(&mut self) -> Parsed<Expr> {
        self.sized(Self::arithmetic)
    }

    fn sized(&mut self, part: fn(&mut Self) -> Parsed<Expr>) -> Parsed<Expr> {
        let start = self.span();
        let size = match (self.kind(), self.kind_at(self.at() + 1)) {
            (TokenKind::Tilde, TokenKind::Quote) => Size::FloatingRelative,
            (TokenKind::Tilde, _) => Size::Floating,
            (TokenKind::Quote, _) => Size::Relative,
            _ => return part(self),
        };
        self.advance();
        if size == Size::FloatingRelative {
            self.advance();
        }
        let value = Box::new(part(self)?);
        self.expr(ExprKind::Sized { size, value }, start)
    }

    /// An expression without chances. A `%` before `:` is not part of it.
    pub fn arithmetic(&mut self) -> Parsed<Expr> {
        self.binary(1)
    }

    fn is_chance_sign(&self) -> bool {
        self.is(TokenKind::Percent) && self.kind_at(self.at() + 1) == TokenKind::Colon
    }

    fn binary(&mut self, least: u8) -> Parsed<Expr> {
        let start = self.span();
        let mut left = self.unary()?;
        while let Some(op) = binary_op(self.kind()) {
            if op.precedence() < least || self.is_chance_sign() {
                break;
            }
            self.advance();
            let right = Box::new(self.binary(op.precedence() + 1)?);
            let kind = ExprKind::Binary {
                op,
                left: Box::new(left),
                right,
            };
            left = self.expr(kind, start)?;
        }
        Ok(left)
    }

    fn unary(&mut self) -> Parsed<Expr> {
        let Some(op) = unary_op(self.kind()) else {
            return self.postfix();
        };
        let start = self.advance().span;
        let operand = Box::new(self.nested(Self::unary)?);
        self.expr(ExprKind::Unary { op, operand }, start)
    }

    fn postfix(&mut self) -> Parsed<Expr> {
        let start = self.span();
        let mut value = self.primary()?;
        while self.is(TokenKind::OpenBracket) {
            let indices = self.list(TokenKind::CloseBracket, Self::element)?;
            if indices.is_empty() {
                return self.fail("expected an index between `[` and `]`".to_string());
            }
            let array = Box::new(value);
            value = self.expr(ExprKind::Index { array, indices }, start)?;
        }
        Ok(value)
    }

    fn primary(&mut self) -> Parsed<Expr> {
        let span = self.span();
        match self.kind() {
            TokenKind::Number => self.number(),
            TokenKind::Text => {
                self.advance();
                let value = unescape(self.slice(span));
                self.expr(ExprKind::Text(value), span)
            }
            kind @ (TokenKind::True | TokenKind::False) => {
                self.advance();
                self.expr(ExprKind::Bool(kind == TokenKind::True), span)
            }
            TokenKind::Name => self.name(),
            TokenKind::OpenParen => {
                self.advance();
                let mut value = self.nested(Self::value)?;
                self.expect(TokenKind::CloseParen, "to close `(`")?;
                value.span = self.since(span);
                Ok(value)
            }
            TokenKind::OpenBracket => self.nested(Self::array),
            TokenKind::Case => {
                let branches = self.nested(|parser| parser.cases(Self::value))?;
                self.expr(ExprKind::Branches(Box::new(branches)), span)
            }
            TokenKind::Quote | TokenKind::Tilde => self.fail_with_hint(
                "expected a value".to_string(),
                Some("a size prefix stands before the whole argument: `'-0.5`".to_string()),
            ),
            _ => self.fail("expected a value".to_string()),
        }
    }

    fn number(&mut self) -> Parsed<Expr> {
        let span = self.advance().span;
        match self.slice(span).parse::<f64>() {
            Ok(value) if value.is_finite() => self.expr(ExprKind::Number(value), span),
            _ => {
                self.diagnostics.error(span, "this number is too large");
                Err(Failed)
            }
        }
    }

    fn name(&mut self) -> Parsed<Expr> {
        let span = self.advance().span;
        let name = self.ident(span);
        if !self.is(TokenKind::OpenParen) {
            return self.expr(ExprKind::Name(name), span);
        }
        let args = self.list(TokenKind::CloseParen, Self::argument)?;
        if !self.is(TokenKind::OpenBrace) {
            return self.expr(ExprKind::Call { name, args }, span);
        }
        let cells = self.nested(|parser| parser.cells(Sizes::One, Self::value))?;
        self.expr(ExprKind::Cells { name, args, cells }, span)
    }

    /// `[a, b ; c, d]`
    fn array(&mut self) -> Parsed<Expr> {
        let start = self.advance().span;
        let mut rows = vec![vec![self.element()?]];
        loop {
            let kind = self.kind();
            match kind {
                TokenKind::Comma | TokenKind::Semicolon => {
                    self.advance();
                    let element = self.element()?;
                    match rows.last_mut() {
                        Some(row) if kind == TokenKind::Comma => row.push(element),
                        _ => rows.push(vec![element]),
                    }
                }
                TokenKind::CloseBracket => {
                    self.advance();
                    return self.expr(ExprKind::Array(rows), start);
                }
                _ => return self.fail("expected `,`, `;` or `]` in an array".to_string()),
            }
        }
    }

    /// An element of an array or an index: a value or a range `from : step : to`.
    fn element(&mut self) -> Parsed<Expr> {
        let start = self.span();
        let from = self.value()?;
        if !self.eat(TokenKind::Colon) {
            return Ok(from);
        }
        let second = Box::new(self.value()?);
        let (step, to) = if self.eat(TokenKind::Colon) {
            (Some(second), Box::new(self.value()?))
        } else {
            (None, second)
        };
        let from = Box::new(from);
        self.expr(ExprKind::Range { from, step, to }, start)
    }

    fn expr(&mut self, kind: ExprKind, start: Span) -> Parsed<Expr> {
        let expr = Expr::new(kind, self.since(start));
        if expr.height() > MAX_HEIGHT {
            let message = format!("this expression has more than {MAX_HEIGHT} levels");
            let hint = "break it into functions or constants".to_string();
            self.diagnostics
                .add(Diagnostic::error(start, message).with_hint(hint));
            return Err(Failed);
        }
        Ok(expr)
    }
}

fn unary_op(kind: TokenKind) -> Option<UnaryOp> {
    Some(match kind {
        TokenKind::Not => UnaryOp::Not,
        TokenKind::Minus => UnaryOp::Minus,
        TokenKind::Plus => UnaryOp::Plus,
        TokenKind::Each(EachOperator::Not) => UnaryOp::EachNot,
        TokenKind::Each(EachOperator::Minus) => UnaryOp::EachMinus,
        TokenKind::Each(EachOperator::Plus) => UnaryOp::EachPlus,
        _ => return None,
    })
}

fn binary_op(kind: TokenKind) -> Option<BinaryOp> {
    Some(match kind {
        TokenKind::Or => BinaryOp::Or,
        TokenKind::And => BinaryOp::And,
        TokenKind::Equal => BinaryOp::Equal,
        TokenKind::NotEqual => BinaryOp::NotEqual,
        TokenKind::Less => BinaryOp::Less,
        TokenKind::LessEqual => BinaryOp::LessEqual,
        TokenKind::Greater => BinaryOp::Greater,
        TokenKind::GreaterEqual => BinaryOp::GreaterEqual,
        TokenKind::Plus => BinaryOp::Add,
        TokenKind::Minus => BinaryOp::Subtract,
        TokenKind::Star => BinaryOp::Multiply,
        TokenKind::Slash => BinaryOp::Divide,
        TokenKind::Percent => BinaryOp::Remainder,
        TokenKind::Each(each) => return each_binary_op(each),
        _ => return None,
    })
}

fn each_binary_op(each: EachOperator) -> Option<BinaryOp> {
    Some(match each {
        EachOperator::Or => BinaryOp::EachOr,
        EachOperator::And => BinaryOp::EachAnd,
        EachOperator::Equal => BinaryOp::EachEqual,
        EachOperator::NotEqual => BinaryOp::EachNotEqual,
        EachOperator::Less => BinaryOp::EachLess,
        EachOperator::LessEqual => BinaryOp::EachLessEqual,
        EachOperator::Greater => BinaryOp::EachGreater,
        EachOperator::GreaterEqual => BinaryOp::EachGreaterEqual,
        EachOperator::Plus => BinaryOp::EachAdd,
        EachOperator::Minus => BinaryOp::EachSubtract,
        EachOperator::Star => BinaryOp::EachMultiply,
        EachOperator::Slash => BinaryOp::EachDivide,
        EachOperator::Percent => BinaryOp::EachRemainder,
        EachOperator::Not => return None,
    })
}
