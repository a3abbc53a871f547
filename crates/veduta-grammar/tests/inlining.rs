//! Inlined rules and booleans: hand-worked truth, and volumes that add up.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{fault, said, solid, tree};
use proptest::prelude::*;

/// The lot is 10 m by 6 m; a cube of so many metres at a place.
fn cube(x: f64, y: f64, z: f64, size: f64) -> String {
    format!("{{ t({x}, {y}, {z}) s({size}, {size}, {size}) primitiveCube() }}")
}

fn volume(operations: &str) -> f64 {
    let found = said(&format!("Lot --> {operations} print(geometry.volume)"));
    found[0].parse().unwrap()
}

#[test]
fn booleans_with_a_cube_in_the_corner() {
    // A block of 180 m3, and a cube of 8 m3 of which 1 m3 is in the block.
    let cube = cube(9.0, 2.0, 5.0, 2.0);
    for (operation, truth) in [("union", 187.0), ("subtract", 179.0), ("intersect", 1.0)] {
        let found = volume(&format!("extrude(3) {operation} {cube}"));
        assert!((found - truth).abs() < 1e-9, "{operation}: {found}");
    }
    let swapped = volume(&format!("extrude(3) subtract(swap) {cube}"));
    let both = volume("subtract { extrude(3) | t(9, 2, 5) s(2, 2, 2) primitiveCube() }");
    assert!((both - 179.0).abs() < 1e-9, "{both}");
    assert!((swapped - 7.0).abs() < 1e-9, "{swapped}");
}

#[test]
fn the_result_is_one_shape_under_the_rule() {
    let made = tree(&format!(
        "Lot --> extrude(3) subtract {} Body.",
        cube(9.0, 2.0, 5.0, 2.0)
    ));
    assert_eq!(made.nodes.len(), 2);
    let (mesh, volume) = solid(&made);
    assert_eq!(mesh.face_count(), 9);
    assert!((volume - 179.0).abs() < 1e-9);
}

#[test]
fn sheets_are_combined_in_their_plane() {
    let values = "print(geometry.area) print(geometry.nFaces)";
    let found = said(&format!("Lot --> subtract {{ s(5, 0, 3) }} {values}"));
    assert_eq!(found, ["45", "1"]);
    assert!(fault("Lot --> comp(f) { all : subtract { t(0, 0, 1) } X. }").contains("one plane"));
    assert!(
        fault("Lot --> extrude(3) intersect { t(0, 1, 0) s(1, 0, 1) primitiveQuad() }")
            .contains("closed")
    );
}

#[test]
fn inlined_shapes_go_on_as_one() {
    let parts = "Parts --> split(x) { 4 : extrude(3) A. | ~1 : extrude(5) B. }";
    let found = said(&format!(
        "Lot --> inline Parts print(geometry.volume) print(scope.sy) {parts}"
    ));
    // 4 m by 6 m by 3 m, and 6 m by 6 m by 5 m.
    assert_eq!(found, ["252", "5"]);
    let found = said(&format!(
        "Lot --> inline(unify) Parts comp(f) {{ bottom = print(geometry.area) X. | all : NIL }} {parts}"
    ));
    assert_eq!(found, ["60"]);
    let rejoined = "Lot --> extrude(3) inline(recompose) comp(f) { all : X. } \
                    print(geometry.nVertices) print(geometry.isClosedSurface)";
    assert_eq!(said(rejoined), ["8", "true"]);
    let apart = "Lot --> inline { NIL } print(geometry.nFaces)";
    assert_eq!(said(apart), ["0"]);
}

#[test]
fn one_shape_is_taken_as_it_is_and_looks_stay_where_they_differ() {
    let one = said("Lot --> inline { color(1, 0, 0) extrude(2) } print(material.color.g)");
    assert_eq!(one, ["0"]);
    let two = "Lot --> color(0, 0, 1) inline Two print(material.color.b) \
               Two --> split(x) { 5 : color(1, 0, 0) A. | 5 : color(0, 1, 0) B. }";
    assert_eq!(said(two), ["1"]);
}

#[test]
fn a_rule_that_inlines_itself_is_stopped() {
    assert!(fault("Lot --> inline Lot").contains("deep"));
    assert!(fault("Lot --> inline { A A } A --> inline { Lot Lot }").contains("deep"));
}

#[test]
fn other_random_numbers_stay_as_they_are() {
    let with = said("Lot --> [ inline { A } NIL ] A A A --> print(rand(1)) NIL");
    let without = said("Lot --> A A A --> print(rand(1)) NIL");
    assert_eq!(with.len(), 3);
    assert_ne!(with[0], with[1]);
    assert_eq!(without.len(), 2);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn volumes_add_up(n in prop::array::uniform4(-2.0..8.0f64), height in 0.5..6.0f64, size in 0.5..6.0f64, turn in 0.0..90.0f64) {
        let other = format!(
            "{{ t({}, {}, {}) r({turn}, {}, 10) s({size}, {size}, {size}) primitiveCube() }}",
            n[0], n[1] - 2.0, n[2], 3.0 * n[3]
        );
        let all = ["union", "subtract", "intersect"].map(|o| volume(&format!("extrude({height}) {o} {other}")));
        let (a, b) = (60.0 * height, size.powi(3));
        prop_assert!((all[0] + all[2] - a - b).abs() < 1e-6 * (a + b), "{all:?}");
        prop_assert!((all[1] + all[2] - a).abs() < 1e-6 * a, "{all:?}");
    }
}
