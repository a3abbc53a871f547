//! Edges of faces that move: hand-worked areas.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{areas, derived, fault, lot_of, mesh_of, said, tree};
use proptest::prelude::*;

#[test]
fn strips_along_the_chosen_edges() {
    let found = tree("Lot --> setback(2) { front : A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![20.0], vec![40.0])
    );
    let found = tree("Lot --> setback(1) { all : A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![28.0], vec![32.0])
    );
    let found = tree("Lot --> setback(1) { front : A. | back : A. | side = C. }");
    assert_eq!(areas(&found, "A"), [9.0, 9.0]);
    assert_eq!(areas(&found, "C"), [10.0]);
    // All of the face is within 3 m of its front or back.
    let found = tree("Lot --> setback(3) { front : A. | back : A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![30.0, 30.0], vec![])
    );
}

#[test]
fn each_edge_by_its_own_distance() {
    let found =
        tree("Lot --> setback(comp(fe) { front : 2 | left : 4 }) { all = A. | remainder : B. }");
    assert_eq!(areas(&found, "B"), [24.0]);
    // Front, right, back, left: 0 to 3 m.
    let found = tree("Lot --> setbackPerEdge(comp.index) { all = A. | remainder : B. }");
    assert_eq!(areas(&found, "B"), [24.0]);
    let found = tree("Lot --> setbackPerEdge('0.25) { front = A. | remainder : B. }");
    assert_eq!(areas(&found, "A"), [25.0]);
}

#[test]
fn the_distance_for_an_area() {
    let found = tree("Lot --> setbackToArea(32) { all = NIL | remainder : B. }");
    assert_eq!(areas(&found, "B"), [32.0]);
    let found = tree("Lot --> setbackToArea(45) { front = A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![15.0], vec![45.0])
    );
    // A metre at the front at least: 1 + d and d at the back leave 10 by 5 - 2 d.
    let least = "comp(fe) { front : 1 }";
    let found = tree(&format!(
        "Lot --> setbackToArea(30, {least}) {{ front : A. | back : C. | remainder : B. }}"
    ));
    assert_eq!(
        (areas(&found, "A"), areas(&found, "C")),
        (vec![20.0], vec![10.0])
    );
    let found = tree("Lot --> setbackToArea(99) { all = A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![], vec![60.0])
    );
}

#[test]
fn wings() {
    let found = tree("Lot --> shapeL(2, 3) { shape : A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![32.0], vec![28.0])
    );
    assert_eq!(mesh_of(&found, "A")[0].corner_count(), 6);
    let found = tree("Lot --> shapeU(2, 1, 3) { remainder : B. | shape : A. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![36.0], vec![24.0])
    );
    let found = tree("Lot --> shapeO(1, 2, 1, 1) { shape : A. | remainder : B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![32.0], vec![28.0])
    );
    assert_eq!(mesh_of(&found, "A")[0].face(0).ring_count(), 2);
}

#[test]
fn faces_that_shrink_and_grow() {
    for (text, truth) in [
        ("offset(-1, inside)", 32.0),
        ("offset(-1, border)", 28.0),
        ("offset(-1)", 60.0),
        ("offset(1, inside)", 96.0),
        ("offset(1, border)", 36.0),
        ("offset(1)", 96.0),
        ("offset(-3, inside)", 0.0),
        ("offset(0)", 60.0),
    ] {
        let found = tree(&format!("Lot --> {text} A."));
        assert_eq!(areas(&found, "A"), [truth], "{text}");
    }
    let found = tree("Lot --> offset(-1) comp(f) { inside : A. | border = B. }");
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![32.0], vec![28.0])
    );
    let first = found.leaves().next().unwrap();
    assert!((first.state.form.scope.size.x - 8.0).abs() < 1e-9);
}

