//! Draws that are spread over the photo (algorithm 5, after Zhang 1996).
//!
//! Matches that lie close together determine an epipolar geometry badly. The rectangle around the
//! points of the first photo is cut into buckets; a bucket is drawn as often as it has points, and
//! one of its points; the points of a draw are of different buckets.

use crate::chance::Chance;
use crate::matches::Match;

/// Rows and columns of buckets.
const SIDE: usize = 8;
/// Times that a point of another bucket is asked for, per point of a draw, before any is taken.
const PATIENCE: usize = 20;

/// The matches by their buckets.
pub struct Buckets {
    of: Vec<u8>,
    filled: usize,
}

impl Buckets {
    /// Cuts the rectangle around the points of the first photo.
    pub fn of(matches: &[Match]) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for one in matches {
            for axis in 0..2 {
                low[axis] = low[axis].min(one.first[axis]);
                high[axis] = high[axis].max(one.first[axis]);
            }
        }
        let cell = |value: f64, axis: usize| {
            let part = (value - low[axis]) / (high[axis] - low[axis]);
            // Not a number where all values are one: the first cell.
            ((part * SIDE as f64) as usize).min(SIDE - 1)
        };
        let of: Vec<u8> = matches
            .iter()
            .map(|one| (cell(one.first[1], 1) * SIDE + cell(one.first[0], 0)) as u8)
            .collect();
        let mut seen = [false; SIDE * SIDE];
        for &bucket in &of {
            seen[usize::from(bucket)] = true;
        }
        let filled = seen.iter().filter(|&&one| one).count();
        Self { of, filled }
    }

    /// Draws `drawn.len()` different matches, of different buckets where there are enough.
    ///
    /// A number drawn among all points falls into a bucket as often as the bucket has points, and
    /// is then one of its points, each alike: steps (v) and (vi) at once.
    pub fn draw(&self, chance: &mut Chance, drawn: &mut [usize]) {
        for place in 0..drawn.len() {
            let apart = self.filled >= drawn.len();
            let mut asked = 0;
            drawn[place] = loop {
                let point = chance.below(self.of.len());
                let before = &drawn[..place];
                let bucket_free = before.iter().all(|&one| self.of[one] != self.of[point]);
                asked += 1;
                let patient = apart && asked < PATIENCE;
                if bucket_free || !(patient || before.contains(&point)) {
                    break point;
                }
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Match {
        Match {
            first: [x, y],
            second: [0.0, 0.0],
        }
    }

    #[test]
    fn buckets_are_drawn_as_often_as_they_have_points() {
        // 30 points in one corner, 10 in each other one.
        let corners = [
            (0.0, 0.0, 30),
            (80.0, 0.0, 10),
            (0.0, 80.0, 10),
            (80.0, 80.0, 10),
        ];
        let matches: Vec<Match> = corners
            .iter()
            .flat_map(|&(x, y, count)| (0..count).map(move |n| at(x + 0.01 * f64::from(n), y)))
            .collect();
        let buckets = Buckets::of(&matches);
        let mut chance = Chance::new(1);
        let mut counts = [0_i32; 4];
        for _ in 0..6000 {
            let mut drawn = [0];
            buckets.draw(&mut chance, &mut drawn);
            counts[[30, 40, 50].iter().filter(|&&end| drawn[0] >= end).count()] += 1;
        }
        for (count, wanted) in counts.iter().zip([3000, 1000, 1000, 1000]) {
            assert!((count - wanted).abs() < 200, "{counts:?}");
        }
    }

    #[test]
    fn points_of_a_draw_are_of_different_buckets() {
        let matches: Vec<Match> = (0..64)
            .flat_map(|n| {
                (0..3).map(move |k| at(f64::from(n % 8) + 0.1 * f64::from(k), f64::from(n / 8)))
            })
            .collect();
        let buckets = Buckets::of(&matches);
        let mut chance = Chance::new(2);
        for _ in 0..500 {
            let mut drawn = [0; 8];
            buckets.draw(&mut chance, &mut drawn);
            let mut own: Vec<u8> = drawn.iter().map(|&one| buckets.of[one]).collect();
            own.sort_unstable();
            own.dedup();
            assert_eq!(own.len(), 8);
        }
    }

    #[test]
    fn matches_in_few_buckets_are_still_different() {
        let matches: Vec<Match> = (0..9).map(|n| at(5.0, 0.001 * f64::from(n))).collect();
        let same: Vec<Match> = (0..9).map(|_| at(5.0, 5.0)).collect();
        for matches in [matches, same] {
            let buckets = Buckets::of(&matches);
            let mut drawn = [0; 8];
            buckets.draw(&mut Chance::new(7), &mut drawn);
            drawn.sort_unstable();
            assert!(drawn.windows(2).all(|two| two[0] < two[1]));
        }
    }
}
