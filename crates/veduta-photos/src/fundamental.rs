//! The fundamental matrix from matches that are taken to be true: seven points, or eight and more.

use nalgebra::{Matrix3, SMatrix, SVector, SymmetricEigen};

use crate::error::MatchError;
use crate::matches::{normalisations, normalised, Match};

/// The fewest matches of the linear method.
pub const EIGHT: usize = 8;
/// The fewest matches that determine one to three matrices.
pub const SEVEN: usize = 7;
/// An eigenvalue below this share of the largest is none: its vector is of the null space.
const NONE: f64 = 1e-13;

/// u of (2.11), for f with the rows of F one after the other: (2.11) has the transpose.
fn row(one: &Match) -> [f64; 9] {
    let [x, y] = one.first;
    let [u, v] = one.second;
    [u * x, u * y, u, v * x, v * y, v, x, y, 1.0]
}

type Square9 = SMatrix<f64, 9, 9>;

fn products(matches: &[Match], weights: Option<&[f64]>) -> Square9 {
    let mut sum = Square9::zeros();
    for (at, one) in matches.iter().enumerate() {
        let u = row(one);
        let weight = weights.map_or(1.0, |all| all[at]);
        for i in 0..9 {
            let scaled = weight * u[i];
            for j in i..9 {
                sum[(j, i)] += scaled * u[j];
            }
        }
    }
    // The decomposition reads the lower triangle, and the tests both.
    for i in 0..9 {
        for j in 0..i {
            sum[(j, i)] = sum[(i, j)];
        }
    }
    sum
}

/// Eigenvectors of the smallest two eigenvalues, smallest first, and the third smallest and the
/// largest eigenvalue; None where it does not converge.
struct Smallest {
    vectors: [SVector<f64, 9>; 2],
    values: [f64; 4],
}

fn smallest(sum: Square9) -> Option<Smallest> {
    let found = SymmetricEigen::try_new(sum, f64::EPSILON, 500)?;
    let mut order: [usize; 9] = std::array::from_fn(|n| n);
    order.sort_by(|&a, &b| found.eigenvalues[a].total_cmp(&found.eigenvalues[b]));
    let vector = |rank: usize| found.eigenvectors.column(order[rank]).into_owned();
    let value = |rank: usize| found.eigenvalues[order[rank]];
    Some(Smallest {
        vectors: [vector(0), vector(1)],
        values: [value(0), value(1), value(2), value(8)],
    })
}

fn matrix(f: &SVector<f64, 9>) -> Matrix3<f64> {
    Matrix3::from_row_slice(f.as_slice())
}

/// The nearest matrix of rank two.
pub fn rank_two(f: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let mut parts = f.try_svd(true, true, f64::EPSILON, 500)?;
    let least = parts.singular_values.imin();
    parts.singular_values[least] = 0.0;
    parts.recompose().ok()
}

/// F of unit length, its largest number positive: so that two of them can be compared.
pub fn scaled(f: Matrix3<f64>) -> Option<Matrix3<f64>> {
    let size = f.norm();
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    Some(f / (size * f[f.iamax_full()].signum()))
}

/// The normalised eight points (algorithm 1) over eight or more matches, each with its weight.
pub fn eight_points(
    matches: &[Match],
    weights: Option<&[f64]>,
) -> Result<Matrix3<f64>, MatchError> {
    if matches.len() < EIGHT {
        let (got, needed) = (matches.len(), EIGHT);
        return Err(MatchError::TooFew { got, needed });
    }
    eight(matches, weights).ok_or(MatchError::Degenerate)
}

fn eight(matches: &[Match], weights: Option<&[f64]>) -> Option<Matrix3<f64>> {
    let (t1, t2) = normalisations(matches)?;
    let even: Vec<Match> = matches
        .iter()
        .map(|one| normalised(one, &t1, &t2))
        .collect();
    let found = smallest(products(&even, weights))?;
    // A second vector that fits as well: any mixture of both would.
    if found.values[1] <= NONE * found.values[3] {
        return None;
    }
    let f = rank_two(&matrix(&found.vectors[0]))?;
    scaled(t2.transpose() * f * t1)
}

