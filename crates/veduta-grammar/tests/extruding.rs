//! `extrude` of shapes that are no level sheet, against volumes worked out by hand.

use crate::support::said;

fn numbers(operations: &str, values: &[&str]) -> Vec<f64> {
    let asked: Vec<String> = values
        .iter()
        .map(|value| format!("print({value})"))
        .collect();
    let found = said(&format!("Lot --> {operations} {}", asked.join(" ")));
    let number = |told: &String| match told.as_str() {
        "true" => 1.0,
        told => told.parse::<f64>().unwrap_or(f64::NAN),
    };
    found.iter().map(number).collect()
}

fn assert_near(found: &[f64], truth: &[f64], what: &str) {
    let near =
        found.len() == truth.len() && found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(near, "{what}: {found:?} and not {truth:?}");
}

const SOLID: [&str; 2] = ["geometry.volume", "geometry.isClosedSurface"];

#[test]
fn a_level_top_is_measured_from_the_lowest_corner() {
    // 10 m by 6 m, rising by 2 m to the right: 1 m in the mean.
    let slope = "modify(fe) { right : t(0, 2, 0) X. }";
    for (extrude, volume) in [
        ("extrude(world.up, 5)", 300.0),
        ("extrude(world.up.flatTop, 5)", 240.0),
        ("extrude(world.up.flatTop, 0)", 60.0),
        ("extrude(world.up.flatTop, 1)", 60.0),
        ("extrude(world.up.flatTop, -5)", 240.0),
    ] {
        let found = numbers(&format!("{slope} {extrude}"), &SOLID);
        assert_near(&found, &[volume, 1.0], extrude);
    }
    let level = numbers("extrude(world.up.flatTop, 3)", &SOLID);
    assert_near(&level, &[180.0, 1.0], "a level sheet");
}

#[test]
fn faces_go_along_their_own_normals_and_corners_stay_together() {
    // Two slopes of 45 degrees, each 6 m by 5 m times the root of 2.
    let roof = "inline(recompose) split(x) { ~1 : A. | ~1 : A. } \
                modify(e, noAlign) { inside : t(0, 5, 0) X. }";
    let alone = numbers(&format!("{roof} extrude(1)"), &SOLID[..1]);
    assert_near(&alone, &[60.0 * 2f64.sqrt()], "face.normal");
    let same = numbers(&format!("{roof} extrude(face.normal, 1)"), &SOLID[..1]);
    assert_eq!(alone, same);
    // The ridge goes straight up by 1 m, the eaves out and up; or down, and in and down.
    for (height, eaves) in [(1.0, 11.0), (-1.0, 9.0)] {
        let together = numbers(&format!("{roof} extrude(vertex.normal, {height})"), &SOLID);
        let truth = 6.0 * (5.0 + eaves * 0.5f64.sqrt());
        assert_near(&together, &[truth, 1.0], "vertex.normal");
    }
}

#[test]
fn edges_become_walls() {
    let areas = |operation: &str| {
        said(&format!(
            "Lot --> comp(e) {{ all : {operation} print(geometry.area) NIL }}"
        ))
    };
    assert_eq!(areas("extrude(world.up, 2)"), ["20", "12", "20", "12"]);
    let outwards = "Lot --> comp(fe) { front : extrude(2) print(scope.sx) print(scope.sy) \
                    print(scope.sz) print(geometry.area) print(scope.elevation) NIL }";
    assert_eq!(said(outwards), ["10", "2", "0", "20", "0"]);
    assert!(
        said("Lot --> comp(v) { all : extrude(2) print(geometry.area) NIL }")
            .iter()
            .all(|area| area == "0")
    );
}
