//! Programs, lots and seeds made at random, each from its number alone.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::f64::consts::TAU;

use veduta_grammar::engine::{lower, Code, State};
use veduta_grammar::{check, Program, Source};

use super::draw::Draw;
use super::support;

/// What programs are made of: operations with `#` for a number and `@` for a rule, and numbers.
pub struct Words {
    pub operations: &'static [&'static str],
    /// Numbers of which programs get somewhere.
    pub plain: &'static [&'static str],
    pub numbers: &'static [&'static str],
}

/// A program with what it starts from.
pub struct Case {
    pub main: String,
    pub library: String,
    pub start: State,
    pub seed: u64,
}

impl Case {
    pub fn of(number: u64, words: &Words) -> Self {
        let mut draw = Draw(number.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d);
        let library = format!(
            "attr high = {}\nPart(n) --> {} Whole.\nOther --> {}",
            draw.plain(),
            draw.choice(words, "Other"),
            draw.choice(words, "Leaf.")
        );
        let again = if draw.one_in(3) { "A" } else { "" };
        let main = format!(
            "import lib : \"lib.cga\"\nattr high = {}\nf(n) = n + high\n\
             Lot --> {} {again}\nA --> {}\nB(n) --> {} C.",
            draw.plain(),
            draw.body(words, "A"),
            draw.choice(words, "B(f(1))"),
            draw.choice(words, "lib.Part(n)"),
        );
        Self {
            main,
            library,
            start: lot(&mut draw),
            seed: draw.next(),
        }
    }

    /// The rules as the engine takes them.
    pub fn code(&self) -> Code {
        let program = Program::load(Source::new("main.cga", self.main.clone()), |_, _| {
            Ok(Source::new("lib.cga", self.library.clone()))
        });
        let checked = check(&program);
        assert!(!checked.has_errors(), "{}", checked.render(&program));
        let lowered = lower(&program, &checked);
        assert!(!lowered.has_errors(), "{:?}", lowered.diagnostics);
        lowered.code
    }
}

/// A lot around the origin, with a courtyard or without.
fn lot(draw: &mut Draw) -> State {
    let count = 3 + draw.below(9);
    let ring: Vec<(f64, f64)> = (0..count)
        .map(|k| {
            let (angle, r) = (TAU * k as f64 / count as f64, 2.0 + 10.0 * draw.share());
            ((r * angle.cos()).round(), r * angle.sin())
        })
        .collect();
    let hole: &[(f64, f64)] = &[(0.1, 0.1), (0.1, -0.1), (-0.1, -0.1), (-0.1, 0.1)];
    match draw.below(4) {
        0 => support::lot(),
        1 => support::lot_of(&[&ring, hole]),
        _ => support::lot_of(&[&ring]),
    }
}

impl Draw {
    fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    fn plain(&mut self) -> &'static str {
        ["0.4", "1", "2.5", "4", "9"][self.below(5)]
    }

    fn number(&mut self, words: &Words) -> &'static str {
        match self.below(8) {
            0 => words.numbers[self.below(words.numbers.len())],
            _ => words.plain[self.below(words.plain.len())],
        }
    }

    /// Some operations, whose blocks go on to `next`.
    fn body(&mut self, words: &Words, next: &str) -> String {
        let mut text = String::new();
        for _ in 0..1 + self.below(3) {
            let operation = words.operations[self.below(words.operations.len())];
            let pushed = self.one_in(12);
            text.push_str(if pushed { "[ " } else { "" });
            for character in operation.chars() {
                match character {
                    '#' => text.push_str(self.number(words)),
                    '@' => text.push_str(next),
                    other => text.push(other),
                }
            }
            text.push_str(if pushed { " Kept. ] " } else { " " });
        }
        text
    }

    /// A body, alternatives by chance, or alternatives by a condition.
    fn choice(&mut self, words: &Words, next: &str) -> String {
        let one = self.body(words, next);
        match self.below(6) {
            0 => format!("30% : {one} {next} else : {}", self.body(words, next)),
            1 => format!(
                "case geometry.area > {} : {one} else : {} {next}",
                self.number(words),
                self.body(words, next)
            ),
            _ => format!("{one} {}", if self.one_in(2) { next } else { "" }),
        }
    }
}
