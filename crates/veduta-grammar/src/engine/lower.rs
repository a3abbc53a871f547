//! Checked rule files to the code that runs: names become numbers, once for all derivations.

use std::sync::Arc;

use crate::ast::{self, Ident, ItemKind, Override};
use crate::{Checked, Definition, Diagnostic, Program, Resolution, Role, Span, Target};

use super::code::{Code, Global, Rule, UserFunction};

/// The code, and what of the files does not derive yet, by file.
#[derive(Debug, Clone, Default)]
pub struct Lowered {
    pub code: Code,
    pub diagnostics: Vec<Vec<Diagnostic>>,
}

impl Lowered {
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().flatten().any(Diagnostic::is_error)
    }
}

/// Lowers a program that has been checked without errors. Of a definition with styles, the one
/// of the style `Default` is taken.
pub fn lower(program: &Program, checked: &Checked) -> Lowered {
    let numbers = Numbers::of(checked);
    let mut lowered = Lowered {
        code: Code {
            names: (0..program.names.len())
                .map(|index| program.names.shared(index))
                .collect(),
            ..Code::default()
        },
        diagnostics: Vec::new(),
    };
    for unit in 0..program.units.len() {
        let mut lowering = Lowering {
            program,
            resolution: &checked.resolutions[unit],
            numbers: &numbers,
            unit,
            asks: false,
            trims: false,
            diagnostics: Vec::new(),
        };
        lowering.imports();
        lowering.definitions(&checked.definitions[unit].values, &mut lowered.code);
        lowering.definitions(&checked.definitions[unit].rules, &mut lowered.code);
        lowered.code.asks |= lowering.asks;
        lowered.code.trims |= lowering.trims;
        lowered.diagnostics.push(lowering.diagnostics);
    }
    if lowered.code.start.is_none()
        && checked
            .definitions
            .first()
            .is_some_and(|d| !d.rules.is_empty())
    {
        lowered.code.start = Some(0);
    }
    lowered
}

/// What a value is in the code.
#[derive(Debug, Clone, Copy)]
pub(super) enum Number {
    /// Evaluated once for a start shape.
    Global(usize),
    Function(usize),
}

/// The numbers of all definitions in the code, file by file.
pub(super) struct Numbers {
    values: Vec<Vec<Number>>,
    first_rule: Vec<usize>,
}

impl Numbers {
    fn of(checked: &Checked) -> Self {
        let (mut globals, mut functions, mut rules) = (0, 0, 0);
        let (mut values, mut first_rule) = (Vec::new(), Vec::new());
        let mut count = |definition: &Definition| {
            let counter = if is_global(definition) {
                &mut globals
            } else {
                &mut functions
            };
            *counter += 1;
            if is_global(definition) {
                Number::Global(*counter - 1)
            } else {
                Number::Function(*counter - 1)
            }
        };
        for unit in &checked.definitions {
            values.push(unit.values.iter().map(&mut count).collect());
            first_rule.push(rules);
            rules += unit.rules.len();
        }
        Self { values, first_rule }
    }

    pub fn value(&self, unit: usize, index: usize) -> Number {
        self.values[unit][index]
    }

    pub fn rule(&self, unit: usize, index: usize) -> usize {
        self.first_rule[unit] + index
    }
}

/// Attributes, and constants without parameters.
fn is_global(definition: &Definition) -> bool {
    definition.role != Role::Function && definition.arity == 0
}

/// One file on its way.
pub(super) struct Lowering<'a> {
    pub program: &'a Program,
    pub numbers: &'a Numbers,
    /// Whether a rule of the file asks about other shapes.
    pub asks: bool,
    pub trims: bool,
    resolution: &'a Resolution,
    unit: usize,
    diagnostics: Vec<Diagnostic>,
}

impl<'a> Lowering<'a> {
    fn imports(&mut self) {
        for item in &self.program.units[self.unit].parse.file.items {
            if let ItemKind::Import(import) = &item.kind {
                for change in import.overrides.iter().flatten() {
                    let name = match change {
                        Override::Protect(name)
                        | Override::Value { name, .. }
                        | Override::Rule { name, .. } => name,
                    };
                    self.fault(name.span, "changes of what is imported do not derive yet");
                }
            }
        }
    }

    fn definitions(&mut self, definitions: &[Definition], code: &mut Code) {
        for definition in definitions {
            let default = definition
                .variants
                .iter()
                .find(|variant| variant.style == 0);
            let variant = default.unwrap_or(&definition.variants[0]);
            match &self.program.units[self.unit].parse.file.items[variant.item].kind {
                ItemKind::Rule(rule) => self.rule(rule, definition, code),
                ItemKind::Value(value) => self.value(value, definition, code),
                _ => {}
            }
        }
    }

    fn rule(&mut self, rule: &ast::Rule, definition: &Definition, code: &mut Code) {
        if matches!(definition.role, Role::StartRule { .. })
            && self.unit == 0
            && code.start.is_none()
        {
            code.start = Some(code.rules.len());
        }
        let locals = self.locals(&rule.locals);
        let body = self.body(&rule.body);
        code.rules.push(Rule {
            name: self.shared(rule.name),
            unit: self.unit,
            span: rule.name.span,
            symbol: rule.name.symbol,
            params: definition.arity,
            locals,
            body,
        });
    }

    fn value(&mut self, value: &ast::Value, definition: &Definition, code: &mut Code) {
        let locals = self.locals(&value.locals);
        let expr = self.expr(&value.value);
        let name = self.shared(value.name);
        if is_global(definition) {
            code.globals.push(Global {
                name,
                unit: self.unit,
                is_attribute: definition.role == Role::Attr,
                locals,
                value: expr,
            });
        } else {
            code.functions.push(UserFunction {
                name,
                unit: self.unit,
                params: definition.arity,
                locals,
                value: expr,
            });
        }
    }

    fn locals(&mut self, locals: &[ast::Local]) -> Vec<super::code::Expr> {
        locals.iter().map(|local| self.expr(&local.value)).collect()
    }

    pub fn target(&self, name: Ident) -> Option<Target> {
        self.resolution.target(&name)
    }

    pub fn text(&self, name: Ident) -> &'a str {
        self.program.names.text(name.symbol)
    }

    pub fn shared(&self, name: Ident) -> Arc<str> {
        self.program.names.shared(name.symbol.index())
    }

    pub fn fault(&mut self, span: Span, message: impl Into<String>) {
        self.diagnostics.push(Diagnostic::error(span, message));
    }

    /// The fault of something that the checker knows and the engine does not.
    pub fn unknown(&mut self, name: Ident) {
        self.fault(
            name.span,
            format!("`{}` does not derive yet", self.text(name)),
        );
    }
}
