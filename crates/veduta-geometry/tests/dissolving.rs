//! Cells of a wall as the wall with its holes; touching boxes as one solid.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::collections::HashMap;

use glam::DVec3;
use proptest::prelude::*;
use veduta_geometry::solid::{dissolve, Corner, Sheet};

const NEAR: f64 = 1e-6;

fn corner(place: [f64; 3]) -> Corner {
    Corner {
        place: place.into(),
        uv: [0.0; 2],
    }
}

fn sheet(group: u32, ring: &[[f64; 3]]) -> Sheet {
    Sheet {
        rings: vec![ring.iter().copied().map(corner).collect()],
        group,
        solid: 0,
    }
}

/// A rectangle in the plane z = 0, seen from above.
fn flat(group: u32, x: [f64; 2], y: [f64; 2]) -> Sheet {
    let ring = [
        [x[0], y[0], 0.0],
        [x[1], y[0], 0.0],
        [x[1], y[1], 0.0],
        [x[0], y[1], 0.0],
    ];
    sheet(group, &ring)
}

fn boxed(low: [f64; 3], high: [f64; 3]) -> Vec<Sheet> {
    let at = |x: usize, y: usize, z: usize| {
        let pick = |axis: usize, which: usize| [low[axis], high[axis]][which];
        [pick(0, x), pick(1, y), pick(2, z)]
    };
    let faces = [
        [at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)],
        [at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)],
        [at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)],
        [at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)],
        [at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)],
        [at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)],
    ];
    faces.iter().map(|ring| sheet(0, ring)).collect()
}

fn area(ring: &[Corner]) -> f64 {
    let away = |k: usize| ring[k].place - ring[0].place;
    let sum: DVec3 = (1..ring.len() - 1)
        .map(|k| 0.5 * away(k).cross(away(k + 1)))
        .sum();
    sum.length()
}

/// Six times the volume within, by tetrahedra to the origin: right for closed surfaces alone.
fn volume(sheets: &[Sheet]) -> f64 {
    let mut sum = 0.0;
    for ring in sheets.iter().flat_map(|sheet| &sheet.rings) {
        for k in 1..ring.len() - 1 {
            sum += ring[0].place.dot(ring[k].place.cross(ring[k + 1].place));
        }
    }
    sum / 6.0
}

/// Whether every edge is run along once each way.
fn is_closed(sheets: &[Sheet]) -> bool {
    let key = |place: DVec3| place.to_array().map(f64::to_bits);
    let mut count: HashMap<_, i32> = HashMap::new();
    for ring in sheets.iter().flat_map(|sheet| &sheet.rings) {
        for (k, corner) in ring.iter().enumerate() {
            let next = ring[(k + 1) % ring.len()].place;
            *count.entry((key(corner.place), key(next))).or_default() += 1;
        }
    }
    count
        .iter()
        .all(|(&(a, b), &n)| n == 1 && count.get(&(b, a)) == Some(&1))
}

#[test]
fn cells_around_an_opening_are_a_wall_with_a_hole() {
    let wall = |x, y| flat(0, x, y);
    let cells = [
        wall([0.0, 1.0], [0.0, 3.0]),
        wall([1.0, 2.0], [0.0, 1.0]),
        flat(1, [1.0, 2.0], [1.0, 2.0]),
        wall([1.0, 2.0], [2.0, 3.0]),
        wall([2.0, 5.0], [0.0, 3.0]),
    ];
    let found = dissolve(&cells, NEAR);
    assert_eq!(found.len(), 2);
    assert_eq!(
        found[0].rings.iter().map(Vec::len).collect::<Vec<_>>(),
        [4, 4]
    );
    assert_eq!(
        found[0].rings.iter().map(|r| area(r)).collect::<Vec<_>>(),
        [15.0, 1.0]
    );
    assert_eq!((found[1].group, found[1].rings.len()), (1, 1));
}

#[test]
fn what_touches_in_a_corner_alone_stays_apart() {
    let cells = [
        flat(0, [0.0, 1.0], [0.0, 1.0]),
        flat(0, [1.0, 2.0], [1.0, 2.0]),
    ];
    assert_eq!(dissolve(&cells, NEAR).len(), 2);
}

