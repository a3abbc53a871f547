//! Where a name is defined: in the file, in those that it imports, or in the language.

use super::definitions::Definitions;
use super::reached::Named;
use super::{Checker, Target};
use crate::ast::Ident;
use crate::builtins::{attributes, functions, operations, words};
use crate::suggest::{closest, did_you_mean};
use crate::Symbol;

/// The file in which a dotted name ends, and its last part.
pub(super) enum Place {
    In {
        unit: usize,
        name: Option<Symbol>,
    },
    /// The first part names no import.
    NoImport,
    /// It names one whose file is missing, which has been reported: the file and its import.
    Missing {
        unit: usize,
        link: usize,
    },
}

impl Checker<'_> {
    /// Follows the imports in a dotted name.
    pub fn place(&self, name: &Ident) -> Place {
        let mut unit = self.unit;
        let mut rest = self.text(name);
        while let Some((first, after)) = rest.split_once('.') {
            let id = self.names().find(first);
            let imports = &self.program.units[unit].imports;
            let Some(link) = imports.iter().position(|link| Some(link.id) == id) else {
                return Place::NoImport;
            };
            match imports[link].unit {
                None => return Place::Missing { unit, link },
                Some(next) => unit = next,
            }
            rest = after;
        }
        let name = self.names().find(rest);
        Place::In { unit, name }
    }

    /// The slot of a parameter or local variable.
    pub fn local(&self, name: &Ident) -> Option<usize> {
        self.locals.get(&name.symbol).copied()
    }

    pub fn add_local(&mut self, name: &Ident) {
        let slot = self.locals.len();
        self.locals.insert(name.symbol, slot);
    }

    pub fn defined(&self, unit: usize) -> &Definitions {
        &self.definitions[unit]
    }

    /// The name of a value that may have been meant.
    pub fn suggest_value(&self, name: &Ident) -> Option<String> {
        let own = self.defined(self.unit).values.iter();
        let own = own.map(|one| self.text(&one.name));
        let locals = self.locals.keys().map(|local| self.names().text(*local));
        let built_in = functions::FUNCTIONS.iter().map(|one| one.name);
        let attributes: Vec<String> = attributes::names().collect();
        let attributes = attributes.iter().map(String::as_str);
        let all = locals.chain(own).chain(built_in).chain(attributes);
        did_you_mean(closest(self.text(name), all)).or_else(|| self.suggest_imported(name))
    }

    /// The name of a rule or operation that may have been meant.
    pub fn suggest_rule(&self, name: &Ident) -> Option<String> {
        let own = self.defined(self.unit).rules.iter();
        let own = own.map(|one| self.text(&one.name));
        let built_in = operations::OPERATIONS.iter().map(|one| one.name);
        did_you_mean(closest(self.text(name), own.chain(built_in)))
            .or_else(|| self.suggest_imported(name))
    }

    pub fn suggest_selector(&self, name: &Ident, known: &[&'static str]) -> Option<String> {
        let known = known.iter().copied().chain([words::REMAINDER]);
        did_you_mean(closest(self.text(name), known)).or_else(|| self.suggest_value(name))
    }

    /// For `lib.Rof`: the name in `lib` that may have been meant.
    fn suggest_imported(&self, name: &Ident) -> Option<String> {
        let text = self.text(name);
        let (prefix, last) = text.rsplit_once('.')?;
        let Place::In { unit, .. } = self.place(name) else {
            let imports = self.program.units[self.unit].imports.iter();
            let ids = imports.map(|link| self.names().text(link.id));
            let first = text.split('.').next().unwrap_or(text);
            return did_you_mean(closest(first, ids));
        };
        let defined = self.defined(unit);
        let all = defined.values.iter().chain(&defined.rules);
        let found = closest(last, all.map(|one| self.text(&one.name)))?;
        Some(format!("did you mean `{prefix}.{found}`?"))
    }

    /// "`f` takes 1 or 2 arguments, 3 are given"
    pub fn report_count(&mut self, name: &Ident, wanted: &[usize], given: usize) {
        let mut counts: Vec<String> = wanted.iter().map(ToString::to_string).collect();
        let last = counts.pop().unwrap_or_default();
        let (counts, unit) = match (counts.as_slice(), last.as_str()) {
            ([], "0") => ("no".to_string(), "arguments"),
            ([], "1") => (last, "argument"),
            ([], _) => (last, "arguments"),
            (others, _) => (format!("{} or {last}", others.join(", ")), "arguments"),
        };
        let text = self.text(name);
        let are = if given == 1 { "is" } else { "are" };
        let message = format!("`{text}` takes {counts} {unit}, {given} {are} given");
        self.diagnostics.error(name.span, message);
    }

    /// Keeps the target of a name, and that a rule is called.
    pub fn resolve_rule(&mut self, name: &Ident, unit: usize, index: usize) {
        self.used_rules.insert((unit, index));
        self.reach.name(Named::Rule((unit, index)));
        self.resolve(name, Target::Rule { unit, index });
    }
}
