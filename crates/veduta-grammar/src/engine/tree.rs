//! What a derivation made: the tree of shapes with the choices that led to it.

use std::ops::Range;
use std::sync::Arc;

use super::draws::{LogSum, Taken};
use super::overrides::Edited;
use super::random::Stream;
use super::state::State;
use super::value::Value;

/// A shape of the tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// The shape that it was made from; None for the start shape.
    pub parent: Option<u32>,
    /// Which child of its parent it is, from 0.
    pub place: u32,
    pub name: Arc<str>,
    /// The rule that was applied to it; None for a leaf.
    pub rule: Option<u32>,
    /// What its rule was given, without edits.
    pub args: Box<[Value]>,
    /// What its rule draws from.
    pub stream: Stream,
    /// The random alternatives taken in that rule, in order.
    pub choices: Vec<Taken>,
    /// The logarithm of the chance of the alternatives taken in rules that it inlined.
    pub inlined: LogSum,
    /// The shape as the rule got it; of a leaf, as it stays.
    pub state: State,
    /// The number of its first child: children stand together, and all below them follows.
    pub first_child: u32,
    pub child_count: u32,
}

impl Node {
    /// Of the chances of the alternatives that its rule took, and the rules that it inlined.
    pub(super) fn log_sum(&self) -> LogSum {
        let mut sum = LogSum::of(&self.choices);
        sum.add(self.inlined);
        sum
    }
}

/// The value of an attribute or constant that was needed, or that is drawn by chance.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// Its number in the code.
    pub global: u32,
    pub name: Arc<str>,
    pub is_attribute: bool,
    pub value: Value,
    pub choices: Vec<Taken>,
}

/// How many messages and reports the rule of a shape gave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Told {
    pub node: u32,
    pub messages: usize,
    pub reports: usize,
}

/// A derivation of one start shape. A node comes after its parent, and all that is below a node
/// stands together, without the node itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tree {
    pub nodes: Vec<Node>,
    /// The numbers of the leaves, in the order of the tree.
    pub leaves: Vec<u32>,
    /// The sum of the logarithms of the chances of all random alternatives taken: in the rules of
    /// all shapes, and in all attributes and constants.
    pub log_prior: f64,
    pub(super) log_sum: LogSum,
    /// In the order of the code.
    pub globals: Vec<Known>,
    /// What `report` collected: key and value, in order.
    pub reports: Vec<(Arc<str>, Value)>,
    /// What `print` wrote, and what the engine has to say.
    pub messages: Vec<String>,
    /// Whose these are, in order. Those of an attribute belong to the shape that needed it first.
    pub told: Vec<Told>,
    /// What became of the edits, in the order of their paths.
    pub edited: Vec<Edited>,
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

    /// The node at the end of a path, if there is one.
    pub fn find(&self, path: &[u32]) -> Option<u32> {
        let mut at = 0;
        self.nodes.first()?;
        for place in path {
            at = self
                .children(at)
                .find(|&child| self.nodes[child as usize].place == *place)?;
        }
        Some(at)
    }

    /// The numbers of the shapes that were made from a node.
    pub fn children(&self, node: u32) -> Range<u32> {
        let node = &self.nodes[node as usize];
        node.first_child..node.first_child + node.child_count
    }

    /// The numbers of all that is below a node.
    pub fn below(&self, node: u32) -> Range<u32> {
        let first = self.nodes[node as usize].first_child;
        let rest = self.nodes.get(first as usize..).unwrap_or_default();
        let belongs = |one: &Node| {
            one.parent
                .is_some_and(|parent| parent == node || parent >= first)
        };
        let count = rest.iter().take_while(|one| belongs(one)).count();
        first..first + count as u32
    }

    /// The shapes that stay.
    pub fn leaves(&self) -> impl Iterator<Item = &Node> {
        self.leaves.iter().map(|&leaf| &self.nodes[leaf as usize])
    }

    /// Finds the leaves and the prior of a new tree.
    pub(super) fn settle(&mut self) {
        self.leaves = self.leaves_in(0..self.nodes.len());
        self.log_sum = LogSum::of(self.globals.iter().flat_map(|known| &known.choices));
        self.log_sum.add(self.log_sum_in(0..self.nodes.len()));
        self.log_prior = self.log_sum.value();
    }

    pub(super) fn leaves_in(&self, range: Range<usize>) -> Vec<u32> {
        let numbers = range.start as u32..;
        let nodes = self.nodes[range].iter().zip(numbers);
        let leaves = nodes.filter(|(node, _)| node.rule.is_none());
        leaves.map(|(_, number)| number).collect()
    }

    pub(super) fn log_sum_in(&self, range: Range<usize>) -> LogSum {
        let mut sum = LogSum::default();
        for node in &self.nodes[range] {
            sum.add(node.log_sum());
        }
        sum
    }
}
