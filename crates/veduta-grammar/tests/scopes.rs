//! Scopes, round shapes, points and tags: hand-worked truth.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{areas, derived, fault, lot_of, mesh_of, said, solid, tree};
use glam::DVec3;
use proptest::prelude::*;

fn volumes(text: &str, name: &str) -> Vec<f64> {
    let meshes = mesh_of(&tree(text), name);
    let rounded = |v: f64| (v * 1e6).round() / 1e6;
    meshes.iter().map(|mesh| rounded(mesh.volume())).collect()
}

#[test]
fn mirrored_geometry() {
    // A shed that rises to the left, and then to the right.
    let halves = "split(x) { 5 : A. | ~1 : A. }";
    let shed = "Lot --> roofShed(byHeight, 3, 1)";
    assert_eq!(volumes(&format!("{shed} {halves}"), "A"), [67.5, 22.5]);
    let found = format!("{shed} mirror(true, false, false) {halves}");
    assert_eq!(volumes(&found, "A"), [22.5, 67.5]);
    assert!(mesh_of(&tree(&found), "A")
        .iter()
        .all(|mesh| mesh.is_closed()));
    let down = tree("Lot --> mirror(false, true, false) A.");
    assert_eq!(mesh_of(&down, "A")[0].face(0).normal(), DVec3::NEG_Y);
    let turned = tree("Lot --> mirrorScope(true, false, true) t(1, 0, 0) A.");
    assert!((turned.leaves().next().unwrap().state.form.scope.origin.x - 9.0).abs() < 1e-9);
    let odd = said("Lot --> mirrorScope(true, false, false) print(scope.sx)");
    assert!(odd[0].contains("turned round"));
    assert_eq!(odd[1], "10");
}

#[test]
fn other_scopes_around_the_same_geometry() {
    let sizes = "print(scope.sx) print(scope.sy) print(scope.sz)";
    let turned = format!("Lot --> rotateScope(0, 90, 0) {sizes}");
    assert_eq!(said(&turned), ["6", "0", "10"]);
    assert_eq!(
        volumes(
            "Lot --> rotateScope(0, 90, 0) roofRidge(byHeight, 5) A.",
            "A"
        ),
        [150.0]
    );
    let lot = || lot_of(&[&[(0.0, 0.0), (8.0, 6.0), (5.0, 10.0), (-3.0, 4.0)]]);
    for (text, truth) in [
        ("alignScopeToAxes()", ["11", "0", "10"]),
        (
            "alignScopeToAxes() alignScopeToGeometryBBox(xz)",
            ["10", "0", "5"],
        ),
        (
            "alignScopeToAxes() alignScopeToGeometryBBox(zx)",
            ["5", "0", "10"],
        ),
        (
            "alignScopeToAxes() alignScopeToGeometry(yUp, 0, 0)",
            ["10", "0", "5"],
        ),
        (
            "alignScopeToAxes() alignScopeToGeometry(zUp, any, longest)",
            ["10", "5", "0"],
        ),
        (
            "alignScopeToAxes() alignScopeToGeometry(yUp, largest, 1)",
            ["5", "0", "10"],
        ),
        (
            "alignScopeToAxes() alignScopeToAxes(object.xyz)",
            ["10", "0", "5"],
        ),
    ] {
        let found = derived(&format!("Lot --> {text} {sizes}"), lot()).unwrap();
        assert_eq!(found.messages, truth, "{text}");
    }
}

