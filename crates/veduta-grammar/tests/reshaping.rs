//! Geometry anew, modified parts, pivots and texture splits: hand-worked truth and properties.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{areas, derived, fault, lot_of, mesh_of, said, tree};
use proptest::prelude::*;

fn print(operations: &str, values: &[&str]) -> Vec<String> {
    let all: String = values
        .iter()
        .map(|value| format!(" print({value})"))
        .collect();
    said(&format!("Lot --> {operations}{all}"))
}

#[test]
fn the_start_shape_comes_back() {
    let values = ["geometry.area", "scope.ty", "material.color.g"];
    let found = print(
        "color(1, 0, 0) t(1, 2, 3) extrude(3) resetGeometry()",
        &values,
    );
    assert_eq!(found, ["60", "0", "0"]);
}

#[test]
fn footprints() {
    let values = ["geometry.area", "geometry.nFaces", "scope.sy", "scope.ty"];
    assert_eq!(
        print("t(0, 2, 0) roofHip(45) footprint()", &values),
        ["60", "1", "0", "2"]
    );
    // A block over a corner of the lot, 6 m by 4 m, of which 2 m by 2 m are above it.
    let two = "inline { [ extrude(3) A. ] t(8, 5, 4) s(6, 1, 4) primitiveCube() }";
    assert_eq!(
        print(&format!("{two} footprint()"), &values),
        ["80", "1", "0", "0"]
    );
    let wall = "extrude(3) comp(f) { front : W | all : NIL } W --> t(0, 0, 0) alignScopeToAxes() footprint()";
    let found = tree(&format!("Lot --> {wall} X."));
    assert_eq!(areas(&found, "X"), [0.0]);
}

#[test]
fn what_is_not_seen_is_cleaned() {
    let values = ["geometry.nFaces", "geometry.nVertices", "geometry.area"];
    let halves = "inline split(x) { 5 : X. | 5 : X. }";
    assert_eq!(
        print(&format!("{halves} cleanupGeometry(all, 0)"), &values),
        ["1", "4", "60"]
    );
    assert_eq!(
        print(&format!("{halves} cleanupGeometry(edges, 0)"), &values),
        ["1", "6", "60"]
    );
    assert_eq!(
        print(&format!("{halves} cleanupGeometry(vertices, 0)"), &values),
        ["2", "6", "60"]
    );
    let twice = "inline { [ X. ] X. }";
    assert_eq!(
        print(&format!("{twice} cleanupGeometry(faces, 0)"), &values),
        ["1", "4", "60"]
    );
    // A step of 0.1 m in the outline goes where 0.2 m may.
    let step = lot_of(&[&[
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 6.0),
        (5.0, 6.0),
        (5.0, 6.1),
        (0.0, 6.1),
    ]]);
    let found = derived(
        "Lot --> cleanupGeometry(all, 0.2) print(geometry.nVertices)",
        step,
    )
    .unwrap();
    assert_eq!(found.messages, ["4"]);
    assert!(fault("Lot --> cleanupGeometry(all, 2)").contains("from 0 to 1"));
}

#[test]
fn outlines_are_squared() {
    let slanted = lot_of(&[&[(0.0, 0.0), (10.0, 0.5), (10.0, 6.0), (0.0, 6.0)]]);
    let text = "Lot --> alignScopeToAxes() rectify(10) print(geometry.area) print(geometry.isRectangular(0))";
    let found = derived(text, slanted.clone()).unwrap();
    // The southern edge comes to its middle: 0.25 m.
    assert_eq!(found.messages, ["57.5", "true"]);
    let text = "Lot --> alignScopeToAxes() rectify(1) print(geometry.area) print(geometry.isRectangular(0))";
    assert_eq!(derived(text, slanted).unwrap().messages, ["57.5", "false"]);
    assert!(fault("Lot --> extrude(3) rectify(10)").contains("solids"));
}

#[test]
fn modified_parts_take_the_rest_along() {
    // A frustum of 60 m2 and 15 m2, 3 m high.
    let taper = "extrude(3) modify(f) { top : s('0.5, '0.5, '1) center(xy) }";
    let values = [
        "geometry.volume",
        "geometry.isClosedSurface",
        "geometry.nFaces",
    ];
    assert_eq!(print(taper, &values), ["105", "true", "6"]);
    // Only the scope moves: 1 m up with all corners.
    let lifted = "extrude(3) modify(v, noAlign) { all : t(0, 1, 0) }";
    assert_eq!(
        print(lifted, &["geometry.volume", "scope.ty"]),
        ["180", "1"]
    );
    // The ridge of a gable roof: a wedge of the same section, however the ridge slides along.
    let slid = "roofGable(45) modify(e) { ridge : t(1, 0, 0) }";
    assert_eq!(print(slid, &values)[..2], ["90", "true"]);
    let open = "extrude(3) modify(f) { top : NIL }";
    assert_eq!(
        print(open, &["geometry.nFaces", "geometry.isClosedSurface"]),
        ["5", "false"]
    );
    let grown = "extrude(3) modify(f) { top : extrude(2) }";
    assert_eq!(print(grown, &["geometry.nFaces", "scope.sy"]), ["11", "5"]);
    let bent = "extrude(3) modify(v, noAlign) { 0 : t(0, -1, 0) }";
    assert_eq!(print(bent, &["geometry.isClosedSurface"]), ["true"]);
}

