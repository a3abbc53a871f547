//! Questions about other shapes: hand-worked truth, and answers that do not depend on the order.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::sync::Arc;

use crate::support::{code, said, tree};
use glam::DVec3;
use proptest::prelude::*;
use veduta_grammar::engine::{derive, occluders, Neighbour, Options, State};
use veduta_grammar::shape::{box_distance, Form, Geometry, Scope};

/// Two blocks of 5 m by 6 m, 3 m and 6 m high, side by side.
const BLOCKS: &str = "Lot --> split(x) { 5 : Block(3) | 5 : Block(6) } \
                      Block(height) --> extrude(height) comp(f) { left : W | right : W | all : X. } ";

#[test]
fn walls_between_blocks() {
    // The low block's right wall is covered in full, the high one's left wall in part.
    let found = said(&format!(
        "{BLOCKS} W --> print(split.index + comp.sel + inside(intra) + touches(intra) + overlaps(intra))"
    ));
    assert_eq!(
        found,
        [
            "0leftfalsefalsefalse",
            "0righttruetruefalse",
            "1leftfalsetruefalse",
            "1rightfalsefalsefalse"
        ]
    );
}

#[test]
fn a_shape_is_no_obstacle_to_itself_its_parents_and_its_children() {
    let alone =
        "Lot --> extrude(3) comp(f) { all : print(\"\" + touches() + inside() + overlaps()) W. }";
    assert!(said(alone).iter().all(|text| text == "falsefalsefalse"));
    let nested = "Lot --> extrude(3) print(overlaps()) split(y) { 1 : comp(f) { all : print(overlaps()) W. } }";
    assert!(said(nested).iter().all(|text| text == "false"));
}

#[test]
fn volumes_within_and_across() {
    let text = "Lot --> [ t(1, 1, 1) s(2, 2, 2) primitiveCube() Q ] [ extrude(4) Hull. ] \
                [ t(9, 3, 5) s(2, 2, 2) primitiveCube() Q ] [ t(0, 4, 0) s(1, 1, 1) primitiveCube() Q ] NIL \
                Q --> print(\"\" + inside() + overlaps() + touches())";
    let found = said(text);
    assert_eq!(found, ["truetruetrue", "falsetruetrue", "falsefalsetrue"]);
}

#[test]
fn labels_are_asked_for_by_name() {
    let text = "Lot --> [ extrude(4) label(\"hull\") NIL ] [ t(20, 0, 0) extrude(1) label(\"far\") NIL ] Q \
                Q --> extrude(2) print(\"\" + inside(intra, \"hull\") + inside(intra, \"far\") + inside(intra, \"none\")) \
                print(contextCount(intra, \"hull\") + contextCount(all, \"none\")) \
                print(minimumDistance(intra, \"far\")) print(minimumDistance(intra, \"none\") > 1e300) \
                print(contextCompare(intra, \"hull\", world.highest) + contextCompare(intra, \"far\", area.largest))";
    assert_eq!(said(text), ["truefalsefalse", "1", "10", "true", "1"]);
}

#[test]
fn what_a_first_answer_prevents_is_no_obstacle() {
    // Each stands only where nothing touches it: in the first pass both do, so in the second
    // neither does, whichever comes first.
    let text =
        "Lot --> split(x) { 5 : B | 5 : B } B --> case touches(intra) : NIL else : extrude(3) X.";
    // Flat halves touch no solid: they lie on the other's side in an edge alone.
    assert_eq!(tree(text).leaves.len(), 2);
    let text =
        "Lot --> extrude(3) split(x) { 5 : B | 5 : B } B --> case touches(intra) : NIL else : X.";
    assert_eq!(tree(text).leaves.len(), 0);
}

#[test]
fn neighbours_are_asked_for_by_inter() {
    let rules =
        code("Lot --> extrude(3) comp(f) { side : W | all : X. } W --> print(inside(inter))");
    let lot = |x: f64| {
        let mut scope = Scope::of_size(DVec3::new(10.0, 0.0, 6.0));
        scope.origin.x = x;
        State::new(
            Form {
                scope,
                geometry: Geometry::Rectangle(1),
            },
            0,
        )
    };
    let start = rules.start.unwrap();
    let beside = occluders(&rules, start, lot(10.0), &Options::default()).unwrap();
    let options = Options {
        neighbours: vec![Neighbour::new(Arc::new(beside), DVec3::ZERO)],
        ..Options::default()
    };
    let found = derive(&rules, start, lot(0.0), &options).unwrap().messages;
    assert_eq!(found.iter().filter(|text| *text == "true").count(), 1);
    let alone = derive(&rules, start, lot(0.0), &Options::default())
        .unwrap()
        .messages;
    assert!(alone.iter().all(|text| text == "false"));
}

