//! Turns about the pivot, and where operations put it: axes worked out by hand.

use crate::support::said;

/// Rounded to a millionth, without a sign at 0.
fn numbers(operations: &str, values: &[&str]) -> Vec<f64> {
    let asked: Vec<String> = values
        .iter()
        .map(|value| format!("print({value})"))
        .collect();
    let found = said(&format!("Lot --> {operations} {}", asked.join(" ")));
    let number =
        |told: &String| (told.parse::<f64>().unwrap_or(f64::NAN) * 1e6).round() / 1e6 + 0.0;
    found.iter().map(number).collect()
}

const PLACE: [&str; 3] = ["scope.tx", "scope.ty", "scope.tz"];
const TURN: [&str; 3] = ["scope.rx", "scope.ry", "scope.rz"];
const SIZE: [&str; 3] = ["scope.sx", "scope.sy", "scope.sz"];

#[test]
fn turns_follow_one_another_about_the_pivot() {
    // x to y about z, and then y to z about x, which has stayed where it was.
    let twice = "r(0, 0, 90) r(90, 0, 0) t(1, 0, 0)";
    assert_eq!(numbers(twice, &PLACE), [0.0, 0.0, 1.0]);
    let same = "rotate(rel, pivot, 0, 0, 90) rotate(rel, pivot, 90, 0, 0) t(1, 0, 0)";
    assert_eq!(numbers(same, &PLACE), [0.0, 0.0, 1.0]);
    // The scope's own x stays along y.
    let own = "r(0, 0, 90) rotate(rel, scope, 90, 0, 0) t(1, 0, 0)";
    assert_eq!(numbers(own, &PLACE), [0.0, 1.0, 0.0]);
}

#[test]
fn the_scope_alone_turns_about_the_pivot_too() {
    // 10, 3 and 6 m: x comes to lie along z, y against x, z against y.
    let twice = "extrude(3) rotateScope(0, 0, 90) rotateScope(90, 0, 0)";
    assert_eq!(numbers(twice, &SIZE), [6.0, 10.0, 3.0]);
}

#[test]
fn parts_are_turned_about_their_own_pivot() {
    // Of the right wall x runs to the back, y up: a turn about z tilts it in its plane.
    let wall = "extrude(3) comp(f) { right : r(0, 0, 90) t(1, 0, 0)";
    assert_eq!(
        numbers(&format!("{wall} print(scope.ty) NIL }}"), &[]),
        [1.0]
    );
}

#[test]
fn aligned_scopes_have_the_pivot_at_their_origin() {
    let turned = "extrude(3) t(1, 2, 3) r(10, 20, 30)";
    let none = [0.0; 3];
    for align in [
        "alignScopeToAxes()",
        "alignScopeToAxes(world.y)",
        "alignScopeToAxes(object.x)",
        "alignScopeToGeometry(zUp, 2, 1)",
        "alignScopeToGeometryBBox(xz)",
    ] {
        let after = format!("{turned} {align}");
        assert_eq!(numbers(&after, &PLACE), none, "{align}");
        assert_eq!(numbers(&after, &TURN), none, "{align}");
    }
}

#[test]
fn one_axis_is_aligned_and_another_kept_in_the_plane_across_it() {
    // After 40 degrees about y and then 30 about z, x is (cos 40 cos 30, cos 40 sin 30, -sin 40).
    let world = "convert(y, scope, world, orient, 0, 0, 0)";
    let level = ["x", "z"].map(|axis| format!("convert({axis}, scope, world, orient, 0, 0, 0)"));
    let found = numbers(
        "r(0, 40, 30) alignScopeToAxes(y)",
        &[world, &level[0], &level[1]],
    );
    let (c, s) = (40f64.to_radians().cos(), 40f64.to_radians().sin());
    let about_y = s.atan2(c * 30f64.to_radians().cos()).to_degrees();
    assert!(
        (found[0] - about_y).abs() < 2e-6 && found[1..] == [0.0, 0.0],
        "{found:?}"
    );
}

#[test]
fn the_letters_of_set_pivot_say_what_becomes_of_each_axis() {
    // x, y and z of 10, 3 and 6 m: with yzx the new y is the old x, z is y, and x is z.
    assert_eq!(
        numbers("extrude(3) setPivot(xyz, 0)", &SIZE),
        [10.0, 3.0, 6.0]
    );
    assert_eq!(
        numbers("extrude(3) setPivot(yzx, 0)", &SIZE),
        [6.0, 10.0, 3.0]
    );
    assert_eq!(
        numbers("extrude(3) setPivot(zxy, 0)", &SIZE),
        [3.0, 6.0, 10.0]
    );
}

#[test]
fn the_pivot_stays_where_parts_are_not_aligned() {
    let corners = said("Lot --> comp(v, noAlign) { all : print(scope.tx + \" \" + scope.tz) NIL }");
    let mut sorted = corners.clone();
    sorted.sort();
    assert_eq!(sorted, ["0 0", "0 6", "10 0", "10 6"]);
    assert_eq!(
        said("Lot --> extrude(3) comp(f, noAlign) { right : print(scope.tx) NIL }"),
        ["10"]
    );
}
