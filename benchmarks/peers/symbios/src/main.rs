//! The crate `symbios-shape` on its own example and on a facade of boxes, for benchmarks/grammar/grammar.py.
//!
//! `symbios-peer CORES COUNT` prints one line per grammar: its name, terminals, seconds.

use std::thread;
use std::time::Instant;

use symbios_shape::grammar::parse_ops;
use symbios_shape::{Interpreter, Quat, Scope, Vec3};

type Rules = &'static [(&'static str, &'static str)];

/// The crate's example `simple_building`.
const BOXES: Rules = &[
    ("Lot", "Extrude(12) Split(Y) { 3: Ground | ~1: Floor | ~1: Floor | 2: Roof }"),
    ("Ground", "Split(X) { 1.5: Column | ~1: ShopFront | 1.5: Column }"),
    ("Floor", "Repeat(X, 2.5) { Window }"),
    ("Roof", "Taper(0.75) I(\"RoofMesh\")"),
];

/// Floors and bays of a facade; benchmarks/grammar/grammar.py has the same in CGA.
const FACADE: Rules = &[
    ("Lot", "Extrude(18) Repeat(Y, 3) { Floor }"),
    ("Floor", "Repeat(X, 2.4) { Bay }"),
    ("Bay", "Split(X) { 0.6: Wall | ~1: Middle | 0.6: Wall }"),
    ("Middle", "Split(Y) { 0.4: Wall | ~1: Window | 0.5: Wall }"),
];

fn terminals(rules: Rules, size: f64, count: u64, seed: u64) -> usize {
    let mut engine = Interpreter::new();
    for (name, text) in rules {
        engine.add_rule(*name, parse_ops(text).expect("the rule is read"));
    }
    let mut all = 0;
    for lot in 0..count {
        engine.seed = seed + lot;
        let footprint = Scope::new(Vec3::ZERO, Quat::IDENTITY, Vec3::new(size, 0.0, size));
        let model = engine.derive(footprint, "Lot").expect("the lot derives");
        all += std::hint::black_box(model).len();
    }
    all
}

fn main() {
    let numbers: Vec<u64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let (cores, count) = (numbers[0], numbers[1]);
    for (name, rules, size) in [("boxes", BOXES, 15.0), ("facade", FACADE, 24.0)] {
        let began = Instant::now();
        let workers: Vec<_> = (0..cores)
            .map(|core| thread::spawn(move || terminals(rules, size, count / cores, core * count)))
            .collect();
        let all: usize = workers.into_iter().map(|w| w.join().expect("a worker ends")).sum();
        println!("{name} {all} {}", began.elapsed().as_secs_f64());
    }
}
