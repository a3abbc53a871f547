//! Leaves that are one thing: the frames and panes of a window, the bars of a railing.

use std::collections::HashMap;
use std::sync::Arc;

use super::code::Code;
use super::pack::Packed;
use super::tree::{Node, Tree};
use super::value::Value;

/// What rule files may say of a surface by `set`, in attributes of these names that they declare:
/// what it is called, which closed solid beside the body it is part of, and how it is known.
const NAME: &str = "surface";
const SOLID: &str = "solid";
const PROVENANCE: &str = "provenance";

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
    /// What the rules call it; empty where they do not say it.
    pub name: Vec<Arc<str>>,
    /// The name of the surface that it was made in, of those that the rules name; or empty.
    pub within: Vec<Arc<str>>,
    /// As the rules have it, or empty.
    pub solid: Vec<Arc<str>>,
    pub provenance: Vec<Arc<str>>,
}

/// Joins leaves of one `surface`, wherever they are; and of those that the rules do not name, the
/// leaves that got their class from one application of a rule: a surface is the shape that this
/// rule was applied to. Leaves without a class are joined below the rule that left them.
pub fn surfaces(tree: &Tree, packed: &Packed, code: &Code) -> Surfaces {
    let told = Told::of(code);
    let mut known: HashMap<(u32, Arc<str>), u32> = HashMap::new();
    let mut found = Surfaces::default();
    for &leaf in &packed.feature_node {
        let node = &tree.nodes[leaf as usize];
        let class = node.state.look.class.clone();
        let name = told.name(node);
        let node = if name.is_empty() {
            origin(tree, leaf, |above| {
                !class.is_empty() && above.state.look.class == class
            })
        } else {
            origin(tree, leaf, |above| told.name(above) == name)
        };
        let key = if name.is_empty() {
            (node, class.clone())
        } else {
            (u32::MAX, name.clone())
        };
        let next = found.node.len() as u32;
        let surface = *known.entry(key).or_insert(next);
        if surface == next {
            let size = tree.nodes[node as usize].state.form.scope.size;
            let leaf = &tree.nodes[leaf as usize];
            found.node.push(node);
            found.class.push(class);
            found.size.push([size.x, size.y]);
            found.within.push(told.around(tree, node, &name));
            found.name.push(name);
            found.solid.push(told.text(leaf, told.solid));
            found.provenance.push(told.text(leaf, told.provenance));
        }
        found.of_feature.push(surface);
    }
    found
}

/// The nearest shape above a leaf that was not yet what the leaf is.
fn origin(tree: &Tree, leaf: u32, is_same: impl Fn(&Node) -> bool) -> u32 {
    let mut at = leaf;
    while let Some(parent) = tree.nodes[at as usize].parent {
        at = parent;
        if !is_same(&tree.nodes[at as usize]) {
            break;
        }
    }
    at
}

/// The attributes of a rule file that tell something of surfaces.
struct Told {
    name: Option<usize>,
    solid: Option<usize>,
    provenance: Option<usize>,
}

impl Told {
    fn of(code: &Code) -> Self {
        let attribute = |name: &str| {
            let mut all = code.globals.iter();
            all.position(|global| global.is_attribute && global.name.as_ref() == name)
        };
        Self {
            name: attribute(NAME),
            solid: attribute(SOLID),
            provenance: attribute(PROVENANCE),
        }
    }

    fn name(&self, node: &Node) -> Arc<str> {
        self.text(node, self.name)
    }

    /// What `set` has said for a shape; empty where it has not, or what it said is no text.
    fn text(&self, node: &Node, attribute: Option<usize>) -> Arc<str> {
        let set = attribute.zip(node.state.set.as_ref());
        match set.and_then(|(attribute, set)| set.get(&attribute)) {
            Some(Value::Text(text)) => text.clone(),
            _ => "".into(),
        }
    }

    /// The name of the nearest surface around a shape that is not `name`.
    fn around(&self, tree: &Tree, node: u32, name: &str) -> Arc<str> {
        let mut at = Some(node);
        while let Some(node) = at.map(|at| &tree.nodes[at as usize]) {
            let other = self.name(node);
            if !other.is_empty() && other.as_ref() != name {
                return other;
            }
            at = node.parent;
        }
        "".into()
    }
}
