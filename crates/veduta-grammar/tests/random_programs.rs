//! Programs made at random from all operations: no panic, bounded time, closed solids stay closed.

#![allow(clippy::unwrap_used)] // helpers of tests

mod support;

use std::time::Instant;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use veduta_grammar::engine::{derive, operation_names, pack, Limits, Options, State};
use veduta_grammar::shape::Geometry;

/// Each operation with `#` for a number and `@` for a rule.
const OPERATIONS: &[&str] = &[
    "NIL",
    "alignScopeToAxes()",
    "alignScopeToAxes(y)",
    "alignScopeToAxes(object.xyz)",
    "alignScopeToGeometry(yUp, #, #)",
    "alignScopeToGeometry(zUp, any, world.lowest)",
    "alignScopeToGeometryBBox(zx)",
    "bakeUV(0)",
    "center(xz)",
    "cleanupGeometry(all, 0)",
    "cleanupGeometry(edges, #)",
    "color(#, #, #)",
    "comp(f) { top : @ | aslant : @ | border = @ | all : @ }",
    "comp(e) { eave || ridge : @ | hip = @ | # : @ | vertical : @ }",
    "comp(fe) { object.front : @ | world.up = @ | geometry.area > # && left : @ }",
    "comp(v) { border : @ | # : @ }",
    "comp(h) { all = @ }",
    "convexify()",
    "copyUV(0, #)",
    "deleteHoles()",
    "deleteTags(\"a*\")",
    "deleteUV(#)",
    "envelope(normal, #, #, #, #, #)",
    "envelope(world.up, #, #, #)",
    "extrude(#)",
    "extrude(world.up, #)",
    "extrude(\"x\", #)",
    "i(\"brick.obj\")",
    "insertAlongUV(0, \"brick.obj\", #)",
    "insertAlongUV(0, \"brick.obj\", #, vertex.normal, keepPosition)",
    "innerRectangle(scope) { shape : @ | remainder = @ }",
    "innerRectangle(edge) { shape : @ | remainder : @ }",
    "footprint()",
    "inline { @ @ }",
    "inline(unify) @",
    "intersect { t(#, #, #) @ }",
    "label(\"a\")",
    "mirror(true, false, # > 1)",
    "mirrorScope(true, true, false)",
    "modify(e) { ridge : t(0, #, 0) | 0 : NIL }",
    "modify(f) { top : @ | side : s('0.5, '1, '1) }",
    "modify(v) { # : t(#, #, #) }",
    "normalizeUV(0, uv, collectiveAllFaces)",
    "offset(#)",
    "offset(-#, inside)",
    "offset(#, border)",
    "primitiveCone(#, #, #)",
    "primitiveCube(#, '#, #)",
    "primitiveCylinder()",
    "primitiveDisk(#)",
    "primitiveQuad(#, #)",
    "primitiveSphere(#, #)",
    "print(geometry.volume + geometry.area(side) + geometry.angle(azimuth))",
    "print(geometry.isConcave + geometry.boundaryLength + geometry.nVertices)",
    "print(geometry.du(0, unitSpace) + sum(comp(fe) { all : scope.sx }))",
    "print(inside() + touches(all) + overlaps(intra, \"a\"))",
    "print(minimumDistance(all, \"a\") + contextCompare(all, \"a\", area.largest))",
    "print(geometry.isPlanar(#)) print(geometry.isRectangular(#))",
    "projectUV(0)",
    "r(#, #, #)",
    "r(scopeCenter, #, #, #)",
    "report(\"a\", #)",
    "rectify(#)",
    "resetGeometry()",
    "resetMaterial()",
    "reverseNormals()",
    "roofButterfly(#, #)",
    "roofCrossGable(byHeight, #, 0, comp.index)",
    "roofDome(#, 0, #)",
    "roofDutch(#, 0.5, #)",
    "roofFlat(#, #, #)",
    "roofGable(#, #, #)",
    "roofGable(byHeight, #, 0, 0, # > 1, #)",
    "roofGambrel(#, #, #)",
    "roofHalfHip(#, 0.3, #)",
    "roofHip(byHeight, #, #)",
    "roofHip(#)",
    "roofHip(#, 0, true)",
    "roofMansard(#, #, #, #)",
    "roofOnion(#)",
    "roofPerEdge(comp(fe) { front : 90 | all : # })",
    "roofPyramid(byAngle, #)",
    "roofRidge(byHeight, #)",
    "roofSaltbox(#, #)",
    "roofSawtooth(#, #)",
    "roofShed(#, #)",
    "roofSkillion(#, #, #)",
    "roofVault(#, #)",
    "rotate(rel, world, #, #, #)",
    "rotate(abs, scope, #, #, #)",
    "rotateScope(#, #, #)",
    "rotateUV(0, #)",
    "s(#, '#, #)",
    "scaleUV(0, #, #)",
    "scatter(surface, #, gaussian, front, '#) { @ }",
    "scatter(scope, #, uniform) { @ }",
    "set(material.color.r, #)",
    "setMaterial([\"color.r\", \"0.5\", \"roughness\", #])",
    "setPivot(yzx, 3)",
    "setback(#) { front : @ | all = @ | remainder : @ }",
    "setback(comp(fe) { front : # | left : # }) { side : @ | remainder = @ }",
    "setbackPerEdge('#) { all : @ | remainder : @ }",
    "setbackToArea(#) { back : @ | remainder : @ }",
    "setupProjection(0, scope.xz, ~#, '#, #, #, #)",
    "shapeL(#, #) { shape : @ | remainder : @ }",
    "shapeO(#, #, #, #) { shape : @ | remainder : @ }",
    "shapeU(#, #, #) { shape = @ | remainder = @ }",
    "scatter(volume, #, uniform) { @ }",
    "set(scope.tx, #)",
    "snap(xy, \"a\", #)",
    "split(x) { # : @ | { ~# : @ | '# : @ }* }",
    "split(y) { ~# : @ | ~# : @ }",
    "split(z, noAdjust) { { ~# : @ }* }",
    "split(u) { ~# : @ | # : @ }",
    "split(v, unitSpace, 0) { # : @ }*",
    "splitAndSetbackPerimeter(#) { ~# : # : @ | # : # : @ } { remainder : @ }",
    "splitAndSetbackPerimeter('#, #, comp(fe) { front : true }) { ~# : # : @ }* { remainder = @ }",
    "splitArea(x) { # : @ | { ~# : @ }* }",
    "splitArea(y) { '0.3 : @ | ~1 : @ }",
    "subtract(swap) { r(#, #, #) primitiveCube() }",
    "t(#, '#, #)",
    "tag(\"ab\")",
    "taper(#)",
    "texture(\"a.jpg\")",
    "tileUV(0, ~#, #)",
    "translate(rel, scope, #, #, #)",
    "translate(abs, world, #, #, #)",
    "translateUV(0, #, #)",
    "trim()",
    "union @",
];

