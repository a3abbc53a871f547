//! What expressions can ask of shapes, and functions of values: hand-worked truth.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support;

use std::collections::BTreeSet;

use crate::support::{fault, lot_of, said};
use veduta_grammar::builtins::{attributes, functions, operations};
use veduta_grammar::engine::{attribute_names, function_names, operation_names};

fn print(shape: &str, values: &[&str]) -> Vec<String> {
    let all: String = values
        .iter()
        .map(|value| format!(" print({value})"))
        .collect();
    said(&format!("Lot --> {shape}{all}"))
}

#[test]
fn sizes_of_a_box() {
    let values = [
        "geometry.area",
        "geometry.area(top)",
        "geometry.area(side)",
        "geometry.area(world.south)",
        "geometry.volume",
        "geometry.nFaces",
        "geometry.nEdges",
        "geometry.nVertices",
        "geometry.height",
        "geometry.isClosedSurface",
        "geometry.isConcave",
        "geometry.isOriented(side)",
    ];
    let box_truth = [
        "216", "60", "96", "30", "180", "6", "12", "8", "3", "true", "false", "false",
    ];
    assert_eq!(print("extrude(3)", &values), box_truth);
    // The same as faces: half of a box of 6 m.
    assert_eq!(print("extrude(6) split(y) { 3 : X } X -->", &[]), [""; 0]);
    let values = [
        "geometry.area",
        "geometry.volume",
        "geometry.isClosedSurface",
        "geometry.nHoles",
    ];
    assert_eq!(print("", &values), ["60", "0", "false", "0"]);
    assert_eq!(
        print("s(0, 0, 0)", &["geometry.area", "geometry.volume"]),
        ["0", "0"]
    );
}

#[test]
fn forms_of_faces() {
    let values = [
        "geometry.isRectangular(0)",
        "geometry.isPlanar(0)",
        "geometry.isConcave",
        "geometry.boundaryLength",
        "geometry.angle(maxSlope)",
    ];
    assert_eq!(print("", &values), ["true", "true", "false", "32", "0"]);
    let l = lot_of(&[&[
        (0.0, 0.0),
        (8.0, 0.0),
        (8.0, 2.0),
        (3.0, 2.0),
        (3.0, 6.0),
        (0.0, 6.0),
    ]]);
    let text = "Lot --> print(geometry.isConcave) print(geometry.isRectangular(1)) \
                print(geometry.area) print(geometry.nEdges) print(geometry.boundaryLength)";
    let found = support::derived(text, l).unwrap();
    assert_eq!(found.messages, ["true", "false", "28", "6", "28"]);
    let court = lot_of(&[
        &[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)],
        &[(3.0, 3.0), (3.0, 5.0), (5.0, 5.0), (5.0, 3.0)],
    ]);
    let found = support::derived("Lot --> print(geometry.nHoles) print(geometry.area)", court);
    assert_eq!(found.unwrap().messages, ["1", "60"]);
    // A wall to the south: upright, and it faces 180 degrees.
    let wall = "extrude(3) comp(f) { front : W | all : NIL } W --> ";
    let found = print(
        wall,
        &["geometry.angle(maxSlope)", "geometry.angle(azimuth)"],
    );
    assert_eq!(found, ["90", "180"]);
}

#[test]
fn places_of_shapes() {
    let values = [
        "initialShape.name",
        "initialShape.origin.pz",
        "scope.elevation",
        "pivot.px",
    ];
    assert_eq!(print("t(1, 2, 3)", &values), ["Lot", "0", "2", "0"]);
    assert_eq!(
        print("color(\"#102030\")", &["material.color.rgb"]),
        ["#102030"]
    );
}

#[test]
fn keys_of_the_tree() {
    let text = "Lot --> print(getTreeKey) split(x) { 5 : A print(getTreeKey) | 5 : A } \
                A --> split(y) { 1 : NIL } print(getTreeKey()) inline B B B --> print(getTreeKey())";
    let found = said(&format!("{text} NIL"));
    assert_eq!(
        found,
        ["0;", "0;", "0;0;", "0;0;0;", "0;0;1;", "0;1;", "0;1;0;", "0;1;1;"]
    );
}

#[test]
fn values_of_components() {
    let values = [
        "comp(fe) { front : 5 | left : 2 }",
        "sum(comp(f) { top : geometry.area })",
    ];
    let found = print("", &values);
    let numbers: f64 = found[0].matches('5').count() as f64;
    assert_eq!((numbers, found[0].matches('2').count()), (1.0, 1));
    assert_eq!(found[1], "60");
}

