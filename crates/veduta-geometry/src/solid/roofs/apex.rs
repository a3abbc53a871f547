//! Where the point of a pyramid can stand.

use crate::solid::inset::Rings;

/// A place from which all edges are seen from inside, `wanted` where that is one; None where there
/// is none. It is the mean of the corners of the kernel (Lee and Preparata 1979), which is clipped
/// here edge by edge.
pub fn apex(rings: &Rings, wanted: [f64; 2]) -> Option<[f64; 2]> {
    let mut kernel: Vec<[f64; 2]> = bounds(rings);
    let extent = (kernel[2][0] - kernel[0][0]).hypot(kernel[2][1] - kernel[0][1]);
    let least = 1e-6 * extent;
    let mut sees = true;
    for ring in rings {
        for (k, &a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let off = |p: [f64; 2]| {
                ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length - least
            };
            sees &= off(wanted) > 0.0;
            kernel = clipped(&kernel, off);
        }
    }
    if sees {
        return Some(wanted);
    }
    if kernel.len() < 3 {
        return None;
    }
    let mean = |axis: usize| kernel.iter().map(|p| p[axis]).sum::<f64>() / kernel.len() as f64;
    Some([mean(0), mean(1)])
}

fn bounds(rings: &Rings) -> Vec<[f64; 2]> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in rings.iter().flatten() {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// The part of a convex ring where `off` is not below zero.
fn clipped(ring: &[[f64; 2]], off: impl Fn([f64; 2]) -> f64) -> Vec<[f64; 2]> {
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (k, &a) in ring.iter().enumerate() {
        let b = ring[(k + 1) % ring.len()];
        let (here, next) = (off(a), off(b));
        if here >= 0.0 {
            kept.push(a);
        }
        if (here >= 0.0) != (next >= 0.0) {
            let share = here / (here - next);
            kept.push([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]);
        }
    }
    kept
}
