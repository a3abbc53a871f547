//! What is inside a cell of eight samples: its sheets, and which of its edges each of them crosses.
//!
//! Corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge `4 * d + low + 2 * high` runs along axis d;
//! low and high are the corner's bits of the two other axes, the lower axis first. Face `2 * a + s`
//! is across axis a, at its lower (s = 0) or upper side.

pub const NO_SHEET: u8 = u8::MAX;
pub const EDGES: usize = 12;

/// The sheet of each edge, `NO_SHEET` where the surface does not cross it, and how many there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sheets {
    pub of_edge: [u8; EDGES],
    pub count: u8,
}

/// The edge along `axis` from this corner; the corner's own bit of the axis does not matter.
pub fn edge_of(axis: usize, corner: usize) -> usize {
    let (low, high) = others(axis);
    4 * axis + (corner >> low & 1) + 2 * (corner >> high & 1)
}

/// The two corners of an edge, the lower one first.
pub fn corners_of(edge: usize) -> (usize, usize) {
    let axis = edge / 4;
    let (low, high) = others(axis);
    let first = ((edge & 1) << low) | ((edge >> 1 & 1) << high);
    (first, first | 1 << axis)
}

fn others(axis: usize) -> (usize, usize) {
    match axis {
        0 => (1, 2),
        1 => (0, 2),
        _ => (0, 1),
    }
}

/// The corners of a face, one after another around it.
fn ring(face: usize) -> [usize; 4] {
    let axis = face / 2;
    let (low, high) = others(axis);
    let base = (face & 1) << axis;
    [
        base,
        base | 1 << low,
        base | 1 << low | 1 << high,
        base | 1 << high,
    ]
}

/// The edge between two corners that differ in one bit.
fn between(first: usize, second: usize) -> usize {
    edge_of((first ^ second).trailing_zeros() as usize, first)
}

fn inside(case: u8, corner: usize) -> bool {
    case >> corner & 1 == 1
}

/// The pairs of edges that the surface joins on a face. Where inside and outside alternate around it,
/// each inside corner is cut off for itself; with `flip` each outside corner is.
fn joined(case: u8, face: usize, flip: bool) -> impl Iterator<Item = (usize, usize)> {
    let around = ring(face);
    let edges = [0, 1, 2, 3].map(|n| between(around[n], around[(n + 1) % 4]));
    let crossed =
        [0, 1, 2, 3].map(|n| inside(case, around[n]) != inside(case, around[(n + 1) % 4]));
    let count = crossed.iter().filter(|one| **one).count();
    let mut pairs = [None, None];
    if count == 4 {
        let first = usize::from(inside(case, around[0]) == flip);
        pairs = [first, first + 2].map(|n| Some((edges[(n + 3) % 4], edges[n])));
    } else if count == 2 {
        let mut of = edges.into_iter().zip(crossed).filter(|one| one.1);
        pairs[0] = of.next().zip(of.next()).map(|(a, b)| (a.0, b.0));
    }
    pairs.into_iter().flatten()
}

/// The sheets of a cell. case: bit c is set where corner c is inside. flips: bit f is set where the
/// corners of face f are joined the other way.
pub fn sheets(case: u8, flips: u8) -> Sheets {
    let mut root: [u8; EDGES] = std::array::from_fn(|edge| edge as u8);
    let find = |root: &[u8; EDGES], mut at: u8| {
        while root[at as usize] != at {
            at = root[at as usize];
        }
        at
    };
    for face in 0..6 {
        for (a, b) in joined(case, face, flips >> face & 1 == 1) {
            let (a, b) = (find(&root, a as u8), find(&root, b as u8));
            root[a.max(b) as usize] = a.min(b);
        }
    }
    let mut of_edge = [NO_SHEET; EDGES];
    let mut count = 0;
    for edge in 0..EDGES {
        let (a, b) = corners_of(edge);
        if inside(case, a) == inside(case, b) {
            continue;
        }
        let top = find(&root, edge as u8) as usize;
        if of_edge[top] == NO_SHEET {
            of_edge[top] = count;
            count += 1;
        }
        of_edge[edge] = of_edge[top];
    }
    Sheets { of_edge, count }
}

/// The faces that one sheet of the cell meets twice, as bits: where the neighbour does the same, four
/// quads would share an edge.
pub fn doubled(case: u8) -> u8 {
    let of_edge = sheets(case, 0).of_edge;
    let twice = |face: &usize| {
        let mut met = joined(case, *face, false).map(|pair| of_edge[pair.0]);
        matches!((met.next(), met.next()), (Some(a), Some(b)) if a == b)
    };
    (0..6).filter(twice).fold(0, |bits, face| bits | 1 << face)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_and_edges_agree() {
        for edge in 0..EDGES {
            let (a, b) = corners_of(edge);
            assert_eq!(between(a, b), edge);
            assert_eq!(between(b, a), edge);
        }
    }

    #[test]
    fn sheets_part_corners_as_faces_do() {
        assert_eq!(sheets(0, 0).count, 0);
        assert_eq!(sheets(255, 0).count, 0);
        assert_eq!(sheets(0b0000_0001, 0).count, 1);
        assert_eq!(sheets(0b0000_0011, 0).count, 1);
        assert_eq!(sheets(0b0000_1001, 0).count, 2, "across a face");
        assert_eq!(sheets(0b1000_0001, 0).count, 2, "across the cell");
        assert_eq!(sheets(0b0110_1001, 0).count, 4, "a chess board");
    }

    #[test]
    fn a_cell_meets_one_face_twice_at_most_and_flipping_it_parts_the_sheet() {
        for case in 0..=255_u8 {
            let faces = doubled(case);
            assert!(faces.count_ones() <= 1, "case {case}");
            if faces != 0 {
                let (before, after) = (sheets(case, 0), sheets(case, faces));
                assert_eq!(before.count + 1, after.count, "case {case}");
            }
        }
    }
}
