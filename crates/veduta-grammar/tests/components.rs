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

#[test]
fn what_hangs_together_becomes_one_shape() {
    let of = |cells: &str| {
        said(&format!(
            "Lot --> extrude(4) comp(f) {{ {cells} }}
             C --> print(comp.sel + \" \" + comp.index + \" \" + comp.total + \" \" + geometry.area) C."
        ))
    };
    // The sides go round; top and bottom have no edge in common.
    assert_eq!(of("side =: C"), ["side 0 1 128"]);
    assert_eq!(
        of("horizontal =: C"),
        ["horizontal 0 2 60", "horizontal 1 2 60"]
    );
    assert_eq!(of("horizontal = C"), ["horizontal 0 1 120"]);
    // Front and right meet in an edge, the back stands alone.
    assert_eq!(
        of("front || right || top =: C | all =: C"),
        [" 0 1 124", "all 0 1 124"]
    );
    assert_eq!(
        of("left || right =: C | front || back : C"),
        [" 0 2 24", " 1 2 24", " 0 2 40", " 1 2 40"]
    );
}

#[test]
fn faces_that_meet_in_a_corner_do_not_hang_together() {
    let text = "Lot --> s(2, 0, 2) split(x) { 1 : split(z) { 1 : A. | 1 : NIL } | 1 : split(z) { 1 : NIL | 1 : A. } }";
    let inlined = format!("{text} Start --> inline Lot comp(f) {{ all =: print(comp.total) NIL }}");
    let inlined = inlined.replace("Start -->", "@StartRule Start -->");
    assert_eq!(said(&inlined), ["2", "2"]);
}

#[test]
fn edges_hang_together_by_their_ends() {
    let text = |selector: &str| {
        format!(
            "Lot --> comp(e) {{ {selector} =: print(comp.total + \" \" + scope.sx + \" \" + scope.sy) NIL }}"
        )
    };
    assert_eq!(said(&text("all")), ["1 10 6"]);
    assert_eq!(
        said(&text("object.left || object.right")),
        ["2 6 0", "2 6 0"]
    );
    let values = "Lot --> extrude(4) print(str(comp(f) { horizontal =: geometry.area | all =: comp.total }))";
    assert_eq!(said(values), ["[60,60,1,1,1,1]"]);
}

#[test]
fn edges_of_faces_look_away_from_the_face_and_have_its_normal_for_y() {
    // The front of a lot that lies: y up, z to the front.
    let directions = "print(convert(scope, world, orient, [0, 0, 0])) NIL }";
    assert_eq!(
        said(&format!("Lot --> comp(fe) {{ front : {directions}")),
        ["(3)[0,0,0]"]
    );
    assert_eq!(
        said("Lot --> comp(fe) { front : t(0, 2, 0) print(scope.elevation) NIL }"),
        ["2"]
    );
}

#[test]
fn edges_between_faces_have_the_mean_of_their_normals_for_z_and_run_upwards() {
    // The edge at the front of the roof of a box looks up and out at 45 degrees.
    let told = "t(0, 0, sqrt(2)) print(rint(1e6 * scope.elevation) / 1e6) NIL }";
    assert_eq!(
        said(&format!(
            "Lot --> extrude(3) comp(e) {{ top && front : {told}"
        ))
        .len(),
        0
    );
    let found = said(&format!("Lot --> extrude(3) comp(e) {{ top : {told}"));
    assert_eq!(found, ["4"; 4]);
    // Upright edges begin at the ground.
    let upright = said("Lot --> extrude(3) comp(e) { vertical : print(scope.elevation) NIL }");
    assert_eq!(upright, ["0"; 4]);
}

#[test]
fn vertices_look_along_the_mean_of_their_faces() {
    assert_eq!(
        said("Lot --> comp(v) { top : t(0, 0, 1) print(scope.elevation) NIL }"),
        ["1"; 4]
    );
    // A corner of a box looks along its diagonal.
    let corner = "print(rint(1e6 * scope.elevation) / 1e6) NIL }";
    let found = said(&format!(
        "Lot --> extrude(3) comp(v) {{ all : t(0, 0, sqrt(3)) {corner}"
    ));
    let mut sorted = found.clone();
    sorted.sort();
    assert_eq!(sorted, ["-1", "-1", "-1", "-1", "4", "4", "4", "4"]);
}

#[test]
fn corners_of_faces_are_counted_face_by_face() {
    let counted = "print(comp.total) NIL }";
    assert_eq!(
        said(&format!("Lot --> extrude(3) comp(v) {{ all : {counted}")),
        vec!["8"; 8]
    );
    assert_eq!(
        said(&format!("Lot --> extrude(3) comp(fv) {{ all : {counted}")),
        vec!["24"; 24]
    );
    assert_eq!(
        said(&format!("Lot --> extrude(3) comp(fv) {{ top : {counted}")),
        ["4"; 4]
    );
    assert_eq!(
        said(&format!("Lot --> comp(fv) {{ border : {counted}")),
        ["4"; 4]
    );
}

#[test]
fn corners_that_two_parts_move_go_by_the_sum() {
    // The front goes 1 m out, the right side too: (0, 7), (11, 7), (11, 0), (0, 0).
    let both = "modify(fe) { front : t(0, 0, 1) X. | right : t(0, 0, 1) X. }";
    assert_eq!(
        said(&format!("Lot --> {both} print(geometry.area)")),
        ["77"]
    );
    let corners = "modify(fv) { all : t(0, 0, 1) X. }";
    assert_eq!(
        said(&format!("Lot --> {corners} print(scope.elevation)")),
        ["1"]
    );
    // One face lies over the other's corner: the shared corners go up twice.
    let halves = "inline(recompose) split(x) { ~1 : A. | ~1 : A. } modify(f, noAlign) { all : t(0, 1, 0) X. }";
    assert_eq!(said(&format!("Lot --> {halves} print(scope.sy)")), ["1"]);
}