#[test]
fn pivots_come_to_corners() {
    let values = [
        "pivot.px",
        "pivot.pz",
        "scope.tx",
        "scope.sx",
        "scope.sz",
        "geometry.area",
    ];
    assert_eq!(
        print("setPivot(xyz, 0)", &values),
        ["0", "0", "0", "10", "6", "60"]
    );
    assert_eq!(
        print("setPivot(xyz, 2)", &values),
        ["10", "6", "0", "10", "6", "60"]
    );
    assert_eq!(
        print("setPivot(xyz, 1)", &values),
        ["10", "0", "0", "6", "10", "60"]
    );
    assert_eq!(
        print("setPivot(xyz, 2) t(1, 0, 0)", &["scope.tx", "pivot.oy"])[..1],
        ["1"]
    );
    assert_eq!(
        print("setPivot(xyz, 2) resetGeometry()", &["pivot.px"]),
        ["0"]
    );
    assert!(fault("Lot --> setPivot(xyz, 8)").contains("corner 8"));
}

#[test]
fn texture_splits_close_hollows() {
    // A room of 10 m by 6 m by 4 m, seen from within, in parts of 4 m and 6 m.
    let found = tree(
        "Lot --> setupProjection(0, scope.xz, 1, 1) projectUV(0) extrude(4) reverseNormals() \
         split(u) { 4 : A. | ~1 : B. }",
    );
    for (name, volume) in [("A", -96.0), ("B", -144.0)] {
        let meshes = mesh_of(&found, name);
        assert_eq!(meshes.len(), 1);
        assert!(meshes[0].is_closed(), "{name}");
        assert!((meshes[0].volume() - volume).abs() < 1e-9, "{name}");
    }
}

#[test]
fn splits_along_textures() {
    let tiles = "Lot --> setupProjection(0, scope.xz, 2, 3) projectUV(0)";
    let found = tree(&format!("{tiles} split(u) {{ 2 : A. | ~1 : B. }}"));
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![24.0], vec![36.0])
    );
    let found = tree(&format!(
        "{tiles} split(v, unitSpace) {{ 1 : A. | ~1 : B. }}"
    ));
    assert_eq!(
        (areas(&found, "A"), areas(&found, "B")),
        (vec![10.0], vec![50.0])
    );
    // Whole tiles, and what each part has of the texture.
    let found = said(&format!(
        "{tiles} split(u, uvSpace, 0) {{ 1 : print(geometry.uMin(0)) A. }}*"
    ));
    assert_eq!(found, ["0", "1", "2", "3", "4"]);
    let sides = "Lot --> extrude(3) comp(f) { left : S | all : NIL } S --> setupProjection(0, world.xy, 1, 1) \
                 projectUV(0) split(u) { 1 : A. }";
    assert_eq!(tree(sides).leaves.len(), 0);
}

#[test]
fn walls_end_where_the_next_begins() {
    // The wall of a box, 10 m by 3 m, made 14 m wide and 1 m thick: the mitres at its corners let
    // it be 10 m wide at the back and 12 m at the front.
    let wall = "extrude(3) comp(f) { front : W | all : NIL } \
                W --> s(14, '1, 0) center(x) extrude(1) trim() print(geometry.volume) print(geometry.isClosedSurface)";
    assert_eq!(said(&format!("Lot --> {wall}")), ["33", "true"]);
    // Level edges do not trim until they are asked to: then the top and bottom are mitred, too.
    let tall = wall.replace("s(14, '1, 0) center(x)", "s(14, 7, 0) center(xy)");
    assert_eq!(said(&format!("Lot --> {tall}"))[0], "77");
    let level = format!("Lot --> set(trim.horizontal, true) {tall}");
    // 10 m by 3 m at the back, 12 m by 5 m at the front, and the rule of the prismoid.
    let truth = (30.0 + 4.0 * 11.0 * 4.0 + 60.0) / 6.0;
    let found: f64 = said(&level)[0].parse().unwrap();
    assert!((found - truth).abs() < 1e-6, "{found} {truth}");
    let off = format!("Lot --> set(trim.vertical, false) print(trim.vertical) {wall}");
    assert_eq!(said(&off), ["false", "42", "true"]);
}