#[test]
fn round_shapes() {
    // A square of 2 m2 on its corners.
    assert_eq!(volumes("Lot --> primitiveCylinder(4, 1, 3) A.", "A"), [6.0]);
    assert_eq!(volumes("Lot --> primitiveCone(4, 1, 3) A.", "A"), [2.0]);
    assert_eq!(areas(&tree("Lot --> primitiveDisk(4, 1) A."), "A"), [2.0]);
    let place = "primitiveDisk(4, 1) print(scope.tx) print(scope.tz) print(scope.sx)";
    assert_eq!(said(&format!("Lot --> {place}")), ["4", "2", "2"]);
    // 10 by 8 (the mean) by 6, with 16 sides.
    let whole = 480.0 * 2.0 * (std::f64::consts::TAU / 16.0).sin();
    let found = volumes("Lot --> primitiveCylinder() A.", "A");
    assert!((found[0] - whole).abs() < 1e-5);
    let (_, ball) = solid(&tree("Lot --> primitiveSphere(100, 50, 1)"));
    assert!((ball / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 2e-3);
    for wrong in [
        "primitiveDisk(2)",
        "primitiveSphere(1e9, 9)",
        "primitiveCone(3, -1, 1)",
    ] {
        assert!(!fault(&format!("Lot --> {wrong}")).is_empty());
    }
}

#[test]
fn holes_and_convex_pieces() {
    let court = || {
        lot_of(&[
            &[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)],
            &[(3.0, 3.0), (3.0, 5.0), (5.0, 5.0), (5.0, 3.0)],
        ])
    };
    let found = derived("Lot --> deleteHoles() A.", court()).unwrap();
    assert_eq!(areas(&found, "A"), [64.0]);
    let found = derived("Lot --> comp(h) { all : A. }", court()).unwrap();
    assert_eq!(areas(&found, "A"), [4.0]);
    let text = "Lot --> convexify() comp(f) { all : print(geometry.isConcave) A. }";
    let found = derived(text, court()).unwrap();
    assert!(found.messages.iter().all(|said| said == "false"));
    assert!(found.leaves.len() <= 8, "{}", found.leaves.len());
    assert!((areas(&found, "A").iter().sum::<f64>() - 60.0).abs() < 1e-6);
    let (_, volume) = solid(&derived("Lot --> extrude(2) convexify()", court()).unwrap());
    assert!((volume - 120.0).abs() < 1e-6);
}

#[test]
fn points_on_shapes() {
    let text = "Lot --> scatter(scope, 40, uniform) { X. }";
    let (one, other) = (tree(text), tree(text));
    assert_eq!(one.leaves.len(), 40);
    let places = |tree: &veduta_grammar::engine::Tree| -> Vec<DVec3> {
        tree.leaves()
            .map(|leaf| leaf.state.form.scope.origin)
            .collect()
    };
    assert_eq!(places(&one), places(&other));
    let inside = |p: &DVec3| (0.0..=10.0).contains(&p.x) && (0.0..=6.0).contains(&p.z);
    assert!(places(&one).iter().all(inside));
    // On the slopes of a roof, upright on them.
    let roof = tree("Lot --> roofGable(45) scatter(surface, 200, uniform) { X. }");
    assert_eq!(roof.leaves.len(), 200);
    let slope = 0.5f64.sqrt();
    let ups = roof
        .leaves()
        .map(|leaf| leaf.state.form.scope.axes.y_axis.y);
    let on_slope = ups.filter(|up| (up - slope).abs() < 1e-9).count();
    // Slopes have 84.9 of 162.9 m2: five standard deviations of 200 draws.
    assert!((on_slope as f64 - 104.2).abs() < 36.0, "{on_slope}");
    let front = tree("Lot --> scatter(surface, 300, gaussian, front, '0.1) { X. }");
    let mean = places(&front).iter().map(|p| p.z).sum::<f64>() / 300.0;
    // Half a bell of 0.6 m: its mean is 0.6 sqrt(2 / pi) from the front.
    assert!((6.0 - mean - 0.479).abs() < 0.15, "{mean}");
    assert!(fault("Lot --> scatter(scope, 1e9, uniform) { X. }").contains("points"));
    assert_eq!(
        tree("Lot --> scatter(scope, -3, uniform) { X. }")
            .leaves
            .len(),
        0
    );
}

