//! Sequential tree-reweighted message passing, and a last descent cell by cell.

use crate::grid::Grid;

/// Above, left, right, below: the side that a message comes from; its opposite is `3 - side`.
const SIDES: usize = 4;

/// A label for each cell, with `rounds` of messages to and fro; the same input, the same labels.
pub fn label(grid: &Grid<'_>, rounds: usize) -> Vec<u32> {
    if grid.labels <= 1 {
        return vec![0; grid.cells()];
    }
    let mut messages = Messages::new(grid);
    let mut best = descended(grid, cheapest(grid));
    let mut least = grid.energy(&best);
    for _ in 0..rounds {
        messages.pass(true);
        messages.pass(false);
        let found = descended(grid, messages.rounded());
        let energy = grid.energy(&found);
        if energy < least {
            (best, least) = (found, energy);
        }
    }
    best
}

/// What each cell would choose alone.
fn cheapest(grid: &Grid<'_>) -> Vec<u32> {
    (0..grid.cells())
        .map(|cell| least(grid.costs_at(cell)))
        .collect()
}

fn least(costs: &[f32]) -> u32 {
    let mut best = 0;
    for (label, cost) in costs.iter().enumerate() {
        if *cost < costs[best] {
            best = label;
        }
    }
    best as u32
}

/// The labelling after each cell has taken what suits its neighbours, until none changes.
fn descended(grid: &Grid<'_>, mut labelling: Vec<u32>) -> Vec<u32> {
    let mut costs = vec![0.0; grid.labels];
    for _ in 0..50 {
        let mut changed = false;
        for cell in 0..grid.cells() {
            costs.copy_from_slice(grid.costs_at(cell));
            for next in grid.neighbours(cell).into_iter().flatten() {
                for (label, cost) in costs.iter_mut().enumerate() {
                    *cost += grid.seam((cell, next), (label, labelling[next] as usize));
                }
            }
            let found = least(&costs);
            if costs[found as usize] < costs[labelling[cell] as usize] {
                labelling[cell] = found;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    labelling
}

/// What the neighbours of each cell say to it: a number per side and label.
struct Messages<'a> {
    grid: &'a Grid<'a>,
    said: Vec<f32>,
}

impl<'a> Messages<'a> {
    fn new(grid: &'a Grid<'a>) -> Self {
        Self {
            grid,
            said: vec![0.0; grid.cells() * SIDES * grid.labels],
        }
    }

    fn place(&self, cell: usize, side: usize) -> usize {
        (cell * SIDES + side) * self.grid.labels
    }

    /// Each cell in turn tells those behind it (or before it) what their labels would cost.
    fn pass(&mut self, forward: bool) {
        let cells = self.grid.cells();
        let labels = self.grid.labels;
        let (mut sum, mut told) = (vec![0.0f32; labels], vec![0.0f32; labels]);
        for step in 0..cells {
            let cell = if forward { step } else { cells - 1 - step };
            let neighbours = self.grid.neighbours(cell);
            let before = neighbours[..2].iter().flatten().count();
            let behind = neighbours[2..].iter().flatten().count();
            // The number of monotonic chains through the cell (Kolmogorov 2006, section 5).
            let share = 1.0 / before.max(behind).max(1) as f32;
            sum.copy_from_slice(self.grid.costs_at(cell));
            for (side, _) in with_neighbour(&neighbours) {
                let from = self.place(cell, side);
                for label in 0..labels {
                    sum[label] += self.said[from + label];
                }
            }
            let ahead = if forward { 2..4 } else { 0..2 };
            for (side, next) in with_neighbour(&neighbours).filter(|(side, _)| ahead.contains(side))
            {
                let from = self.place(cell, side);
                for label in 0..labels {
                    told[label] = share * sum[label] - self.said[from + label];
                }
                self.tell((cell, next), 3 - side, &told);
            }
        }
    }

    fn tell(&mut self, cells: (usize, usize), side: usize, told: &[f32]) {
        let to = self.place(cells.1, side);
        let mut least = f32::INFINITY;
        for theirs in 0..self.grid.labels {
            let mut best = f32::INFINITY;
            for (own, cost) in told.iter().enumerate() {
                best = best.min(cost + self.grid.seam(cells, (own, theirs)));
            }
            self.said[to + theirs] = best;
            least = least.min(best);
        }
        for message in &mut self.said[to..to + self.grid.labels] {
            *message -= least;
        }
    }

    /// Labels cell by cell: given those before it, by what those behind it say.
    fn rounded(&self) -> Vec<u32> {
        let mut labelling = vec![0u32; self.grid.cells()];
        let mut costs = vec![0.0; self.grid.labels];
        for cell in 0..self.grid.cells() {
            costs.copy_from_slice(self.grid.costs_at(cell));
            for (side, next) in with_neighbour(&self.grid.neighbours(cell)) {
                let from = self.place(cell, side);
                for (label, cost) in costs.iter_mut().enumerate() {
                    *cost += if side < 2 {
                        self.grid
                            .seam((next, cell), (labelling[next] as usize, label))
                    } else {
                        self.said[from + label]
                    };
                }
            }
            labelling[cell] = least(&costs);
        }
        labelling
    }
}

fn with_neighbour(
    neighbours: &[Option<usize>; SIDES],
) -> impl Iterator<Item = (usize, usize)> + '_ {
    (neighbours.iter().enumerate()).filter_map(|(side, next)| next.map(|cell| (side, cell)))
}
