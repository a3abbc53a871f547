//! What a derivation made: the tree of shapes with the choices that led to it.

use std::sync::Arc;

use super::state::State;

/// A shape of the tree.
#[derive(Debug, Clone)]
pub struct Node {
    /// The shape that it was made from; None for the start shape.
    pub parent: Option<u32>,
    /// Which child of its parent it is, from 0.
    pub place: u32,
    pub name: Arc<str>,
    /// The rule that was applied to it; None for a leaf.
    pub rule: Option<u32>,
    /// The alternatives taken in that rule, in order.
    pub choices: Vec<u16>,
    /// The shape as the rule got it; of a leaf, as it stays.
    pub state: State,
}

/// A derivation of one start shape. A node comes after its parent.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    pub nodes: Vec<Node>,
    /// The numbers of the leaves, in the order of the tree.
    pub leaves: Vec<u32>,
    /// The sum of the logarithms of the chances of all random alternatives taken.
    pub log_prior: f64,
    /// What `report` collected: key and value, in order.
    pub reports: Vec<(Arc<str>, super::Value)>,
    /// What `print` wrote, and what the engine has to say.
    pub messages: Vec<String>,
}

impl Tree {
    /// The way from the start shape to a node: the places of children.
    pub fn path(&self, node: u32) -> Vec<u32> {
        let mut path = Vec::new();
        let mut at = &self.nodes[node as usize];
        while let Some(parent) = at.parent {
            path.push(at.place);
            at = &self.nodes[parent as usize];
        }
        path.reverse();
        path
    }

    /// The shapes that stay.
    pub fn leaves(&self) -> impl Iterator<Item = &Node> {
        self.leaves.iter().map(|&leaf| &self.nodes[leaf as usize])
    }
}
