//! How far scopes are from each other.

use glam::DVec3;

use super::scope::Scope;

/// The least distance between two boxes (m); 0 where they overlap.
///
/// Boxes that do not overlap are nearest at a corner of one, or at an edge of each.
pub fn box_distance(one: &Scope, other: &Scope) -> f64 {
    if overlap(one, other) {
        return 0.0;
    }
    let (a, b) = (corners(one), corners(other));
    let mut least = f64::INFINITY;
    for corner in a {
        least = least.min(corner_distance(corner, other));
    }
    for corner in b {
        least = least.min(corner_distance(corner, one));
    }
    for (p, q) in edges() {
        for (r, s) in edges() {
            least = least.min(segment_distance([a[p], a[q]], [b[r], b[s]]));
        }
    }
    least
}

fn corners(scope: &Scope) -> [DVec3; 8] {
    std::array::from_fn(|k| {
        let unit = |bit: usize| (k >> bit & 1) as f64;
        scope.world(DVec3::new(unit(0), unit(1), unit(2)))
    })
}

/// The edges between corners whose numbers differ in one bit.
fn edges() -> impl Iterator<Item = (usize, usize)> {
    (0..8)
        .flat_map(|from| (0..3).map(move |bit| (from, from | 1 << bit)))
        .filter(|(a, b)| a != b)
}

fn corner_distance(corner: DVec3, scope: &Scope) -> f64 {
    let own = scope.axes.transpose() * (corner - scope.origin);
    own.distance(own.clamp(DVec3::ZERO, scope.size))
}

/// Whether no axis parts two boxes (Gottschalk, Lin and Manocha 1996).
fn overlap(one: &Scope, other: &Scope) -> bool {
    let all = |scope: &Scope| [scope.axes.x_axis, scope.axes.y_axis, scope.axes.z_axis];
    let (a, b) = (all(one), all(other));
    let across = a.iter().flat_map(|p| b.iter().map(move |q| p.cross(*q)));
    let axes = a.iter().chain(&b).copied().chain(across);
    let reach = |scope: &Scope, axis: DVec3| {
        let places = corners(scope).map(|corner| corner.dot(axis));
        let low = places.into_iter().fold(f64::INFINITY, f64::min);
        (low, places.into_iter().fold(f64::NEG_INFINITY, f64::max))
    };
    axes.into_iter().all(|axis| {
        let ((low, high), (from, to)) = (reach(one, axis), reach(other, axis));
        low <= to && from <= high
    })
}

/// The least distance between two segments (Ericson 2005, section 5.1.9).
fn segment_distance([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    let (along, other, between) = (b - a, d - c, a - c);
    let (aa, oo) = (along.length_squared(), other.length_squared());
    let (ab, ob, ao) = (along.dot(between), other.dot(between), along.dot(other));
    let under = aa * oo - ao * ao;
    let share = |over: f64, under: f64| {
        if under > 0.0 {
            (over / under).clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    let s = if under > 1e-12 * aa * oo {
        share(ao * ob - ab * oo, under)
    } else {
        0.0
    };
    let t = share(ao * s + ob, oo);
    // t may have been clamped: the best place on the first for it.
    let s = share(ao * t - ab, aa);
    (a + along * s).distance(c + other * t)
}
