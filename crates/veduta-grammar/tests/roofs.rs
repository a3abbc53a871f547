//! What stands on faces: hand-worked volumes.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support;

use crate::support::{areas, derived, fault, lot_of, said, solid, tree};
use proptest::prelude::*;

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
fn gables_where_they_are_wanted() {
    // The front is the first edge: the ridge runs from there to the back, 5 m up.
    let across = 10.0 * 5.0 / 2.0 * 6.0;
    assert_eq!(volume("roofGable(45, 0, 0, false, 0)"), across);
    assert_eq!(volume("roofGable(byAngle, 45, 0, 0, false, 2)"), across);
    assert_eq!(volume("roofGable(45, 0, 0, false, 1)"), 90.0);
    assert_eq!(volume("roofGable(45, 0, 0, false, [0, 2])"), across);
    assert_eq!(volume("roofGable(45, 0, 0, false, [1])"), 90.0 - 9.0);
    // Wings 6 m and 2 m wide under ridges of one height: the gables are over each other.
    let l: &[(f64, f64)] = &[(0., 0.), (12., 0.), (12., 2.), (6., 2.), (6., 8.), (0., 8.)];
    for text in [
        "roofHip(45, 0, true)",
        "roofGable(45, 0, 0, true)",
        "roofHip(byHeight, 3, 0, true)",
    ] {
        let found = derived(&format!("Lot --> {text}"), lot_of(&[l])).unwrap();
        let (mesh, _) = solid(&found);
        let level = |y: f64| y.abs() < 1e-9 || (y - 3.0).abs() < 1e-9;
        assert!(mesh.points.iter().all(|p| level(p.y)), "{text}");
    }
}

#[test]
fn roofs_of_our_own() {
    let down = 0.5f64.sqrt();
    // A frustum 10 by 6 to 8 by 4 m, 1 m high, and a hip roof 1 m high.
    let frustum = (60.0 + 4.0 * 45.0 + 32.0) / 6.0;
    let mansard = frustum + 4.0 * (24.0 - 4.0) / 6.0;
    let upper = 0.5f64.atan().to_degrees();
    for (text, truth) in [
        (format!("roofMansard(45, {upper}, 1)"), mansard),
        (format!("roofGambrel(45, {upper}, 1)"), 10.0 * (5.0 + 2.0)),
        (
            "roofHalfHip(45, 0.5)".into(),
            90.0 - 2.0 * (3.0 * 1.5 / 2.0) * 1.5 / 3.0,
        ),
        ("roofHalfHip(byHeight, 3, 0.5)".into(), 90.0 - 2.25),
        ("roofDutch(45, 0.5)".into(), 72.0 + 2.25),
        ("roofSaltbox(45, 45)".into(), 90.0),
        (format!("roofSaltbox(45, {upper})"), 10.0 * 6.0 * 2.0 / 2.0),
        (format!("roofSaltbox(45, {upper}, 0, 0, 2)"), 60.0),
        ("roofPerEdge([45, 90, 45, 90])".into(), 90.0),
        (
            format!("roofPerEdge([45, 90, 45, 90], {down}, 0.25)"),
            7.0 * 3.5 / 2.0 * 10.5,
        ),
        ("roofSkillion(byHeight, 3)".into(), 90.0),
        ("roofSkillion(byHeight, 3, 90)".into(), 90.0),
        ("roofButterfly(45)".into(), 10.0 * 6.0 * (0.3 + 1.5)),
        ("roofCrossGable(byHeight, 3)".into(), 60.0 * 2.0),
        ("roofSawtooth(45, 3)".into(), 60.0 * (0.2 + 1.0)),
        ("roofSawtooth(45, 5, 0, 1)".into(), 60.0 * (0.2 + 1.0)),
        ("roofFlat(1, 1, 0.5)".into(), 60.0 * 0.5 + 28.0),
        ("roofVault(3, 0, 0, 2)".into(), 10.0 * vault_section()),
    ] {
        let found = volume(&text);
        assert!((found - truth).abs() < 1e-5, "{text}: {found}, not {truth}");
    }
    for text in [
        "roofDome(3)",
        "roofOnion(5)",
        "roofDome(3, 0.2, 4)",
        "roofFlat(1, 0.3)",
    ] {
        assert!(volume(text) > 0.0, "{text}");
    }
}

/// Half a circle of 3 m in four straight pieces (m2).
fn vault_section() -> f64 {
    let (x, y) = (3.0 - 3.0 * 0.5f64.sqrt(), 3.0 * 0.5f64.sqrt());
    x * y + (3.0 - x) * (y + 3.0)
}