#[test]
fn a_texture_that_does_not_go_on_parts_two_cells() {
    let mut cells = [
        flat(0, [0.0, 1.0], [0.0, 1.0]),
        flat(0, [1.0, 2.0], [0.0, 1.0]),
    ];
    for (k, cell) in cells.iter_mut().enumerate() {
        for corner in &mut cell.rings[0] {
            corner.uv = [corner.place.x, corner.place.y + 0.5 * k as f64];
        }
    }
    assert_eq!(dissolve(&cells, NEAR).len(), 2);
    for corner in &mut cells[1].rings[0] {
        corner.uv[1] = corner.place.y;
    }
    let whole = dissolve(&cells, NEAR);
    assert_eq!(whole.len(), 1);
    for corner in &whole[0].rings[0] {
        assert_eq!(corner.uv, [corner.place.x, corner.place.y]);
    }
}

#[test]
fn cells_of_two_solids_stay_apart() {
    let mut cells = [
        flat(0, [0.0, 1.0], [0.0, 1.0]),
        flat(0, [1.0, 2.0], [0.0, 1.0]),
    ];
    cells[1].solid = 1;
    assert_eq!(dissolve(&cells, NEAR).len(), 2);
}

#[test]
fn boxes_on_each_other_are_one_solid() {
    let mut all = boxed([0.0, 0.0, 0.0], [3.0, 2.0, 1.0]);
    all.extend(boxed([1.0, 0.0, 1.0], [2.0, 2.0, 4.0]));
    let found = dissolve(&all, NEAR);
    assert!(is_closed(&found));
    assert!((volume(&found) - 12.0).abs() < 1e-12);
    // An upturned T: eight sides, one of them between two steps, and two faces of eight corners.
    assert_eq!(found.len(), 10);
}

/// A cell of nested splits: cut at a share along x or y, or left alone.
#[derive(Debug, Clone)]
enum Cut {
    Leaf(u32),
    At(bool, f64, Box<Cut>, Box<Cut>),
}

fn cuts() -> impl Strategy<Value = Cut> {
    let leaf = (0u32..3).prop_map(Cut::Leaf);
    leaf.prop_recursive(5, 40, 2, |inner| {
        (any::<bool>(), 0.1..0.9, inner.clone(), inner)
            .prop_map(|(x, at, a, b)| Cut::At(x, at, Box::new(a), Box::new(b)))
    })
}

fn cells(cut: &Cut, x: [f64; 2], y: [f64; 2], found: &mut Vec<Sheet>) {
    let within = |range: [f64; 2], at: f64| range[0] + at * (range[1] - range[0]);
    match cut {
        Cut::Leaf(group) => found.push(flat(*group, x, y)),
        Cut::At(true, at, a, b) => {
            cells(a, [x[0], within(x, *at)], y, found);
            cells(b, [within(x, *at), x[1]], y, found);
        }
        Cut::At(false, at, a, b) => {
            cells(a, x, [y[0], within(y, *at)], found);
            cells(b, x, [within(y, *at), y[1]], found);
        }
    }
}

proptest! {
    /// A box whose front is cut into cells closes again, and each group keeps its area.
    #[test]
    fn a_box_with_a_cut_face_closes(cut in cuts()) {
        let mut all: Vec<Sheet> = boxed([0.0, 0.0, -2.0], [7.0, 5.0, 0.0]);
        all.retain(|face| face.rings[0].iter().any(|corner| corner.place.z < 0.0));
        for face in &mut all {
            face.group = 9;
        }
        let sides = all.len();
        cells(&cut, [0.0, 7.0], [0.0, 5.0], &mut all);
        let found = dissolve(&all, NEAR);
        prop_assert!(is_closed(&found));
        prop_assert!((volume(&found) - 70.0).abs() < 1e-9);
        for group in 0..3 {
            let before: f64 = all[sides..].iter().filter(|s| s.group == group).map(|s| area(&s.rings[0])).sum();
            let after: f64 = found.iter().filter(|s| s.group == group)
                .map(|s| area(&s.rings[0]) - s.rings[1..].iter().map(|r| area(r)).sum::<f64>())
                .sum();
            prop_assert!((before - after).abs() < 1e-9);
        }
    }
}
