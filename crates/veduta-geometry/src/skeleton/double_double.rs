//! Numbers of two doubles: some 32 digits.
//!
//! A number is the unevaluated sum of a double and of a much smaller one. The sum of two doubles
//! and its rounding error are exact by Knuth's two-sum, the product by Dekker's splitting ("A
//! floating-point technique for extending the available precision", 1971); the rest follows. A
//! fused multiply-add would be shorter, but it is a library call on processors without it.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dd {
    hi: f64,
    lo: f64,
}

impl Dd {
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The nearest double.
    pub fn to_f64(self) -> f64 {
        self.hi
    }

    pub fn is_finite(self) -> bool {
        self.hi.is_finite() && self.lo.is_finite()
    }

    pub fn is_positive(self) -> bool {
        self.hi > 0.0 || (self.hi == 0.0 && self.lo > 0.0)
    }

    pub fn is_negative(self) -> bool {
        (-self).is_positive()
    }

    /// The exact product of two doubles.
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        let (a1, a0) = halves(a);
        let (b1, b0) = halves(b);
        let lo = ((a1 * b1 - hi) + a1 * b0 + a0 * b1) + a0 * b0;
        Self { hi, lo }
    }

    /// The square root, of numbers above zero: one step of Newton from the double's root.
    pub fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        let rest = self - Self::product(root, root);
        quick_sum(root, rest.hi / (2.0 * root))
    }

    /// A total order for numbers that are finite.
    pub fn order(self, other: Self) -> Ordering {
        self.hi
            .total_cmp(&other.hi)
            .then_with(|| self.lo.total_cmp(&other.lo))
    }
}

impl From<f64> for Dd {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for Dd {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = two_sum(self.hi, other.hi);
        let low = two_sum(self.lo, other.lo);
        let sum = quick_sum(high.hi, high.lo + low.hi);
        quick_sum(sum.hi, sum.lo + low.lo)
    }
}

impl Neg for Dd {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl Sub for Dd {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let high = Self::product(self.hi, other.hi);
        quick_sum(high.hi, high.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for Dd {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * Self::from(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::from(second);
        quick_sum(first, second) + Self::from(rest.hi / other.hi)
    }
}

/// The scalar product of two vectors of the plane.
pub fn dot(a: [Dd; 2], b: [Dd; 2]) -> Dd {
    a[0] * b[0] + a[1] * b[1]
}

/// The area of the parallelogram of two vectors; above zero where `b` is to the left of `a`.
pub fn cross(a: [Dd; 2], b: [Dd; 2]) -> Dd {
    a[0] * b[1] - a[1] * b[0]
}

/// Sum and error of two doubles, exactly.
fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let part = hi - a;
    Dd {
        hi,
        lo: (a - (hi - part)) + (b - part),
    }
}

/// The same where `a` is not the smaller one.
fn quick_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    Dd {
        hi,
        lo: b - (hi - a),
    }
}

/// The upper 26 bits of a double, and the rest.
fn halves(a: f64) -> (f64, f64) {
    let moved = 134_217_729.0 * a;
    let high = moved - (moved - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_double_loses_is_kept() {
        let small = Dd::from(1.0) / Dd::from(3.0) - Dd::from(1.0 / 3.0);
        assert!(small.to_f64() != 0.0);
        let again = (Dd::from(1.0 / 3.0) + small) * Dd::from(3.0) - Dd::from(1.0);
        assert!(again.to_f64().abs() < 1e-31);
        let root = Dd::from(2.0).sqrt();
        assert!((root * root - Dd::from(2.0)).to_f64().abs() < 1e-31);
        let square = Dd::product(1.0 + f64::EPSILON, 1.0 + f64::EPSILON);
        let rest = square - Dd::from(1.0) - Dd::from(2.0 * f64::EPSILON);
        assert_eq!(rest.to_f64(), f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn order_looks_at_both_parts() {
        let one = Dd::from(1.0);
        let more = one + Dd::from(1e-25);
        assert_eq!(one.order(more), Ordering::Less);
        assert!((more - one).is_positive() && (one - more).is_negative());
    }
}
