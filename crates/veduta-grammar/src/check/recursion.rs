//! Values that need themselves in every case, and so could never be evaluated.

use super::Checker;
use crate::Diagnostic;

/// Which value of a file evaluates which others in any case.
#[derive(Debug, Default)]
pub(super) struct Calls {
    /// Pairs of the value in hand and one that it evaluates.
    pairs: Vec<(usize, usize)>,
    current: Option<usize>,
    /// Branches around the place in hand: what is in one may not be evaluated.
    branches: usize,
}

impl Calls {
    pub fn enter(&mut self, value: Option<usize>) {
        self.current = value;
    }

    pub fn leave(&mut self) {
        self.current = None;
    }

    pub fn enter_branch(&mut self) {
        self.branches += 1;
    }

    pub fn leave_branch(&mut self) {
        self.branches -= 1;
    }

    pub fn call(&mut self, value: usize) {
        if let (Some(current), 0) = (self.current, self.branches) {
            self.pairs.push((current, value));
        }
    }

    /// The values on circles of calls, and between two circles: what remains when those that
    /// evaluate nothing are taken away, again and again, from both ends of the calls.
    fn endless(&self, count: usize) -> Vec<usize> {
        let forward = settle(&self.pairs, count);
        let turned: Vec<(usize, usize)> = self.pairs.iter().map(|(a, b)| (*b, *a)).collect();
        let backward = settle(&turned, count);
        (0..count)
            .filter(|value| forward[*value] && backward[*value])
            .collect()
    }
}

/// For each value whether its calls lead into a circle.
fn settle(pairs: &[(usize, usize)], count: usize) -> Vec<bool> {
    let mut callers = vec![Vec::new(); count];
    let mut open = vec![0_usize; count];
    for (caller, called) in pairs {
        callers[*called].push(*caller);
        open[*caller] += 1;
    }
    let mut settled: Vec<usize> = (0..count).filter(|value| open[*value] == 0).collect();
    while let Some(value) = settled.pop() {
        for caller in &callers[value] {
            open[*caller] -= 1;
            if open[*caller] == 0 {
                settled.push(*caller);
            }
        }
    }
    open.iter().map(|calls| *calls > 0).collect()
}

impl Checker<'_> {
    pub fn report_endless_values(&mut self) {
        let values = &self.definitions[self.unit].values;
        for index in self.calls.endless(values.len()) {
            let name = values[index].name;
            let message = format!("`{}` needs its own value", self.text(&name));
            let hint = "a function may call itself in a branch of a `case`".to_string();
            self.diagnostics
                .add(Diagnostic::error(name.span, message).with_hint(hint));
        }
    }
}
