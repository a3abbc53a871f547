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
            Some(self.annotation_args()?)
        } else {
            None
        };
        Ok(Annotation {
            name,
            args,
            span: self.since(start),
        })
    }

    /// The arguments as far as they are values. Others are for a user interface, as this knows it or
    /// a later one will: they are passed over, to the bracket that closes them.
    fn annotation_args(&mut self) -> Parsed<Vec<AnnotationArg>> {
        let Some(end) = self.after_partner(self.at()) else {
            return self.list(TokenKind::CloseParen, Self::annotation_arg);
        };
        let args = self.quietly(|parser| parser.list(TokenKind::CloseParen, Self::annotation_arg));
        if args.is_err() {
            self.go_to(end);
        }
        Ok(args.unwrap_or_default())
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