#[test]
fn children_keep_a_baked_texture() {
    let cells = "split(x) { 5 : X | 5 : X } X --> print(geometry.vMin(0))";
    assert_eq!(said(&format!("Lot --> {cells}")), ["0", "0"]);
    assert_eq!(said(&format!("Lot --> bakeUV(0) {cells}")), ["0", "0.5"]);
}

#[test]
fn materials_are_forgotten() {
    let text = "color(1, 0, 0) set(material.name, \"wall\") resetMaterial()";
    assert_eq!(
        print(text, &["material.color.g", "material.name"]),
        ["1", "wall"]
    );
}

#[test]
fn long_cuts_may_stay_away() {
    // From the dent to a far corner it is 7.7 m.
    let dented = || lot_of(&[&[(0.0, 0.0), (5.0, 0.1), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)]]);
    let faces = |text: &str| derived(text, dented()).unwrap().messages.remove(0);
    assert_eq!(faces("Lot --> convexify() print(geometry.nFaces)"), "2");
    assert_eq!(faces("Lot --> convexify(5) print(geometry.nFaces)"), "1");
    assert_eq!(faces("Lot --> convexify(8) print(geometry.nFaces)"), "2");
}

#[test]
fn too_many_parts_are_told_in_words() {
    let told = fault("Lot --> split(x) { { 1e-300 : A. }* }");
    assert!(told.contains("more than 100000 parts"), "{told}");
    let told = fault("Lot --> split(x) { { 0.00001 : A. }* }");
    assert!(told.contains("1000000 parts; 100000"), "{told}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn cleaning_keeps_the_volume(n in prop::array::uniform6(1u8..12)) {
        let [x, y, z, a, b, c] = n.map(|v| f64::from(v) * 0.5);
        let union = format!("extrude(3) union {{ t({x}, {y}, {z}) s({a}, {b}, {c}) primitiveCube() }}");
        let before = print(&union, &["geometry.volume"]);
        let after = print(&format!("{union} cleanupGeometry(all, 0)"), &["geometry.volume", "geometry.isClosedSurface"]);
        let [before, after_volume] = [&before[0], &after[0]].map(|text| text.parse::<f64>().unwrap());
        prop_assert!((before - after_volume).abs() < 1e-6 * before);
        prop_assert_eq!(&after[1], "true");
    }

    #[test]
    fn nearly_square_outlines_become_square(n in prop::array::uniform8(-0.3..0.3f64), width in 4.0..20.0f64, depth in 4.0..20.0f64) {
        let ring = [
            (n[0], n[1]), (width + n[2], n[3]), (width + n[4], depth + n[5]), (n[6], depth + n[7]),
        ];
        let text = "Lot --> alignScopeToAxes() rectify(20) print(geometry.isRectangular(0.001)) print(geometry.area)";
        let found = derived(text, lot_of(&[&ring])).unwrap().messages;
        prop_assert_eq!(&found[0], "true");
        // Each side goes through the middle it had.
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        let area = (mean(width + n[2], width + n[4]) - mean(n[0], n[6])) * (mean(depth + n[5], depth + n[7]) - mean(n[1], n[3]));
        let found: f64 = found[1].parse().unwrap();
        prop_assert!((found - area).abs() < 1e-6, "{found} {area}");
    }

    #[test]
    fn footprints_of_roofs_are_their_outlines(radii in prop::collection::vec(3.0..12.0f64, 3..10), angle in 5.0..70.0f64) {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(k, r): (usize, &f64)| (r * (step * k as f64).cos(), r * (step * k as f64).sin());
        let ring: Vec<(f64, f64)> = radii.iter().enumerate().map(corner).collect();
        let text = format!("Lot --> print(geometry.area) roofHip({angle}) footprint() print(geometry.area)");
        if let Ok(found) = derived(&text, lot_of(&[&ring])) {
            let area = |at: usize| found.messages[at].parse::<f64>().unwrap();
            prop_assert!((area(0) - area(1)).abs() < 1e-5 * area(0), "{:?}", found.messages);
        }
    }

    #[test]
    fn texture_splits_divide_the_area(size in 0.3..4.0f64, tile in 0.5..5.0f64, turn in 0.0..180.0f64) {
        let text = format!(
            "Lot --> setupProjection(0, scope.xz, {tile}, {tile}) projectUV(0) rotateUV(0, {turn}) \
             split(u, unitSpace) {{ {size} : A. }}*"
        );
        let sum: f64 = areas(&tree(&text), "A").iter().sum();
        prop_assert!((sum - 60.0).abs() < 1e-4, "{sum}");
    }
}
