//! Checked rule files to the code that runs: names become numbers, once for all derivations.

use std::sync::Arc;

use crate::ast::{self, Ident, ItemKind, Override};
use crate::{Checked, Definition, Diagnostic, Program, Role, Span, Target};

use super::code::{Body, Code, Global, Rule, Step, UserFunction};
use super::instances::{attribute, instances, Instance, MAX_INSTANCES};

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

/// Lowers a program that has been checked without errors, in the style `Default`.
pub fn lower(program: &Program, checked: &Checked) -> Lowered {
    lower_in_style(program, checked, 0)
}

/// Lowers a program that has been checked without errors. `style` is that of the main file: an
/// index of its styles. What is imported has the first style that its import statement names.
pub fn lower_in_style(program: &Program, checked: &Checked, style: usize) -> Lowered {
    let mut lowered = Lowered {
        code: Code {
            names: (0..program.names.len())
                .map(|index| program.names.shared(index))
                .collect(),
            ..Code::default()
        },
        diagnostics: vec![Vec::new(); program.units.len()],
    };
    let Some(instances) = instances(program, checked, style) else {
        let message = format!("imports of imports come to more than {MAX_INSTANCES} files");
        let fault = Diagnostic::error(Span::default(), message);
        lowered.diagnostics[0].push(fault);
        return lowered;
    };
    let numbers = Numbers::of(program, checked, &instances);
    for instance in 0..instances.len() {
        let mut lowering = Lowering {
            program,
            checked,
            numbers: &numbers,
            instances: &instances,
            instance,
            tells_pivot: false,
            asks: false,
            asks_beside: false,
            lists_files: false,
            reads_files: false,
            asks_place: false,
            trims: false,
            tags: false,
            diagnostics: vec![Vec::new(); program.units.len()],
        };
        let unit = instances[instance].unit;
        lowering.definitions(&checked.definitions[unit].values, &mut lowered.code);
        lowering.definitions(&checked.definitions[unit].rules, &mut lowered.code);
        lowered.code.asks |= lowering.asks;
        lowered.code.tells_pivot |= lowering.tells_pivot;
        lowered.code.asks_beside |= lowering.asks_beside;
        lowered.code.lists_files |= lowering.lists_files;
        lowered.code.reads_files |= lowering.reads_files;
        lowered.code.asks_place |= lowering.asks_place;
        lowered.code.trims |= lowering.trims;
        lowered.code.tags |= lowering.tags;
        for (all, new) in lowered.diagnostics.iter_mut().zip(lowering.diagnostics) {
            let new = new.into_iter().filter(|one| !all.contains(one));
            let new: Vec<Diagnostic> = new.collect();
            all.extend(new);
        }
    }
    // The rules of the main file are the first ones of the code.
    let main = checked.definitions.first();
    lowered.code.start = main.and_then(|main| main.start(&program.names));
    lowered
}

/// What a value is in the code.
#[derive(Debug, Clone, Copy)]
pub(super) enum Number {
    /// Evaluated once for a start shape.
    Global(usize),
    Function(usize),
}

/// The numbers of all definitions in the code, instance by instance.
pub(super) struct Numbers {
    values: Vec<Vec<Number>>,
    first_rule: Vec<usize>,
    /// The names of the globals.
    globals: Vec<Arc<str>>,
}

impl Numbers {
    /// An attribute that takes its value from one of the importing file is this one.
    fn of(program: &Program, checked: &Checked, instances: &[Instance]) -> Self {
        let mut all = Self {
            values: Vec::new(),
            first_rule: Vec::new(),
            globals: Vec::new(),
        };
        let (mut functions, mut rules) = (0, 0);
        for instance in instances {
            let defined = &checked.definitions[instance.unit];
            let import = instance.import(instances, program);
            let kept = import.map(|import| instance.protected(import));
            let mut numbers = Vec::with_capacity(defined.values.len());
            for definition in &defined.values {
                let name = definition.name.symbol;
                let taken = match (&kept, instance.from, definition.role) {
                    (Some(Some(kept)), Some((parent, _)), Role::Attr) if !kept.contains(&name) => {
                        let above = &checked.definitions[instances[parent].unit];
                        attribute(above, name).map(|index| all.values[parent][index])
                    }
                    _ => None,
                };
                numbers.push(match taken {
                    Some(number) => number,
                    None if is_global(definition) => {
                        let text = program.names.text(name);
                        all.globals
                            .push(format!("{}{text}", instance.prefix).into());
                        Number::Global(all.globals.len() - 1)
                    }
                    None => {
                        functions += 1;
                        Number::Function(functions - 1)
                    }
                });
            }
            all.values.push(numbers);
            all.first_rule.push(rules);
            rules += defined.rules.len();
        }
        all
    }

