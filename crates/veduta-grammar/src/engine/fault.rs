//! Why a derivation stopped.

use std::sync::Arc;

use crate::Span;

/// A fault at a place in a rule file.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    pub span: Span,
    pub message: String,
    /// The asset that is wanted and not there: with it, the derivation may be tried again.
    pub missing_asset: Option<Arc<str>>,
}

impl Fault {
    pub fn at(span: Span, message: impl Into<String>) -> Self {
        Self {
            span,
            message: message.into(),
            missing_asset: None,
        }
    }

    /// An asset is not there.
    pub fn missing(span: Span, name: Arc<str>) -> Self {
        Self {
            missing_asset: Some(name.clone()),
            ..Self::at(span, format!("there is no asset `{name}`"))
        }
    }
}
