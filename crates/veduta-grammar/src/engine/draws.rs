//! The random alternatives that the rule of one shape takes.

use super::overrides::Edit;

/// A random alternative that was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taken {
    /// Which one, from 0; that of `else` is the last.
    pub index: u16,
    /// Of how many.
    pub of: u16,
    /// From 0 to 1.
    pub chance: f64,
}

/// A sum of the logarithms of chances. It is the same in any order, so that parts can be taken
/// out again: it counts in steps of 2^-64, and chances of 0 apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LogSum {
    steps: i128,
    zeros: u64,
}

const STEPS: f64 = 18_446_744_073_709_551_616.0;

impl LogSum {
    pub fn of<'a>(all: impl IntoIterator<Item = &'a Taken>) -> Self {
        let mut sum = Self::default();
        for taken in all {
            if taken.chance > 0.0 {
                sum.steps += (taken.chance.ln() * STEPS) as i128;
            } else {
                sum.zeros += 1;
            }
        }
        sum
    }

    pub fn add(&mut self, other: Self) {
        self.steps += other.steps;
        self.zeros += other.zeros;
    }

    /// Takes out what has been added before.
    pub fn take(&mut self, other: Self) {
        self.steps -= other.steps;
        self.zeros = self.zeros.saturating_sub(other.zeros);
    }

    pub fn value(&self) -> f64 {
        if self.zeros > 0 {
            return f64::NEG_INFINITY;
        }
        self.steps as f64 / STEPS
    }
}

/// What was taken so far, and what an edit asks for.
#[derive(Debug, Default)]
pub struct Draws {
    pub taken: Vec<Taken>,
    /// Of what inlined rules took.
    pub inlined: LogSum,
    wanted: Vec<Option<u16>>,
}

impl Draws {
    pub fn of(edit: Option<&Edit>) -> Self {
        Self {
            taken: Vec::new(),
            inlined: LogSum::default(),
            wanted: edit.map(|edit| edit.choices.clone()).unwrap_or_default(),
        }
    }

    /// Takes the alternative that was drawn, unless an edit asks for another one that is there.
    /// Gives which one it is.
    pub fn take(&mut self, drawn: usize, chances: &[f64], sum: f64) -> usize {
        let wanted = self.wanted.get(self.taken.len()).copied().flatten();
        let wanted = wanted.map(usize::from).filter(|one| *one < chances.len());
        let index = wanted.unwrap_or(drawn);
        self.taken.push(Taken {
            index: index as u16,
            of: chances.len() as u16,
            chance: chances[index] / sum,
        });
        index
    }

    /// What an edit asks for and is not there.
    pub fn fault(&self) -> Option<String> {
        let given = self.taken.len();
        if self.wanted.len() > given {
            let has = match given {
                0 => "has no random choice".to_string(),
                1 => "has 1 random choice".to_string(),
                _ => format!("has {given} random choices"),
            };
            return Some(format!("choice {} is set, but it {has}", self.wanted.len()));
        }
        let pairs = self.wanted.iter().zip(&self.taken).enumerate();
        for (number, (wanted, taken)) in pairs {
            if let Some(index) = wanted.filter(|index| *index >= taken.of) {
                return Some(format!(
                    "choice {} is set to {}, but it has {} alternatives",
                    number + 1,
                    u32::from(index) + 1,
                    taken.of
                ));
            }
        }
        None
    }
}