    pub fn value(&self, instance: usize, index: usize) -> Number {
        self.values[instance][index]
    }

    pub fn rule(&self, instance: usize, index: usize) -> usize {
        self.first_rule[instance] + index
    }
}

/// Attributes, and constants without parameters.
fn is_global(definition: &Definition) -> bool {
    definition.role != Role::Function && definition.arity == 0
}

/// A rule that stops the derivation where it is reached.
fn broken(
    fault: &Diagnostic,
    unit: usize,
    rule: &ast::Rule,
    name: Arc<str>,
    params: Vec<Arc<str>>,
) -> Rule {
    let hint = fault.hint.as_ref().map(|hint| format!(": {hint}"));
    let message = format!("{}{}", fault.message, hint.unwrap_or_default());
    let step = Step::Broken {
        message: message.into(),
        span: fault.span,
    };
    Rule {
        name,
        unit,
        span: rule.name.span,
        symbol: rule.name.symbol,
        params,
        locals: Vec::new(),
        body: Body::Steps(vec![step]),
    }
}

/// One file on its way.
pub(super) struct Lowering<'a> {
    pub program: &'a Program,
    pub numbers: &'a Numbers,
    /// Whether something in the file hangs on the pivots of shapes.
    pub tells_pivot: bool,
    /// Whether a rule of the file asks about other shapes.
    pub asks: bool,
    /// Whether one asks about shapes of other lots.
    pub asks_beside: bool,
    pub lists_files: bool,
    pub reads_files: bool,
    pub asks_place: bool,
    pub trims: bool,
    pub tags: bool,
    checked: &'a Checked,
    instances: &'a [Instance],
    instance: usize,
    /// By file.
    diagnostics: Vec<Vec<Diagnostic>>,
}

/// What an import statement has instead of a rule.
struct Extension {
    unit: usize,
    span: Span,
    params: Vec<Arc<str>>,
    body: Body,
}

