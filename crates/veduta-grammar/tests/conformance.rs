//! What the reference says of missing values, of pivots, and of components put together.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{areas, said, tree};

#[test]
fn zero_stands_for_what_is_no_number() {
    let text = "const none = ln(-1)  attr height = none  isThere = !isNull(height)
         Lot --> print(isThere) print(height) extrude(height) print(scope.sy) A";
    let said = said(text);
    assert_eq!(said[..2], ["false", "nan"]);
    assert!(said[2].contains("in the rule Lot, 0 stands for a value that is NaN"));
    assert_eq!(said[3], "0");
    let text = "Lot --> split(x) { 1 / 0 : A. | ~1 : B. } ";
    assert_eq!(areas(&tree(text), "A"), Vec::<f64>::new());
    assert_eq!(areas(&tree(text), "B"), [60.0]);
    // It is said once for each place, whatever the number of uses.
    let many = "Lot --> set(scope.tx, 0 / 0) t(0 / 0, 0 / 0, 0) set(material.opacity, 1 / 0) A";
    assert_eq!(crate::support::said(many).len(), 4);
}

#[test]
fn functions_take_zero_for_it_too() {
    let values = "print(floor(ln(-1))) print(pow(1 / 0, 2)) print(isnan(ln(-1)) && isinf(-1 / 0))";
    assert_eq!(said(&format!("Lot --> {values}")), ["0", "0", "true"]);
}

#[test]
fn empty_arrays_know_what_they_hold() {
    let values = "print(\"<\" + stringArray[0] + \">\") print(boolArray[3]) print(floatArray[-1]) \
                  print(\"<\" + [stringArray, stringArray][0] + \">\") print([\"a\"][[false]][0] + \"|\")";
    assert_eq!(
        said(&format!("Lot --> {values}")),
        ["<>", "false", "0", "<>", "|"]
    );
}

#[test]
fn strings_go_on_over_lines() {
    let text = "Lot --> print(\"one\n  two\") print(\"\\u00e9\\u12\")  # a \" in a comment";
    assert_eq!(said(text), ["one\n  two", "\u{e9}\\u12"]);
}

#[test]
fn pivots_stand_at_first_corners() {
    let places = "print(scope.tx) print(scope.ty) print(scope.rx)";
    // The front is 10 m long: its own pivot is its first corner.
    let text = format!(
        "Lot --> t(3, 0, 0) print(scope.tx) extrude(4) comp(f) {{ front : Front | all : NIL }}
         Front --> {places} split(x) {{ 2 : NIL | ~1 : print(scope.tx) Upper }}
         Upper --> t(0, 1, 0) print(scope.ty) print(pivot.px) print(pivot.pz)"
    );
    assert_eq!(said(&text), ["3", "0", "0", "0", "2", "1", "3", "6"]);
}

#[test]
fn components_put_together_have_the_axes_of_the_first() {
    let text =
        "Lot --> extrude(4) comp(f) { top = t(0, 0, 2) print(scope.elevation) A. | all : NIL }";
    assert_eq!(said(text), ["6"]);
}