#[test]
fn what_stands_beside_depends_on_work_and_not_on_time() {
    let rules = code("Lot --> [ scatter(scope, 9, uniform) { X. } ] extrude(3) Y.");
    let start = rules.start.unwrap();
    let lot = || {
        let scope = Scope::of_size(DVec3::new(10.0, 0.0, 6.0));
        let geometry = Geometry::Rectangle(1);
        State::new(Form { scope, geometry }, 0)
    };
    let mut options = Options::default();
    options.limits.seconds = 0.0;
    assert!(derive(&rules, start, lot(), &options).is_err());
    let found = occluders(&rules, start, lot(), &options).unwrap();
    let whole = occluders(&rules, start, lot(), &Options::default()).unwrap();
    assert_eq!(found.len(), whole.len());
    assert!(!found.is_empty());
    options.limits.work = 0;
    assert!(occluders(&rules, start, lot(), &options).is_err());
}

#[test]
fn a_neighbour_may_be_in_a_frame_of_its_own() {
    // The same house, 10 m to the right: as a shape that stands there, or seen from there.
    let rules = code(
        "Lot --> extrude(3) label(\"hull\") comp(f) { front : W | right : W | back : W | left : W | all : X. } \
         W --> print(comp.sel + inside(inter) + minimumDistance(inter, \"hull\") \
         + contextCompare(inter, \"hull\", world.easternmost))",
    );
    let lot = |x: f64| {
        let mut scope = Scope::of_size(DVec3::new(10.0, 0.0, 6.0));
        scope.origin.x = x;
        let geometry = Geometry::Rectangle(1);
        State::new(Form { scope, geometry }, 0)
    };
    let start = rules.start.unwrap();
    let said = |own: f64, offset: f64| {
        let shapes = occluders(&rules, start, lot(own), &Options::default()).unwrap();
        let one = Neighbour::new(Arc::new(shapes), DVec3::new(offset, 0.0, 0.0));
        let options = Options {
            neighbours: vec![one],
            ..Options::default()
        };
        derive(&rules, start, lot(0.0), &options).unwrap().messages
    };
    let told = said(0.0, 10.0);
    assert_eq!(told, said(10.0, 0.0));
    // Right's wall lies on the neighbour and comes no nearer; the left one is 10 m off.
    let mut sorted = told.clone();
    sorted.sort();
    assert_eq!(
        sorted,
        ["backfalse01", "frontfalse01", "leftfalse101", "righttrue01"]
    );
}

#[test]
fn code_tells_whether_it_asks_about_other_lots() {
    let asks = |question: &str| {
        let found = code(&format!("Lot --> print({question})"));
        (found.asks, found.asks_beside)
    };
    assert_eq!(asks("inside(intra)"), (true, false));
    assert_eq!(asks("contextCount(intra, \"a\")"), (true, false));
    assert_eq!(asks("inside()"), (true, true));
    assert_eq!(asks("touches(inter)"), (true, true));
    assert_eq!(asks("overlaps(all)"), (true, true));
    assert_eq!(asks("getTreeKey()"), (false, false));
}

fn turned() -> impl Strategy<Value = Scope> {
    let numbers = prop::array::uniform9(-3.0..3.0f64);
    numbers.prop_map(|n| Scope {
        origin: DVec3::new(n[0], n[1], n[2]),
        axes: glam::DMat3::from_euler(glam::EulerRot::XYZ, n[3], n[4], n[5]),
        size: DVec3::new(n[6], n[7], n[8]).abs(),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Projections onto one box and the other in turn come to the two nearest places (Cheney and
    /// Goldstein 1959).
    #[test]
    fn boxes_are_as_far_as_their_nearest_places(a in turned(), b in turned()) {
        let onto = |scope: &Scope, place: DVec3| {
            let own = scope.axes.transpose() * (place - scope.origin);
            scope.origin + scope.axes * own.clamp(DVec3::ZERO, scope.size)
        };
        let mut place = a.origin;
        let mut far = f64::INFINITY;
        for _ in 0..20_000 {
            let other = onto(&b, place);
            place = onto(&a, other);
            far = place.distance(other);
        }
        let found = box_distance(&a, &b);
        prop_assert!((found - far).abs() < 1e-3, "{found} {far}");
    }

    /// Boxes of a row, in any order of the rules: the answers are those of the intervals.
    #[test]
    fn answers_do_not_depend_on_the_order(starts in prop::collection::vec((0u8..20, 1u8..6), 2..6), turn in 0usize..6) {
        let mut order: Vec<usize> = (0..starts.len()).collect();
        order.rotate_left(turn % starts.len());
        let cells: String = order
            .iter()
            .map(|&k| format!("[ t({}, 0, 0) s({}, 1, 1) primitiveCube() B({k}) ] ", starts[k].0, starts[k].1))
            .collect();
        let text = format!("Lot --> {cells} NIL B(k) --> print(str(k) + overlaps() + touches())");
        let mut found = said(&text);
        found.sort();
        let truth: Vec<String> = (0..starts.len())
            .map(|k| {
                let ends = |k: usize| (i32::from(starts[k].0), i32::from(starts[k].0) + i32::from(starts[k].1));
                let (low, high) = ends(k);
                let others = || (0..starts.len()).filter(|&j| j != k).map(ends);
                let overlaps = others().any(|(from, to)| low < to && from < high);
                let touches = others().any(|(from, to)| low <= to && from <= high);
                format!("{k}{overlaps}{touches}")
            })
            .collect();
        prop_assert_eq!(found, truth);
    }
}
