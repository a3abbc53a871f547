//! A syntax tree to a program: names become numbers, once for all derivations.

use std::collections::HashMap;
use std::sync::Arc;

use crate::ast::{self, File, Ident, ItemKind, RuleKeyword, ValueKeyword};
use crate::{Diagnostic, Names, Span, Symbol};

use super::program::{Global, Program, Rule, UserFunction};

/// A program, and what could not be resolved in it.
#[derive(Debug, Clone, Default)]
pub struct Lowered {
    pub program: Program,
    pub diagnostics: Vec<Diagnostic>,
}

/// Resolves the names of a file. Faults are told with their places; the program is usable when
/// there are none.
pub fn lower(file: &File, names: &Names) -> Lowered {
    let mut lowering = Lowering::new(names);
    lowering.declare(file);
    lowering.define(file);
    Lowered {
        program: lowering.program,
        diagnostics: lowering.diagnostics,
    }
}

/// What a name in an expression or a step can mean, beyond parameters and built-in names. Rules and
/// functions come with the number of their parameters.
#[derive(Debug, Clone, Copy)]
pub(super) enum Meaning {
    Rule(usize, usize),
    Global(usize),
    Function(usize, usize),
}

pub(super) struct Lowering<'a> {
    pub names: &'a Names,
    pub program: Program,
    pub diagnostics: Vec<Diagnostic>,
    pub meanings: HashMap<Symbol, Meaning>,
    /// The parameters and `with` values of the definition at hand, by slot.
    pub slots: Vec<Symbol>,
}

impl<'a> Lowering<'a> {
    fn new(names: &'a Names) -> Self {
        let program = Program {
            names: (0..names.len()).map(|index| names.shared(index)).collect(),
            ..Program::default()
        };
        Self {
            names,
            program,
            diagnostics: Vec::new(),
            meanings: HashMap::new(),
            slots: Vec::new(),
        }
    }

    /// Gives each definition its number, so that definitions may use those after them.
    fn declare(&mut self, file: &File) {
        let (mut rules, mut globals, mut functions) = (0, 0, 0);
        for item in &file.items {
            let (name, meaning, next) = match &item.kind {
                ItemKind::Rule(rule) => {
                    let meaning = Meaning::Rule(rules, rule.params.len());
                    (rule.name, meaning, &mut rules)
                }
                ItemKind::Value(value) if is_global(value) => {
                    (value.name, Meaning::Global(globals), &mut globals)
                }
                ItemKind::Value(value) => {
                    let meaning = Meaning::Function(functions, value.params.len());
                    (value.name, meaning, &mut functions)
                }
                ItemKind::Import(import) => {
                    self.fault(import.id.span, "imports do not derive yet");
                    continue;
                }
                ItemKind::Version(_) | ItemKind::Style(_) => continue,
            };
            *next += 1;
            self.meanings.insert(name.symbol, meaning);
        }
    }

    fn define(&mut self, file: &File) {
        for item in &file.items {
            match &item.kind {
                ItemKind::Rule(rule) => {
                    let starts = rule.keyword == RuleKeyword::Start
                        || item
                            .annotations
                            .iter()
                            .any(|a| self.text(a.name) == "StartRule");
                    self.rule(rule, starts);
                }
                ItemKind::Value(value) if is_global(value) => self.global(value),
                ItemKind::Value(value) => self.function(value),
                _ => {}
            }
        }
        if self.program.start.is_none() && !self.program.rules.is_empty() {
            self.program.start = Some(0);
        }
    }

    fn rule(&mut self, rule: &ast::Rule, starts: bool) {
        if starts && self.program.start.is_none() {
            self.program.start = Some(self.program.rules.len());
        }
        let locals = self.open(&rule.params, &rule.locals);
        let body = self.body(&rule.body);
        self.program.rules.push(Rule {
            name: self.shared(rule.name),
            symbol: rule.name.symbol,
            params: rule.params.len(),
            locals,
            body,
        });
    }

    fn global(&mut self, value: &ast::Value) {
        if !value.locals.is_empty() {
            self.fault(
                value.name.span,
                "`with` before an attribute does not derive yet",
            );
        }
        self.slots.clear();
        let expr = self.expr(&value.value);
        self.program.globals.push(Global {
            name: self.shared(value.name),
            is_attribute: value.keyword == ValueKeyword::Attr,
            value: expr,
        });
    }

    fn function(&mut self, value: &ast::Value) {
        let locals = self.open(&value.params, &value.locals);
        let expr = self.expr(&value.value);
        self.program.functions.push(UserFunction {
            name: self.shared(value.name),
            params: value.params.len(),
            locals,
            value: expr,
        });
    }

    /// Fills the slots: parameters first, then each `with` value, which sees those before it.
    fn open(&mut self, params: &[Ident], locals: &[ast::Local]) -> Vec<super::program::Expr> {
        self.slots = params.iter().map(|param| param.symbol).collect();
        let mut found = Vec::with_capacity(locals.len());
        for local in locals {
            found.push(self.expr(&local.value));
            self.slots.push(local.name.symbol);
        }
        found
    }

    pub fn text(&self, name: Ident) -> &'a str {
        self.names.text(name.symbol)
    }

    pub fn shared(&self, name: Ident) -> Arc<str> {
        self.names.shared(name.symbol.index())
    }

    pub fn fault(&mut self, span: Span, message: impl Into<String>) {
        self.diagnostics.push(Diagnostic::error(span, message));
    }

    /// Says so where a rule or a function does not get as many arguments as it has parameters.
    pub fn check_count(&mut self, name: Ident, span: Span, params: usize, args: usize) {
        if params != args {
            let message = format!("`{}` takes {params} arguments, not {args}", self.text(name));
            self.fault(span, message);
        }
    }
}

/// Attributes, and constants that are no functions: evaluated once for a start shape.
fn is_global(value: &ast::Value) -> bool {
    value.keyword != ValueKeyword::Function && value.params.is_empty()
}
