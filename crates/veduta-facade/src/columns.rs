//! The horizontal split: a chain of window stripes whose labels are (position, width), with gaps.
//!
//! Koutsourakis et al. 2009, section 3.3 and equation 8: the structure of the floors' chain, with
//! the equality of the first case of equation 5 relaxed to an inequality, and gaps (walls) that are
//! homogeneous and symmetric.

use crate::error::{expect_len, ChainError};
use crate::sums::{DiagonalSums, MirrorSums};

/// One chain to solve. All costs are in pixel columns.
pub struct ColumnChain<'a> {
    /// How much each pixel column looks like a window rather than like wall (negative: wall).
    pub evidence: &'a [f64],
    /// How much a jamb is to be seen at each column boundary, one more value than columns.
    pub jamb: &'a [f64],
    /// Allowed stripe widths (pixels), ascending.
    pub widths: &'a [usize],
    /// Positions are multiples of this step (pixels).
    pub step: usize,
    /// The narrowest gap between two stripes (pixels).
    pub gap_min: usize,
    /// The widest gap between two stripes (pixels).
    pub gap_max: usize,
    /// Weight of the jambs.
    pub jamb_weight: f64,
    /// Weight of the similarity of neighbouring stripes (alpha of equation 5).
    pub similarity: f64,
    /// Weight of the difference of their widths (beta of equation 5).
    pub width_change: f64,
    /// Weight of the mirror symmetry of a gap (equation 8).
    pub gap_symmetry: f64,
    /// The dissimilarity at which two stretches are as unlike as any two of the facade.
    pub neutral: f64,
}

/// The best chain: its energy and the stripes from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnSolution {
    /// Its energy (pixel columns).
    pub energy: f64,
    /// `(position, width)` of each stripe (pixels).
    pub stripes: Vec<(usize, usize)>,
}

struct Terms<'a> {
    chain: &'a ColumnChain<'a>,
    running: Vec<f64>,
    alike: DiagonalSums,
    mirror: MirrorSums,
}

impl Terms<'_> {
    /// Evidence of `from..to`; the cost of calling it wall.
    fn wall(&self, from: usize, to: usize) -> f64 {
        self.running[to] - self.running[from]
    }

    fn stripe(&self, at: usize, width: usize) -> f64 {
        let c = self.chain;
        let end = at + width;
        -self.wall(at, end) - c.jamb_weight * (c.jamb[at] + c.jamb[end])
    }

    /// Everything that joins stripe `a` to stripe `b` on its right, the gap included.
    fn pair(&self, a: (usize, usize), b: (usize, usize)) -> f64 {
        let c = self.chain;
        let gap = a.0 + a.1;
        let narrower = a.1.min(b.1);
        self.wall(gap, b.0)
            + c.width_change * a.1.abs_diff(b.1) as f64
            + c.similarity * (self.alike.mean(a.0, b.0 - a.0, narrower) - c.neutral) * b.1 as f64
            + c.gap_symmetry * (self.mirror.mean(gap, b.0) - c.neutral) * (b.0 - gap) as f64
    }
}

