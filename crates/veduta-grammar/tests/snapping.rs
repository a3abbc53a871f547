//! `snap`, places that are set, and points in rooms: hand-worked truth.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{fault, said, tree};
use proptest::prelude::*;

/// A line at x = 3, and then cells of 2.5 m.
fn cells(snap: &str) -> Vec<String> {
    said(&format!(
        "Lot --> [ split(x) {{ 3 : label(\"line\") NIL | ~1 : NIL }} ] split(x) {{ {{ ~2.5 : Cell }}* }}\n\
         Cell --> {snap} print(scope.sx)"
    ))
}

#[test]
fn sides_move_to_lines_within_reach() {
    assert_eq!(cells("snap(x, \"line\", 1)"), ["3", "2", "2.5", "2.5"]);
    assert_eq!(cells("snap(xz, \"line\", 0.4)"), ["2.5"; 4]);
    // Half of 2.5 m reaches from 2.5 m to 3 m.
    assert_eq!(cells("snap(x, \"line\")"), ["3", "2", "2.5", "2.5"]);
    assert_eq!(cells("snap(x, \"other\", 9)"), ["2.5"; 4]);
    // Lines across another axis do not count, nor do those of shapes that are turned.
    assert_eq!(cells("r(0, 30, 0) snap(x, \"line\", 1)"), ["2.5"; 4]);
    // Both sides of the second cell are nearest to the line at 3 m: it stays as it is.
    assert_eq!(cells("snap(x, \"line\", 2.1)")[1], "2.5");
}

#[test]
fn a_shape_does_not_snap_to_itself() {
    let text = "Lot --> split(x) { { ~5 : label(\"a\") s(4, '1, '1) snap(x, \"a\", 2) print(scope.sx) NIL }* }";
    // The first reaches from 0 to 4, the other from 5 to 9; their labels from 0 to 5 and on to 10.
    assert_eq!(said(text), ["5", "4"]);
    assert!(fault("Lot --> snap(x, \"a\", -1)").contains("from 0 on"));
}

#[test]
fn what_is_in_the_scope_is_stretched() {
    let text = "Lot --> [ t(0, 4, 0) label(\"top\") NIL ] extrude(3) snap(y, \"top\", 1) print(geometry.volume)";
    assert_eq!(said(text), ["240"]);
    let wall = "Lot --> [ s(0.2, 0, 0) t(3, 0, 0) label(\"line\") NIL ] \
                extrude(2) comp(f) { front : snap(x, \"line\", 4) print(scope.sx) print(geometry.area) A. }";
    // From x = 0 to x = 10 along the front; 3 m is nearest to 0, 3.2 m too far from 10.
    assert_eq!(said(wall), ["7", "14"]);
}

#[test]
fn scopes_are_set() {
    let text = "Lot --> t(3, 0, 0) set(scope.tx, 1) set(scope.sx, 4) set(scope.rz, 87.5) \
                print(scope.tx) print(geometry.area) print(scope.rz)";
    assert_eq!(said(text), ["1", "24", "87.5"]);
    let pivot =
        "Lot --> setPivot(xyz, 2) set(scope.tx, 2) print(convert(x, scope, world, pos, 0, 0, 0))";
    assert_eq!(said(pivot), ["8"]);
    assert!(fault("Lot --> set(scope.sx, \"wide\")").contains("a finite number"));
}

#[test]
fn points_in_rooms() {
    // A pyramid of 3 m over the middle of the lot.
    let text = "Lot --> taper(3) scatter(volume, 300, uniform) { \
                print(scope.tx) print(scope.ty) print(scope.tz) NIL }";
    let numbers: Vec<f64> = said(text)
        .iter()
        .map(|text| text.parse().unwrap())
        .collect();
    let points: Vec<&[f64]> = numbers.chunks(3).collect();
    assert_eq!(points.len(), 300);
    for point in &points {
        let share = 1.0 - point[1] / 3.0;
        assert!((point[0] - 5.0).abs() / 5.0 <= share + 1e-9, "{point:?}");
        assert!((point[2] - 3.0).abs() / 3.0 <= share + 1e-9, "{point:?}");
    }
    let mean = points.iter().map(|point| point[1]).sum::<f64>() / 300.0;
    assert!((mean - 0.75).abs() < 0.12, "{mean}");
    // What is open has points on its faces.
    let open = "Lot --> scatter(volume, 5, uniform) { print(scope.ty) NIL }";
    assert_eq!(said(open), ["0"; 5]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Cells that share a border still do, and no side moves farther than the reach.
    #[test]
    fn rows_stay_rows(
        lines in prop::collection::vec(0.1f64..9.9, 1..4),
        reach in 0.0f64..0.6,
        count in 2u32..7,
    ) {
        let labels: String = lines
            .iter()
            .map(|line| format!("[ s({line}, '1, '1) label(\"line\") NIL ] "))
            .collect();
        let size = 10.0 / f64::from(count);
        let text = format!(
            "Lot --> {labels} split(x) {{ {{ ~{size} : Cell }}* }}\n\
             Cell --> snap(x, \"line\", {reach}) A."
        );
        let found = tree(&text);
        let mut end = None;
        for (k, leaf) in found.leaves().enumerate() {
            let scope = leaf.state.form.scope;
            let (low, high) = (scope.origin.x, scope.origin.x + scope.size.x);
            prop_assert!((low - k as f64 * size).abs() <= reach + 1e-9, "{low}");
            let is_line = lines.iter().any(|line| (line - low).abs() < 1e-9);
            prop_assert!(is_line || (low - k as f64 * size).abs() < 1e-9, "{low}");
            prop_assert!(end.is_none_or(|end: f64| (end - low).abs() < 1e-9), "{low}");
            end = Some(high);
        }
    }
}
