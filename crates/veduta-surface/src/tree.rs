//! Boxes around triangles, in a binary tree.

use crate::triangle::{Triangle, Vector};

const LEAF: usize = 4;

/// A box, and its triangles where `below` is None, else its two children.
#[derive(Debug)]
struct Node {
    low: Vector,
    high: Vector,
    from: usize,
    to: usize,
    below: Option<[usize; 2]>,
}

/// All triangles of a mesh, those near each other beside each other.
#[derive(Debug)]
pub struct Tree {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
}

impl Tree {
    pub const ROOT: usize = 0;

    /// None where there is no triangle.
    pub fn new(mut triangles: Vec<Triangle>) -> Option<Self> {
        if triangles.is_empty() {
            return None;
        }
        let mut nodes = vec![Node::around(&triangles, 0, triangles.len())];
        let mut waiting = vec![Self::ROOT];
        while let Some(node) = waiting.pop() {
            let (from, to) = (nodes[node].from, nodes[node].to);
            if to - from <= LEAF {
                continue;
            }
            let axis = nodes[node].longest();
            let middle = (to - from) / 2;
            triangles[from..to]
                .select_nth_unstable_by(middle, |a, b| centre(a, axis).total_cmp(&centre(b, axis)));
            let pair = [nodes.len(), nodes.len() + 1];
            nodes.push(Node::around(&triangles, from, from + middle));
            nodes.push(Node::around(&triangles, from + middle, to));
            nodes[node].below = Some(pair);
            waiting.extend(pair);
        }
        Some(Self { triangles, nodes })
    }

    pub fn children(&self, node: usize) -> Option<[usize; 2]> {
        self.nodes[node].below
    }

    pub fn leaf(&self, node: usize) -> &[Triangle] {
        let node = &self.nodes[node];
        &self.triangles[node.from..node.to]
    }

    /// The squared distance of a point from a box; 0 within.
    pub fn squared(&self, node: usize, point: Vector) -> f64 {
        let node = &self.nodes[node];
        (0..3)
            .map(|axis| {
                let below = node.low[axis] - point[axis];
                let above = point[axis] - node.high[axis];
                below.max(above).max(0.0).powi(2)
            })
            .sum()
    }
}

impl Node {
    fn around(triangles: &[Triangle], from: usize, to: usize) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for triangle in &triangles[from..to] {
            let [least, most] = triangle.bounds();
            for axis in 0..3 {
                low[axis] = low[axis].min(least[axis]);
                high[axis] = high[axis].max(most[axis]);
            }
        }
        Self {
            low,
            high,
            from,
            to,
            below: None,
        }
    }

    fn longest(&self) -> usize {
        let side = |axis: usize| self.high[axis] - self.low[axis];
        (0..3).fold(
            0,
            |best, axis| if side(axis) > side(best) { axis } else { best },
        )
    }
}

/// Twice the middle of a triangle's box.
fn centre(triangle: &Triangle, axis: usize) -> f64 {
    let [low, high] = triangle.bounds();
    low[axis] + high[axis]
}