impl ColumnChain<'_> {
    /// Solves the chain exactly. `distance` is the `columns` by `columns` matrix of the mean squared
    /// differences of pixel columns. No stripe at all is a valid solution.
    pub fn solve(&self, distance: &[f32]) -> Result<ColumnSolution, ChainError> {
        let columns = self.evidence.len();
        expect_len("jamb", self.jamb.len(), columns + 1)?;
        if self.widths.is_empty() || self.widths.contains(&0) {
            return Err(ChainError::Labels { name: "widths" });
        }
        if self.step == 0 {
            return Err(ChainError::Labels { name: "step" });
        }
        let widest = self.widths.iter().copied().max().unwrap_or(1);
        let mut running = vec![0.0; columns + 1];
        for x in 0..columns {
            running[x + 1] = running[x] + self.evidence[x];
        }
        let terms = Terms {
            chain: self,
            running,
            alike: DiagonalSums::new(distance, columns, (widest + self.gap_max).min(columns))?,
            mirror: MirrorSums::new(distance, columns)?,
        };
        Ok(self.forward(&terms, columns))
    }

    fn forward(&self, terms: &Terms, columns: usize) -> ColumnSolution {
        let n = self.widths.len();
        let places = columns / self.step + 1;
        let mut cost = vec![f64::INFINITY; places * n];
        let mut from: Vec<Option<u32>> = vec![None; places * n];
        let mut best = (terms.wall(0, columns), None);
        for place in 0..places {
            let at = place * self.step;
            for (i, width) in self.widths.iter().enumerate() {
                if at + width > columns {
                    continue;
                }
                let (before, label) = self.best_before(terms, &cost, at, *width);
                let here = place * n + i;
                cost[here] = before + terms.stripe(at, *width);
                from[here] = label;
                let total = cost[here] + terms.wall(at + width, columns);
                if total < best.0 {
                    best = (total, Some(here as u32));
                }
            }
        }
        let mut stripes = Vec::new();
        let mut label = best.1;
        while let Some(here) = label {
            let here = here as usize;
            stripes.push((here / n * self.step, self.widths[here % n]));
            label = from[here];
        }
        stripes.reverse();
        ColumnSolution {
            energy: best.0,
            stripes,
        }
    }

    /// The cheapest way to arrive at a stripe: nothing but wall, or one of the stripes before it.
    fn best_before(
        &self,
        terms: &Terms,
        cost: &[f64],
        at: usize,
        width: usize,
    ) -> (f64, Option<u32>) {
        let n = self.widths.len();
        let mut best = (terms.wall(0, at), None);
        for (j, other) in self.widths.iter().enumerate() {
            let Some(last) = at.checked_sub(self.gap_min + other) else {
                continue;
            };
            let first = at.saturating_sub(self.gap_max + other).div_ceil(self.step);
            for place in first..=last / self.step {
                let so_far = cost[place * n + j];
                if so_far.is_finite() {
                    let total = so_far + terms.pair((place * self.step, *other), (at, width));
                    if total < best.0 {
                        best = (total, Some((place * n + j) as u32));
                    }
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn search(terms: &Terms, columns: usize, so_far: f64, last: (usize, usize), best: &mut f64) {
        let c = terms.chain;
        let end = last.0 + last.1;
        *best = best.min(so_far + terms.wall(end, columns));
        for gap in c.gap_min..=c.gap_max {
            for width in c.widths {
                let next = (end + gap, *width);
                if next.0 % c.step == 0 && next.0 + next.1 <= columns {
                    let cost = so_far + terms.pair(last, next) + terms.stripe(next.0, next.1);
                    search(terms, columns, cost, next, best);
                }
            }
        }
    }

    proptest! {
        #[test]
        fn equals_exhaustive_search(
            evidence in proptest::collection::vec(-1.0f64..1.0, 16),
            jamb in proptest::collection::vec(-1.0f64..1.0, 17),
            half in proptest::collection::vec(0.0f32..2.0, 16 * 16),
            step in 1usize..3,
        ) {
            let columns = 16;
            let distance: Vec<f32> = (0..columns * columns)
                .map(|v| half[v] + half[v % columns * columns + v / columns])
                .collect();
            let chain = ColumnChain {
                evidence: &evidence, jamb: &jamb, widths: &[2, 3, 4], step, gap_min: 1, gap_max: 6,
                jamb_weight: 0.3, similarity: 0.4, width_change: 0.1, gap_symmetry: 0.2,
                neutral: 1.0,
            };
            let solved = chain.solve(&distance).unwrap();
            let mut running = vec![0.0; columns + 1];
            for x in 0..columns {
                running[x + 1] = running[x] + evidence[x];
            }
            let terms = Terms {
                chain: &chain, running,
                alike: DiagonalSums::new(&distance, columns, 10).unwrap(),
                mirror: MirrorSums::new(&distance, columns).unwrap(),
            };
            let mut best = terms.wall(0, columns);
            for at in (0..columns).step_by(step) {
                for width in chain.widths {
                    if at + width <= columns {
                        let cost = terms.wall(0, at) + terms.stripe(at, *width);
                        search(&terms, columns, cost, (at, *width), &mut best);
                    }
                }
            }
            prop_assert!((solved.energy - best).abs() < 1e-9);
        }
    }

    #[test]
    fn finds_no_stripe_in_plain_wall() {
        let chain = ColumnChain {
            evidence: &[-1.0; 12],
            jamb: &[0.0; 13],
            widths: &[2, 3],
            step: 1,
            gap_min: 1,
            gap_max: 4,
            jamb_weight: 1.0,
            similarity: 0.0,
            width_change: 0.0,
            gap_symmetry: 0.0,
            neutral: 1.0,
        };
        let solved = chain.solve(&[0.0; 144]).unwrap();
        assert!(solved.stripes.is_empty());
        assert_eq!(solved.energy, -12.0);
    }
}
