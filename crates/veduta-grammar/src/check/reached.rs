//! What the start rule never reaches refuses nothing: faults there are told as warnings.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::definitions::{Definition, Definitions};
use crate::diagnostic::Diagnostics;
use crate::limits::MAX_DIAGNOSTICS;
use crate::{Diagnostic, Names, Program, Span};

const WHY: &str = "nothing reaches this rule";
const UNUSED: &str = "nothing that is reached uses it";

/// A rule: its file, and its place among the definitions or the items there.
type Place = (usize, usize);

/// A rule or a value that a statement names.
#[derive(Debug, Clone, Copy)]
pub(super) enum Named {
    Rule(Place),
    Value(Place),
}

/// What the statements of one file call, and what was said of them.
#[derive(Debug, Default)]
pub(super) struct Reach {
    /// The item in hand, where it is a rule or a value that only counts where others name it.
    pub origin: Option<usize>,
    /// Who names what (file and definition).
    named: Vec<(Option<usize>, Named)>,
    /// What stops a derivation in a branch that is taken, and no other.
    pub stops: Vec<Diagnostic>,
    /// Which diagnostics are about an item.
    pub told: Vec<(usize, Range<usize>)>,
    /// Who names something of a file that is missing: its importer, which import, and where.
    missed: Vec<(Option<usize>, Place, Span)>,
}

impl Reach {
    pub fn name(&mut self, what: Named) {
        self.named.push((self.origin, what));
    }

    pub fn miss(&mut self, unit: usize, link: usize, span: Span) {
        self.missed.push((self.origin, (unit, link), span));
    }
}

/// What nothing reaches.
#[derive(Debug, Default)]
pub(super) struct Unreached {
    /// Rules and values that cannot be derived, by file and item, and why.
    pub broken: HashMap<Place, Diagnostic>,
    /// What was an error where it were reached, by file.
    pub told: Vec<Vec<Diagnostic>>,
}

/// What reaching is told from.
pub(super) struct Settling<'a> {
    pub program: &'a Program,
    pub definitions: &'a [Definitions],
    /// The rule that the derivation begins with.
    pub start: Option<Place>,
    /// By file.
    pub reaches: Vec<Reach>,
    pub does_not_parse: bool,
}

impl Settling<'_> {
    /// Tells missing imports, softens what is wrong with rules that nothing reaches, and gives
    /// those.
    pub fn settle(self, faults: &mut [Diagnostics]) -> Unreached {
        // What calls a rule may stand in a statement that did not parse.
        let items = (!self.does_not_parse).then(|| self.reached_items());
        let is_reached = |unit: usize, origin: Option<usize>| match (&items, origin) {
            (Some(items), Some(item)) => items.contains(&(unit, item)),
            _ => true,
        };
        let mut found = Unreached {
            broken: HashMap::new(),
            told: vec![Vec::new(); self.program.units.len()],
        };
        let mut wanted = HashSet::new();
        for (unit, reach) in self.reaches.iter().enumerate() {
            for (origin, link, span) in &reach.missed {
                match origin {
                    Some(item) if !is_reached(unit, *origin) => {
                        let message = "this stands in an imported file that is missing";
                        let fault = Diagnostic::error(*span, message);
                        found.broken.entry((unit, *item)).or_insert(fault);
                    }
                    _ => {
                        wanted.insert(*link);
                    }
                }
            }
            found.told[unit].extend(reach.stops.iter().cloned());
            for (item, some) in &reach.told {
                if !is_reached(unit, Some(*item)) {
                    for (before, told) in faults[unit].soften(some.clone(), WHY) {
                        found.broken.entry((unit, *item)).or_insert(before);
                        found.told[unit].push(told);
                    }
                }
            }
        }
        for (unit, file) in self.program.units.iter().enumerate() {
            for (link, fault) in &file.missing {
                let at = faults[unit].len();
                faults[unit].add(fault.clone());
                if items.is_some() && !wanted.contains(&(unit, *link)) {
                    let all = at..faults[unit].len();
                    let softened = faults[unit].soften(all, UNUSED).into_iter();
                    found.told[unit].extend(softened.map(|(_, told)| told));
                }
            }
        }
        for told in &mut found.told {
            told.truncate(MAX_DIAGNOSTICS);
        }
        found
    }

    /// The items of rules and values that the start rule reaches, over calls and uses of any
    /// branch. Attributes are reached: a call gives them, and is shown them.
    fn reached_items(&self) -> HashSet<Place> {
        let mut next: HashMap<Place, Vec<Named>> = HashMap::new();
        let mut open: Vec<Named> = self.start.into_iter().map(Named::Rule).collect();
        for (unit, reach) in self.reaches.iter().enumerate() {
            for (origin, named) in &reach.named {
                match origin {
                    Some(item) => next.entry((unit, *item)).or_default().push(*named),
                    None => open.push(*named),
                }
            }
        }
        let mut reached = HashSet::new();
        while let Some(named) = open.pop() {
            let (unit, definition) = match named {
                Named::Rule((unit, index)) => (unit, &self.definitions[unit].rules[index]),
                Named::Value((unit, index)) => (unit, &self.definitions[unit].values[index]),
            };
            for variant in &definition.variants {
                if reached.insert((unit, variant.item)) {
                    open.extend(next.get(&(unit, variant.item)).into_iter().flatten());
                }
            }
        }
        reached
    }
}

/// The rule that a derivation begins with: the one that is named, if there is one, or that which
/// the main file has for it.
pub(super) fn start(
    definitions: &[Definitions],
    names: &Names,
    named: Option<&str>,
) -> Option<Place> {
    let main = definitions.first()?;
    let is_named =
        |rule: &Definition| rule.arity == 0 && Some(names.text(rule.name.symbol)) == named;
    let called = main.rules.iter().position(is_named);
    called.or_else(|| main.start(names)).map(|index| (0, index))
}
