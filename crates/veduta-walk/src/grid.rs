//! Nodes on a grid, some of them left out, and how strongly neighbours hold together.

use crate::error::{want, WalkError};

/// No node at this place of the grid.
pub const NONE: i32 = -1;

/// A graph whose nodes are in the order in which they are visited: rows from the top.
pub struct Grid {
    /// For each node: its later neighbours (right, below) and the weight between.
    later: Vec<Vec<(usize, f32)>>,
    earlier: Vec<Vec<(usize, usize)>>,
}

impl Grid {
    /// node: (rows, columns) the numbers 0, 1, 2, ... of the nodes row by row, `NONE` elsewhere.
    /// right, down: the weight towards the neighbour on the right and below.
    pub fn new(
        shape: (usize, usize),
        node: &[i32],
        right: &[f32],
        down: &[f32],
    ) -> Result<Self, WalkError> {
        let (rows, columns) = shape;
        want("the nodes", node.len(), rows * columns)?;
        want("the weights to the right", right.len(), rows * columns)?;
        want("the weights downwards", down.len(), rows * columns)?;
        let mut later: Vec<Vec<(usize, f32)>> = Vec::new();
        for (at, &number) in node.iter().enumerate() {
            if number == NONE {
                continue;
            }
            if number as i64 != later.len() as i64 {
                return Err(WalkError::Index {
                    what: "the number of a node",
                    value: number.into(),
                    count: later.len(),
                });
            }
            let mut own = Vec::with_capacity(2);
            if at % columns + 1 < columns && node[at + 1] != NONE && right[at] > 0.0 {
                own.push((node[at + 1], right[at]));
            }
            if at / columns + 1 < rows && node[at + columns] != NONE && down[at] > 0.0 {
                own.push((node[at + columns], down[at]));
            }
            later.push(
                own.into_iter()
                    .map(|(to, weight)| (to as usize, weight))
                    .collect(),
            );
        }
        let mut earlier = vec![Vec::new(); later.len()];
        for (from, own) in later.iter().enumerate() {
            for (slot, &(to, _)) in own.iter().enumerate() {
                if to >= later.len() {
                    return Err(WalkError::Index {
                        what: "the number of a node",
                        value: to as i64,
                        count: later.len(),
                    });
                }
                earlier[to].push((from, slot));
            }
        }
        Ok(Self { later, earlier })
    }

    pub fn len(&self) -> usize {
        self.later.len()
    }

    pub fn is_empty(&self) -> bool {
        self.later.is_empty()
    }

    /// The later neighbours of a node, and the weights between.
    pub fn later(&self, node: usize) -> &[(usize, f32)] {
        &self.later[node]
    }

    /// The earlier neighbours of a node, each with the place of this node among its later ones.
    pub fn earlier(&self, node: usize) -> &[(usize, usize)] {
        &self.earlier[node]
    }

    /// The weight between an earlier neighbour and the node in that place of its later ones.
    pub fn weight(&self, from: usize, slot: usize) -> f32 {
        self.later[from][slot].1
    }
}
