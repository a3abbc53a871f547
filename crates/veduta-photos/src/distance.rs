//! How far matches are off a fundamental matrix or a homography, squared (px²).

use nalgebra::{Matrix2, Matrix3, Vector2};

use crate::matches::Match;

/// The parts of `F m1` and `F^T m2`: both lines' squared normals, and the algebraic error (2.23).
fn lines(f: &Matrix3<f64>, one: &Match) -> (f64, f64, f64) {
    let [x, y] = one.first;
    let [u, v] = one.second;
    let a = f[(0, 0)] * x + f[(0, 1)] * y + f[(0, 2)];
    let b = f[(1, 0)] * x + f[(1, 1)] * y + f[(1, 2)];
    let c = f[(2, 0)] * x + f[(2, 1)] * y + f[(2, 2)];
    let d = f[(0, 0)] * u + f[(1, 0)] * v + f[(2, 0)];
    let e = f[(0, 1)] * u + f[(1, 1)] * v + f[(2, 1)];
    (a * a + b * b, d * d + e * e, a * u + b * v + c)
}

/// What the squared algebraic error is to be multiplied with to be `epipolar`.
pub fn epipolar_weight(f: &Matrix3<f64>, one: &Match) -> f64 {
    let (second, first, _) = lines(f, one);
    1.0 / second + 1.0 / first
}

/// Squared distances from the epipolar lines in both photos, added (2.17).
pub fn epipolar(f: &Matrix3<f64>, one: &Match) -> f64 {
    let (second, first, error) = lines(f, one);
    finite(error * error * (1.0 / second + 1.0 / first))
}

/// Squared distance to the nearest match that fits, to first order (Sampson; Hartley and
/// Zisserman 2003, 11.9). (2.18) means it, and takes a root too many in (2.19).
pub fn sampson(f: &Matrix3<f64>, one: &Match) -> f64 {
    let (second, first, error) = lines(f, one);
    finite(error * error / (second + first))
}

/// The same of a homography (Hartley and Zisserman 2003, 4.2.6).
pub fn sampson_plane(h: &Matrix3<f64>, one: &Match) -> f64 {
    let [x, y] = one.first;
    let [u, v] = one.second;
    let row = |n: usize| h[(n, 0)] * x + h[(n, 1)] * y + h[(n, 2)];
    let (top, middle, depth) = (row(0), row(1), row(2));
    let error = Vector2::new(u * depth - top, v * depth - middle);
    let along = [u * h[(2, 0)] - h[(0, 0)], u * h[(2, 1)] - h[(0, 1)]];
    let across = [v * h[(2, 0)] - h[(1, 0)], v * h[(2, 1)] - h[(1, 1)]];
    let mixed = along[0] * across[0] + along[1] * across[1];
    let spread = Matrix2::new(
        along[0] * along[0] + along[1] * along[1] + depth * depth,
        mixed,
        mixed,
        across[0] * across[0] + across[1] * across[1] + depth * depth,
    );
    let solved = spread
        .try_inverse()
        .map(|inverse| error.dot(&(inverse * error)));
    finite(solved.unwrap_or(f64::INFINITY))
}

/// Squared distances of both points from where the homography has them, added.
pub fn transfer(h: &Matrix3<f64>) -> impl Fn(&Match) -> f64 {
    let h = *h;
    let back = h.try_inverse();
    let off = |m: &Matrix3<f64>, [x, y]: [f64; 2], [u, v]: [f64; 2]| {
        let row = |n: usize| m[(n, 0)] * x + m[(n, 1)] * y + m[(n, 2)];
        let depth = row(2);
        let (across, down) = (row(0) / depth - u, row(1) / depth - v);
        across * across + down * down
    };
    move |one| match &back {
        Some(back) => finite(off(&h, one.first, one.second) + off(back, one.second, one.first)),
        None => f64::INFINITY,
    }
}

/// No distance (both lines vanish) counts as infinitely far.
fn finite(value: f64) -> f64 {
    if value.is_nan() {
        f64::INFINITY
    } else {
        value
    }
}