impl<'a> Lowering<'a> {
    fn own(&self) -> &'a Instance {
        &self.instances[self.instance]
    }

    /// The instance in which what a name means is defined.
    pub fn place(&self, name: Ident) -> usize {
        let end = Instance::end_of(self.instances, self.instance, self.text(name), self.program);
        end.unwrap_or(self.instance)
    }

    /// The number of the rule that an importing file has for the one that a name means.
    pub fn grafted(&self, name: Ident, arity: usize) -> Option<usize> {
        let text = self.text(name);
        let last = text.rsplit('.').next().unwrap_or(text);
        let (all, program) = (self.instances, self.program);
        let place = self.place(name);
        let (instance, rule) = Instance::graft(all, place, last, arity, program, self.checked)?;
        Some(self.numbers.rule(instance, rule))
    }

    fn definitions(&mut self, definitions: &[Definition], code: &mut Code) {
        let file = &self.program.units[self.own().unit].parse.file;
        for (index, definition) in definitions.iter().enumerate() {
            let variant = self.own().variant(&definition.variants);
            match &file.items[variant.item].kind {
                ItemKind::Rule(rule) => self.rule(rule, variant.item, definition, code),
                ItemKind::Value(value) => {
                    let place = (self.own().unit, variant.item);
                    let fault = self.checked.broken.get(&place);
                    self.value(value, fault, index, definition, code);
                }
                _ => {}
            }
        }
    }

    fn rule(&mut self, rule: &ast::Rule, item: usize, definition: &Definition, code: &mut Code) {
        let (name, symbol) = (self.shared(rule.name), rule.name.symbol);
        let own = self.own().unit;
        let extended = self.extended(definition);
        if let (Some(fault), None) = (self.checked.broken.get(&(own, item)), &extended) {
            let params = self.shared_all(&rule.params);
            code.rules.push(broken(fault, own, rule, name, params));
            return;
        }
        code.rules.push(match extended {
            Some(extension) => Rule {
                name,
                unit: extension.unit,
                span: extension.span,
                symbol,
                params: extension.params,
                locals: Vec::new(),
                body: extension.body,
            },
            None => Rule {
                name,
                unit: self.own().unit,
                span: rule.name.span,
                symbol,
                params: self.shared_all(&rule.params),
                locals: self.locals(&rule.locals),
                body: self.body(&rule.body),
            },
        });
    }

    /// What the import statement has instead of an extension rule: its parameters and its body.
    fn extended(&mut self, definition: &Definition) -> Option<Extension> {
        let import = self.own().import(self.instances, self.program)?;
        let mut overrides = import.overrides.iter().flatten();
        let found = overrides.find_map(|one| match one {
            Override::Rule { name, params, body }
                if name.symbol == definition.name.symbol && params.len() == definition.arity =>
            {
                Some((name, params, body))
            }
            _ => None,
        });
        let (name, params, body) = found?;
        let params = self.shared_all(params);
        Some(self.above(|lowering| Extension {
            unit: lowering.own().unit,
            span: name.span,
            params,
            body: lowering.body(body),
        }))
    }

    /// What is lowered by `work` stands in the importing file.
    fn above<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let own = self.instance;
        self.instance = self.own().from.map_or(own, |(parent, _)| parent);
        let made = work(self);
        self.instance = own;
        made
    }

    fn value(
        &mut self,
        value: &ast::Value,
        fault: Option<&Diagnostic>,
        index: usize,
        definition: &Definition,
        code: &mut Code,
    ) {
        let own = self.own().unit;
        match self.numbers.value(self.instance, index) {
            Number::Global(number) if number < code.globals.len() => {} // of the importing file
            Number::Global(number) => {
                let (unit, locals, value) = match self.imposed(definition) {
                    Some((unit, value)) => (unit, Vec::new(), value),
                    None => {
                        let (locals, value) = self.locals_and_value(value, fault);
                        (own, locals, value)
                    }
                };
                code.globals.push(Global {
                    name: self.numbers.globals[number].clone(),
                    unit,
                    is_attribute: definition.role == Role::Attr,
                    locals,
                    value,
                });
            }
            Number::Function(_) => {
                let (locals, expr) = self.locals_and_value(value, fault);
                code.functions.push(UserFunction {
                    name: self.shared(value.name),
                    unit: own,
                    params: definition.arity,
                    locals,
                    value: expr,
                });
            }
        }
    }

    /// One that stops the derivation where it has a fault after all.
    fn locals_and_value(
        &mut self,
        value: &ast::Value,
        fault: Option<&Diagnostic>,
    ) -> (Vec<super::code::Expr>, super::code::Expr) {
        match fault {
            Some(fault) => (Vec::new(), super::code::Expr::broken(fault)),
            None => (self.locals(&value.locals), self.expr(&value.value)),
        }
    }

    /// The value that the import statement gives an attribute, evaluated in the importing file.
    /// With the number of this file.
    fn imposed(&mut self, definition: &Definition) -> Option<(usize, super::code::Expr)> {
        let import = self.own().import(self.instances, self.program)?;
        let mut overrides = import.overrides.iter().flatten();
        let value = overrides.find_map(|one| match one {
            Override::Value { name, value }
                if name.symbol == definition.name.symbol && definition.role == Role::Attr =>
            {
                Some(value)
            }
            _ => None,
        })?;
        Some(self.above(|lowering| (lowering.own().unit, lowering.expr(value))))
    }

    fn locals(&mut self, locals: &[ast::Local]) -> Vec<super::code::Expr> {
        locals.iter().map(|local| self.expr(&local.value)).collect()
    }

    pub fn target(&self, name: Ident) -> Option<Target> {
        self.checked.resolutions[self.own().unit].target(&name)
    }

    pub fn text(&self, name: Ident) -> &'a str {
        self.program.names.text(name.symbol)
    }

    pub fn shared(&self, name: Ident) -> Arc<str> {
        self.program.names.shared(name.symbol.index())
    }

    fn shared_all(&self, names: &[Ident]) -> Vec<Arc<str>> {
        names.iter().map(|name| self.shared(*name)).collect()
    }

    /// The name of an attribute in the code, where `name` means one.
    pub fn attribute_name(&self, name: Ident) -> Option<Arc<str>> {
        let Some(Target::Value { index, .. }) = self.target(name) else {
            return None;
        };
        match self.numbers.value(self.place(name), index) {
            Number::Global(number) => Some(self.numbers.globals[number].clone()),
            Number::Function(_) => None,
        }
    }

    pub fn fault(&mut self, span: Span, message: impl Into<String>) {
        let unit = self.own().unit;
        self.diagnostics[unit].push(Diagnostic::error(span, message));
    }

    /// What is built otherwise than the rules say.
    pub fn warn(&mut self, span: Span, message: impl Into<String>) {
        let unit = self.own().unit;
        self.diagnostics[unit].push(Diagnostic::warning(span, message));
    }
}
