//! How much time, work and memory a derivation has had, against its limits.

use std::cell::Cell;
use std::time::Instant;

use veduta_geometry::{Budget, Spent};

use super::limits::Limits;

/// How many steps may be taken between two looks at the clock: some tenths of a millisecond.
const STEPS_PER_LOOK: u64 = 1 << 16;

/// What stopped a derivation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    Time,
    Work,
    Memory,
}

/// Counts steps, and looks at the clock once in a while. What is over stays over.
#[derive(Debug)]
pub struct Clock {
    started: Instant,
    limits: Limits,
    steps: Cell<u64>,
    bytes: Cell<u64>,
    next_look: Cell<u64>,
    over: Cell<Option<Over>>,
}

impl Clock {
    pub fn starting(limits: Limits) -> Self {
        Self {
            started: Instant::now(),
            limits,
            steps: Cell::new(0),
            bytes: Cell::new(0),
            next_look: Cell::new(STEPS_PER_LOOK),
            over: Cell::new(None),
        }
    }

    /// What the derivation has too much of, now.
    pub fn look(&self) -> Option<Over> {
        if self.over.get().is_none() {
            self.next_look.set(self.steps.get() + STEPS_PER_LOOK);
            if self.steps.get() > self.limits.work {
                self.over.set(Some(Over::Work));
            } else if self.bytes.get() > self.limits.memory {
                self.over.set(Some(Over::Memory));
            } else if self.started.elapsed().as_secs_f64() > self.limits.seconds {
                self.over.set(Some(Over::Time));
            }
        }
        self.over.get()
    }
}

impl Budget for Clock {
    fn take(&self, steps: usize) -> Result<(), Spent> {
        let sum = self.steps.get().saturating_add(steps as u64);
        self.steps.set(sum);
        let looks = sum >= self.next_look.get() || sum > self.limits.work;
        if looks && self.look().is_some() {
            return Err(Spent);
        }
        Ok(())
    }

    fn hold(&self, bytes: usize) -> Result<(), Spent> {
        let sum = self.bytes.get().saturating_add(bytes as u64);
        self.bytes.set(sum);
        if sum > self.limits.memory && self.look().is_some() {
            return Err(Spent);
        }
        Ok(())
    }
}
