//! The vertical split: a chain of floors whose labels are (position, height).
//!
//! Koutsourakis et al. 2009, section 3.2, equations 5 to 7. Rows count down the image, so the first
//! node is the floor under the eaves and the last one stands on the ground floor. A node of height
//! zero ("does not exist") can only stand at the end of the chain, so a chain that ends after `m`
//! nodes is the same labelling; the table over `m` gives the exact optimum for every count at once.

use crate::error::{expect_len, ChainError};
use crate::sums::DiagonalSums;

/// One chain to solve. All costs are in rows, so that the caller divides by the image height.
pub struct FloorChain<'a> {
    /// Allowed floor heights (rows), ascending.
    pub heights: &'a [usize],
    /// Cost of the eaves at each row boundary, `rows + 1` values; infinite where not allowed.
    pub eaves: &'a [f64],
    /// Cost per row of floor of a boundary between two floors, `rows + 1` values (equation 7,
    /// centred).
    pub boundary: &'a [f64],
    /// Cost of the ground floor's top, `rows + 1` values; infinite where not allowed.
    pub ground: &'a [f64],
    /// Weight of the similarity of consecutive floors (alpha of equation 5).
    pub similarity: f64,
    /// Weight of the difference of their heights (beta of equation 5).
    pub height_change: f64,
    /// The dissimilarity at which two floors are as unlike as any two stretches of the facade.
    /// Equation 6 is taken relative to it, which makes the energy fair across storey counts.
    pub neutral: f64,
    /// The largest count of floors above the ground floor.
    pub max_floors: usize,
}

/// The best chain of one count.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorSolution {
    /// Its energy (rows).
    pub energy: f64,
    /// Row boundaries from the eaves to the ground floor's top: one more than floors.
    pub boundaries: Vec<usize>,
}

struct Table {
    cost: Vec<f64>,
    from: Vec<u16>,
}

const NONE: u16 = u16::MAX;

