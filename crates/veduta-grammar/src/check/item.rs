//! Statements.

use std::collections::HashSet;

use super::call::takes;
use super::definitions::Role;
use super::lookup::Place;
use super::{Checker, Target};
use crate::ast::{
    Annotation, Ident, Import, Item, ItemKind, Local, Override, Rule, RuleKeyword, ValueKeyword,
};
use crate::builtins::annotations::ANNOTATIONS;
use crate::builtins::{operations, NONE};
use crate::suggest::{closest, did_you_mean};
use crate::Diagnostic;

impl<'a> Checker<'a> {
    pub(super) fn file(&mut self) {
        let file = &self.program.units[self.unit].parse.file;
        self.imports_differ();
        let mut in_style = false;
        for (index, item) in file.items.iter().enumerate() {
            in_style |= matches!(item.kind, ItemKind::Style(_));
            self.reach.origin = self.can_be_unreached(item).then_some(index);
            let before = self.diagnostics.len();
            self.item(item, in_style);
            let is_rule = matches!(item.kind, ItemKind::Rule(_));
            if self.reach.origin.is_some() && is_rule {
                self.reach
                    .told
                    .push((index, before..self.diagnostics.len()));
            }
        }
        self.reach.origin = None;
        self.report_endless_values();
    }

    fn item(&mut self, item: &'a Item, in_style: bool) {
        item.annotations.iter().for_each(|one| self.annotation(one));
        self.locals.clear();
        match &item.kind {
            ItemKind::Version(_) | ItemKind::Style(_) => {}
            ItemKind::Import(import) => self.import(import),
            ItemKind::Value(value) => {
                let own = self
                    .defined(self.unit)
                    .value(value.name.symbol, value.params.len());
                self.calls.enter(own);
                self.params(&value.params);
                self.locals(&value.locals);
                self.expr(&value.value, NONE);
                self.calls.leave();
            }
            ItemKind::Rule(rule) => {
                if in_style && rule.keyword != RuleKeyword::None {
                    let message = "start and extension rules belong before the first style";
                    self.diagnostics.error(rule.name.span, message);
                }
                self.hidden_by_operation(rule);
                self.grafted_import(rule);
                self.params(&rule.params);
                self.locals(&rule.locals);
                self.body(&rule.body);
            }
        }
    }

    /// Whether a statement is a rule, a constant or a function that only counts where others name
    /// it. A rule of an import that this file tells otherwise is called under another name.
    fn can_be_unreached(&self, item: &Item) -> bool {
        match &item.kind {
            ItemKind::Rule(rule) => !self.text(&rule.name).contains('.'),
            ItemKind::Value(value) => value.keyword != ValueKeyword::Attr,
            _ => false,
        }
    }

    fn hidden_by_operation(&mut self, rule: &Rule) {
        let name = self.text(&rule.name);
        let same = operations::find(name).map(|(_, operation)| operation);
        if same.is_some_and(|operation| takes(operation, rule.params.len())) {
            let message = format!("calls of `{name}` mean the operation, not this rule");
            self.diagnostics
                .add(Diagnostic::warning(rule.name.span, message));
        }
    }

    /// A rule `lib.Facade` is one of a file that is imported as `lib`.
    fn grafted_import(&mut self, rule: &Rule) {
        if matches!(self.place(&rule.name), Place::NoImport) {
            let text = self.text(&rule.name);
            let import = text.split('.').next().unwrap_or(text);
            let message = format!("nothing is imported as `{import}`");
            self.diagnostics.error(rule.name.span, message);
        }
    }

    fn annotation(&mut self, annotation: &Annotation) {
        let name = self.text(&annotation.name);
        if !ANNOTATIONS.contains(&name) {
            let near = closest(name, ANNOTATIONS.iter().copied());
            let hint = near.map(|near| format!("did you mean `@{near}`?"));
            let message = format!("there is no annotation `@{name}`");
            self.diagnostics
                .add(Diagnostic::warning(annotation.name.span, message).with_hint(hint));
        }
    }

    fn params(&mut self, params: &[Ident]) {
        for param in params {
            if self.local(param).is_some() {
                let message = format!("there are two parameters `{}`", self.text(param));
                self.diagnostics.error(param.span, message);
            }
            self.add_local(param);
        }
    }

    fn locals(&mut self, locals: &[Local]) {
        for local in locals {
            self.expr(&local.value, NONE);
            if self.local(&local.name).is_some() {
                let text = self.text(&local.name);
                let message = format!("`{text}` is a parameter or local variable already");
                self.diagnostics.error(local.name.span, message);
            }
            self.add_local(&local.name);
        }
    }

    fn imports_differ(&mut self) {
        let file = &self.program.units[self.unit].parse.file;
        let mut seen = HashSet::new();
        for item in &file.items {
            let ItemKind::Import(import) = &item.kind else {
                continue;
            };
            if !seen.insert(import.id.symbol) {
                let message = format!("there are two imports `{}`", self.text(&import.id));
                self.diagnostics.error(import.id.span, message);
            }
        }
    }

    fn import(&mut self, import: &Import) {
        let links = self.program.units[self.unit].imports.iter();
        let mut same = links.filter(|link| link.id == import.id.symbol);
        let unit = same.next().and_then(|link| link.unit);
        if let (Some(unit), Some(styles)) = (unit, &import.styles) {
            for style in styles {
                if self
                    .defined(unit)
                    .style(style.symbol, self.names())
                    .is_none()
                {
                    let message = format!("the file has no style `{}`", self.text(style));
                    self.diagnostics.error(style.span, message);
                }
            }
        }
        for one in import.overrides.iter().flatten() {
            self.override_(one, unit);
        }
    }

    fn override_(&mut self, one: &Override, unit: Option<usize>) {
        match one {
            Override::Protect(name) => self.overrides_attr(name, unit),
            Override::Value { name, value } => {
                self.overrides_attr(name, unit);
                self.expr(value, NONE);
            }
            Override::Rule { name, params, body } => {
                self.overrides_extension(name, params.len(), unit);
                self.locals.clear();
                self.params(params);
                self.body(body);
                self.locals.clear();
            }
        }
    }

    fn overrides_attr(&mut self, name: &Ident, unit: Option<usize>) {
        let Some(unit) = unit else { return };
        let defined = self.defined(unit);
        match defined.value(name.symbol, 0) {
            Some(index) if defined.values[index].role == Role::Attr => {
                self.resolve(name, Target::Value { unit, index });
            }
            _ => {
                let attrs = defined.values.iter().filter(|one| one.role == Role::Attr);
                let hint = closest(self.text(name), attrs.map(|one| self.text(&one.name)));
                let message = format!("the file has no attribute `{}`", self.text(name));
                let fault = Diagnostic::error(name.span, message);
                self.diagnostics.add(fault.with_hint(did_you_mean(hint)));
            }
        }
    }

    fn overrides_extension(&mut self, name: &Ident, arity: usize, unit: Option<usize>) {
        let Some(unit) = unit else { return };
        let defined = self.defined(unit);
        match defined.rule(name.symbol, arity) {
            Some(index) if defined.rules[index].role == Role::Extension => {
                self.resolve_rule(name, unit, index);
            }
            _ => {
                let text = self.text(name);
                let message = format!("the file has no extension `{text}` of {arity} parameters");
                let hint = "only rules with the keyword `extension` can be replaced".to_string();
                let fault = Diagnostic::error(name.span, message);
                self.diagnostics.add(fault.with_hint(hint));
            }
        }
    }
}
