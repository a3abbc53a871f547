//! Edits of single shapes, by their place in the tree.

use std::collections::HashMap;

use super::tree::Tree;

/// What is to be otherwise at one place.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edit {
    /// The shape is left out, with all below it.
    pub delete: bool,
    /// The random alternatives to take in its rule, in order; the rest are drawn.
    pub choices: Vec<u16>,
}

/// Edits by the path of the shape: the places of children from the start shape on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Overrides {
    edits: HashMap<Vec<u32>, Edit>,
}

impl Overrides {
    pub fn new(edits: impl IntoIterator<Item = (Vec<u32>, Edit)>) -> Self {
        Self {
            edits: edits.into_iter().collect(),
        }
    }

    pub(super) fn choices(&self, tree: &Tree, node: u32) -> Vec<u16> {
        if self.edits.is_empty() {
            return Vec::new();
        }
        let edit = self.edits.get(&tree.path(node));
        edit.map(|edit| edit.choices.clone()).unwrap_or_default()
    }

    pub(super) fn deletes(&self, tree: &Tree, parent: u32, place: u32) -> bool {
        if self.edits.is_empty() {
            return false;
        }
        let mut path = tree.path(parent);
        path.push(place);
        self.edits.get(&path).is_some_and(|edit| edit.delete)
    }
}