#[test]
fn faces_of_a_roof_are_told_apart() {
    let cells = "comp(f) { isTagged(\"roof.side\") : Gable. | isTagged(\"roof.bottom\") : Floor. | all : Slope. }";
    for roof in ["roofGable(45)", "roofGambrel(80, 20, 1)", "roofVault(3)"] {
        let found = tree(&format!("Lot --> {roof} {cells}"));
        assert_eq!(areas(&found, "Floor").len(), 1, "{roof}");
        assert_eq!(areas(&found, "Gable").len(), 2, "{roof}");
    }
    let found = tree(&format!("Lot --> roofGable(45) {cells}"));
    assert_eq!(areas(&found, "Gable"), [9.0, 9.0]);
    assert_eq!(areas(&found, "Slope").len(), 2);
    // What is made of a face is no roof.
    let again = "Lot --> roofHip(45) comp(f) { isTagged(\"roof.top\") : extrude(1) comp(f) { isTagged(\"roof.side\") : Bad. | isTagged(\"roof.top\") : Good. } | all : NIL }";
    assert_eq!(areas(&tree(again), "Bad").len(), 0);
    assert_eq!(areas(&tree(again), "Good").len(), 4 * 6 - 2);
    // Joined faces carry the tag, too.
    let joined = "Lot --> roofGable(45) comp(f) { isTagged(\"roof.side\") = case isTagged(\"roof.side\") : Gables. else : Bad. }";
    assert_eq!(areas(&tree(joined), "Gables"), [18.0]);
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
fn edges_without_numbers_of_their_own_are_walls() {
    // The front leans from 3 m on, by 3 m up to the top: 10 m by 36 m2 less 4.5 m2.
    let found = said("Lot --> envelope(normal, 6, [3], [45]) print(geometry.volume)");
    assert_eq!(found, ["315"]);
}

#[test]
fn there_are_no_more_walls_or_angles_than_edges() {
    for arrays in ["[3, 3, 3, 3, 3], [45]", "[3], [45, 45, 45, 45, 45]"] {
        let told = fault(&format!("Lot --> envelope(normal, 6, {arrays})"));
        assert!(told.contains("5 numbers for 4 edges"), "{arrays}: {told}");
    }
}

#[test]
fn faults_say_what_is_wrong() {
    assert!(fault("Lot --> roofShed(0)").contains("a slope"));
    assert!(fault("Lot --> roofHip(45, -1)").contains("from 0 on"));
    assert!(fault("Lot --> roofHip(45, 0, 1)").contains("true or false"));
    assert!(fault("Lot --> roofGable(45, 0, 0, false, 4)").contains("from 0 to 3"));
    assert!(fault("Lot --> roofGable(45, 0, 0, false, 1, 2)").contains("5 are the most"));
    assert!(fault("Lot --> roofDutch(45, 1)").contains("between 0 and 1"));
    assert!(fault("Lot --> roofDutch(byAngle, 45)").contains("a share"));
    assert!(fault("Lot --> roofSawtooth(45, 0)").contains("a count"));
    assert!(fault("Lot --> roofPerEdge([45, 45])").contains("there are 2 values for 4 edges"));
    assert!(fault("Lot --> roofPerEdge([90, 90, 90, 90])").contains("not upright"));
    assert!(fault("Lot --> roofFlat(0, 1)").contains("above 0"));
    assert!(fault("Lot --> roofMansard(70, 95, 2)").contains("a slope"));
    assert!(fault("Lot --> roofPyramid(\"steep\", 1)").contains("byAngle"));
    assert!(fault("Lot --> envelope(normal, 1, 1, 0)").contains("a slope"));
    let wall = "Lot --> extrude(1) comp(f) { front : envelope(world.up, 1, 0, 9) | all : NIL }";
    assert!(fault(wall).contains("not level"));
}

#[test]
fn half_hips_over_two_walls_in_one_line() {
    // A slit parts the wall, so that its gables end at two heights; between the slopes above them
    // there is an upright step.
    let ring: &[(f64, f64)] = &[
        (0.1, 0.1),
        (0.1, -5.987746351021138),
        (9.0, 0.0),
        (-1.0, 1.7320508075688767),
        (-5.0, -9.418926844302916),
        (-0.1, -6.122302448796913),
        (-0.1, 0.1),
    ];
    let found = derived("Lot --> roofHalfHip(1, 0.3, 1)", lot_of(&[ring])).unwrap();
    let (mesh, _) = solid(&found);
    assert!(mesh.is_closed());
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
            format!("roofMansard({angle}, 20, 1, 0.3)"),
            format!("roofGambrel({angle}, 20, 1, 0.3, 0.2)"),
            format!("roofHalfHip({angle}, 0.4, 0.3)"),
            format!("roofDutch({angle}, 0.6, 0.3)"),
            format!("roofSaltbox({angle}, 30, 0.3)"),
            format!("roofSkillion({angle}, {edge}, 0.3)"),
            format!("roofButterfly({angle}, 0.3)"),
            format!("roofCrossGable({angle}, 0.3)"),
            format!("roofSawtooth({angle}, {})", edge + 1),
            "roofDome(3, 0.3)".to_owned(),
            "roofOnion(5, 0.3)".to_owned(),
            "roofVault(3, 0.3, 0.2)".to_owned(),
            "roofFlat(1, 0.3, 0.2, 0.3)".to_owned(),
            format!("envelope(normal, 3, 1, {angle}, 2, {angle})"),
        ] {
            if let Ok(found) = derived(&format!("Lot --> {text}"), lot_of(&[&ring])) {
                let (_, volume) = solid(&found);
                prop_assert!(volume > 0.0, "{text}");
            }
        }
    }
}
