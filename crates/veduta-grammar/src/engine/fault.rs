//! Why a derivation stopped.

use crate::Span;

/// A fault at a place in a rule file.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    pub span: Span,
    pub message: String,
}

impl Fault {
    pub fn at(span: Span, message: impl Into<String>) -> Self {
        Self {
            span,
            message: message.into(),
        }
    }
}