#[test]
fn a_text_can_name_an_attribute() {
    let text = "channel(name) = \"material.color.\" + name  attr height = 1
         Lot --> set(sel(channel(\"r\")), 0.5) print(material.color.r)
                 set(sel(\"height\"), 7) print(height) A";
    assert_eq!(said(text), ["0.5", "7"]);
    let none = crate::support::fault("Lot --> set(sel(\"scope.elevation\"), 1) A");
    assert!(
        none.contains("`scope.elevation` is no attribute that can be set"),
        "{none}"
    );
}

#[test]
fn each_shape_has_a_number_of_its_own() {
    let text = "Lot --> print(uid) split(x) { { 2 : A }* }  A --> print(uid)";
    let mut numbers = said(text);
    assert_eq!(numbers, said(text));
    numbers.sort();
    numbers.dedup();
    assert_eq!(numbers.len(), 6);
}

#[test]
fn the_seed_can_be_set() {
    let text = "A --> split(x) { { 1 : B }* }  B --> C C  C --> print(rand()) NIL";
    let of = |start: &str| said(&format!("Lot --> {start} {text}"));
    let whole = |draws: Vec<String>| -> Vec<String> { draws[..20].to_vec() };
    let seven = of("set(seedian, 7) A");
    // What came before in the rule does not matter, nor where it stands.
    assert_eq!(seven, of("[ t(1, 0, 0) D ] set(seedian, 7) A"));
    assert_eq!(seven, of("rotateScope(0, 0, 0) [ [ set(seedian, 7) A ] ]"));
    assert_ne!(seven, of("set(seedian, 8) A"));
    assert_ne!(seven, of("A"));
    // After brackets and cells all is as before.
    assert_eq!(
        of("print(rand()) A"),
        of("print(rand()) [ set(seedian, 3) NIL ] A")
    );
    assert_eq!(
        whole(of("[ set(seedian, 7) A ] [ set(seedian, 7) A ]")),
        seven
    );
    assert_eq!(
        said(
            "Lot --> set(seedian, 7) print(seedian) [ set(seedian, 2.5) A ] print(seedian) B
              A --> print(seedian)"
        ),
        ["7", "7", "2.5"]
    );
    let none = crate::support::fault("Lot --> set(seedian, \"a\") A");
    assert!(none.contains("`seedian` is a number, not `a`"), "{none}");
}

#[test]
fn turns_are_told_as_they_were_made() {
    // The example of `convert`: a turn of -10, 70 and 0 degrees on a lot that stands turned about y is told as
    // -10, 70 and what the lot is turned, and 0.
    let said = |operations: &str, values: [&str; 3]| -> Vec<String> {
        let rounded = values.map(|value| format!("print(rint(1e6 * {value}) / 1e6)"));
        said(&format!("Lot --> {operations} {}", rounded.join(" ")))
    };
    let to_world =
        ["x", "y", "z"].map(|axis| format!("convert({axis}, scope, world, orient, 0, 0, 0)"));
    let to_world = [&to_world[0], &to_world[1], &to_world[2]].map(String::as_str);
    let turned = "r(0, -46.5, 0) setPivot(xyz, 0) r(-10, 70, 0)";
    assert_eq!(said(turned, to_world), ["-10", "23.5", "0"]);
    let own = ["scope.rx", "scope.ry", "scope.rz"];
    assert_eq!(said("r(10, 20, 30)", own), ["10", "20", "30"]);
    // Setting one leaves the others.
    assert_eq!(
        said("r(10, 20, 30) set(scope.rx, 40)", own),
        ["40", "20", "30"]
    );
    let given = "convert(scope, world, orient, [10, 20, 30])";
    let back = [0, 1, 2].map(|k| format!("{given}[{k}]"));
    let back = [&back[0], &back[1], &back[2]].map(String::as_str);
    assert_eq!(said("", back), ["10", "20", "30"]);
}

#[test]
fn scopes_are_turned_and_moved_in_named_frames() {
    let place = |operations: &str| -> Vec<String> {
        let values = ["x", "y", "z"].map(|axis| {
            format!("print(rint(1e6 * convert({axis}, scope, world, pos, 0, 0, 0)) / 1e6)")
        });
        said(&format!("Lot --> {operations} {}", values.join(" ")))
    };
    let turn = |operations: &str| -> Vec<String> {
        let values = ["x", "y", "z"].map(|axis| {
            format!("print(rint(1e6 * convert({axis}, scope, world, orient, 0, 0, 0)) / 1e6)")
        });
        said(&format!("Lot --> {operations} {}", values.join(" ")))
    };
    // The origin of the scope stays.
    assert_eq!(
        place("t(2, 0, 1) rotate(rel, scope, 0, 90, 0)"),
        ["2", "0", "1"]
    );
    assert_eq!(
        place("t(2, 0, 1) rotate(abs, world, 0, 90, 0)"),
        ["2", "0", "1"]
    );
    assert_eq!(
        turn("r(0, 30, 0) rotate(abs, world, 0, 60, 0)"),
        ["0", "60", "0"]
    );
    assert_eq!(
        turn("r(0, 30, 0) rotate(rel, world, 0, 60, 0)"),
        ["0", "90", "0"]
    );
    // About the axes of the lot, and about those of the scope, which has been turned about x.
    assert_eq!(
        turn("r(40, 0, 0) rotate(rel, object, 0, 20, 0)"),
        ["40", "20", "0"]
    );
    assert_eq!(
        turn("r(40, 0, 0) rotate(rel, pivot, 0, 20, 0)"),
        ["40", "20", "0"]
    );
    assert_ne!(
        turn("r(40, 0, 0) rotate(rel, scope, 0, 20, 0)"),
        ["40", "20", "0"]
    );
    assert_eq!(
        place("t(2, 0, 1) r(0, 90, 0) translate(rel, scope, 1, 0, 0)"),
        ["2", "0", "0"]
    );
    assert_eq!(
        place("t(2, 0, 1) r(0, 90, 0) translate(rel, object, 1, 0, 0)"),
        ["3", "0", "1"]
    );
    assert_eq!(
        place("t(2, 0, 1) translate(abs, object, 5, 0, 0)"),
        ["5", "0", "0"]
    );
    // In a wall, its own corner is the pivot.
    let wall =
        "Lot --> extrude(4) comp(f) { right : t(1, 1, 0) translate(abs, pivot, 0, 3, 0) A } \
                A --> print(scope.tx) print(scope.ty) print(scope.elevation)";
    assert_eq!(said(wall), ["0", "3", "3"]);
    // The same where nothing tells of the pivot.
    let dark = "Lot --> extrude(4) comp(f) { right : t(1, 1, 0) translate(abs, pivot, 0, 3, 0) B. | all : NIL }";
    let tree = tree(dark);
    let leaf = tree.leaves().next().unwrap();
    assert_eq!(leaf.state.form.scope.origin.to_array(), [10.0, 3.0, 6.0]);
}
