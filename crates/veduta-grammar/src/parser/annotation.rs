//! Annotations: `@Range(min=0, max=10)`.

use super::cursor::{Parsed, Parser};
use crate::ast::{Annotation, AnnotationArg, AnnotationValue};
use crate::token::TokenKind;

impl Parser<'_> {
    pub fn annotations(&mut self) -> Parsed<Vec<Annotation>> {
        let mut annotations = Vec::new();
        while self.is(TokenKind::At) {
            annotations.push(self.annotation()?);
        }
        if !annotations.is_empty() && self.is(TokenKind::EndOfFile) {
            return self.fail("expected the statement to which the annotations belong".to_string());
        }
        Ok(annotations)
    }

    fn annotation(&mut self) -> Parsed<Annotation> {
        let start = self.advance().span;
        let name = self.plain_name("of an annotation")?;
        let args = if self.is(TokenKind::OpenParen) {
            Some(self.list(TokenKind::CloseParen, Self::annotation_arg)?)
        } else {
            None
        };
        Ok(Annotation {
            name,
            args,
            span: self.since(start),
        })
    }

    fn annotation_arg(&mut self) -> Parsed<AnnotationArg> {
        let mut name = None;
        if self.kind_at(self.at() + 1) == TokenKind::Assign {
            name = Some(self.plain_name("of an argument")?);
            self.advance();
        }
        let value = if self.is(TokenKind::OpenBrace) {
            AnnotationValue::List(self.list(TokenKind::CloseBrace, Self::value)?)
        } else {
            AnnotationValue::Expr(self.value()?)
        };
        Ok(AnnotationArg { name, value })
    }
}
