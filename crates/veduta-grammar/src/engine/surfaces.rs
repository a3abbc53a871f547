//! Leaves that are one thing: the frames and panes of a window, the bars of a railing.

use std::collections::HashMap;
use std::sync::Arc;

use super::pack::Packed;
use super::tree::Tree;

/// What packed leaves belong to.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surfaces {
    /// The surface of each feature of the packed leaves.
    pub of_feature: Vec<u32>,
    /// The shape that each surface was made from.
    pub node: Vec<u32>,
    pub class: Vec<Arc<str>>,
    /// Size of that shape's scope along x and y (m).
    pub size: Vec<[f64; 2]>,
}

/// Joins the leaves that got their class from one application of a rule: a surface is the shape
/// that this rule was applied to. Leaves without a class are joined below the rule that left them.
pub fn surfaces(tree: &Tree, packed: &Packed) -> Surfaces {
    let mut known: HashMap<(u32, Arc<str>), u32> = HashMap::new();
    let mut found = Surfaces::default();
    for &leaf in &packed.feature_node {
        let class = tree.nodes[leaf as usize].state.look.class.clone();
        let node = origin(tree, leaf, &class);
        let next = found.node.len() as u32;
        let surface = *known.entry((node, class.clone())).or_insert(next);
        if surface == next {
            let size = tree.nodes[node as usize].state.form.scope.size;
            found.node.push(node);
            found.class.push(class);
            found.size.push([size.x, size.y]);
        }
        found.of_feature.push(surface);
    }
    found
}

/// The nearest shape above a leaf that did not have its class yet.
fn origin(tree: &Tree, leaf: u32, class: &str) -> u32 {
    let mut at = leaf;
    while let Some(parent) = tree.nodes[at as usize].parent {
        at = parent;
        let had = tree.nodes[at as usize].state.look.class.as_ref();
        if had != class || class.is_empty() {
            break;
        }
    }
    at
}
