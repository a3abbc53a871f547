//! The quads around the edges that the surface crosses, each as two triangles.

use crate::active::{Active, Cases, Layer};
use crate::cell::edge_of;

/// The triangles around the edges that begin in the lowest corner of the cells of a layer.
pub fn triangles_of(
    layers: &[Layer],
    starts: &[usize],
    x: usize,
    cases: &Cases,
    positions: &[[f64; 3]],
) -> Vec<[u32; 3]> {
    let layer = &layers[x];
    let mut found = Vec::with_capacity(2 * layer.cells.len());
    for y in 0..layer.rows.len() - 1 {
        for cell in layer.row(y) {
            for axis in 0..3 {
                if (cell.case & 1) == (cell.case >> (1 << axis) & 1) {
                    continue;
                }
                let at = [x, y, cell.z as usize];
                if let Some(quad) = quad(layers, starts, at, axis, cases) {
                    let turned = cell.case & 1 == 0;
                    split(quad, turned, positions, &mut found);
                }
            }
        }
    }
    found
}

/// The vertices of the four cells around an edge, counter-clockwise seen from its upper end; None
/// where one of them is not known.
fn quad(
    layers: &[Layer],
    starts: &[usize],
    at: [usize; 3],
    axis: usize,
    cases: &Cases,
) -> Option<[u32; 4]> {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut corners = [0; 4];
    for (corner, (back_u, back_v)) in corners.iter_mut().zip([(1, 1), (0, 1), (0, 0), (1, 0)]) {
        let mut place = at;
        place[u] = place[u].checked_sub(back_u)?;
        place[v] = place[v].checked_sub(back_v)?;
        let cell = layers[place[0]].find(place[1], place[2])?;
        let seen_from = back_u << u | back_v << v;
        *corner = vertex(cell, starts[place[0]], edge_of(axis, seen_from), cases);
    }
    Some(corners)
}

fn vertex(cell: &Active, start: usize, edge: usize, cases: &Cases) -> u32 {
    start as u32 + cell.first + u32::from(cases.of(cell).of_edge[edge])
}

/// Along the shorter diagonal.
fn split(quad: [u32; 4], turned: bool, positions: &[[f64; 3]], into: &mut Vec<[u32; 3]>) {
    let [a, b, c, d] = if turned {
        [quad[3], quad[2], quad[1], quad[0]]
    } else {
        quad
    };
    let length = |from: u32, to: u32| -> f64 {
        let (from, to) = (positions[from as usize], positions[to as usize]);
        (0..3).map(|axis| (from[axis] - to[axis]).powi(2)).sum()
    };
    if length(a, c) <= length(b, d) {
        into.extend([[a, b, c], [a, c, d]]);
    } else {
        into.extend([[a, b, d], [b, c, d]]);
    }
}
