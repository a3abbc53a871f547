//! `splitAndSetbackPerimeter`: areas worked out by hand on a lot of 10 m by 6 m, whose outline runs along
//! the front (10 m), the right, the back and the left.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::{areas, derived, fault, lot_of, mesh_of, said, tree};
use proptest::prelude::*;

/// The areas of the strips `A` and `C`, and of what remains.
fn found(operation: &str, cells: &str) -> [Vec<f64>; 3] {
    let text =
        format!("Lot --> splitAndSetbackPerimeter({operation}) {cells} {{ remainder : B. }}");
    let tree = tree(&text);
    ["A", "C", "B"].map(|name| areas(&tree, name))
}

#[test]
fn one_section() {
    let front = found("0", "{ 10 : 2 : A. | ~1 : 0 : NIL }");
    assert_eq!(front, [vec![20.0], vec![], vec![40.0]]);
    let within = found("2", "{ 4 : 1 : A. | ~1 : 0 : NIL }");
    assert_eq!(within, [vec![4.0], vec![], vec![56.0]]);
    // 2 m of the front and 4 m of the right, 2 m deep: 2 m by 4 m along the right.
    let corner = found("8", "{ 6 : 2 : A. | ~1 : 0 : NIL }");
    assert_eq!(corner, [vec![8.0], vec![], vec![52.0]]);
    let around = found("3", "{ ~1 : 1 : A. }");
    assert_eq!(around, [vec![28.0], vec![], vec![32.0]]);
}

#[test]
fn deeper_strips_win() {
    // 3 m of the front, 4 m deep; and of 5 m of the left, 2 m deep, what it leaves: 2 m by 1 m.
    let cells = "{ 3 : 4 : A. | ~1 : 0 : NIL | 5 : 2 : C. }";
    assert_eq!(found("0", cells), [vec![12.0], vec![2.0], vec![46.0]]);
}

#[test]
fn patterns_repeat_and_shares_are_of_the_outline() {
    let [strips, _, rest] = found("0", "{ ~4 : 1 : A. }*");
    assert_eq!(strips.len(), 8);
    assert!(
        (strips.iter().sum::<f64>() - 28.0).abs() < 1e-6,
        "{strips:?}"
    );
    assert_eq!(rest, [32.0]);
    // A quarter of 32 m from the middle of the front on: 5 m of it, and 3 m of the right, 1 m deep.
    let quarter = found("5", "{ '0.25 : 1 : A. | ~1 : 0 : NIL }");
    assert_eq!(quarter, [vec![7.0], vec![], vec![53.0]]);
    let text =
        "Lot --> splitAndSetbackPerimeter(0) { { ~8 : split.index : print(split.index) A. }* } \
                { remainder : B. }";
    assert_eq!(said(text), ["1", "2", "3"]);
}

#[test]
fn edges_are_chosen() {
    let mask = "comp(fe) { front : true | all : false }";
    let cells = "{ 5 : 1 : A. | 5 : 2 : C. }";
    assert_eq!(
        found(&format!("'0.5, 0, {mask}"), cells),
        [vec![5.0], vec![10.0], vec![45.0]]
    );
    // From the right on: 6 m of it, and 4 m of the back.
    let all = "[true, true, true, true]";
    let right = found(&format!("0, 5, {all}"), "{ 10 : 1 : A. | ~1 : 0 : NIL }");
    assert_eq!(right, [vec![9.0], vec![], vec![51.0]]);
    assert_eq!(
        found("0, 0, [false]", "{ 10 : 1 : A. }"),
        [vec![], vec![], vec![60.0]]
    );
}

#[test]
fn faults_name_the_depth() {
    let text = "Lot --> splitAndSetbackPerimeter(0) { 10 : -1 : A. } { remainder : B. }";
    assert!(fault(text).contains("a depth from 0 on"));
    let mask = "Lot --> splitAndSetbackPerimeter(0, 0, 1) { 10 : 1 : A. } { remainder : B. }";
    assert!(fault(mask).contains("an array of true and false"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Strips and what remains are the lot, and no two of them overlap.
    #[test]
    fn nothing_is_lost(
        radii in prop::collection::vec(4.0f64..12.0, 4..9),
        offset in 0.0f64..30.0,
        sizes in prop::collection::vec((1.0f64..12.0, 0.0f64..4.0), 1..5),
    ) {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let ring: Vec<(f64, f64)> = radii
            .iter()
            .enumerate()
            .map(|(k, r)| (r * (step * k as f64).cos(), r * (step * k as f64).sin()))
            .collect();
        let cells: Vec<String> = sizes.iter().map(|(s, d)| format!("~{s} : {d} : A.")).collect();
        let text = format!(
            "Lot --> splitAndSetbackPerimeter({offset}) {{ {} }} {{ remainder : B. }}",
            cells.join(" | ")
        );
        let tree = derived(&text, lot_of(&[&ring])).unwrap();
        let parts: f64 = ["A", "B"]
            .iter()
            .flat_map(|name| mesh_of(&tree, name))
            .map(|mesh| mesh.area())
            .sum();
        let whole: f64 = (0..ring.len())
            .map(|k| (ring[k], ring[(k + 1) % ring.len()]))
            .map(|((ax, ay), (bx, by))| 0.5 * (ax * by - bx * ay))
            .sum();
        prop_assert!((parts - whole).abs() < 1e-6 * whole, "{} {}", parts, whole);
    }
}
