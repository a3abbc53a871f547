//! Edits of single shapes, by their place in the tree.

use std::collections::HashMap;
use std::sync::Arc;

use super::tree::{Node, Tree};
use super::value::Value;

/// What is to be otherwise at one place.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Edit {
    /// The name that the shape must have; an edit of another one is reported, and does nothing.
    pub name: Option<Arc<str>>,
    /// The shape is left out, with all below it.
    pub delete: bool,
    /// The random alternatives to take in its rule, in order; None and the rest are drawn.
    pub choices: Vec<Option<u16>>,
    /// Parameters of its rule, or attributes for it and all below it.
    pub values: Vec<(Arc<str>, Value)>,
}

/// What became of an edit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edited {
    pub path: Vec<u32>,
    /// Why it could not be done, or not all of it.
    pub fault: Option<String>,
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

    /// Whether a shape at this path is to be left out.
    pub(super) fn deletes(&self, path: &[u32], name: &Arc<str>) -> bool {
        let edit = self.edits.get(path);
        edit.is_some_and(|edit| edit.delete && edit.misnamed(name).is_none())
    }

    pub(super) fn edit(&self, tree: &Tree, node: u32) -> Option<&Edit> {
        if self.edits.is_empty() {
            return None;
        }
        self.edits.get(&tree.path(node))
    }

    /// The path of a child, where it is edited.
    pub(super) fn edited_child(
        &self,
        tree: &Tree,
        parent: u32,
        place: u32,
    ) -> Option<(Vec<u32>, &Edit)> {
        if self.edits.is_empty() {
            return None;
        }
        let mut path = tree.path(parent);
        path.push(place);
        let edit = self.edits.get(&path)?;
        Some((path, edit))
    }

    /// Adds the edits at or below `root` that the derivation never came to.
    pub(super) fn report_missed(&self, tree: &mut Tree, root: &[u32]) {
        let done: Vec<Vec<u32>> = tree.edited.iter().map(|one| one.path.clone()).collect();
        let below = self.edits.iter().filter(|(path, _)| path.starts_with(root));
        for (path, edit) in below.filter(|(path, _)| !done.contains(path)) {
            let fault = match tree.find(path).map(|node| &tree.nodes[node as usize]) {
                None => "there is no such shape".to_string(),
                Some(node) => edit
                    .misnamed(&node.name)
                    .unwrap_or_else(|| "no rule is applied to it: it can only be deleted".into()),
            };
            tree.edited.push(Edited {
                path: path.clone(),
                fault: Some(fault),
            });
        }
        tree.edited.sort_by(|one, other| one.path.cmp(&other.path));
    }
}

impl Edit {
    /// What to say where the shape has another name than the edit wants.
    pub(super) fn misnamed(&self, name: &Arc<str>) -> Option<String> {
        let wanted = self.name.as_ref().filter(|wanted| *wanted != name)?;
        Some(format!("it is no `{wanted}` any more but `{name}`"))
    }

    /// Whether it can be done to a node.
    pub(super) fn fits(&self, node: &Node) -> bool {
        self.misnamed(&node.name).is_none()
    }
}
