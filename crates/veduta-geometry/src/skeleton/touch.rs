//! Parts of an outline that touch: made to meet in one point, or moved apart.

use super::clean::{area_m2, Ring};
use super::tolerance::CleanTolerance;

/// Makes vertices of one ring that are nearer than `touch_m` to each other one point.
pub fn snap(rings: &mut [Ring], touch_m: f64) {
    for ring in rings {
        let mut order: Vec<usize> = (0..ring.len()).collect();
        order.sort_by(|&a, &b| {
            ring[a].point_m[0]
                .total_cmp(&ring[b].point_m[0])
                .then(a.cmp(&b))
        });
        for place in 0..order.len() {
            let [x, y] = ring[order[place]].point_m;
            for &other in &order[place + 1..] {
                let [u, v] = ring[other].point_m;
                if u - x > touch_m {
                    break;
                }
                if (u - x).hypot(v - y) <= touch_m {
                    ring[other].point_m = [x, y];
                }
            }
        }
    }
}

/// Moves vertices off the edges that they touch, to the side on which their neighbours are.
/// Outlines may touch each other: they are roofs of their own. Whether any has been moved.
pub fn move_apart(rings: &mut [Ring], tolerance: &CleanTolerance) -> bool {
    let mut moved = false;
    // A vertex that is moved off one edge may come to another; what still touches after some
    // rounds is left, and refused as a crossing.
    for _ in 0..4 {
        let shifts = shifts_off_edges(rings, tolerance);
        if shifts.is_empty() {
            break;
        }
        moved = true;
        for (ring, vertex, shift) in shifts {
            let point = &mut rings[ring][vertex].point_m;
            point[0] += shift[0];
            point[1] += shift[1];
        }
    }
    moved
}

/// Ring, vertex and shift (m) of each vertex that touches an edge.
fn shifts_off_edges(rings: &[Ring], tolerance: &CleanTolerance) -> Vec<(usize, usize, [f64; 2])> {
    let mut edges = Vec::new();
    for (ring, vertices) in rings.iter().enumerate() {
        for from in 0..vertices.len() {
            let to = (from + 1) % vertices.len();
            let (a, b) = (vertices[from].point_m, vertices[to].point_m);
            edges.push((a[0].min(b[0]), a[0].max(b[0]), ring, from, to));
        }
    }
    edges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_outline: Vec<bool> = rings.iter().map(|ring| area_m2(ring) > 0.0).collect();
    let longest_m = edges.iter().map(|e| e.1 - e.0).fold(0.0, f64::max);
    let touch_m = tolerance.touch_m;
    let mut shifts = Vec::new();
    for (ring, vertices) in rings.iter().enumerate() {
        for vertex in 0..vertices.len() {
            let [x, _] = vertices[vertex].point_m;
            let first = edges.partition_point(|edge| edge.0 < x - longest_m - touch_m);
            let near = edges[first..]
                .iter()
                .take_while(|edge| edge.0 <= x + touch_m)
                .filter(|edge| edge.1 >= x - touch_m)
                .filter(|edge| edge.2 != ring || (edge.3 != vertex && edge.4 != vertex))
                .filter(|edge| edge.2 == ring || !(is_outline[ring] && is_outline[edge.2]));
            for &(_, _, other, from, to) in near {
                let edge = [rings[other][from].point_m, rings[other][to].point_m];
                if let Some(shift) = shift_off(vertices, vertex, edge, tolerance) {
                    shifts.push((ring, vertex, shift));
                    break;
                }
            }
        }
    }
    shifts
}

fn shift_off(
    ring: &Ring,
    vertex: usize,
    [a, b]: [[f64; 2]; 2],
    tolerance: &CleanTolerance,
) -> Option<[f64; 2]> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length_m = dx.hypot(dy);
    let (ux, uy) = (dx / length_m, dy / length_m);
    let place = |p: [f64; 2]| {
        let (x, y) = (p[0] - a[0], p[1] - a[1]);
        (ux * x + uy * y, ux * y - uy * x)
    };
    let (along_m, off_m) = place(ring[vertex].point_m);
    let touch_m = tolerance.touch_m;
    if off_m.abs() > touch_m || along_m < -touch_m || along_m > length_m + touch_m {
        return None;
    }
    let count = ring.len();
    let neighbours = [
        ring[(vertex + count - 1) % count],
        ring[(vertex + 1) % count],
    ];
    let sides_m: f64 = neighbours.map(|one| place(one.point_m).1).iter().sum();
    let wanted_m = tolerance.gap_m.copysign(sides_m) - off_m;
    Some([-uy * wanted_m, ux * wanted_m])
}
