//! What a component knows of itself, and values of components: the examples of the reference.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::said;

#[test]
fn a_component_is_counted_among_those_of_its_selector() {
    // comp.sel, comp.index and comp.total of a cube, as the reference lists them.
    let found = said(
        "Lot --> primitiveCube(1, 1, 1) comp(f) { front : C | side : C | all = C }\n\
         C --> print(comp.sel + \" \" + comp.index + \" \" + comp.total) C.",
    );
    assert_eq!(
        found,
        ["front 0 1", "side 0 3", "side 1 3", "side 2 3", "all 0 1"]
    );
}

#[test]
fn strips_and_what_remains_are_counted_by_cell() {
    let found = said(
        "Lot --> offset(-1) comp(f) { inside : C | border : C }\n\
         C --> print(comp.sel + \" \" + comp.index + \" \" + comp.total) C.",
    );
    assert_eq!(
        found,
        [
            "inside 0 1",
            "border 0 4",
            "border 1 4",
            "border 2 4",
            "border 3 4"
        ]
    );
}

#[test]
fn a_selector_sees_the_number_among_all() {
    let found = said(
        "Lot --> extrude(1) comp(f) { comp.index == comp.total - 1 : print(\"last\") NIL \
         | all : print(comp.index) NIL }",
    );
    assert_eq!(found, ["last", "0", "1", "2", "3", "4"]);
}

#[test]
fn values_of_components() {
    let value = |cells: &str| {
        said(&format!(
            "Lot --> extrude(4) print(str(comp(f) {{ {cells} }})) NIL"
        ))
    };
    // Bottom, top, front, back, left and right of 10 m by 6 m by 4 m.
    assert_eq!(value("all : geometry.area"), ["[60,60,40,40,24,24]"]);
    // After `=`, that of all as one shape, at the place of each.
    assert_eq!(value("side = geometry.area"), ["[0,0,128,128,128,128]"]);
    assert_eq!(
        value("top : comp.sel | side : comp.sel + comp.index"),
        ["[,top,side0,side1,side2,side3]"]
    );
    assert_eq!(
        value("side = comp.total | all : comp.total"),
        ["[2,2,1,1,1,1]"]
    );
    assert_eq!(value("front = geometry.area"), ["[0,0,40,0,0,0]"]);
}
