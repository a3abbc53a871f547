//! Whether rings cross or touch, by exact predicates (the crate `robust`, after Shewchuk 1997).

use robust::{orient2d, Coord};

/// The first two edges found that cross or touch without being neighbours. Edge `e` runs from
/// point `e` to point `next[e]`.
pub fn crossing(points: &[[f64; 2]], next: &[u32]) -> Option<(usize, usize)> {
    let mut boxes: Vec<([f64; 2], [f64; 2], usize)> = next
        .iter()
        .enumerate()
        .map(|(edge, &to)| {
            let (a, b) = (points[edge], points[to as usize]);
            let low = [a[0].min(b[0]), a[1].min(b[1])];
            let high = [a[0].max(b[0]), a[1].max(b[1])];
            (low, high, edge)
        })
        .collect();
    boxes.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    for (place, (low, high, first)) in boxes.iter().enumerate() {
        for (other_low, other_high, second) in &boxes[place + 1..] {
            if other_low[0] > high[0] {
                break;
            }
            let apart = other_low[1] > high[1] || other_high[1] < low[1];
            let (to, other_to) = (next[*first] as usize, next[*second] as usize);
            if apart || to == *second || other_to == *first {
                continue;
            }
            let one = [points[*first], points[to]];
            let other = [points[*second], points[other_to]];
            if meet(one, other) {
                return Some((*first.min(second), *first.max(second)));
            }
        }
    }
    None
}

/// The first hole that is outside of the first ring or inside of another hole, given rings that
/// do not cross.
pub fn rings_nested(rings: &[Vec<[f64; 2]>]) -> Option<usize> {
    (1..rings.len()).find(|&hole| {
        let point = rings[hole][0];
        let in_other = |other: usize| other != hole && inside(point, &rings[other]);
        !inside(point, &rings[0]) || (1..rings.len()).any(in_other)
    })
}

/// Whether a point is inside of a ring (the count of crossings of a ray is odd).
pub fn inside(point: [f64; 2], ring: &[[f64; 2]]) -> bool {
    let mut odd = false;
    let mut last = ring[ring.len() - 1];
    for &here in ring {
        if (here[1] > point[1]) != (last[1] > point[1]) {
            let turn = side(last, here, point);
            if (turn > 0.0) == (here[1] > last[1]) {
                odd = !odd;
            }
        }
        last = here;
    }
    odd
}

/// Whether two segments share a point.
fn meet(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> bool {
    let [a, b] = one;
    let [c, d] = other;
    let (c_side, d_side) = (side(a, b, c), side(a, b, d));
    if (c_side > 0.0 && d_side > 0.0) || (c_side < 0.0 && d_side < 0.0) {
        return false;
    }
    let (a_side, b_side) = (side(c, d, a), side(c, d, b));
    if (a_side > 0.0 && b_side > 0.0) || (a_side < 0.0 && b_side < 0.0) {
        return false;
    }
    // What is left crosses, touches, or lies on one line; there the boxes decide.
    (0..2).all(|axis| {
        a[axis].min(b[axis]) <= c[axis].max(d[axis]) && c[axis].min(d[axis]) <= a[axis].max(b[axis])
    })
}

/// Above zero where `c` is to the left of the line from `a` to `b`, exactly.
pub fn side(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coord = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    orient2d(coord(a), coord(b), coord(c))
}
