//! Why a derivation stopped.

use std::sync::Arc;

use super::limits::Limit;
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
    /// The limit that was reached: with a higher one, the derivation may go on.
    pub over: Option<Limit>,
}

impl Fault {
    pub fn at(span: Span, message: impl Into<String>) -> Self {
        Self {
            unit: None,
            span,
            message: message.into(),
            missing_asset: None,
            over: None,
        }
    }

    /// A limit is reached.
    pub fn over(limit: Limit, span: Span, message: impl Into<String>) -> Self {
        Self {
            over: Some(limit),
            ..Self::at(span, message)
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
