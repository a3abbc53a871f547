//! Attributes of the edges of a lot, and where lots lie on Earth: hand-worked truth.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::collections::HashMap;

use veduta_grammar::engine::{derive, Options, State, Value, EDGES, ON_EARTH};

use crate::support::{code, lot_of};

fn texts(all: &[&str]) -> Value {
    Value::list(all.iter().map(|text| Value::text(text)).collect())
}

fn numbers(all: &[f64]) -> Value {
    Value::list(all.iter().map(|&number| Value::Number(number)).collect())
}

/// A lot of 10 m by 6 m whose edges run from the south to the east, the north and the west.
fn square() -> State {
    lot_of(&[&[(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)]])
}

fn said(text: &str, start: State, given: &[(&str, Value)]) -> Vec<String> {
    let code = code(text);
    let given = given.iter();
    let attributes: HashMap<String, Value> = given
        .map(|(name, value)| (name.to_string(), value.clone()))
        .collect();
    let options = Options {
        attributes,
        ..Options::default()
    };
    derive(&code, code.start.unwrap(), start, &options)
        .unwrap()
        .messages
}

fn sides() -> (String, Value) {
    let value = texts(&["south", "east", "north", "west"]);
    (format!("{EDGES}side"), value)
}

#[test]
fn faces_have_what_the_edge_below_them_has() {
    let (name, value) = sides();
    let text = "Lot --> extrude(3) comp(f) { world.south : P | world.east : P | world.north : P \
                | world.west : P | all : NIL } P --> print(edgeAttr.getString(\"side\"))";
    let found = said(text, square(), &[(&name, value)]);
    assert_eq!(found, ["south", "east", "north", "west"]);
}

#[test]
fn parts_of_walls_stand_for_the_edge_that_they_cover_most() {
    let lot = lot_of(&[&[(0.0, 0.0), (7.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)]]);
    let width = numbers(&[1.0, 2.0, 3.0, 4.0, 5.0]);
    let name = format!("{EDGES}n");
    let strips = "split(x) { 5 : P | 1.5 : P | 1.5 : P | ~1 : P }";
    let text = format!(
        "Lot --> s(10, 0, 6) t(0, 4, 0) s(10, 1, 6) primitiveCube() comp(f) {{ world.south : W \
         | all : NIL }} W --> {strips} P --> print(edgeAttr.getFloat(\"n\"))"
    );
    assert_eq!(said(&text, lot, &[(&name, width)]), ["1", "1", "2", "2"]);
}

#[test]
fn concave_lots_tell_their_nearest_edge() {
    let l = lot_of(&[&[
        (0.0, 0.0),
        (8.0, 0.0),
        (8.0, 2.0),
        (3.0, 2.0),
        (3.0, 6.0),
        (0.0, 6.0),
    ]]);
    let name = format!("{EDGES}n");
    let text = "Lot --> extrude(3) comp(f) { bottom : NIL | top : NIL | all : P } \
                P --> print(edgeAttr.getFloat(\"n\"))";
    let mut found = said(
        text,
        l,
        &[(&name, numbers(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]))],
    );
    found.sort();
    assert_eq!(found, ["1", "2", "3", "4", "5", "6"]);
}

#[test]
fn edges_and_what_is_missing() {
    let (name, value) = sides();
    let text = "Lot --> comp(fe) { all : P } P --> print(edgeAttr.getString(\"side\"))";
    let mut found = said(text, square(), &[(&name, value.clone())]);
    found.sort();
    assert_eq!(found, ["east", "north", "south", "west"]);
    let text = "Lot --> extrude(3) comp(f) { front : P | all : NIL } P --> \
                print(edgeAttr.getFloat(\"side\")) print(edgeAttr.getBool(\"none\")) \
                print(len(edgeAttr.getString(\"none\")))";
    let wrong = numbers(&[1.0, 2.0]);
    let given = [(name.as_str(), value), ("/edgeattr/none", wrong)];
    assert_eq!(said(text, square(), &given), ["0", "false", "0"]);
}

#[test]
fn edges_give_tags() {
    let (name, value) = sides();
    let given = [(name.as_str(), value)];
    let text =
        "Lot --> setTagsFromEdgeAttrs() comp(fe) { isTagged(\"edgeattr.side.south\") : P(1) \
                | isTagged(\"edgeattr.side.*\") : P(2) | all : P(3) } P(n) --> print(n)";
    let mut found = said(text, square(), &given);
    found.sort();
    assert_eq!(found, ["1", "2", "2", "2"]);
    let text =
        "Lot --> setTagsFromEdgeAttrs() setback(2) { isTagged(\"edgeattr.side.north\") : P } \
                P --> print(geometry.area)";
    assert_eq!(said(text, square(), &given), ["20"]);
    let text = "Lot --> print(geometry.hasTags(\"edgeattr.side.*\")) setTagsFromEdgeAttrs() \
                print(geometry.hasTags(\"edgeattr.side.*\")) deleteTags() \
                print(geometry.hasTags(\"edgeattr.side.*\"))";
    assert_eq!(said(text, square(), &given), ["false", "true", "false"]);
}

#[test]
fn streets_are_at_the_edges_that_have_one() {
    let width = numbers(&[6.0, 8.0, 0.0, 0.0]);
    let given = [("/edgeattr/streetWidth", width)];
    let text = "Lot --> extrude(3) comp(f) { street.front : P(\"front\") | street.back : P(\"back\") \
                | street.right : P(\"right\") | street.left : P(\"left\") | street.side : P(\"?\") } \
                P(s) --> print(s)";
    let mut found = said(text, square(), &given);
    found.sort();
    assert_eq!(found, ["back", "front", "front", "left"]);
    let mut without = said(text, square(), &[]);
    without.sort();
    assert_eq!(without, ["back", "front", "left", "right"]);
}

#[test]
fn older_words_for_sides_at_streets() {
    let width = numbers(&[6.0, 8.0, 0.0, 0.0]);
    let given = [("/edgeattr/streetWidth", width)];
    let text = "Lot --> extrude(3) comp(f) { streetSide : P(\"at\") | noStreetSide : P(\"off\") } \
                P(s) --> print(s)";
    let sorted = |given: &[(&str, Value)]| {
        let mut found = said(text, square(), given);
        found.sort();
        found
    };
    assert_eq!(sorted(&given), ["at", "at", "off", "off"]);
    assert_eq!(sorted(&[]), ["at", "off", "off", "off"]);
}

#[test]
fn places_on_earth() {
    // Half a degree east of 9, 0.00001 of a degree for each metre.
    let told = numbers(&[500.0, 600.0, 9.5, 47.0, 1e-5, 0.0, 0.0, 1e-5]);
    let values = ["x", "y", "lon", "lat"].map(|word| format!("print(getGeoCoord({word}))"));
    let text = format!("Lot --> t(3, 0, -2) {}", values.concat());
    let found = said(&text, square(), &[(ON_EARTH, told)]);
    // The scope's origin is the corner in the north-west, 6 m north of the first.
    assert_eq!(found, ["503", "608", "9.50003", "47.00008"]);
    assert_eq!(said(&text, square(), &[]), ["3", "8", "0", "0"]);
    // Older files write X and Y.
    let text = "Lot --> t(3, 0, -2) print(getGeoCoord(X)) print(getGeoCoord(Y))";
    let told = numbers(&[500.0, 600.0, 9.5, 47.0, 1e-5, 0.0, 0.0, 1e-5]);
    assert_eq!(said(text, square(), &[(ON_EARTH, told)]), ["503", "608"]);
    assert_eq!(said(text, square(), &[]), ["3", "8"]);
}
