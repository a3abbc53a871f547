//! Matches, and the normalisation that every linear method starts with.

use nalgebra::{Matrix3, Vector3};

use crate::error::MatchError;

/// A point of the first photo and the point of the second that shows the same (px).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match {
    /// x and y in the first photo.
    pub first: [f64; 2],
    /// x and y in the second photo.
    pub second: [f64; 2],
}

impl Match {
    /// Homogeneous, in the first photo.
    pub fn m1(&self) -> Vector3<f64> {
        Vector3::new(self.first[0], self.first[1], 1.0)
    }

    /// Homogeneous, in the second photo.
    pub fn m2(&self) -> Vector3<f64> {
        Vector3::new(self.second[0], self.second[1], 1.0)
    }
}

/// The matches of two lists of points; an error where one of them is not finite.
pub fn paired(first: &[[f64; 2]], second: &[[f64; 2]]) -> Result<Vec<Match>, MatchError> {
    if first.len() != second.len() {
        let (first, second) = (first.len(), second.len());
        return Err(MatchError::Unequal { first, second });
    }
    let each = first.iter().zip(second).enumerate();
    each.map(|(at, (&first, &second))| {
        if first.iter().chain(&second).all(|value| value.is_finite()) {
            Ok(Match { first, second })
        } else {
            Err(MatchError::NotFinite { at })
        }
    })
    .collect()
}

/// T and T' of algorithm 1, for both photos: the mean comes to the origin, the mean distance from
/// it to the square root of two. None where all points of a photo are one.
pub fn normalisations(matches: &[Match]) -> Option<(Matrix3<f64>, Matrix3<f64>)> {
    Some((
        normalisation(matches, |m| m.first)?,
        normalisation(matches, |m| m.second)?,
    ))
}

fn normalisation(matches: &[Match], point: impl Fn(&Match) -> [f64; 2]) -> Option<Matrix3<f64>> {
    let count = matches.len() as f64;
    let (mut x, mut y) = (0.0, 0.0);
    for one in matches {
        let [px, py] = point(one);
        x += px;
        y += py;
    }
    (x, y) = (x / count, y / count);
    let mut away = 0.0;
    for one in matches {
        let [px, py] = point(one);
        away += (px - x).hypot(py - y);
    }
    let scale = std::f64::consts::SQRT_2 * count / away;
    // Points whose spread is lost in their coordinates' last digits are one.
    if !scale.is_finite() || scale * (1.0 + x.abs() + y.abs()) > 1e12 {
        return None;
    }
    Some(Matrix3::new(
        scale,
        0.0,
        -scale * x,
        0.0,
        scale,
        -scale * y,
        0.0,
        0.0,
        1.0,
    ))
}

/// The match in normalised coordinates.
pub fn normalised(one: &Match, t1: &Matrix3<f64>, t2: &Matrix3<f64>) -> Match {
    let apply =
        |t: &Matrix3<f64>, [x, y]: [f64; 2]| [t[(0, 0)] * x + t[(0, 2)], t[(1, 1)] * y + t[(1, 2)]];
    Match {
        first: apply(t1, one.first),
        second: apply(t2, one.second),
    }
}