const NUMBERS: &[&str] = &[
    "0",
    "1",
    "2",
    "3",
    "0.5",
    "7.25",
    "-1",
    "-0.01",
    "1e-9",
    "30",
    "45",
    "90",
    "100",
    "1e5",
    "1e15",
    "1e300",
    "(1 / 0)",
    "(0 / 0)",
    "rand(4)",
    "scope.sx",
    "(scope.sy / 2)",
    "geometry.area",
    "comp.index",
];

fn number() -> impl Strategy<Value = &'static str> {
    // Plain sizes are more likely, so that programs get somewhere.
    prop_oneof![4 => prop::sample::select(&NUMBERS[1..6]), 1 => prop::sample::select(NUMBERS)]
}

/// A body whose blocks go on to `next`.
fn body(next: &'static str) -> impl Strategy<Value = String> {
    let one = (
        prop::sample::select(OPERATIONS),
        prop::collection::vec(number(), 7),
    );
    prop::collection::vec(one, 1..4).prop_map(move |all| {
        let mut text = String::new();
        for (operation, numbers) in all {
            let mut numbers = numbers.iter();
            for character in operation.chars() {
                match character {
                    '#' => text.push_str(numbers.next().unwrap_or(&"1")),
                    '@' => text.push_str(next),
                    other => text.push(other),
                }
            }
            text.push(' ');
        }
        text
    })
}

