//! Checks the files of a program: what each name refers to, and what cannot work.

mod branches;
mod call;
mod definitions;
mod expression;
mod item;
mod lookup;
mod reached;
mod recursion;
mod selectors;

use std::collections::{HashMap, HashSet};

use crate::ast::Ident;
use crate::diagnostic::Diagnostics;
use crate::{Diagnostic, Names, Program, Symbol};

pub use definitions::{Definition, Definitions, Role, Style, Variant};

/// What a name refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Target {
    /// A parameter or local variable of the definition around it: its slot, parameters first.
    Local(usize),
    /// `Checked::definitions[unit].values[index]`
    Value { unit: usize, index: usize },
    /// `Checked::definitions[unit].rules[index]`
    Rule { unit: usize, index: usize },
    /// An index of [`OPERATIONS`](crate::builtins::operations::OPERATIONS).
    Operation(usize),
    /// An index of [`FUNCTIONS`](crate::builtins::functions::FUNCTIONS).
    Function(usize),
    /// An attribute of the current shape, known by its name.
    Attribute,
    /// A word that selects something, such as `front` or `noAdjust`.
    Word,
    /// A shape that no rule goes on with.
    Leaf,
}

/// What the names of one file refer to.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Resolution {
    targets: HashMap<u32, Target>,
}

impl Resolution {
    /// The target of a name of a call, an operation or an expression. `None` for names that define
    /// something, and for those of which an error has been reported.
    pub fn target(&self, name: &Ident) -> Option<Target> {
        self.targets.get(&name.span.start).copied()
    }

    /// Places of names (`Ident::span.start`) with their targets, in no order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, Target)> + '_ {
        self.targets.iter().map(|(place, target)| (*place, *target))
    }
}

/// What checking a program gives; each list has one entry per file of the program.
#[derive(Debug, Default)]
pub struct Checked {
    /// Those of parsing and of checking, in the order of the text.
    pub diagnostics: Vec<Vec<Diagnostic>>,
    pub definitions: Vec<Definitions>,
    pub resolutions: Vec<Resolution>,
    /// Rules and values that cannot be derived and that nothing reaches from the start rule, by file
    /// and item, and why: where one is reached after all, the derivation stops.
    pub broken: HashMap<(usize, usize), Diagnostic>,
    /// What would be an error where it were reached; among the diagnostics, too.
    pub unreached: Vec<Vec<Diagnostic>>,
}

impl Checked {
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().flatten().any(Diagnostic::is_error)
    }

    /// All faults as text, file by file.
    pub fn render(&self, program: &Program) -> String {
        let files = program.units.iter().zip(&self.diagnostics);
        let each = files.flat_map(|(unit, list)| list.iter().map(|one| one.render(&unit.source)));
        each.collect()
    }
}

/// Checks a program. Statements that did not parse are left out, so what they define is missing.
pub fn check(program: &Program) -> Checked {
    check_from(program, None)
}

/// The same for a derivation that begins with the rule of the main file that is named `start`.
pub fn check_from(program: &Program, start: Option<&str>) -> Checked {
    let mut faults: Vec<Diagnostics> = Vec::new();
    let mut definitions = Vec::new();
    for unit in &program.units {
        let mut list = Diagnostics::default();
        unit.parse
            .diagnostics
            .iter()
            .for_each(|one| list.add(one.clone()));
        definitions.push(Definitions::collect(
            &unit.parse.file,
            &program.names,
            &mut list,
        ));
        faults.push(list);
    }
    let does_not_parse = program
        .units
        .iter()
        .any(|unit| unit.parse.diagnostics.iter().any(Diagnostic::is_error));
    let is_broken = does_not_parse || program.units.iter().any(|unit| !unit.missing.is_empty());
    let defined = definitions.iter();
    let grafts = defined.flat_map(|one| one.grafts(&program.names)).collect();
    let mut used = HashSet::new();
    let mut resolutions = Vec::new();
    let mut reaches = Vec::new();
    for (unit, list) in faults.iter_mut().enumerate() {
        let mut checker = Checker::new(program, &definitions, &grafts, unit, list);
        checker.is_broken = is_broken;
        checker.file();
        used.extend(checker.used_rules);
        reaches.push(checker.reach);
        resolutions.push(Resolution {
            targets: checker.targets,
        });
    }
    let unreached = reached::Settling {
        program,
        definitions: &definitions,
        start: reached::start(&definitions, &program.names, start),
        reaches,
        does_not_parse,
    }
    .settle(&mut faults);
    // What calls a rule, or defines it, may stand in a statement that did not parse.
    if let (false, Some(main), Some(list)) = (is_broken, definitions.first(), faults.first_mut()) {
        main.report_unused(&program.names, &used, list);
    }
    Checked {
        diagnostics: faults.into_iter().map(Diagnostics::into_sorted).collect(),
        definitions,
        resolutions,
        broken: unreached.broken,
        unreached: unreached.told,
    }
}

/// Walks over one file.
struct Checker<'a> {
    program: &'a Program,
    definitions: &'a [Definitions],
    /// Names and numbers of parameters of what the program's files define for their imports.
    grafts: &'a HashSet<(&'a str, usize)>,
    unit: usize,
    diagnostics: &'a mut Diagnostics,
    targets: HashMap<u32, Target>,
    /// Rules that are called, with their files.
    used_rules: HashSet<(usize, usize)>,
    /// Slots of the parameters and local variables of the definition in hand.
    locals: HashMap<Symbol, usize>,
    calls: recursion::Calls,
    reach: reached::Reach,
    /// How many alternatives one is in.
    branching: usize,
    /// Whether statements did not parse: what they define is not known to be missing.
    is_broken: bool,
}

impl<'a> Checker<'a> {
    fn new(
        program: &'a Program,
        definitions: &'a [Definitions],
        grafts: &'a HashSet<(&'a str, usize)>,
        unit: usize,
        diagnostics: &'a mut Diagnostics,
    ) -> Self {
        Self {
            program,
            definitions,
            grafts,
            unit,
            diagnostics,
            targets: HashMap::new(),
            used_rules: HashSet::new(),
            locals: HashMap::new(),
            calls: recursion::Calls::default(),
            reach: reached::Reach::default(),
            branching: 0,
            is_broken: false,
        }
    }

    fn names(&self) -> &'a Names {
        &self.program.names
    }

    fn text(&self, name: &Ident) -> &'a str {
        self.names().text(name.symbol)
    }

    fn resolve(&mut self, name: &Ident, target: Target) {
        self.targets.insert(name.span.start, target);
    }
}
