//! What a file defines.

use std::collections::{HashMap, HashSet};

use crate::ast::{File, Ident, Item, ItemKind, RuleKeyword, ValueKeyword};
use crate::diagnostic::Diagnostics;
use crate::{Diagnostic, Names, Symbol};

/// The values and rules of a file. Definitions of the same name and number of parameters are one,
/// with a variant per style.
#[derive(Debug, Clone, Default)]
pub struct Definitions {
    pub values: Vec<Definition>,
    pub rules: Vec<Definition>,
    /// Names of styles; the first is `Default`, which all files have.
    pub styles: Vec<Style>,
    values_by_name: HashMap<Symbol, Vec<usize>>,
    rules_by_name: HashMap<Symbol, Vec<usize>>,
    styles_by_name: HashMap<Symbol, usize>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    /// `None` for the style `Default`.
    pub name: Option<Symbol>,
    /// The style that it extends.
    pub base: usize,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Definition {
    pub name: Ident,
    /// The number of parameters.
    pub arity: usize,
    pub role: Role,
    /// In the order of the file; at least one.
    pub variants: Vec<Variant>,
}

/// What a definition is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Attr,
    Const,
    Function,
    Rule,
    /// `start`, or `@StartRule`.
    StartRule {
        keyword: bool,
    },
    Extension,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variant {
    /// An index of [`Definitions::styles`].
    pub style: usize,
    /// An index of the items of the file.
    pub item: usize,
}

impl Definitions {
    pub(super) fn collect(file: &File, names: &Names, faults: &mut Diagnostics) -> Self {
        let mut all = Self {
            styles: vec![Style {
                name: None,
                base: 0,
            }],
            ..Self::default()
        };
        let mut style = 0;
        for (index, item) in file.items.iter().enumerate() {
            let variant = Variant { style, item: index };
            match &item.kind {
                ItemKind::Style(one) => style = all.add_style(one, names, faults),
                ItemKind::Value(value) => {
                    let role = match value.keyword {
                        ValueKeyword::Attr => Role::Attr,
                        ValueKeyword::Const => Role::Const,
                        ValueKeyword::Function => Role::Function,
                    };
                    let (list, by_name) = (&mut all.values, &mut all.values_by_name);
                    let new = new_definition(value.name, value.params.len(), role, variant);
                    add(list, by_name, new, names, faults);
                }
                ItemKind::Rule(rule) => {
                    let role = rule_role(rule.keyword, item, names);
                    let (list, by_name) = (&mut all.rules, &mut all.rules_by_name);
                    let new = new_definition(rule.name, rule.params.len(), role, variant);
                    add(list, by_name, new, names, faults);
                }
                ItemKind::Version(_) | ItemKind::Import(_) => {}
            }
        }
        all
    }

    fn add_style(
        &mut self,
        new: &crate::ast::Style,
        names: &Names,
        faults: &mut Diagnostics,
    ) -> usize {
        let mut base = 0;
        if let Some(name) = new.base {
            match self.style(name.symbol, names) {
                Some(found) => base = found,
                None => {
                    let text = names.text(name.symbol);
                    faults.error(name.span, format!("there is no style `{text}` before this"));
                }
            }
        }
        if self.style(new.name.symbol, names).is_some() {
            let text = names.text(new.name.symbol);
            faults.error(
                new.name.span,
                format!("the style `{text}` is there already"),
            );
        }
        let index = self.styles.len();
        self.styles_by_name.insert(new.name.symbol, index);
        self.styles.push(Style {
            name: Some(new.name.symbol),
            base,
        });
        index
    }

    /// The index of a style.
    pub fn style(&self, name: Symbol, names: &Names) -> Option<usize> {
        let found = self.styles_by_name.get(&name).copied();
        found.or((names.text(name) == "Default").then_some(0))
    }

    /// The values of a name, which differ in their numbers of parameters.
    pub fn values_named(&self, name: Symbol) -> &[usize] {
        self.values_by_name.get(&name).map_or(&[], Vec::as_slice)
    }

    /// The rules of a name, which differ in their numbers of parameters.
    pub fn rules_named(&self, name: Symbol) -> &[usize] {
        self.rules_by_name.get(&name).map_or(&[], Vec::as_slice)
    }

    pub fn value(&self, name: Symbol, arity: usize) -> Option<usize> {
        let named = self.values_named(name).iter();
        named
            .copied()
            .find(|index| self.values[*index].arity == arity)
    }

