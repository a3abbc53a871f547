//! What stands on faces: hand-worked volumes.

#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use proptest::prelude::*;
use support::{areas, derived, fault, lot_of, solid, tree};

fn volume(text: &str) -> f64 {
    let (_, volume) = solid(&tree(&format!("Lot --> {text}")));
    (volume * 1e6).round() / 1e6
}

#[test]
fn pyramids_and_sheds() {
    assert_eq!(volume("taper(5)"), 100.0);
    assert_eq!(volume("taper(-5)"), 100.0);
    // The front is the first edge, 3 m from the middle; the right one follows.
    assert_eq!(volume("roofPyramid(45)"), 60.0);
    assert_eq!(volume("roofPyramid(byHeight, 2)"), 40.0);
    assert_eq!(volume("roofShed(byHeight, 3)"), 90.0);
    assert_eq!(volume("roofShed(45, 1)"), 300.0);
    assert_eq!(volume("roofShed(byAngle, 45, -3)"), 300.0);
    assert_eq!(volume("roofRidge(byAngle, 45)"), 90.0);
    let sizes = "roofRidge(byAngle, 45) print(scope.sx) print(scope.sy) print(scope.sz)";
    assert_eq!(tree(&format!("Lot --> {sizes}")).messages, ["10", "3", "6"]);
}

#[test]
fn eaves_that_hang_over() {
    // Half a metre out at 45 degrees, a quarter over the gables: eaves 7 m apart, 10.5 m long.
    let down = 0.5f64.sqrt();
    let gable = format!("roofGable(45, {down}, 0.25)");
    assert_eq!(volume(&gable), 7.0 * 3.5 / 2.0 * 10.5);
    let found = tree(&format!("Lot --> {gable} print(scope.ty) print(scope.sx)"));
    assert_eq!(found.messages, ["-0.5", "10.5"]);
    let truth = 7.0 * 3.5 * (3.0 * 11.0 - 7.0) / 6.0;
    assert!((volume(&format!("roofHip(45, {down})")) - truth).abs() < 1e-6);
    // The height is that over the face, with or without an overhang.
    let found = tree("Lot --> roofHip(byHeight, 3, 1) print(scope.ty + scope.sy)");
    assert_eq!(found.messages, ["3"]);
}

#[test]
fn envelopes() {
    // 10 by 6 to 8 by 4 within a metre.
    let frustum = (60.0 + 4.0 * 45.0 + 32.0) / 6.0;
    let rounded = |v: f64| (v * 1e6).round() / 1e6;
    assert_eq!(
        volume("envelope(normal, 1, 0, 45, 0, 45, 0, 45)"),
        rounded(frustum)
    );
    let walls = "envelope(world.up, 4, 3, 45, 3, 45, 3, 45, 3, 45)";
    assert_eq!(volume(walls), rounded(180.0 + frustum));
    // The front leans from a metre on: 6, 6, 5 and 4 m deep.
    assert_eq!(volume("envelope(normal, 3, 1, 45)"), 160.0);
    assert_eq!(
        volume("envelope(normal, 3, [1, 9, 9, 9], [45, 90, 90, 90])"),
        160.0
    );
}

#[test]
fn a_mansard_of_two_slopes() {
    // A hip roof cut at 1 m is 8 by 4 on top, and carries another.
    let text = "Lot --> roofHip(45) split(y) { 1 : Low | ~1 : NIL }
                Low --> comp(f) { top && horizontal : Top | all : NIL }
                Top --> A. roofHip(byHeight, 1) B.";
    let found = tree(text);
    assert_eq!(areas(&found, "B").len(), 1);
    assert!(
        (areas(&found, "A")[0] - 32.0).abs() < 1e-6,
        "{:?}",
        areas(&found, "A")
    );
    let upper = &support::mesh_of(&found, "B")[0];
    assert!(upper.is_closed());
    assert!((upper.volume() - 4.0 * (24.0 - 4.0) / 6.0).abs() < 1e-6);
    // The same from an envelope that stops.
    let text = "Lot --> envelope(normal, 1, 0, 75, 0, 75, 0, 75) Low
                Low --> comp(f) { horizontal && top : roofHip(30) B. | all = A. }";
    assert!(support::mesh_of(&tree(text), "B")[0].is_closed());
}

#[test]
fn faults_say_what_is_wrong() {
    assert!(fault("Lot --> roofShed(0)").contains("a slope"));
    assert!(fault("Lot --> roofHip(45, -1)").contains("from 0 on"));
    assert!(fault("Lot --> roofHip(45, 0, true)").contains("even"));
    assert!(fault("Lot --> roofPyramid(\"steep\", 1)").contains("byAngle"));
    assert!(fault("Lot --> envelope(normal, 1, 1, 0)").contains("a slope"));
    assert!(fault("Lot --> envelope(normal, 1, [1], [1])").contains("1 numbers for 4"));
    let wall = "Lot --> extrude(1) comp(f) { front : envelope(world.up, 1, 0, 9) | all : NIL }";
    assert!(fault(wall).contains("not level"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn all_of_them_are_closed(radii in prop::collection::vec(2.0..9.0f64, 3..14), angle in 5.0..80.0f64, edge in 0..20) {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(k, r): (usize, &f64)| {
            let angle = step * k as f64;
            (r * angle.cos(), r * angle.sin())
        };
        let ring: Vec<(f64, f64)> = radii.iter().enumerate().map(corner).collect();
        for text in [
            format!("taper({angle})"),
            format!("roofPyramid({angle})"),
            format!("roofShed({angle}, {edge})"),
            format!("roofRidge(byAngle, {angle})"),
            format!("roofGable({angle}, 0.3, 0.2)"),
            format!("roofHip({angle}, 0.3)"),
            format!("envelope(normal, 3, 1, {angle}, 2, {angle})"),
        ] {
            if let Ok(found) = derived(&format!("Lot --> {text}"), lot_of(&[&ring])) {
                let (_, volume) = solid(&found);
                prop_assert!(volume > 0.0, "{text}");
            }
        }
    }
}
