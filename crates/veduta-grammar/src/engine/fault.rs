//! Why a derivation stopped.

use std::sync::Arc;

use crate::Span;

/// A fault at a place in a rule file.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The number of the file in the program: 0 is the main one, the others are imported.
    pub unit: Option<usize>,
    pub span: Span,
    pub message: String,
    /// The asset that is wanted and not there: with it, the derivation may be tried again.
    pub missing_asset: Option<Arc<str>>,
}

impl Fault {
    pub fn at(span: Span, message: impl Into<String>) -> Self {
        Self {
            unit: None,
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

    /// The fault with the file of what was at work, where it is not known yet.
    pub fn within(mut self, unit: usize) -> Self {
        self.unit.get_or_insert(unit);
        self
    }
}
