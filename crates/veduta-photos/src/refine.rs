//! The last step of the fundamental matrix: an M-estimator with Huber's weights (algorithm 2).
//!
//! Where the thesis minimises the algebraic error of normalised points (2.23), we minimise the
//! distances from the epipolar lines (2.17): weighted anew in each round, the linear method does
//! both at once. Two slips of its text: (2.24) leaves sigma out of the weight, and step vii is
//! T'^T F T.

use nalgebra::Matrix3;

use crate::distance::{epipolar, epipolar_weight};
use crate::fundamental::{eight_points, scaled};
use crate::matches::Match;

/// Errors up to this many standard deviations count by their square, larger ones by their size
/// (Huber 1981: 95 % as efficient as least squares where all errors are normal).
const TUNING: f64 = 1.345;
/// Rounds at most.
const ROUNDS: usize = 30;
/// A change of F, of unit length, that is none.
const STILL: f64 = 1e-9;

/// Huber's weight of an error, by its standard deviation.
pub fn weight(error: f64, sigma: f64) -> f64 {
    let limit = TUNING * sigma;
    if error <= limit {
        1.0
    } else {
        limit / error
    }
}

/// Huber's cost of an error.
fn cost(error: f64, sigma: f64) -> f64 {
    let limit = TUNING * sigma;
    if error <= limit {
        error * error / 2.0
    } else {
        limit * (error - limit / 2.0)
    }
}

/// F of the least cost among the rounds, `start` among them. Rounds of weights that follow the last
/// F need not go down: no worse F than the first is given back.
pub fn huber(matches: &[Match], start: &Matrix3<f64>, sigma_px: f64) -> Matrix3<f64> {
    let total = |f: &Matrix3<f64>| -> f64 {
        let each = matches.iter().map(|one| epipolar(f, one).sqrt());
        each.map(|error| cost(error, sigma_px)).sum()
    };
    let Some(mut f) = scaled(*start) else {
        return *start;
    };
    let mut best = (total(&f), f);
    for _ in 0..ROUNDS {
        let weights: Vec<f64> = matches
            .iter()
            .map(|one| {
                let bounded = weight(epipolar(&f, one).sqrt(), sigma_px);
                bounded * epipolar_weight(&f, one)
            })
            .collect();
        if !weights.iter().all(|one| one.is_finite()) {
            break;
        }
        let Ok(next) = eight_points(matches, Some(&weights)) else {
            break;
        };
        let found = total(&next);
        if found < best.0 {
            best = (found, next);
        }
        let change = (next - f).norm();
        f = next;
        if change < STILL {
            break;
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_is_the_slope_of_the_cost_by_the_error() {
        for error in [0.01, 0.5, 1.0, 3.0, 20.0] {
            let step = 1e-6;
            let slope = (cost(error + step, 0.7) - cost(error - step, 0.7)) / (2.0 * step);
            assert!((slope - weight(error, 0.7) * error).abs() < 1e-6);
        }
    }
}
