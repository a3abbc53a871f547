//! A shape while a rule works on it, and what its children get from it.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::shape::Form;

use super::value::Value;

/// How a shape looks, and what it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// sRGB, 0 to 1.
    pub colour: [f32; 3],
    pub opacity: f32,
    pub texture: Option<Arc<str>>,
    /// What a surface is in the model: `wall`, `window`, `door`, `roof`, ...; empty where the
    /// rules do not say it.
    pub class: Arc<str>,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            colour: [1.0; 3],
            opacity: 1.0,
            texture: None,
            class: "".into(),
        }
    }
}

/// Which of how many parts a shape is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Place {
    pub index: usize,
    pub total: usize,
}

/// The current shape.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    pub form: Form,
    pub look: Arc<Look>,
    /// Attributes that `set` has changed for this shape and its children.
    pub set: Option<Arc<BTreeMap<usize, Value>>>,
    pub split: Place,
    pub comp: Place,
    /// The selector that `comp` chose the shape by.
    pub selector: Arc<str>,
    pub seed: u32,
}

impl State {
    pub fn new(form: Form, seed: u32) -> Self {
        Self {
            form,
            look: Arc::new(Look::default()),
            set: None,
            split: Place::default(),
            comp: Place::default(),
            selector: "".into(),
            seed,
        }
    }

    /// Another form with the same looks and attributes.
    pub fn with_form(&self, form: Form) -> Self {
        Self {
            form,
            ..self.clone()
        }
    }
}