    pub fn rule(&self, name: Symbol, arity: usize) -> Option<usize> {
        let named = self.rules_named(name).iter();
        named
            .copied()
            .find(|index| self.rules[*index].arity == arity)
    }

    /// The rules with the keyword `start`.
    pub fn start_rules(&self) -> impl Iterator<Item = usize> + '_ {
        let is_start = |one: &Definition| one.role == (Role::StartRule { keyword: true });
        (0..self.rules.len()).filter(move |index| is_start(&self.rules[*index]))
    }

    /// The rule that a derivation begins with where none is named: the one that is marked so, else
    /// the first one that takes no arguments and is none of an import, else the first one.
    pub fn start(&self, names: &Names) -> Option<usize> {
        let is_marked = |rule: &Definition| matches!(rule.role, Role::StartRule { .. });
        let is_able =
            |rule: &Definition| rule.arity == 0 && !names.text(rule.name.symbol).contains('.');
        let marked = self.rules.iter().position(is_marked);
        marked
            .or_else(|| self.rules.iter().position(is_able))
            .or((!self.rules.is_empty()).then_some(0))
    }

    /// The last part of the name, and the number of parameters, of each rule that stands for one of
    /// an import.
    pub(super) fn grafts<'n>(
        &'n self,
        names: &'n Names,
    ) -> impl Iterator<Item = (&'n str, usize)> + 'n {
        let named = self
            .rules
            .iter()
            .map(|rule| (names.text(rule.name.symbol), rule.arity));
        named
            .filter(|(name, _)| name.contains('.'))
            .map(|(name, arity)| (last_part(name), arity))
    }

    /// Rules that nothing calls; the first rule and start rules are called from outside.
    pub(super) fn report_unused(
        &self,
        names: &Names,
        used: &HashSet<(usize, usize)>,
        faults: &mut Diagnostics,
    ) {
        // Those with a dot stand for rules of imports.
        let is_own = |rule: &Definition| !names.text(rule.name.symbol).contains('.');
        let own = self.rules.iter().enumerate();
        for (index, rule) in own.filter(|(_, rule)| is_own(rule)).skip(1) {
            let text = names.text(rule.name.symbol);
            if rule.role == Role::Rule && !used.contains(&(0, index)) {
                let message = format!("nothing calls the rule `{text}`");
                faults.add(Diagnostic::warning(rule.name.span, message));
            }
        }
    }
}

/// What follows the last dot of a name, or all of it.
pub(super) fn last_part(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(_, last)| last)
}

fn rule_role(keyword: RuleKeyword, item: &Item, names: &Names) -> Role {
    let annotations = item.annotations.iter();
    let mut named = annotations.map(|one| names.text(one.name.symbol));
    match keyword {
        RuleKeyword::Start => Role::StartRule { keyword: true },
        RuleKeyword::Extension => Role::Extension,
        RuleKeyword::None if named.any(|name| name == "StartRule") => {
            Role::StartRule { keyword: false }
        }
        RuleKeyword::None => Role::Rule,
    }
}

fn new_definition(name: Ident, arity: usize, role: Role, variant: Variant) -> Definition {
    Definition {
        name,
        arity,
        role,
        variants: vec![variant],
    }
}

fn add(
    list: &mut Vec<Definition>,
    by_name: &mut HashMap<Symbol, Vec<usize>>,
    new: Definition,
    names: &Names,
    faults: &mut Diagnostics,
) {
    let named = by_name.entry(new.name.symbol).or_default();
    let same = named.iter().find(|index| list[**index].arity == new.arity);
    let Some(index) = same else {
        named.push(list.len());
        return list.push(new);
    };
    let old = &mut list[*index];
    let style = new.variants[0].style;
    // Styles follow each other, so a variant of the same style is the last.
    if old.variants.last().is_some_and(|one| one.style == style) {
        let text = names.text(new.name.symbol);
        let message = match new.arity {
            0 => format!("`{text}` is defined twice"),
            arity => format!("`{text}` with {arity} parameters is defined twice"),
        };
        let hint = "definitions of the same name must differ in their number of parameters";
        faults.add(
            Diagnostic::error(new.name.span, message)
                .with_hint((new.arity > 0).then(|| hint.into())),
        );
    }
    old.variants.extend(new.variants);
}
