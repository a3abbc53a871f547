//! Programs made at random from all operations: no panic, bounded work and memory, the same result
//! again and on another thread, closed solids stay closed.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

use crate::support;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::Mutex;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use crate::programs::{Case, Words};
use veduta_grammar::engine::{
    derive, operation_names, pack, rederive, Fault, Limits, Options, Packed, Tree,
};
use veduta_grammar::shape::Geometry;

/// Each operation with `#` for a number and `@` for a rule.
const OPERATIONS: &[&str] = &[
    "NIL",
    "alignScopeToAxes()",
    "alignScopeToAxes(y)",
    "alignScopeToAxes(object.xyz)",
    "alignScopeToGeometry(yUp, #, #)",
    "alignScopeToGeometry(zUp, auto)",
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
    "extrude(world.x, #)",
    "extrude(\"x\", #)",
    "i(\"brick.obj\")",
    "insertAlongUV(0, \"brick.obj\", #)",
    "insertAlongUV(0, \"brick.obj\", #, vertex.normal, keepPosition)",
    "innerRect",
    "innerRectangle(scope) { shape : @ | remainder = @ }",
    "innerRectangle(edge) { shape : @ | remainder : @ }",
    "footprint()",
    "i(\"brick.obj\")",
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
    "setTagsFromEdgeAttrs()",
    "taper(#)",
    "texture(\"a.jpg\")",
    "tileUV(0, ~#, #)",
    "translate(rel, scope, #, #, #)",
    "translate(abs, world, #, #, #)",
    "translateUV(0, #, #)",
    "offsetUV(0, #, #)",
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

const WORDS: Words = Words {
    operations: OPERATIONS,
    plain: &["1", "2", "3", "0.5", "7.25", "0.3", "high", "1 + rand(3)"],
    numbers: NUMBERS,
};

/// The programs of each run of the tests.
const PROGRAMS: u64 = 10_000;
/// Of how many programs one is derived again, and shapes of it anew.
const AGAIN: u64 = 8;

/// Which programs are derived: those numbered from 0 on; or as many as `FUZZ_CASES` of the
/// environment says, from `FUZZ_FIRST` on or from anywhere, with the time limit that counts.
struct Plan {
    first: u64,
    count: u64,
    told: bool,
    /// `FUZZ_STEPS`: steps of work in place of seconds, on a machine that is busy.
    steps: Option<u64>,
}

impl Plan {
    fn of_environment() -> Self {
        let told = |name: &str| std::env::var(name).ok().and_then(|told| told.parse().ok());
        let count = told("FUZZ_CASES");
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let anywhere = now.map_or(0, |now| now.as_nanos() as u64 >> 16 << 24);
        Self {
            first: told("FUZZ_FIRST").unwrap_or(if count.is_some() { anywhere } else { 0 }),
            count: count.unwrap_or(PROGRAMS),
            told: count.is_some(),
            steps: told("FUZZ_STEPS"),
        }
    }

    /// So many steps are some tenths of a second. The clock stops none of the programs of each run:
    /// how fast a machine is, makes no difference.
    fn limits(&self) -> Limits {
        let by_time = self.told && self.steps.is_none();
        Limits {
            depth: 20,
            shapes: 1_000,
            faces: 2_000,
            parts: 100,
            seconds: if by_time { 2.0 } else { 3_600.0 },
            work: if by_time {
                u64::MAX
            } else {
                self.steps.unwrap_or(20_000_000)
            },
            memory: 256 << 20,
        }
    }
}

/// What is in a tree, without numbers that are none.
fn result(found: &Result<Tree, Fault>) -> Result<(Packed, Vec<String>, usize), String> {
    let tree = found.as_ref().map_err(|fault| fault.message.clone())?;
    let names = tree.nodes.iter().map(|node| node.name.to_string());
    Ok((pack(tree), names.collect(), tree.messages.len()))
}

fn check_sound(tree: &Tree, limits: &Limits, of: &str) {
    // The start shape is not counted.
    assert!(tree.nodes.len() <= limits.shapes + 1, "{of}");
    for leaf in tree.leaves() {
        let form = &leaf.state.form;
        let is_finite = form.scope.size.is_finite() && form.scope.origin.is_finite();
        assert!(is_finite, "{of}");
        if let Geometry::Faces { mesh, solid } = &form.geometry {
            assert!(mesh.points.iter().all(|point| point.is_finite()), "{of}");
            assert!(mesh.face_count() <= limits.faces, "{of}");
            assert!(!solid || mesh.is_closed(), "not closed: {of}");
        }
    }
    let packed = pack(tree);
    assert!(packed.uv.iter().flatten().all(|c| c.is_finite()), "{of}");
}

/// Derives a program, looks at what comes of it, and gives what became of it and how long it took.
fn check_one(number: u64, plan: &Plan) -> (String, f64) {
    let case = Case::of(number, &WORDS);
    let of = format!("FUZZ_FIRST={number}\n{}\n{}", case.main, case.library);
    let told = OnPanic(&of);
    let code = case.code();
    let options = Options {
        seed: case.seed,
        limits: plan.limits(),
        assets: support::assets(),
        ..Options::default()
    };
    let began = busy_seconds();
    let found = derive(&code, 0, case.start.clone(), &options);
    let seconds = busy_seconds() - began;
    if let Ok(tree) = &found {
        check_sound(tree, &options.limits, &of);
    }
    if number % AGAIN == 0 && !plan.told {
        let there = || result(&derive(&code, 0, case.start.clone(), &options));
        let elsewhere = std::thread::scope(|scope| scope.spawn(there).join().unwrap());
        assert!(elsewhere == result(&found), "another result: {of}");
    }
    if let (Ok(tree), 0) = (&found, number % AGAIN) {
        let mut again = tree.clone();
        let node = case.seed as usize % tree.nodes.len();
        let done = rederive(&code, &mut again, &tree.path(node as u32), &options);
        if let Ok(done) = done {
            assert!(done, "{of}");
            assert!(result(&Ok(again)) == result(&found), "another part: {of}");
        }
    }
    std::mem::forget(told);
    let outcome = found.map_or_else(|fault| kind_of(&fault.message), |_| "derived".into());
    (outcome, seconds)
}

/// Says which program it was, where a thread panics.
struct OnPanic<'a>(&'a str);