impl FloorChain<'_> {
    /// The exact optimum for each count of floors, index 0 for one floor; `None` where no chain fits.
    pub fn solve(
        &self,
        sums: &DiagonalSums,
        rows: usize,
    ) -> Result<Vec<Option<FloorSolution>>, ChainError> {
        for (name, values) in [
            ("eaves", self.eaves),
            ("boundary", self.boundary),
            ("ground", self.ground),
        ] {
            expect_len(name, values.len(), rows + 1)?;
        }
        if self.heights.is_empty() || self.heights.contains(&0) || self.heights.len() >= NONE.into()
        {
            return Err(ChainError::Labels { name: "heights" });
        }
        let mut tables = vec![self.first(rows)];
        let mut solutions = vec![self.best(&tables, rows)];
        for _ in 1..self.max_floors {
            let next = self.extend(&tables[tables.len() - 1], sums, rows);
            tables.push(next);
            solutions.push(self.best(&tables, rows));
        }
        Ok(solutions)
    }

    /// The pairwise term of equation 5 for a floor `(top, above)` over one of height `below`, with
    /// the boundary between them, which counts for the height of a floor.
    fn pair(&self, sums: &DiagonalSums, top: usize, above: usize, below: usize) -> f64 {
        let unlike = sums.mean(top, above, above.min(below)) - self.neutral;
        self.similarity * unlike * below as f64
            + self.height_change * above.abs_diff(below) as f64
            + self.boundary[top + above] * (above + below) as f64 / 2.0
    }

    fn first(&self, rows: usize) -> Table {
        let n = self.heights.len();
        let mut cost = vec![f64::INFINITY; (rows + 1) * n];
        for (top, line) in cost.chunks_mut(n).enumerate() {
            for (c, h) in line.iter_mut().zip(self.heights) {
                if top + h <= rows {
                    *c = self.eaves[top];
                }
            }
        }
        Table {
            from: vec![NONE; cost.len()],
            cost,
        }
    }

    fn extend(&self, above: &Table, sums: &DiagonalSums, rows: usize) -> Table {
        let n = self.heights.len();
        let mut cost = vec![f64::INFINITY; (rows + 1) * n];
        let mut from = vec![NONE; cost.len()];
        for top in 0..=rows {
            for (i, h) in self.heights.iter().enumerate() {
                let so_far = above.cost[top * n + i];
                let below = top + h;
                if !so_far.is_finite() || below > rows {
                    continue;
                }
                for (j, g) in self.heights.iter().enumerate() {
                    if below + g > rows {
                        break;
                    }
                    let total = so_far + self.pair(sums, top, *h, *g);
                    let at = below * n + j;
                    if total < cost[at] {
                        cost[at] = total;
                        from[at] = i as u16;
                    }
                }
            }
        }
        Table { cost, from }
    }

    fn best(&self, tables: &[Table], rows: usize) -> Option<FloorSolution> {
        let n = self.heights.len();
        let last = tables.last()?;
        let mut best = (f64::INFINITY, 0, 0);
        for top in 0..=rows {
            for (i, h) in self.heights.iter().enumerate() {
                if top + h <= rows {
                    let total = last.cost[top * n + i] + self.ground[top + h];
                    if total < best.0 {
                        best = (total, top, i);
                    }
                }
            }
        }
        let (energy, mut top, mut label) = best;
        if !energy.is_finite() {
            return None;
        }
        let mut boundaries = vec![top + self.heights[label], top];
        for table in tables.iter().skip(1).rev() {
            label = usize::from(table.from[top * n + label]);
            top -= self.heights[label];
            boundaries.push(top);
        }
        boundaries.reverse();
        Some(FloorSolution { energy, boundaries })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn search(
        chain: &FloorChain,
        sums: &DiagonalSums,
        rows: usize,
        so_far: f64,
        boundaries: &mut Vec<usize>,
        count: usize,
        best: &mut f64,
    ) {
        let top = boundaries[boundaries.len() - 1];
        if boundaries.len() == count + 1 {
            *best = best.min(so_far + chain.ground[top]);
            return;
        }
        for h in chain.heights {
            if top + h > rows {
                continue;
            }
            let mut cost = so_far;
            if boundaries.len() >= 2 {
                let before = boundaries[boundaries.len() - 2];
                cost += chain.pair(sums, before, top - before, *h);
            }
            boundaries.push(top + h);
            search(chain, sums, rows, cost, boundaries, count, best);
            boundaries.pop();
        }
    }

    proptest! {
        #[test]
        fn equals_exhaustive_search(
            noise in proptest::collection::vec(0.0f32..2.0, 14 * 14),
            eaves in proptest::collection::vec(-1.0f64..1.0, 15),
            boundary in proptest::collection::vec(-1.0f64..1.0, 15),
            ground in proptest::collection::vec(-1.0f64..1.0, 15),
        ) {
            let rows = 14;
            let sums = DiagonalSums::new(&noise, rows, 5).unwrap();
            let chain = FloorChain {
                heights: &[2, 3, 5], eaves: &eaves, boundary: &boundary, ground: &ground,
                similarity: 0.7, height_change: 0.2, neutral: 1.0, max_floors: 4,
            };
            let solved = chain.solve(&sums, rows).unwrap();
            for (i, solution) in solved.iter().enumerate() {
                let mut best = f64::INFINITY;
                for top in 0..=rows {
                    search(&chain, &sums, rows, eaves[top], &mut vec![top], i + 1, &mut best);
                }
                let energy = solution.as_ref().map_or(f64::INFINITY, |s| s.energy);
                prop_assert!(energy == best || (energy - best).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn says_when_no_chain_fits() {
        let sums = DiagonalSums::new(&[0.0; 16], 4, 4).unwrap();
        let zeros = [0.0; 5];
        let chain = FloorChain {
            heights: &[3],
            eaves: &zeros,
            boundary: &zeros,
            ground: &zeros,
            similarity: 1.0,
            height_change: 1.0,
            neutral: 1.0,
            max_floors: 2,
        };
        let solved = chain.solve(&sums, 4).unwrap();
        assert!(solved[0].is_some());
        assert!(solved[1].is_none());
    }
}
