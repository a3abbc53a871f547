//! Solids and sheets: areas and volumes against closed forms, cuts against what they came from.

use glam::DVec3;
use proptest::prelude::*;
use veduta_geometry::solid::{cube, cut, extrude, quad, roofed, Mesh, RoofKind};

const TOLERANCE: f64 = 1e-9;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A comb with a hole in its back, in the plane y = 0, seen from above.
fn comb() -> Mesh {
    let ring = |points: &[(f64, f64)]| points.iter().map(|&(x, z)| v(x, 0.0, -z)).collect();
    let outline: Vec<DVec3> = ring(&[
        (0.0, 0.0),
        (7.0, 0.0),
        (7.0, 6.0),
        (5.0, 6.0),
        (5.0, 3.0),
        (4.0, 3.0),
        (4.0, 6.0),
        (3.0, 6.0),
        (3.0, 3.0),
        (2.0, 3.0),
        (2.0, 6.0),
        (0.0, 6.0),
    ]);
    let hole: Vec<DVec3> = ring(&[(1.0, 1.0), (1.0, 2.0), (6.0, 2.0), (6.0, 1.0)]);
    Mesh::polygon(&[outline, hole])
}

const COMB_AREA: f64 = 42.0 - 6.0 - 5.0;

#[test]
fn the_unit_shapes() {
    assert_eq!(quad().area(), 1.0);
    assert_eq!(quad().face(0).normal(), DVec3::Z);
    assert!(cube().is_closed());
    assert_eq!((cube().area(), cube().volume()), (6.0, 1.0));
}

#[test]
fn a_sheet_becomes_a_prism() {
    assert_eq!(comb().area(), COMB_AREA);
    for (sheet, by) in [(comb(), 4.0), (comb().reversed(), 4.0), (comb(), -4.0)] {
        let solid = extrude(&sheet, v(0.0, by, 0.0));
        assert!(solid.is_closed());
        assert!((solid.volume() - 4.0 * COMB_AREA).abs() < TOLERANCE);
        assert_eq!(solid.face_count(), 2 + 12 + 4);
    }
    assert!(extrude(&quad(), DVec3::X).is_empty());
}

#[test]
fn a_cut_through_the_teeth() {
    let sides = cut(&comb(), 2, -4.0, TOLERANCE, false);
    assert_eq!(sides.below.mesh.face_count(), 3); // z points to the back: the teeth
    assert_eq!(sides.above.mesh.face_count(), 1);
    assert!((sides.below.mesh.area() - 2.0 * 5.0).abs() < TOLERANCE);
    assert_eq!(sides.above.mesh.face(0).ring_count(), 2);
}

#[test]
fn a_cut_through_the_hole() {
    let sides = cut(&comb(), 2, -1.5, TOLERANCE, false);
    assert!((sides.above.mesh.area() - (7.0 * 1.5 - 5.0 * 0.5)).abs() < TOLERANCE);
    assert_eq!(sides.above.mesh.face_count(), 1);
    assert_eq!(sides.above.mesh.face(0).outline().len(), 8);
}

#[test]
fn a_cut_along_edges_makes_no_slivers() {
    // Through the roots of the teeth, and along a side of the hole.
    for at in [-3.0, -2.0, -1.0, 0.0, -6.0] {
        let sides = cut(&comb(), 2, at, TOLERANCE, false);
        let area = sides.below.mesh.area() + sides.above.mesh.area();
        assert!((area - COMB_AREA).abs() < TOLERANCE, "{at}: {area}");
        for piece in [sides.below, sides.above] {
            for face in piece.mesh.faces() {
                assert!(face.area_vector().length() > 0.5, "{at}");
            }
        }
    }
}

