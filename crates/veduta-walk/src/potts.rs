//! The Potts energy of labels on a grid, and two ways to lower it.
//!
//! E(f) = sum of costs(p, f_p) + sum over neighbours of weight(p, q) where f_p and f_q differ.

use crate::error::{want, WalkError};
use crate::grid::Grid;

/// A labelling and what it came to. bound: no labelling has less energy than this.
#[derive(Debug, Clone)]
pub struct Labelled {
    pub labels: Vec<u32>,
    pub energy: f64,
    pub bound: f64,
}

fn check(grid: &Grid, costs: &[f32], labels: usize) -> Result<(), WalkError> {
    if labels == 0 {
        return Err(WalkError::Nothing);
    }
    want("the costs", costs.len(), grid.len() * labels)
}

/// The energy of a labelling.
pub fn energy(grid: &Grid, costs: &[f32], labels: usize, chosen: &[u32]) -> Result<f64, WalkError> {
    check(grid, costs, labels)?;
    want("the labelling", chosen.len(), grid.len())?;
    let mut sum = 0.0_f64;
    for node in 0..grid.len() {
        let own = chosen[node] as usize;
        if own >= labels {
            return Err(WalkError::Index {
                what: "a label",
                value: own as i64,
                count: labels,
            });
        }
        sum += f64::from(costs[node * labels + own]);
        for &(to, weight) in grid.later(node) {
            if chosen[to] != chosen[node] {
                sum += f64::from(weight);
            }
        }
    }
    Ok(sum)
}

/// Iterated conditional modes from the cheapest label of each node on.
pub fn icm(
    grid: &Grid,
    costs: &[f32],
    labels: usize,
    rounds: usize,
) -> Result<Labelled, WalkError> {
    check(grid, costs, labels)?;
    let mut chosen: Vec<u32> = costs.chunks(labels).map(cheapest).collect();
    let mut sums = vec![0.0_f32; labels];
    for _ in 0..rounds {
        let mut changed = false;
        for node in 0..grid.len() {
            sums.copy_from_slice(&costs[node * labels..(node + 1) * labels]);
            for &(to, weight) in grid.later(node) {
                sums[chosen[to] as usize] -= weight;
            }
            for &(from, slot) in grid.earlier(node) {
                sums[chosen[from] as usize] -= grid.weight(from, slot);
            }
            let best = cheapest(&sums);
            changed |= sums[best as usize] < sums[chosen[node] as usize];
            if sums[best as usize] < sums[chosen[node] as usize] {
                chosen[node] = best;
            }
        }
        if !changed {
            break;
        }
    }
    let energy = energy(grid, costs, labels, &chosen)?;
    let bound = costs
        .chunks(labels)
        .map(|row| f64::from(row[cheapest(row) as usize]))
        .sum();
    Ok(Labelled {
        labels: chosen,
        energy,
        bound,
    })
}

fn cheapest(row: &[f32]) -> u32 {
    let mut best = 0;
    for (label, cost) in row.iter().enumerate() {
        if *cost < row[best] {
            best = label;
        }
    }
    best as u32
}

/// Messages on each edge: one, which points against the last sweep.
struct Messages {
    labels: usize,
    start: Vec<usize>,
    values: Vec<f32>,
}

impl Messages {
    fn new(grid: &Grid, labels: usize) -> Self {
        let mut start = Vec::with_capacity(grid.len());
        let mut edges = 0;
        for node in 0..grid.len() {
            start.push(edges);
            edges += grid.later(node).len();
        }
        Self {
            labels,
            start,
            values: vec![0.0; edges * labels],
        }
    }

    fn of(&mut self, from: usize, slot: usize) -> &mut [f32] {
        let first = (self.start[from] + slot) * self.labels;
        &mut self.values[first..first + self.labels]
    }
}

/// Tree-reweighted message passing for the given rounds; the best labelling of all of them.
pub fn trws(
    grid: &Grid,
    costs: &[f32],
    labels: usize,
    rounds: usize,
) -> Result<Labelled, WalkError> {
    check(grid, costs, labels)?;
    let mut messages = Messages::new(grid, labels);
    let mut best = icm(grid, costs, labels, 0)?;
    let mut sums = vec![0.0_f32; labels];
    for _ in 0..rounds {
        let mut chosen = vec![0_u32; grid.len()];
        for node in 0..grid.len() {
            gather(grid, costs, &mut messages, node, &mut sums);
            chosen[node] = conditioned(grid, costs, &mut messages, node, &chosen);
            let share = share_of(grid, node);
            for (slot, &(_, weight)) in grid.later(node).iter().enumerate() {
                pass(messages.of(node, slot), &sums, share, weight);
            }
        }
        let found = energy(grid, costs, labels, &chosen)?;
        if found < best.energy {
            best.energy = found;
            best.labels = chosen;
        }
        let bound = backward(grid, costs, &mut messages, &mut sums);
        best.bound = best.bound.max(bound);
    }
    Ok(best)
}

/// The sweep from the last node to the first; the bound that it comes to.
fn backward(grid: &Grid, costs: &[f32], messages: &mut Messages, sums: &mut [f32]) -> f64 {
    let mut bound = 0.0_f64;
    for node in (0..grid.len()).rev() {
        gather(grid, costs, messages, node, sums);
        let least = sums[cheapest(sums) as usize];
        bound += f64::from(least);
        for value in sums.iter_mut() {
            *value -= least;
        }
        let share = share_of(grid, node);
        for &(from, slot) in grid.earlier(node) {
            let weight = grid.weight(from, slot);
            bound += f64::from(pass(messages.of(from, slot), sums, share, weight));
        }
    }
    bound
}

/// The costs of a node and all messages to it. Between sweeps, every message points to the node.
fn gather(grid: &Grid, costs: &[f32], messages: &mut Messages, node: usize, sums: &mut [f32]) {
    let labels = sums.len();
    sums.copy_from_slice(&costs[node * labels..(node + 1) * labels]);
    for slot in 0..grid.later(node).len() {
        add(sums, messages.of(node, slot));
    }
    for &(from, slot) in grid.earlier(node) {
        add(sums, messages.of(from, slot));
    }
}

fn add(sums: &mut [f32], values: &[f32]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

fn share_of(grid: &Grid, node: usize) -> f32 {
    1.0 / grid.later(node).len().max(grid.earlier(node).len()).max(1) as f32
}

/// Turns the message of an edge round; what was taken from all of its values.
fn pass(message: &mut [f32], sums: &[f32], share: f32, weight: f32) -> f32 {
    let mut least = f32::INFINITY;
    for (value, sum) in message.iter_mut().zip(sums) {
        *value = share * sum - *value;
        least = least.min(*value);
    }
    for value in message.iter_mut() {
        *value = (*value - least).min(weight);
    }
    least
}

/// The best label of a node, given those of the nodes before it.
fn conditioned(
    grid: &Grid,
    costs: &[f32],
    messages: &mut Messages,
    node: usize,
    chosen: &[u32],
) -> u32 {
    let labels = messages.labels;
    let mut sums = costs[node * labels..(node + 1) * labels].to_vec();
    for slot in 0..grid.later(node).len() {
        add(&mut sums, messages.of(node, slot));
    }
    for &(from, slot) in grid.earlier(node) {
        sums[chosen[from] as usize] -= grid.weight(from, slot);
    }
    cheapest(&sums)
}
