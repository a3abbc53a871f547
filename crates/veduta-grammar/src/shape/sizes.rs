//! The sizes of a split: absolute, relative and floating parts, and patterns that repeat.

/// How long a part of a split is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// Metres.
    Absolute(f64),
    /// A share of the whole.
    Relative(f64),
    /// Metres if it can be; floating parts share what the others leave, in these proportions.
    Floating(f64),
}

/// A split as it is written.
#[derive(Debug, Clone, PartialEq)]
pub enum Pattern {
    Part(Size),
    /// `{ ... }*`: as often as there is room.
    Repeat(Vec<Pattern>),
}

/// A part of a split with its place: `part` counts the parts as they are written, `start` and
/// `length` are metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    pub part: usize,
    pub start: f64,
    pub length: f64,
}

/// A split with too many parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooManyParts {
    pub parts: usize,
    pub most: usize,
}

impl std::fmt::Display for TooManyParts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { parts, most } = self;
        // What cannot be counted is not named: a size of 0.000001 m can ask for any number.
        if *parts < 1_000_000_000 {
            write!(f, "a split into {parts} parts; {most} are the most")
        } else {
            write!(f, "a split into more than {most} parts, which are the most")
        }
    }
}

/// Parts shorter than this, and what rounding leaves at the end, are nothing (m).
pub const SHORTEST_M: f64 = 1e-6;

/// The cells along a length of `whole` metres, in order, from 0.
///
/// Parts of no or negative length do not exist. Absolute and relative parts are as they are; what
/// no longer fits is cut off at the end. What they leave is for floating parts and repeats: a
/// pattern with floating parts repeats as often as its parts come closest to their sizes, once at
/// least; one without, as often as it fits, and once more where nothing floats that could take
/// the rest. All patterns of a split repeat equally often. A repeat in a repeat fills what its
/// surrounding pattern has for one turn of it, which is once its own length.
pub fn cells(patterns: &[Pattern], whole: f64, most: usize) -> Result<Vec<Cell>, TooManyParts> {
    let mut lengths = Vec::new();
    let mut next = 0;
    let numbered = number(patterns, &mut next);
    fill(&numbered, whole, whole, most, &mut lengths)?;
    let mut found = Vec::with_capacity(lengths.len());
    let mut start = 0.0;
    for (part, length) in lengths {
        let length = f64::min(length, whole - start);
        if length < SHORTEST_M {
            continue;
        }
        found.push(Cell {
            part,
            start,
            length,
        });
        start += length;
    }
    Ok(found)
}

enum Numbered {
    Part(usize, Size),
    Repeat(Vec<Numbered>),
}

fn number(patterns: &[Pattern], next: &mut usize) -> Vec<Numbered> {
    patterns
        .iter()
        .map(|pattern| match pattern {
            Pattern::Part(size) => {
                *next += 1;
                Numbered::Part(*next - 1, *size)
            }
            Pattern::Repeat(inner) => Numbered::Repeat(number(inner, next)),
        })
        .collect()
}

/// Fixed and floating metres of a pattern, each of its repeats taken once.
fn nominal(patterns: &[Numbered], whole: f64) -> (f64, f64) {
    let mut sums = (0.0, 0.0);
    for pattern in patterns {
        let (fixed, floating) = match pattern {
            Numbered::Part(_, Size::Absolute(size)) => (size.max(0.0), 0.0),
            Numbered::Part(_, Size::Relative(share)) => ((share * whole).max(0.0), 0.0),
            Numbered::Part(_, Size::Floating(size)) => (0.0, size.max(0.0)),
            Numbered::Repeat(inner) => nominal(inner, whole),
        };
        sums = (sums.0 + fixed, sums.1 + floating);
    }
    sums
}

/// Adds the lengths of all parts that fill `room`; `whole` is what relative sizes are shares of.
fn fill(
    patterns: &[Numbered],
    room: f64,
    whole: f64,
    most: usize,
    lengths: &mut Vec<(usize, f64)>,
) -> Result<(), TooManyParts> {
    let (once, repeated): (Vec<&Numbered>, Vec<&Numbered>) = patterns
        .iter()
        .partition(|pattern| matches!(pattern, Numbered::Part(..)));
    let sum = |parts: &[&Numbered]| {
        parts.iter().fold((0.0, 0.0), |sums, part| {
            let (fixed, floating) = nominal(std::slice::from_ref(*part), whole);
            (sums.0 + fixed, sums.1 + floating)
        })
    };
    let (fixed, floating) = sum(&once);
    let (fixed_each, floating_each) = sum(&repeated);
    let left = (room - fixed).max(0.0);
    let times = turns(left, floating, fixed_each, floating_each);
    let parts = lengths.len() as f64 + times * count(patterns) as f64;
    if parts > most as f64 {
        let parts = parts as usize;
        return Err(TooManyParts { parts, most });
    }
    let stretch = ratio(left - times * fixed_each, floating + times * floating_each);
    for pattern in patterns {
        match pattern {
            Numbered::Part(part, size) => lengths.push((*part, length(*size, whole, stretch))),
            Numbered::Repeat(inner) => {
                let (fixed, floating) = nominal(inner, whole);
                for _ in 0..times as usize {
                    fill(inner, fixed + stretch * floating, whole, most, lengths)?;
                }
            }
        }
    }
    Ok(())
}

/// How often the repeats of a split repeat.
fn turns(left: f64, floating: f64, fixed_each: f64, floating_each: f64) -> f64 {
    let each = fixed_each + floating_each;
    if each <= 0.0 || left < SHORTEST_M {
        return 0.0;
    }
    let room = (left - floating).max(0.0);
    if floating_each > 0.0 {
        let closest = (room / each).round();
        let fitting = (left / fixed_each.max(f64::MIN_POSITIVE)).floor();
        return closest.min(fitting).max(1.0);
    }
    let fitting = ((room + SHORTEST_M) / each).floor();
    let rest = room - fitting * each;
    if floating > 0.0 || rest < SHORTEST_M {
        fitting
    } else {
        fitting + 1.0
    }
}

fn count(patterns: &[Numbered]) -> usize {
    patterns
        .iter()
        .map(|pattern| match pattern {
            Numbered::Part(..) => 1,
            Numbered::Repeat(inner) => count(inner),
        })
        .sum()
}

fn length(size: Size, whole: f64, stretch: f64) -> f64 {
    match size {
        Size::Absolute(size) => size,
        Size::Relative(share) => share * whole,
        Size::Floating(size) => size.max(0.0) * stretch,
    }
}

fn ratio(left: f64, nominal: f64) -> f64 {
    if nominal > 0.0 {
        left.max(0.0) / nominal
    } else {
        0.0
    }
}
