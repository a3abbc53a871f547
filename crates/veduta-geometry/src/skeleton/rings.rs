//! Rings out of loose sides.

use super::front::Side;

/// The rings of one face.
pub type Rings = Vec<Vec<u32>>;

/// Joins the sides of each face to closed rings. A side that does not close is left in its ring;
/// the check of the roof finds it.
pub fn rings_of_faces(sides: &mut [Side], faces: usize) -> Vec<Rings> {
    sides.sort_unstable();
    let mut rings = vec![Rings::new(); faces];
    let mut used = vec![false; sides.len()];
    let mut start = 0;
    while start < sides.len() {
        let face = sides[start].face;
        let count = sides[start..].iter().take_while(|side| side.face == face);
        let end = start + count.count();
        let of_face = &sides[start..end];
        for first in 0..of_face.len() {
            if !used[start + first] {
                rings[face as usize].push(ring_from(of_face, &mut used[start..end], first));
            }
        }
        start = end;
    }
    rings
}

fn ring_from(sides: &[Side], used: &mut [bool], first: usize) -> Vec<u32> {
    let mut ring = Vec::with_capacity(sides.len());
    let mut place = Some(first);
    while let Some(at) = place {
        used[at] = true;
        ring.push(sides[at].from);
        let to = sides[at].to;
        let reached = sides.partition_point(|side| side.from < to);
        place = (reached..sides.len())
            .take_while(|&k| sides[k].from == to)
            .find(|&k| !used[k]);
    }
    ring
}

/// Takes rings apart where they visit a node twice.
#[derive(Debug)]
pub struct Untangler {
    /// Where a node is in the ring at hand, plus 1; 0 for none.
    place: Vec<u32>,
}

impl Untangler {
    pub fn new(nodes: usize) -> Self {
        Self {
            place: vec![0; nodes],
        }
    }

    /// The simple rings of `ring`, whose nodes are renamed by `name`. A way to and fro vanishes:
    /// what was to its left and to its right then borders on each other.
    pub fn untangle(&mut self, ring: &[u32], name: impl Fn(u32) -> u32) -> Rings {
        let mut found = Rings::new();
        let mut open: Vec<u32> = Vec::with_capacity(ring.len());
        for node in ring.iter().map(|&node| name(node)) {
            let seen = self.place[node as usize] as usize;
            if seen > 0 {
                if open.len() - seen >= 2 {
                    found.push(open[seen - 1..].to_vec());
                }
                for left in open.drain(seen..) {
                    self.place[left as usize] = 0;
                }
            } else {
                open.push(node);
                self.place[node as usize] = open.len() as u32;
            }
        }
        for &node in &open {
            self.place[node as usize] = 0;
        }
        if open.len() >= 3 {
            found.push(open);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_to_and_fro_vanish_and_lobes_part() {
        let mut untangler = Untangler::new(10);
        let rings = untangler.untangle(&[0, 1, 2, 3, 2, 1, 4], |node| node);
        assert_eq!(rings, vec![vec![0, 1, 4]]);
        let rings = untangler.untangle(&[0, 1, 2, 3, 4, 1, 5], |node| node);
        assert_eq!(rings, vec![vec![1, 2, 3, 4], vec![0, 1, 5]]);
        let rings = untangler.untangle(&[0, 0, 1, 1, 2, 0], |node| node);
        assert_eq!(rings, vec![vec![0, 1, 2]]);
        assert!(untangler.place.iter().all(|&place| place == 0));
    }

    #[test]
    fn loose_sides_close() {
        let side = |face, from, to| Side { face, from, to };
        let mut sides = [
            side(1, 7, 8),
            side(0, 2, 0),
            side(1, 8, 7),
            side(0, 0, 1),
            side(0, 1, 2),
        ];
        let rings = rings_of_faces(&mut sides, 2);
        assert_eq!(rings, vec![vec![vec![0, 1, 2]], vec![vec![7, 8]]]);
    }
}
