//! The homography of four or more matches: the plane that both photos show, or a camera that turned.

use nalgebra::{Matrix3, SMatrix, SymmetricEigen};

use crate::error::MatchError;
use crate::fundamental::scaled;
use crate::matches::{normalisations, normalised, Match};

/// The fewest matches that determine one.
pub const FOUR: usize = 4;
/// See `fundamental`: no eigenvalue at all.
const NONE: f64 = 1e-13;

/// The normalised linear method (Hartley and Zisserman 2003, algorithm 4.2), each match with its
/// weight.
pub fn four_points(matches: &[Match], weights: Option<&[f64]>) -> Result<Matrix3<f64>, MatchError> {
    if matches.len() < FOUR {
        let (got, needed) = (matches.len(), FOUR);
        return Err(MatchError::TooFew { got, needed });
    }
    solve(matches, weights).ok_or(MatchError::Degenerate)
}

fn solve(matches: &[Match], weights: Option<&[f64]>) -> Option<Matrix3<f64>> {
    let (t1, t2) = normalisations(matches)?;
    let mut sum = SMatrix::<f64, 9, 9>::zeros();
    for (at, one) in matches.iter().enumerate() {
        let even = normalised(one, &t1, &t2);
        let [x, y] = even.first;
        let [u, v] = even.second;
        let weight = weights.map_or(1.0, |all| all[at]);
        for row in [
            [x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y, -u],
            [0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y, -v],
        ] {
            for i in 0..9 {
                for j in 0..9 {
                    sum[(i, j)] += weight * row[i] * row[j];
                }
            }
        }
    }
    let found = SymmetricEigen::try_new(sum, f64::EPSILON, 500)?;
    let least = found.eigenvalues.imin();
    let mut values: Vec<f64> = found.eigenvalues.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    if values[1] <= NONE * values[8] {
        return None;
    }
    let h = Matrix3::from_row_slice(found.eigenvectors.column(least).as_slice());
    let h = scaled(t2.try_inverse()? * h * t1)?;
    // A plane seen edge on: its points come to a line.
    h.try_inverse().map(|_| h)
}