fn program() -> impl Strategy<Value = String> {
    (body("A"), body("B"), body("C."), any::<bool>()).prop_map(|(lot, a, b, last)| {
        let end = if last { "A" } else { "" };
        format!("Lot --> {lot} {end}\nA --> {a}\nB --> {b} C.")
    })
}

/// A lot around the origin, with a courtyard or without.
fn lot(radii: &[f64], court: bool) -> State {
    let step = std::f64::consts::TAU / radii.len() as f64;
    let corner = |(k, r): (usize, &f64)| {
        let angle = step * k as f64;
        ((r * angle.cos()).round(), r * angle.sin())
    };
    let ring: Vec<(f64, f64)> = radii.iter().enumerate().map(corner).collect();
    let hole: &[(f64, f64)] = &[(0.1, 0.1), (0.1, -0.1), (-0.1, -0.1), (-0.1, 0.1)];
    if court {
        support::lot_of(&[&ring, hole])
    } else {
        support::lot_of(&[&ring])
    }
}

fn check_one(text: &str, start: State, seed: u64) -> Result<bool, TestCaseError> {
    let code = support::code(text);
    let options = Options {
        seed,
        limits: Limits {
            depth: 20,
            shapes: 3_000,
            faces: 3_000,
            parts: 200,
            seconds: 2.0,
        },
        assets: support::assets(),
        ..Options::default()
    };
    let began = Instant::now();
    let found = derive(&code, 0, start, &options);
    let seconds = began.elapsed().as_secs_f64();
    // Far over the limit: the machine may be busy.
    prop_assert!(seconds < 60.0, "{seconds} s\n{text}");
    let Ok(tree) = found else {
        return Ok(false);
    };
    for leaf in tree.leaves() {
        let form = &leaf.state.form;
        prop_assert!(
            form.scope.size.is_finite() && form.scope.origin.is_finite(),
            "{text}"
        );
        if let Geometry::Faces { mesh, solid } = &form.geometry {
            prop_assert!(mesh.points.iter().all(|point| point.is_finite()), "{text}");
            prop_assert!(!solid || mesh.is_closed(), "not closed\n{text}");
        }
    }
    prop_assert!(
        pack(&tree).uv.iter().flatten().all(|c| c.is_finite()),
        "{text}"
    );
    Ok(true)
}

/// 400 programs in all, the same in each run; or as many others as `FUZZ_CASES` of the environment
/// says, drawn anew.
fn config() -> ProptestConfig {
    let told = std::env::var("FUZZ_CASES").ok();
    let told: Option<u32> = told.and_then(|count| count.parse().ok());
    ProptestConfig {
        cases: told.unwrap_or(400).div_ceil(2),
        rng_seed: told.map_or(RngSeed::Fixed(1), |_| RngSeed::Random),
        ..ProptestConfig::default()
    }
}

// Two tests run side by side, each over half of the programs.
proptest! {
    #![proptest_config(config())]

    #[test]
    fn nothing_breaks_on_lots(
        text in program(),
        radii in prop::collection::vec(2.0..12.0f64, 3..12),
        seed in any::<u64>(),
    ) {
        check_one(&text, lot(&radii, false), seed)?;
    }

    #[test]
    fn nothing_breaks_on_lots_with_courts(
        text in program(),
        radii in prop::collection::vec(2.0..12.0f64, 3..12),
        seed in any::<u64>(),
    ) {
        check_one(&text, lot(&radii, true), seed)?;
    }
}

#[test]
fn every_operation_takes_part() {
    for name in operation_names() {
        let takes = |text: &&&str| text.starts_with(name);
        assert!(OPERATIONS.iter().any(|text| takes(&text)), "{name}");
    }
}