#[test]
fn a_step_that_is_flush_with_the_cut() {
    let profile = [
        v(0.0, 0.0, 0.0),
        v(2.0, 0.0, 0.0),
        v(2.0, 1.0, 0.0),
        v(1.0, 1.0, 0.0),
        v(1.0, 2.0, 0.0),
        v(0.0, 2.0, 0.0),
    ];
    let solid = extrude(&Mesh::polygon(&[profile]), DVec3::Z);
    let sides = cut(&solid, 1, 1.0, TOLERANCE, true);
    assert!(sides.below.mesh.is_closed());
    assert!(sides.above.mesh.is_closed());
    assert!((sides.below.mesh.volume() - 2.0).abs() < TOLERANCE);
    assert!((sides.above.mesh.volume() - 1.0).abs() < TOLERANCE);
    assert!((sides.above.mesh.area() - 6.0).abs() < TOLERANCE);
}

#[test]
fn beside_the_mesh_there_is_nothing() {
    for (at, below, above) in [(-1.0, 0, 6), (0.0, 0, 6), (1.0, 6, 0), (2.0, 6, 0)] {
        let sides = cut(&cube(), 1, at, TOLERANCE, true);
        assert_eq!(sides.below.mesh.face_count(), below, "{at}");
        assert_eq!(sides.above.mesh.face_count(), above, "{at}");
    }
}

#[test]
fn faces_know_where_they_come_from() {
    let sides = cut(&cube(), 1, 0.25, TOLERANCE, true);
    let mut sources: Vec<_> = sides.below.sources.clone();
    sources.sort();
    assert_eq!(sources, [None, Some(0), Some(2), Some(3), Some(4), Some(5)]);
}

fn rectangle(x: f64, y: f64) -> Mesh {
    let corner = |a: f64, b: f64| v(a * x, 1.0, -b * y);
    Mesh::polygon(&[[
        corner(0., 0.),
        corner(1., 0.),
        corner(1., 1.),
        corner(0., 1.),
    ]])
}

/// Cut along its shoulders, at the tip of a notch from either side, and along a hole.
#[test]
fn cuts_through_corners_and_along_sides() {
    let ring = |corners: &[[f64; 2]]| -> Vec<DVec3> {
        corners.iter().map(|&[x, y]| v(x, y, 0.0)).collect()
    };
    let t = ring(&[
        [0.0, 0.0],
        [12.0, 0.0],
        [12.0, 5.0],
        [8.0, 5.0],
        [8.0, 10.0],
        [4.0, 10.0],
        [4.0, 5.0],
        [0.0, 5.0],
    ]);
    let notch = ring(&[[0.0, 0.0], [6.0, 0.0], [6.0, 8.0], [3.0, 4.0], [0.0, 8.0]]);
    let turned = ring(&[[0.0, 0.0], [3.0, 4.0], [6.0, 0.0], [6.0, 8.0], [0.0, 8.0]]);
    let square = ring(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]);
    let hole = ring(&[[3.0, 3.0], [3.0, 6.0], [6.0, 6.0], [6.0, 3.0]]);
    for (rings, at, below, above) in [
        (vec![t], 5.0, vec![(6, 60.0)], vec![(4, 20.0)]),
        (vec![notch], 4.0, vec![(5, 24.0)], vec![(3, 6.0), (3, 6.0)]),
        (vec![turned], 4.0, vec![(3, 6.0), (3, 6.0)], vec![(5, 24.0)]),
        (vec![square, hole], 3.0, vec![(6, 27.0)], vec![(8, 45.0)]),
    ] {
        let found = cut(&Mesh::polygon(&rings), 1, at, TOLERANCE, false);
        let faces = |mesh: &Mesh| -> Vec<(usize, f64)> {
            let one = |face: veduta_geometry::solid::Face<'_>| {
                assert_eq!(face.ring_count(), 1);
                (face.outline().len(), face.area_vector().z)
            };
            mesh.faces().map(one).collect()
        };
        assert_eq!(faces(&found.below.mesh), below);
        assert_eq!(faces(&found.above.mesh), above);
    }
}

