//! From the nodes of the jittered wavefront to those of the true roof.
//!
//! What is one event in truth (all edges of a regular polygon, say) has become many nodes within
//! some 1e-13 of each other. They are made one here, and the node is put on the true planes of the
//! faces around it.

use super::front::{Front, Node, Side};
use super::planes::Lines;
use super::rings::{Rings, Untangler};

/// For each node the one that stands for it: the first of those nearer than `near` to each other
/// along sides.
pub fn merged(nodes: &[Node], sides: &[Side], near: f64) -> Vec<u32> {
    let mut name: Vec<u32> = (0..nodes.len() as u32).collect();
    for side in sides.iter().filter(|side| side.from < side.to) {
        let (a, b) = (&nodes[side.from as usize], &nodes[side.to as usize]);
        let across = [0, 1].map(|k| a.place_m[k] - b.place_m[k]);
        let (dx, dy, dt) = (across[0], across[1], a.time - b.time);
        if dx * dx + dy * dy + dt * dt < near * near {
            let (a, b) = (found(&mut name, side.from), found(&mut name, side.to));
            name[a.max(b) as usize] = a.min(b);
        }
    }
    for node in 0..name.len() {
        // A name is never above the node's number: those below are final already.
        name[node] = name[name[node] as usize];
    }
    name
}

fn found(name: &mut [u32], mut node: u32) -> u32 {
    while name[node as usize] != node {
        name[node as usize] = name[name[node as usize] as usize];
        node = name[node as usize];
    }
    node
}

/// Renames the nodes of all rings, and takes the rings apart where they then touch themselves.
pub fn rename(rings: &mut [Rings], name: &[u32], untangler: &mut Untangler) {
    for of_face in rings {
        let before = std::mem::take(of_face);
        for ring in before {
            of_face.extend(untangler.untangle(&ring, |node| name[node as usize]));
        }
    }
}

/// Puts each node from number `first` on as near to the true planes around it as they allow. A
/// node that they leave free in some direction stays where it is in that direction, and one that
/// would go farther than `most` stays altogether. The nodes of `level` rings come to be at its time.
pub fn settle(
    front: &mut Front,
    lines: &Lines,
    rings: &[Rings],
    level: Option<(&Rings, f64)>,
    first: usize,
    most: f64,
) {
    let mut pulls = vec![Pull::default(); front.nodes.len()];
    for (face, of_face) in rings.iter().enumerate() {
        let Some(&line) = lines.of_edge.get(face) else {
            break; // steps have no plane but the one that the wavefront gave them
        };
        let line = &lines.lines[line as usize];
        let speed = front.planes[face].speed;
        let row = [line.normal[0], line.normal[1], -speed];
        for &node in of_face.iter().flatten() {
            let here = &front.nodes[node as usize];
            let off = row[0] * here.place_m[0]
                + row[1] * here.place_m[1]
                + row[2] * here.time
                + line.offset_m;
            pulls[node as usize].add(row, off);
        }
    }
    if let Some((rest, time)) = level {
        for &node in rest.iter().flatten() {
            pulls[node as usize].add([0.0, 0.0, 1.0], front.nodes[node as usize].time - time);
        }
    }
    for (node, pull) in front.nodes.iter_mut().zip(&pulls).skip(first) {
        let [dx, dy, dt] = pull.shift();
        if dx * dx + dy * dy + dt * dt <= most * most {
            node.place_m[0] += dx;
            node.place_m[1] += dy;
            node.time += dt;
        }
    }
    if let Some((rest, time)) = level {
        for &node in rest.iter().flatten() {
            front.nodes[node as usize].time = time;
        }
    }
}

/// The normal equations of the planes through a node.
#[derive(Debug, Clone, Copy, Default)]
struct Pull {
    /// xx, xy, xt, yy, yt, tt.
    matrix: [f64; 6],
    right: [f64; 3],
}

impl Pull {
    fn add(&mut self, row: [f64; 3], off: f64) {
        let [x, y, t] = row;
        let products = [x * x, x * y, x * t, y * y, y * t, t * t];
        for (sum, product) in self.matrix.iter_mut().zip(products) {
            *sum += product;
        }
        for (sum, part) in self.right.iter_mut().zip(row) {
            *sum -= part * off;
        }
    }

    /// The least shift onto the planes (Tikhonov's regularisation; Cramer's rule).
    fn shift(&self) -> [f64; 3] {
        let [xx, xy, xt, yy, yt, tt] = self.matrix;
        let soft = 1e-6 * (xx + yy + tt) + f64::MIN_POSITIVE;
        let (xx, yy, tt) = (xx + soft, yy + soft, tt + soft);
        let cofactors = [
            yy * tt - yt * yt,
            xt * yt - xy * tt,
            xy * yt - xt * yy,
            xx * tt - xt * xt,
            xy * xt - xx * yt,
            xx * yy - xy * xy,
        ];
        let [a, b, c, d, e, f] = cofactors;
        let whole = xx * a + xy * b + xt * c;
        let [p, q, r] = self.right;
        [
            (a * p + b * q + c * r) / whole,
            (b * p + d * q + e * r) / whole,
            (c * p + e * q + f * r) / whole,
        ]
    }
}