impl Drop for OnPanic<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("{}", self.0);
        }
    }
}

/// A message without its numbers.
fn kind_of(message: &str) -> String {
    let words = message.split(' ').take(5);
    let words = words.filter(|word| !word.contains(|c: char| c.is_ascii_digit()));
    words.collect::<Vec<_>>().join(" ")
}

/// How long this thread has been at work (s), where the system tells; else how long it has been.
fn busy_seconds() -> f64 {
    static STARTED: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let busy = told.and_then(|told| told.split(' ').next()?.parse::<f64>().ok());
    busy.map_or_else(
        || STARTED.get_or_init(Instant::now).elapsed().as_secs_f64(),
        |nanoseconds| 1e-9 * nanoseconds,
    )
}

/// How many programs came to what, with the number of one.
type Outcomes = BTreeMap<String, (u64, u64)>;

/// Thousands of programs, on two threads: each tells nothing but its number where it fails.
#[test]
fn nothing_breaks() {
    let plan = Plan::of_environment();
    let next = AtomicU64::new(0);
    let found: Mutex<(Outcomes, Vec<(f64, u64)>)> = Mutex::default();
    let work = || loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        if index >= plan.count {
            break;
        }
        let number = plan.first.wrapping_add(index);
        let (outcome, seconds) = check_one(number, &plan);
        let mut found = found.lock().unwrap();
        let known = found.0.entry(outcome).or_default();
        *known = (known.0 + 1, number);
        found.1.push((seconds, number));
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        scope.spawn(work);
    });
    let (outcomes, mut times) = found.into_inner().unwrap();
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    if plan.told {
        println!(
            "{outcomes:#?}\nslowest (s): {:?}",
            &times[..times.len().min(20)]
        );
    }
    // Most programs that are made must be of use for this.
    let derived = outcomes.get("derived").map_or(0, |known| known.0);
    assert!(
        derived * 3 > plan.count || plan.count < 100,
        "{outcomes:#?}"
    );
}

#[test]
fn every_operation_takes_part() {
    for name in operation_names() {
        let takes = |text: &&&str| text.starts_with(name);
        assert!(OPERATIONS.iter().any(|text| takes(&text)), "{name}");
    }
}
