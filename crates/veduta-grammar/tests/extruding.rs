//! `extrude` of shapes that are no level sheet, against volumes worked out by hand.

#![allow(clippy::unwrap_used)] // helpers of tests

use glam::{DMat3, DVec3};
use veduta_geometry::solid::Mesh;
use veduta_grammar::engine::State;
use veduta_grammar::shape::Form;

use crate::support::{derived, lot_of, mesh_of, said};

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

/// Arms of 10 m by 3 m and 4 m by 9 m, from a corner on that does not see all of it.
const ANGLE: [(f64, f64); 6] = [
    (10.0, 0.0),
    (10.0, 3.0),
    (4.0, 3.0),
    (4.0, 9.0),
    (0.0, 9.0),
    (0.0, 0.0),
];
const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)];
const COURT: [(f64, f64); 4] = [(2.0, 2.0), (2.0, 6.0), (6.0, 6.0), (6.0, 2.0)];

/// Extruded by corners: the faces that have all corners above a height, by what each covers of the
/// ground (m2; below zero where it looks down).
fn upper_faces(text: &str, start: State, height: f64) -> Vec<f64> {
    let found = derived(text, start).unwrap();
    let mesh = &mesh_of(&found, "A")[0];
    assert!(mesh.is_closed());
    let faces = mesh.faces();
    let upper = faces.filter(|face| face.points().all(|point| point.y > height));
    upper.map(|face| face.area_vector().y).collect()
}

#[test]
fn upper_faces_that_stay_level_are_whole() {
    // All corners of the solids move by 1 m along each axis: the angle is 12 m by 11 m, with arms 5 m
    // and 6 m wide, and the court 2 m by 2 m in 10 m by 10 m.
    let text = format!(
        "Lot --> extrude(5) extrude(vertex.normal, {}) A.",
        3f64.sqrt()
    );
    let found = upper_faces(&text, lot_of(&[&ANGLE]), 5.5);
    assert_near(&found, &[12.0 * 5.0 + 6.0 * 6.0], "an angle");
    let found = upper_faces(&text, lot_of(&[&SQUARE, &COURT]), 5.5);
    assert_near(&found, &[100.0 - 4.0], "a court");
}

#[test]
fn upper_faces_that_bend_leave_out_notches_and_holes() {
    // West of the face the ground falls by 45 degrees: the corners there move up and out, half of that
    // off the vertical, and the others up.
    let bent = |rings: &[&[(f64, f64)]], long: f64| {
        let at = |&(x, y): &(f64, f64)| DVec3::new(x, 0.0, -y);
        let rings = rings.iter().map(|ring| ring.iter().map(at).collect());
        let mut sheet = Mesh::polygon(&rings.collect::<Vec<Vec<DVec3>>>());
        let slope = [(0.0, 0.0), (0.0, long), (-5.0, long), (-5.0, 0.0)];
        sheet.append(&Mesh::polygon(&[slope.map(|(x, y)| DVec3::new(x, x, -y))]));
        let start = State::new(Form::around(sheet, DMat3::IDENTITY, false), 0);
        upper_faces("Lot --> extrude(vertex.normal, 1) A.", start, 0.5)
    };
    let out = 22.5f64.to_radians().sin();
    for (rings, long, area) in [
        (vec![&ANGLE[..]], 9.0, 54.0),
        (vec![&SQUARE[..], &COURT[..]], 8.0, 64.0 - 16.0),
    ] {
        let found = bent(&rings, long);
        assert!(found.iter().all(|&covered| covered > 0.0), "{found:?}");
        assert_near(&[found.iter().sum()], &[area + long * out], "a bent face");
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