#[test]
fn roofs_of_a_rectangle() {
    let slope = 0.5;
    // A hip roof is a gable roof without a pyramid at each end.
    let (long, wide, high) = (12.0, 8.0, 4.0 * slope);
    let hip = roofed(&rectangle(long, wide), &RoofKind::HIP, slope).unwrap();
    assert!(hip.is_closed());
    assert!((hip.volume() - wide * high * (3.0 * long - wide) / 6.0).abs() < TOLERANCE);
    let gable = roofed(&rectangle(long, wide), &RoofKind::GABLE, slope).unwrap();
    assert!(gable.is_closed());
    assert!((gable.volume() - wide * high * long / 2.0).abs() < TOLERANCE);
    let (low, up) = gable.bounds().unwrap();
    assert!((low.y - 1.0).abs() < TOLERANCE && (up.y - 1.0 - high).abs() < TOLERANCE);
}

#[test]
fn a_square_has_two_gables() {
    let gable = roofed(&rectangle(6.0, 6.0), &RoofKind::GABLE, 1.0).unwrap();
    assert!((gable.volume() - 6.0 * 6.0 * 3.0 / 2.0).abs() < TOLERANCE);
    assert_eq!(gable.face_count(), 5);
}

/// A simple polygon around a point, with its corners at growing angles.
fn star() -> impl Strategy<Value = Mesh> {
    prop::collection::vec(0.2..5.0f64, 3..24).prop_map(|radii| {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(k, r): (usize, &f64)| {
            let angle = step * k as f64;
            v(r * angle.cos(), 0.0, -r * angle.sin())
        };
        let outline: Vec<DVec3> = radii.iter().enumerate().map(corner).collect();
        Mesh::polygon(&[outline])
    })
}

proptest! {
    #[test]
    fn roofs_close_over_any_outline(sheet in star(), slope in 0.1..3.0f64) {
        for kind in [RoofKind::HIP, RoofKind::GABLE] {
            let solid = roofed(&sheet, &kind, slope).unwrap();
            prop_assert!(solid.is_closed());
            prop_assert!(solid.volume() > 0.0);
        }
    }

    #[test]
    fn a_cut_keeps_the_area(sheet in star(), axis in prop::sample::select(vec![0usize, 2]), at in -5.0..5.0f64) {
        let sides = cut(&sheet, axis, at, TOLERANCE, false);
        let area = sides.below.mesh.area() + sides.above.mesh.area();
        prop_assert!((area - sheet.area()).abs() < 1e-6, "{area} of {}", sheet.area());
        for point in &sides.below.mesh.points {
            prop_assert!(point[axis] <= at + TOLERANCE);
        }
        for point in &sides.above.mesh.points {
            prop_assert!(point[axis] >= at - TOLERANCE);
        }
    }

    #[test]
    fn a_cut_solid_is_two_solids(sheet in star(), axis in 0usize..3, at in -5.0..5.0f64) {
        let solid = extrude(&sheet, DVec3::Y);
        let sides = cut(&solid, axis, at, TOLERANCE, true);
        let volume = sides.below.mesh.volume() + sides.above.mesh.volume();
        prop_assert!((volume - solid.volume()).abs() < 1e-6);
        for piece in [sides.below, sides.above] {
            prop_assert!(piece.mesh.is_empty() || piece.mesh.is_closed());
        }
    }

    #[test]
    fn a_cut_at_a_corner_makes_no_slivers(sheet in star(), pick in any::<prop::sample::Index>()) {
        let at = pick.get(&sheet.points).x;
        let sides = cut(&sheet, 0, at, TOLERANCE, false);
        let area = sides.below.mesh.area() + sides.above.mesh.area();
        prop_assert!((area - sheet.area()).abs() < 1e-6);
        for piece in [sides.below, sides.above] {
            for face in piece.mesh.faces() {
                for ring in face.rings() {
                    prop_assert!(ring.len() >= 3);
                }
            }
        }
    }
}
