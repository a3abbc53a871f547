//! Edges that move, and what stands on a face: areas and volumes against closed forms.

#![allow(clippy::unwrap_used)] // helpers of tests

use glam::DVec3;
use proptest::prelude::*;
use veduta_geometry::solid::{
    cone, cylinder, disk, envelope, inner_rectangle, inset, merged, outset, pyramids, roofed_over,
    sphere, Bound, Mesh, Overhang, RoofKind,
};

const TOLERANCE: f64 = 1e-6;

/// A level face seen from above with its corners at these x and -z.
fn level(rings: &[&[(f64, f64)]]) -> Mesh {
    let ring = |ring: &&[(f64, f64)]| -> Vec<DVec3> {
        ring.iter().map(|&(x, y)| DVec3::new(x, 2.0, -y)).collect()
    };
    Mesh::polygon(&rings.iter().map(ring).collect::<Vec<_>>())
}

fn rectangle() -> Mesh {
    level(&[&[(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)]])
}

/// 10 by 6 with a courtyard of 4 by 2 in its middle.
fn courtyard() -> Mesh {
    level(&[
        &[(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)],
        &[(3.0, 2.0), (3.0, 4.0), (7.0, 4.0), (7.0, 2.0)],
    ])
}

fn area_of(mesh: &Mesh, faces: &[usize]) -> f64 {
    faces.iter().map(|&f| mesh.face(f).area_vector().y).sum()
}

#[test]
fn strips_along_the_edges_of_a_rectangle() {
    let sheet = rectangle();
    let found = inset(&sheet, sheet.face(0), &[1.0; 4]).unwrap();
    assert_eq!(found.along, [Some(0), Some(1), Some(2), Some(3), None]);
    // Trapezia of 10 and 8, 6 and 4, and what is left: 8 by 4.
    let areas: Vec<f64> = (0..5).map(|face| area_of(&found.mesh, &[face])).collect();
    for (area, truth) in areas.iter().zip([9.0, 5.0, 9.0, 5.0, 32.0]) {
        assert!((area - truth).abs() < TOLERANCE, "{areas:?}");
    }
    let ring = merged(&found.mesh, &[0, 1, 2, 3]);
    assert_eq!((ring.face_count(), ring.face(0).ring_count()), (1, 2));
    assert!((ring.area() - 28.0).abs() < TOLERANCE);
}

#[test]
fn one_edge_alone_and_unequal_ones() {
    let sheet = rectangle();
    let found = inset(&sheet, sheet.face(0), &[2.0, 0.0, 0.0, 0.0]).unwrap();
    assert_eq!(found.along, [Some(0), None]);
    assert!((area_of(&found.mesh, &[0]) - 20.0).abs() < TOLERANCE);
    let found = inset(&sheet, sheet.face(0), &[2.0, 0.0, 0.0, 4.0]).unwrap();
    let rest = found.along.iter().position(Option::is_none).unwrap();
    assert!((area_of(&found.mesh, &[rest]) - 6.0 * 4.0).abs() < TOLERANCE);
    let wings = merged(&found.mesh, &[0, 1]);
    assert_eq!((wings.face_count(), wings.corner_count()), (1, 6));
    let all = inset(&sheet, sheet.face(0), &[30.0; 4]).unwrap();
    assert!(all.along.iter().all(Option::is_some));
    assert!((all.mesh.area() - 60.0).abs() < TOLERANCE);
}

#[test]
fn a_larger_face_around_a_face() {
    let sheet = courtyard();
    let found = outset(&sheet, sheet.face(0), &[0.5; 8]).unwrap();
    // 11 by 7 around a courtyard of 3 by 1.
    assert!((found.grown.area() - 74.0).abs() < TOLERANCE);
    assert_eq!(found.along, [0, 1, 2, 3, 4, 5, 6, 7].map(|edge| edge));
    assert!((found.pieces.mesh.area() - 74.0).abs() < TOLERANCE);
    let filled = outset(&sheet, sheet.face(0), &[1.5; 8]).unwrap();
    assert_eq!(filled.grown.face(0).ring_count(), 1);
    assert!((filled.grown.area() - 13.0 * 9.0).abs() < TOLERANCE);
}