#[test]
fn names_that_shapes_carry() {
    let text =
        "Lot --> [ tag(\"lot.a\") split(x) { 5 : Half | 5 : deleteTags(\"lot*\") Half } ] NIL
                Half --> print(isTagged(\"lot.a\") + \" \" + geometry.hasTags(\"*.a\")) \
                         print(size(geometry.tags)) A.";
    assert_eq!(said(text), ["true true", "1", "false false", "0"]);
    let text = "Lot --> tag(\"a\") comp(fe) { isTagged(\"a\") && front : A. | all = B. }";
    assert_eq!(tree(text).leaves.len(), 2);
}

#[test]
fn texture_coordinates() {
    let ends = "print(geometry.uMin(0)) print(geometry.uMax(0)) print(geometry.vMin(0)) \
                print(geometry.vMax(0))";
    let front = "Lot --> extrude(3) comp(f) { front : F | all : NIL } F --> ";
    for (text, truth) in [
        ("", ["0", "1", "0", "1"]),
        (
            "setupProjection(0, scope.xy, 2, 1.5) projectUV(0)",
            ["0", "5", "0", "2"],
        ),
        (
            "setupProjection(0, scope.xy, '0.5, ~1.4) projectUV(0)",
            ["0", "2", "0", "2"],
        ),
        (
            "setupProjection(0, scope.xy, 2, 1, 1, -1) projectUV(0)",
            ["-0.5", "4.5", "1", "4"],
        ),
        (
            "setupProjection(0, world.xy, -2, 1) projectUV(0)",
            ["-5", "0", "0", "3"],
        ),
        ("tileUV(0, ~3, 1)", ["0", "3", "0", "3"]),
        ("tileUV(0, 0, 1.5)", ["0", "1", "0", "2"]),
        (
            "scaleUV(0, 4, 2) translateUV(0, 1, 0.5)",
            ["1", "5", "0.5", "2.5"],
        ),
        ("scaleUV(0, 4, 2) rotateUV(0, 90)", ["-2", "0", "0", "4"]),
        (
            "scaleUV(0, 4, 2) normalizeUV(0, uvUniform, collectiveAllFaces)",
            ["0", "1", "0", "0.5"],
        ),
        (
            "translateUV(0, 3, 3) normalizeUV(0, u, separatePerFace)",
            ["0", "1", "3", "4"],
        ),
        ("scaleUV(0, 4, 2) deleteUV(0)", ["0", "1", "0", "1"]),
        ("scaleUV(1, 4, 2) copyUV(1, 0)", ["0", "4", "0", "2"]),
        // Textures go with the shape that they lie on.
        (
            "scaleUV(0, 4, 2) t(1, 2, 3) r(10, 20, 30) s(7, 8, 0)",
            ["0", "4", "0", "2"],
        ),
        // What is prepared stays where it was.
        (
            "setupProjection(0, scope.xy, 2, 1) t(7, 7, 7) projectUV(0)",
            ["3.5", "8.5", "7", "10"],
        ),
        (
            "scaleUV(0, 4, 2) mirror(true, false, false)",
            ["0", "4", "0", "2"],
        ),
    ] {
        assert_eq!(said(&format!("{front} {text} {ends}")), truth, "{text}");
    }
    // Children have the map of their parent, and share a corner there.
    let text = format!("{front} scaleUV(0, 4, 2) split(x) {{ 2.5 : NIL | ~1 : {ends} }}");
    assert_eq!(said(&text), ["1", "4", "0", "2"]);
    let text = "print(geometry.du(0, uvSpace)) print(geometry.du(0, unitSpace))";
    assert_eq!(
        said(&format!("{front} scaleUV(0, 4, 2) {text}")),
        ["4", "10"]
    );
    // Where nothing was set up, a picture lies over the scope.
    let text =
        "Lot --> extrude(4) comp(f) { front : projectUV(0) print(geometry.uMax(0)) A. | all : A. }";
    assert_eq!(said(text), ["1"]);
    assert!(fault("Lot --> scaleUV(10, 1, 1)").contains("no texture layer"));
    assert!(fault("Lot --> setupProjection(0, scope.xz, 0, 1)").contains("0 m"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the frame, what is in it stays where it is.
    #[test]
    fn scopes_leave_geometry_alone(x in -180.0..180.0f64, y in -180.0..180.0f64, z in -180.0..180.0f64) {
        let text = format!("Lot --> roofShed(30, 2) A. rotateScope({x}, {y}, {z}) B. \
                            alignScopeToGeometryBBox(xy) B. alignScopeToGeometry(zUp, any, world.lowest) B.");
        let found = tree(&text);
        let truth = mesh_of(&found, "A")[0].bounds().unwrap();
        for mesh in mesh_of(&found, "B") {
            let (low, high) = mesh.bounds().unwrap();
            prop_assert!(low.abs_diff_eq(truth.0, 1e-6) && high.abs_diff_eq(truth.1, 1e-6));
            prop_assert!(mesh.is_closed());
        }
    }
}

#[test]
fn a_size_below_zero_mirrors_at_the_origin() {
    let told = |rules: &str| said(&format!("Lot --> {rules}"));
    let behind = "print(scope.sz) print(scope.tz) print(geometry.area)";
    // The lot is 10 m by 6 m.
    assert_eq!(
        told(&format!("s('1, '1, '-0.5) {behind}")),
        ["3", "-3", "30"]
    );
    let inside_out =
        "extrude(2) s('1, '1, '-1) comp(f) { object.top : A } A --> print(scope.elevation)";
    assert_eq!(told(inside_out), ["0"]);
    let twice =
        "extrude(2) s('-1, '1, '-1) comp(f) { object.top : A } A --> print(scope.elevation)";
    assert_eq!(told(twice), ["2"]);
    let beam = "comp(f) { all : A } A --> s('1, '1, -0.2) primitiveCube() print(scope.sz)";
    assert_eq!(told(beam), ["0.2"]);
}