#[test]
fn the_largest_rectangles() {
    let l = || {
        lot_of(&[&[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 3.0),
            (4.0, 3.0),
            (4.0, 9.0),
            (0.0, 9.0),
        ]])
    };
    let text = "Lot --> innerRectangle(scope) { shape : A. | remainder = B. }";
    let found = derived(text, l()).unwrap();
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![36.0], vec![18.0])
    );
    let turned = lot_of(&[&[(0.0, 0.0), (4.0, 3.0), (1.0, 7.0), (-3.0, 4.0)]]);
    let text = "Lot --> alignScopeToAxes() innerRectangle(edge) { shape : A. | remainder : B. }";
    let found = derived(text, turned).unwrap();
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![25.0], vec![])
    );
}

#[test]
fn parts_by_their_area() {
    let triangle = || lot_of(&[&[(0.0, 0.0), (8.0, 0.0), (0.0, 6.0)]]);
    let text = "Lot --> splitArea(x) { 18 : A. | ~1 : B. }";
    let found = derived(text, triangle()).unwrap();
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![18.0], vec![6.0])
    );
    // Half as long, a quarter of the area.
    let last = found.leaves().last().unwrap().state.form.scope.size.x;
    assert!((last - 4.0).abs() < 1e-9, "{last}");
    let found = derived("Lot --> splitArea(x) { { ~5 : A. }* }", triangle()).unwrap();
    assert_eq!(areas(&found, "A"), [4.8; 5]);
    let found = tree("Lot --> extrude(3) splitArea(y) { '0.5 : A. | ~1 : B. }");
    assert!(mesh_of(&found, "B")[0].is_closed());
}

#[test]
fn selectors_of_the_world_and_the_start() {
    // The lot is turned: its first edge runs north, so its front looks west.
    let turned = || lot_of(&[&[(0.0, 0.0), (0.0, 10.0), (6.0, 10.0), (6.0, 0.0)]]);
    for (selector, truth) in [
        ("world.west", 10.0),
        ("world.south", 6.0),
        ("world.side", 32.0),
        ("object.side", 32.0),
        ("street.front || street.back", 20.0),
        ("!world.north && !world.south", 20.0),
        ("border", 32.0),
        ("-1", 6.0),
    ] {
        let text = format!("Lot --> comp(fe) {{ {selector} : print(scope.sx) E. }}");
        let found = derived(&text, turned()).unwrap();
        let sum: f64 = found
            .messages
            .iter()
            .map(|m| m.parse::<f64>().unwrap())
            .sum();
        assert!((sum - truth).abs() < 1e-9, "{selector}: {sum}");
    }
    let solid = "Lot --> extrude(3) comp(e) { ";
    for (selector, truth) in [("vertical", 4), ("all", 12), ("inside", 12), ("border", 0)] {
        let found = tree(&format!("{solid} {selector} : E. }}"));
        assert_eq!(found.leaves.len(), truth, "{selector}");
    }
}

#[test]
fn edges_of_roofs() {
    // Eaves of 32 m, a ridge of 4 m, four hips of sqrt(3 * 9) m.
    for (selector, truth) in [
        ("eave", 32.0),
        ("ridge", 4.0),
        ("hip", 4.0 * 27f64.sqrt()),
        ("valley", 0.0),
    ] {
        let text = format!("Lot --> roofHip(45) comp(e) {{ {selector} : print(scope.sx) E. }}");
        let sum: f64 = tree(&text)
            .messages
            .iter()
            .map(|m| m.parse::<f64>().unwrap())
            .sum();
        assert!((sum - truth).abs() < 1e-6, "{selector}: {sum}");
    }
    let l = lot_of(&[&[
        (0.0, 0.0),
        (9.0, 0.0),
        (9.0, 4.0),
        (4.0, 4.0),
        (4.0, 9.0),
        (0.0, 9.0),
    ]]);
    let found = derived("Lot --> roofHip(30) comp(e) { valley : E. }", l).unwrap();
    assert_eq!(found.leaves.len(), 1);
    for (selector, count) in [
        ("aslant", 4),
        ("horizontal", 1),
        ("vertical", 0),
        ("nutant", 0),
    ] {
        let found = tree(&format!(
            "Lot --> roofHip(30) comp(f) {{ {selector} : F. }}"
        ));
        assert_eq!(found.leaves.len(), count, "{selector}");
    }
}