#[test]
fn a_bay_closes_to_a_pocket() {
    // A ring of 10 by 10 with a gap of 1 in its wall: 1 m outwards closes the gap.
    let sheet = level(&[&[
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 10.0),
        (0.0, 10.0),
        (0.0, 5.5),
        (2.0, 5.5),
        (2.0, 8.0),
        (8.0, 8.0),
        (8.0, 2.0),
        (2.0, 2.0),
        (2.0, 4.5),
        (0.0, 4.5),
    ]]);
    let found = outset(&sheet, sheet.face(0), &[1.0; 12]).unwrap();
    assert_eq!(found.grown.face(0).ring_count(), 2);
    assert!((found.grown.area() - (144.0 - 16.0)).abs() < TOLERANCE);
}

#[test]
fn roofs_that_reach_out() {
    let sheet = rectangle();
    let out = Overhang {
        eaves: 0.5,
        gables: 0.25,
    };
    // Eaves 7 m apart, 10.5 m long, the ridge 3.5 m over them.
    let gable = roofed_over(&sheet, &RoofKind::GABLE, 1.0, out).unwrap();
    assert!(gable.is_closed());
    assert!((gable.volume() - 7.0 * 3.5 / 2.0 * 10.5).abs() < TOLERANCE);
    let (low, high) = gable.bounds().unwrap();
    assert!((low.y - 1.5).abs() < TOLERANCE && (high.y - 5.0).abs() < TOLERANCE);
    let hip = roofed_over(&sheet, &RoofKind::HIP, 1.0, Overhang { gables: 0.0, ..out }).unwrap();
    assert!(hip.is_closed());
    assert!((hip.volume() - 7.0 * 3.5 * (3.0 * 11.0 - 7.0) / 6.0).abs() < TOLERANCE);
}

#[test]
fn walls_and_slopes_over_a_face() {
    let sheet = rectangle();
    let bound = |wall, speed| Bound { wall, speed };
    // 3 m of walls, then 45 degrees on all sides, cut off 2 m above: 10 x 6 to 6 x 2.
    let found = envelope(&sheet, sheet.face(0), &[bound(3.0, 1.0); 4], 5.0).unwrap();
    assert!(found.is_closed());
    let slopes: f64 = 2.0 / 6.0 * (60.0 + 4.0 * 8.0 * 4.0 + 12.0);
    assert!((found.volume() - (180.0 + slopes)).abs() < TOLERANCE);
    // One edge leans from 1 m on, the opposite from 2 m on; the others stand: a profile of
    // 6, 6, 5 and 3 m at 0, 1, 2 and 3 m of height, 10 m long.
    let bounds = [
        bound(1.0, 1.0),
        bound(9.0, 0.0),
        bound(2.0, 1.0),
        bound(9.0, 0.0),
    ];
    let found = envelope(&sheet, sheet.face(0), &bounds, 3.0).unwrap();
    assert!(found.is_closed());
    assert!((found.volume() - 10.0 * (6.0 + 5.5 + 4.0)).abs() < TOLERANCE);
}

#[test]
fn what_stands_on_a_face() {
    let sheet = courtyard();
    let found = pyramids(&sheet, |_| DVec3::new(5.0, 5.0, -3.0));
    assert!(found.is_closed());
    assert!((found.volume() - 52.0 * 3.0 / 3.0).abs() < TOLERANCE);
}

