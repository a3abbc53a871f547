//! What would take for ever, or all memory, is stopped with the reason.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support;

use crate::support::{code, lot, lot_of};
use veduta_grammar::engine::{derive, rederive, Limits, Options, State};

/// Little work, and much time: what the clock stops depends on the machine.
const LITTLE: Limits = Limits {
    depth: 50,
    shapes: 100_000,
    faces: 100_000,
    parts: 10_000,
    seconds: 3_600.0,
    work: 3_000_000,
    memory: 1 << 30,
};

fn options() -> Options {
    Options {
        limits: LITTLE,
        assets: support::assets(),
        ..Options::default()
    }
}

fn fault_on(text: &str, start: State) -> String {
    let code = code(text);
    let found = derive(&code, 0, start, &options());
    found.unwrap_err().message
}

fn fault(text: &str) -> String {
    fault_on(text, lot())
}

/// A lot of many corners that turn in and out.
fn star() -> State {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 2_000.0;
        let r = 20.0 + 15.0 * ((k % 2) as f64) + (k % 7) as f64;
        (r * angle.cos(), r * angle.sin())
    };
    lot_of(&[&(0..2_000).map(corner).collect::<Vec<_>>()])
}

#[test]
fn work_within_one_operation_is_bounded() {
    let programs = [
        "Lot --> primitiveSphere(90, 90) union { t(0.1, 0.2, 0.3) r(1, 2, 3) X. } Y.",
        "Lot --> primitiveSphere(90, 90) subtract { r(9, 8, 7) s('0.9, '0.9, '0.9) X. } Y.",
        "Lot --> primitiveCylinder(900) split(y) { ~1 : X. | { ~0.002 : X. }* }",
        "Lot --> primitiveSphere(90, 90) splitArea(x) { { 0.05 : X. }* }",
        "Lot --> A A  A --> primitiveSphere(90, 90) t(rand(1), 0, 0) B  B --> case inside(all) : X. else : Y.",
        "Lot --> scatter(surface, 9999, uniform) { [ X. ] scatter(scope, 9999, uniform) { Y. } }",
        "Lot --> primitiveSphere(90, 90) scatter(volume, 999, uniform) { X. }",
        "Lot --> primitiveSphere(90, 90) A(9)  A(n) --> case n < 1 : X. else : cleanupGeometry(all, 0) A(n - 1)",
        "Lot --> primitiveSphere(90, 90) innerRectangle(edge) { shape : X. }",
        "Lot --> primitiveCylinder(999) r(90, 0, 0) comp(f) { top : trim() trim() trim() X. }",
    ];
    for text in programs {
        let found = fault(text);
        assert!(found.contains("steps of work"), "{found}\n{text}");
    }
}

#[test]
fn work_on_outlines_is_bounded() {
    for operation in [
        "convexify()",
        "splitAndSetbackPerimeter(0) { ~100 : 2 : X. }* { remainder : Y. }",
        "roofHip(40)",
        "roofGable(40)",
        "roofDutch(40, 0.5)",
        "roofHalfHip(40, 0.3)",
        "roofMansard(70, 30, 2)",
        "offset(-1)",
        "offset(1)",
        "setback(1) { all : X. }",
        "setbackToArea(10) { all : X. }",
        "envelope(normal, 9, 3, 45, 3, 45, 3, 45)",
    ] {
        let found = fault_on(&format!("Lot --> {operation} Y."), star());
        assert!(found.contains("steps of work"), "{found}\n{operation}");
    }
}

/// Twice as many calls with each level: 2^100.
#[test]
fn functions_that_call_themselves_end() {
    let text = "f(n) = case n < 1 : 1 else : f(n - 1) + f(n - 1)  Lot --> s(f(100), 1, 1) X.";
    assert!(fault(text).contains("steps of work"));
}

#[test]
fn memory_is_bounded() {
    let faces = "Lot --> scatter(scope, 999, uniform) { s(1, 1, 1) primitiveSphere(40, 40) X. }";
    let arrays = "Lot --> A(0)  A(n) --> B(setElems([0:9999], 0, n)) A(n + 1)  B(x) --> X.";
    for text in [faces, arrays] {
        let mut little = options();
        little.limits.memory = 4 << 20;
        let found = derive(&code(text), 0, lot(), &little).unwrap_err().message;
        assert!(found.contains("MiB of memory"), "{found}\n{text}");
    }
}

#[test]
fn strings_are_bounded() {
    let double = "s(n) = case n < 1 : \"abcdefgh\" else : s(n - 1) + s(n - 1)";
    for value in [
        "s(20)",
        "replace(s(12), \"a\", s(12))",
        "listFromArray(stringArray([0:9999]) .+ s(10))",
        "str(stringArray([0:9999]) .+ s(10))",
        "stringArray([0:9999]) .+ s(10)",
        "s(15) + [0:9999] + s(15) + s(15) + s(15)",
    ] {
        let found = fault(&format!("{double}  Lot --> print({value}) X."));
        let told = found.contains("a string of") || found.contains("bytes");
        assert!(told, "{found}\n{value}");
    }
    assert!(fault("Lot --> print(comp(f) { all : [1, 2] }) X.").contains("an array in an array"));
}

/// As much again for each part that is derived anew, and no more.
#[test]
fn a_part_derived_anew_is_bounded() {
    let code = code("attr n = 1  Lot --> A  A --> s(f(n), 1, 1) X.  f(n) = case n < 1 : 1 else : f(n - 1) + f(n - 1)");
    let mut tree = derive(&code, 0, lot(), &options()).unwrap();
    let mut more = options();
    let edit = veduta_grammar::engine::Edit {
        values: vec![("n".into(), veduta_grammar::engine::Value::Number(100.0))],
        ..Default::default()
    };
    more.overrides = veduta_grammar::engine::Overrides::new(vec![(vec![0], edit)]);
    let before = tree.clone();
    let fault = rederive(&code, &mut tree, &[0], &more).unwrap_err();
    assert!(fault.message.contains("steps of work"), "{}", fault.message);
    assert!(tree == before);
}