#[test]
fn functions_of_values() {
    let cases = [
        ("clamp(7, 1, 5)", "5"),
        ("listAdd(\"a;b;\", \"c\")", "a;b;c;"),
        ("listIndex(\"a;b;c;\", \"c\")", "2"),
        ("listItem(\"a;b;c\", 1)", "b"),
        ("listRange(\"a;b;c;d;\", 1, 3)", "b;c;"),
        ("listRemoveAll(\"a;b;a;c;\", \"a;c;\")", "b;"),
        ("listRetainAll(\"a;b;a;c;\", \"a;c;\")", "a;a;c;"),
        ("listSize(\"\")", "0"),
        ("size(listToArray(\"a;b;\"))", "2"),
        ("listFromArray([1, 2])", "1;2;"),
        ("splitString(\"a-b-c\", \"-\")[2]", "c"),
        // As the reference has them.
        ("splitString(\".b.\", \".\")", "[,b,]"),
        ("splitString(\"a\\\\b\\\\c\", \"\\\\\")", "[a,b,c]"),
        ("splitString(\"abc\", \"\")", "[,a,b,c,]"),
        ("splitString(\"a;b;c\", \"$;\")", "[a,b,c]"),
        ("splitString(\"a.b.c\", \"$\\\\.\")", "[a,b,c]"),
        ("splitString(\"a\\t\\tb\\tc\", \"$\\t+\")", "[a,b,c]"),
        ("splitString(\"a b  c\", \"$\\\\s+\")", "[a,b,c]"),
        ("splitString(\"a$b$c\", \"$\\\\$\")", "[a,b,c]"),
        ("splitString(\"abc\", \"$\\\\B\")", "[a,b,c]"),
        ("splitString(\"abacba\", \"$(?<=a)b(?=a)\")", "[a,acba]"),
        ("findLast(\"abcabc\", \"b\")", "4"),
        ("findFirst([3, 1, 2], 2)", "2"),
        ("sortIndices([3, 1, 2])", "[1,2,0]"),
        ("transpose([1, 2 ; 3, 4 ; 5, 6])", "[1,3,5;2,4,6]"),
        ("setElems([1, 2, 3], 1, 9)", "[1,9,3]"),
        ("colorHexToR(\"#ff0000\")", "1"),
        ("colorHexToH(\"#00ff00\")", "120"),
        ("colorHSVToHex(240, 1, 1)", "#0000ff"),
        ("colorRGBToHex(1, 0.2, 0)", "#ff3300"),
        ("colorRamp(\"yellowToRed\", 0.2)", "#ffcc00"),
        ("colorRamp(\"spectrum\", 0.5)", "#00ff00"),
        ("fileBasename(\"a/b/tree.obj\")", "tree"),
        ("fileName(\"a/b/tree.obj\")", "tree.obj"),
    ];
    for (value, truth) in cases {
        let value = format!("str({value})");
        assert_eq!(print("", &[&value]), [truth], "{value}");
    }
    assert!(fault("Lot --> print(splitString(\"a\", \"$(\"))").contains("no regular expression"));
    let long = format!("splitString(\"ab\", \"${}\")", "a".repeat(1001));
    assert!(fault(&format!("Lot --> print({long})")).contains("more than 1000 bytes"));
    assert!(fault("Lot --> print(colorHexToR(\"red\"))").contains("no colour"));
}

/// What the checker knows and the engine does not. Whoever makes one derive takes it off.
const NOT_YET: &[&str] = &["setNormals", "softenNormals", "reduceGeometry"];

#[test]
fn what_does_not_derive_yet_is_listed() {
    let attributes_now: BTreeSet<String> = attribute_names().map(String::from).collect();
    let functions_now: BTreeSet<&str> = function_names().collect();
    let operations_now: BTreeSet<&str> = operation_names().collect();
    let mut missing: Vec<String> = Vec::new();
    let names = operations::OPERATIONS
        .iter()
        .map(|operation| operation.name);
    missing.extend(
        names
            .filter(|name| !operations_now.contains(name))
            .map(String::from),
    );
    let names = functions::FUNCTIONS.iter().map(|function| function.name);
    missing.extend(
        names
            .filter(|name| !functions_now.contains(name))
            .map(String::from),
    );
    missing.extend(attributes::names().filter(|name| !attributes_now.contains(name)));
    // Texture layers but the first, and their parts, are all alike.
    missing.retain(|name| !(name.contains("map.") || name.ends_with("map")));
    assert_eq!(missing, NOT_YET);
    let page = include_str!("../../../docs/grammar-language.md");
    for name in missing {
        assert!(
            page.contains(&format!("`{name}`")),
            "{name} is not named as missing"
        );
    }
    for name in functions_now {
        assert!(functions::find(name).is_some(), "{name}");
    }
    for name in attributes_now {
        assert!(attributes::is_attribute(&name), "{name}");
    }
}