#[test]
fn the_round_unit_shapes() {
    let sides = 64;
    let corner = std::f64::consts::TAU / sides as f64;
    let base = 0.5 * 0.25 * corner.sin() * sides as f64;
    assert!((disk(sides).face(0).area_vector() - base * DVec3::Y).length() < TOLERANCE);
    assert!(cylinder(sides).is_closed() && cone(sides).is_closed());
    assert!((cylinder(sides).volume() - base).abs() < TOLERANCE);
    assert!((cone(sides).volume() - base / 3.0).abs() < TOLERANCE);
    for (sides, rows) in [(3, 2), (16, 8), (64, 64)] {
        assert!(sphere(sides, rows).is_closed());
    }
    let ball = std::f64::consts::PI / 6.0;
    assert!((sphere(200, 100).volume() / ball - 1.0).abs() < 1e-3);
}

#[test]
fn the_largest_rectangle_within() {
    let l: &[[f64; 2]] = &[
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 3.0],
        [4.0, 3.0],
        [4.0, 9.0],
        [0.0, 9.0],
    ];
    assert_eq!(
        inner_rectangle(&[l.to_vec()]),
        Some(([0.0, 0.0], [4.0, 9.0]))
    );
    let hole = vec![[1.0, 1.0], [1.0, 8.0], [3.0, 8.0], [3.0, 1.0]];
    assert_eq!(
        inner_rectangle(&[l.to_vec(), hole]),
        Some(([3.0, 0.0], [10.0, 3.0]))
    );
    // Of a right triangle, half the area.
    let triangle = vec![[0.0, 0.0], [8.0, 0.0], [0.0, 6.0]];
    let (low, high) = inner_rectangle(&[triangle]).unwrap();
    let area = (high[0] - low[0]) * (high[1] - low[1]);
    assert!((area - 12.0).abs() < 1e-6, "{area}");
}

fn star() -> impl Strategy<Value = Mesh> {
    prop::collection::vec(0.5..5.0f64, 3..20).prop_map(|radii| {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(k, r): (usize, &f64)| {
            let angle = step * k as f64;
            DVec3::new(r * angle.cos(), 0.0, -r * angle.sin())
        };
        Mesh::polygon(&[radii.iter().enumerate().map(corner).collect::<Vec<_>>()])
    })
}

proptest! {
    #[test]
    fn pieces_fill_the_face(sheet in star(), distances in prop::collection::vec(0.0..2.0f64, 20)) {
        let edges = sheet.corner_count();
        let given: Vec<f64> = distances[..edges].iter().map(|d| if *d < 0.7 { 0.0 } else { *d }).collect();
        if let Ok(found) = inset(&sheet, sheet.face(0), &given) {
            prop_assert!((found.mesh.area() - sheet.area()).abs() < 1e-6);
            let all: Vec<usize> = (0..found.mesh.face_count()).collect();
            prop_assert!((merged(&found.mesh, &all).area() - sheet.area()).abs() < 1e-6);
        }
    }

    #[test]
    fn what_has_grown_holds_its_pieces(sheet in star(), by in 0.01..1.0f64) {
        let edges = sheet.corner_count();
        if let Ok(found) = outset(&sheet, sheet.face(0), &vec![by; edges]) {
            prop_assert!((found.pieces.mesh.area() - found.grown.area()).abs() < 1e-6);
            // A mitred corner reaches no less far out than a round one.
            let rounded = sheet.area() + std::f64::consts::PI * by * by;
            prop_assert!(found.grown.area() > rounded);
        }
    }

    #[test]
    fn envelopes_are_closed(sheet in star(), walls in prop::collection::vec(0.0..3.0f64, 20), most in 0.5..6.0f64) {
        let bounds: Vec<Bound> = walls[..sheet.corner_count()]
            .iter()
            .map(|&wall| Bound { wall, speed: if wall < 1.0 { 0.0 } else { wall } })
            .collect();
        if let Ok(found) = envelope(&sheet, sheet.face(0), &bounds, most) {
            prop_assert!(found.is_closed());
            prop_assert!(found.volume() <= sheet.area() * most * (1.0 + 1e-9));
        }
    }
}