/// The one or three matrices that seven matches fit exactly (2.14, 2.15); none where the matches
/// do not determine them.
///
/// The thesis has alpha from 0 to 1; it may be any number.
pub fn seven_points(matches: &[Match], found: &mut Vec<Matrix3<f64>>) {
    let Some((t1, t2)) = normalisations(matches) else {
        return;
    };
    let even: Vec<Match> = matches
        .iter()
        .map(|one| normalised(one, &t1, &t2))
        .collect();
    let Some(null) = smallest(products(&even, None)) else {
        return;
    };
    if null.values[2] <= NONE * null.values[3] {
        return;
    }
    let (one, other) = (matrix(&null.vectors[0]), matrix(&null.vectors[1]));
    let step = one - other;
    // det(other + alpha step) at 0, 1, -1, and its leading coefficient, give the cubic.
    let at = |alpha: f64| (other + step * alpha).determinant();
    let (zero, plus, minus, cubic) = (at(0.0), at(1.0), at(-1.0), step.determinant());
    let square = (plus + minus) / 2.0 - zero;
    let linear = (plus - minus) / 2.0 - cubic;
    for alpha in real_roots([cubic, square, linear, zero])
        .into_iter()
        .flatten()
    {
        let f = t2.transpose() * (other + step * alpha) * t1;
        found.extend(scaled(f));
    }
}

/// The real roots of a cubic, highest coefficient first; of a lower degree where it is zero.
fn real_roots([a, b, c, d]: [f64; 4]) -> [Option<f64>; 3] {
    let size = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
    if a.abs() <= 1e-12 * size {
        return quadratic_roots(b, c, d, size);
    }
    let (b, c, d) = (b / a, c / a, d / a);
    let p = c / 3.0 - b * b / 9.0;
    let q = b * b * b / 27.0 - b * c / 6.0 + d / 2.0;
    let part = q * q + p * p * p;
    let shift = b / 3.0;
    let polish = |mut x: f64| {
        for _ in 0..2 {
            let value = ((x + b) * x + c) * x + d;
            let slope = (3.0 * x + 2.0 * b) * x + c;
            let next = x - value / slope;
            if next.is_finite() {
                x = next;
            }
        }
        Some(x)
    };
    if part > 0.0 {
        let root = part.sqrt();
        let large = -q.signum() * (q.abs() + root).cbrt();
        let small = if large == 0.0 { 0.0 } else { -p / large };
        return [polish(large + small - shift), None, None];
    }
    let radius = (-p).max(0.0).sqrt();
    let turn = (-q / (radius * radius * radius)).clamp(-1.0, 1.0).acos() / 3.0;
    let third = 2.0 * std::f64::consts::FRAC_PI_3;
    let root = |n: f64| {
        let x = if radius > 0.0 {
            2.0 * radius * (turn + n * third).cos()
        } else {
            0.0
        };
        polish(x - shift)
    };
    [root(0.0), root(1.0), root(2.0)]
}

fn quadratic_roots(b: f64, c: f64, d: f64, size: f64) -> [Option<f64>; 3] {
    if b.abs() <= 1e-12 * size {
        let only = (c.abs() > 1e-12 * size).then(|| -d / c);
        return [only, None, None];
    }
    let part = c * c - 4.0 * b * d;
    if part < 0.0 {
        return [None; 3];
    }
    let half = -(c + c.signum() * part.sqrt()) / 2.0;
    let other = if half == 0.0 { 0.0 } else { d / half };
    [Some(half / b), Some(other), None]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn roots_are_roots_and_all_of_them(
            roots in proptest::array::uniform3(-3.0f64..3.0), a in 0.2f64..3.0
        ) {
            let [x, y, z] = roots;
            prop_assume!((x - y).abs() > 0.05 && (y - z).abs() > 0.05 && (x - z).abs() > 0.05);
            let cubic = [a, -a * (x + y + z), a * (x * y + y * z + z * x), -a * x * y * z];
            let mut found: Vec<f64> = real_roots(cubic).into_iter().flatten().collect();
            let mut wanted = roots.to_vec();
            found.sort_by(f64::total_cmp);
            wanted.sort_by(f64::total_cmp);
            prop_assert_eq!(found.len(), 3);
            for (one, other) in found.iter().zip(&wanted) {
                prop_assert!((one - other).abs() < 1e-9);
            }
        }

        #[test]
        fn a_single_root_is_found(x in -3.0f64..3.0, re in -2.0f64..2.0, im in 0.1f64..2.0) {
            // (t - x)((t - re)² + im²)
            let (s, p) = (2.0 * re, re * re + im * im);
            let found = real_roots([1.0, -(x + s), p + s * x, -p * x]);
            let all: Vec<f64> = found.into_iter().flatten().collect();
            prop_assert_eq!(all.len(), 1);
            prop_assert!((all[0] - x).abs() < 1e-8);
        }
    }

    #[test]
    fn lower_degrees() {
        let found: Vec<f64> = real_roots([0.0, 1.0, -3.0, 2.0])
            .into_iter()
            .flatten()
            .collect();
        assert_eq!(found.len(), 2);
        assert!(found
            .iter()
            .all(|&x| (x - 1.0).abs() < 1e-12 || (x - 2.0).abs() < 1e-12));
        assert_eq!(real_roots([0.0, 0.0, 2.0, -1.0]), [Some(0.5), None, None]);
        assert_eq!(real_roots([0.0; 4]), [None; 3]);
    }
}
