//! How high a roof is over the distance to its eaves.

/// The steepest that a roof goes on beyond its walls (tangent): dome and mansard do not hang down.
const STEEPEST_BEYOND: f64 = 1.0;

/// Height over the distance from the walls, straight between knots, rising from (0, 0). Beyond the
/// last knot it goes on as before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    knots: Vec<[f64; 2]>,
}

impl Profile {
    /// Two slopes (tangents) that meet at a height.
    pub fn knee(lower: f64, upper: f64, height: f64) -> Self {
        let knee = [height / lower, height];
        Self {
            knots: vec![[0.0; 2], knee, [knee[0] + 1.0, knee[1] + upper]],
        }
    }

    /// A quarter of an ellipse, `width` from its foot to its top.
    pub fn round(width: f64, height: f64, steps: usize) -> Self {
        Self::curve(steps, |share| {
            let angle = std::f64::consts::FRAC_PI_2 * share;
            [width * (1.0 - angle.cos()), height * angle.sin()]
        })
    }

    /// A bulb with a tip: half of the width up to its belly, and a hollow flank from there.
    pub fn bulb(width: f64, height: f64, steps: usize) -> Self {
        let turn = [0.45 * width, 0.5 * height];
        let half = steps.div_ceil(2).max(2);
        let mut belly = Self::round(turn[0], turn[1], half);
        for step in 1..=half {
            let share = step as f64 / half as f64;
            let angle = std::f64::consts::FRAC_PI_2 * share;
            let x = turn[0] + (width - turn[0]) * angle.sin();
            let y = turn[1] + (height - turn[1]) * (1.0 - angle.cos());
            belly.knots.push([x, y]);
        }
        belly
    }

    fn curve(steps: usize, place: impl Fn(f64) -> [f64; 2]) -> Self {
        let steps = steps.max(2);
        let knot = |step: usize| place(step as f64 / steps as f64);
        let mut knots: Vec<[f64; 2]> = (0..=steps).map(knot).collect();
        knots[0] = [0.0; 2];
        Self { knots }
    }

    /// The same over the distance from eaves that reach `reach` beyond the walls: there it goes on
    /// with its lowest slope, but no steeper than 45 degrees.
    pub fn reaching(mut self, reach: f64) -> Self {
        if reach > 0.0 {
            let [x, y] = self.knots[1];
            let slope = (y / x).min(STEEPEST_BEYOND);
            self.knots.insert(0, [-reach, -reach * slope]);
        }
        for knot in &mut self.knots {
            knot[0] += reach;
        }
        self
    }

    /// The distances at which the slope changes.
    pub fn levels(&self) -> impl Iterator<Item = f64> + '_ {
        let inner = 1..self.knots.len() - 1;
        inner.map(|knot| self.knots[knot][0])
    }

    pub fn height(&self, distance: f64) -> f64 {
        let last = self.knots.len() - 1;
        let after = self.knots.partition_point(|knot| knot[0] < distance);
        let end = after.clamp(1, last);
        let ([x0, y0], [x1, y1]) = (self.knots[end - 1], self.knots[end]);
        y0 + (distance - x0) / (x1 - x0) * (y1 - y0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_go_through_their_knots_and_on() {
        let knee = Profile::knee(2.0, 0.5, 4.0);
        assert_eq!([1.0, 2.0, 4.0].map(|d| knee.height(d)), [2.0, 4.0, 5.0]);
        let out = knee.reaching(0.5);
        assert_eq!([0.0, 0.5, 2.5].map(|d| out.height(d)), [-0.5, 0.0, 4.0]);
        assert_eq!(out.levels().collect::<Vec<_>>(), [0.5, 2.5]);
        let round = Profile::round(5.0, 3.0, 8);
        assert!((round.height(5.0) - 3.0).abs() < 1e-12);
        let quarter = Profile::round(1.0, 1.0, 200);
        assert!((quarter.height(0.5) - 0.75f64.sqrt()).abs() < 1e-4);
        let bulb = Profile::bulb(2.0, 6.0, 8);
        assert!((bulb.height(2.0) - 6.0).abs() < 1e-12);
        assert!((bulb.height(0.9) - 3.0).abs() < 1e-12);
    }
}