#[test]
fn conditions_choose() {
    let found = tree("Lot --> extrude(3) comp(f) { geometry.area > 25 && side : A. | all : B. }");
    assert_eq!((areas(&found, "A").len(), areas(&found, "B").len()), (2, 4));
}

#[test]
fn edges_without_a_distance_of_their_own_stand() {
    let areas = "{ all = print(geometry.area) NIL | remainder : print(geometry.area) NIL }";
    let found = |distances: &str| said(&format!("Lot --> setback({distances}) {areas}"));
    // The first edge is 10 m long; a fifth distance is that of no edge.
    assert_eq!(found("[1]"), ["10", "50"]);
    assert_eq!(found("[1, 0, 0, 0, 7]"), ["10", "50"]);
    let missing = found("[1, ln(-1)]");
    assert!(
        missing[0].contains("0 stands for a value that is NaN"),
        "{missing:?}"
    );
    assert_eq!(missing[1..], ["10", "50"]);
}

#[test]
fn edges_are_selected_by_the_texture() {
    // u along x and v along z, to the front; layer 1 has u along z.
    let texture =
        "setupProjection(0, scope.xz, 1, 1) projectUV(0) setupProjection(1, scope.zx, 1, 1) \
                   projectUV(1)";
    let strip = |operation: &str, selector: &str| {
        let cells = format!("{{ {selector} = print(geometry.area) NIL }}");
        said(&format!("Lot --> {texture} {operation} {cells}"))
    };
    for (operation, selector, area) in [
        ("setback(1)", "uv.right", "6"),
        ("setback(1)", "uv.top", "10"),
        ("setback(1, 1)", "uv.right", "10"),
        ("setback(1, 1)", "uv.bottom", "6"),
        ("setbackPerEdge(1, 1)", "uv.top", "6"),
        ("setbackToArea(50)", "uv.bottom", "10"),
        ("setbackToArea(48, 1)", "uv.top", "12"),
        ("setbackToArea(48, [0, 0, 0, 0], 1)", "uv.top", "12"),
    ] {
        assert_eq!(strip(operation, selector), [area], "{operation} {selector}");
    }
    let sides = "comp(fe) { uv.side : print(scope.sx) NIL | all : NIL }";
    assert_eq!(said(&format!("Lot --> {texture} {sides}")), ["6", "6"]);
    // Faces look to no side of what lies on them.
    assert!(said(&format!(
        "Lot --> {texture} comp(f) {{ uv.top : print(1) NIL }}"
    ))
    .is_empty());
}

#[test]
fn faults_say_what_is_wrong() {
    assert!(fault("Lot --> setback(-1) { all : A. }").contains("from 0 on"));
    assert!(fault("Lot --> comp(f) { uv.uMin : A. }").contains("selects no component"));
    assert!(fault("Lot --> primitiveCube(1e300, 1, 1) s(1e9, 1e9, 1e15)").contains("beyond"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn nothing_is_lost(radii in prop::collection::vec(2.0..9.0f64, 3..14), by in 0.05..4.0f64) {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(k, r): (usize, &f64)| {
            let angle = step * k as f64;
            (r * angle.cos(), r * angle.sin())
        };
        let ring: Vec<(f64, f64)> = radii.iter().enumerate().map(corner).collect();
        let whole = areas(&derived("Lot --> A.", lot_of(&[&ring])).unwrap(), "A")[0];
        for text in [
            "setback(D) { front : A. | left = A. | remainder : A. }",
            "shapeU(D, D, D) { shape : A. | remainder : A. }",
            "innerRectangle(edge) { shape : A. | remainder : A. }",
            "splitArea(z) { D : A. | ~1 : A. }",
        ] {
            let text = format!("Lot --> {}", text.replace('D', &by.to_string()));
            if let Ok(found) = derived(&text, lot_of(&[&ring])) {
                let sum: f64 = areas(&found, "A").iter().sum();
                prop_assert!((sum - whole).abs() < 1e-4, "{text}: {sum} of {whole}");
            }
        }
    }
}
