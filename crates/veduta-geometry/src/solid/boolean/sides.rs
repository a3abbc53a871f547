//! Where a place of one mesh lies to the other mesh.

use std::f64::consts::PI;

use glam::DVec3;

use super::cuts::Cuts;
use super::flat::Polygon;
use super::Side;

/// Where a place in a face of a mesh lies to the other mesh.
pub fn side(cuts: &Cuts, which: usize, face: usize, place: DVec3) -> Side {
    let others = &cuts.polygons[1 - which];
    for &level in &cuts.level[which][face] {
        if others[level].holds(place, 0.0) {
            let normal = cuts.polygons[which][face].normal();
            return if normal.dot(others[level].normal()) > 0.0 {
                Side::Same
            } else {
                Side::Opposite
            };
        }
    }
    if winding(cuts, others, place) > 0.5 {
        Side::In
    } else {
        Side::Out
    }
}

/// How often a mesh goes around a place: the solid angles of its faces as seen from there, over
/// that of the sphere (van Oosterom and Strackee 1983).
///
/// A face is not seen from a place in its plane beside it; its triangles would be, from all sides
/// or none as rounding has it.
fn winding(cuts: &Cuts, polygons: &[Polygon], place: DVec3) -> f64 {
    let mut sum = 0.0;
    let seen = polygons
        .iter()
        .filter(|polygon| polygon.above(place).abs() > cuts.near);
    for ring in seen.flat_map(|polygon| &polygon.rings) {
        let seen = |k: usize| cuts.points[ring[k] as usize] - place;
        let first = seen(0);
        for k in 1..ring.len() - 1 {
            sum += solid_angle(first, seen(k), seen(k + 1));
        }
    }
    sum / (4.0 * PI)
}

fn solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let [la, lb, lc] = [a, b, c].map(DVec3::length);
    let over = a.dot(b.cross(c));
    let under = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * over.atan2(under)
}
