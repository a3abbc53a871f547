//! Operations and calls of rules.

use super::definitions::{last_part, Role};
use super::lookup::Place;
use super::{Checker, Target};
use crate::ast::{Block, Body, Call, Cell, ExprKind, Ident};
use crate::builtins::operations::{self, BlockKind, Operation};
use crate::builtins::words::REST_SELECTORS;
use crate::builtins::{attributes, words_at, ANY, NONE};
use crate::{Diagnostic, Span};

impl Checker<'_> {
    pub fn call(&mut self, call: &Call) {
        let count = call.args().len();
        if call.leaf {
            return self.resolve(&call.name, Target::Leaf);
        }
        let rule = self.rule(&call.name, count);
        match operations::find(self.text(&call.name)) {
            Some((index, operation)) if rule.is_none() || takes(operation, count) => {
                self.operation(call, index, operation);
            }
            _ => self.rule_call(call, rule),
        }
    }

    /// The rule of a name for a number of arguments.
    fn rule(&self, name: &Ident, count: usize) -> Option<(usize, usize)> {
        let Place::In { unit, name: symbol } = self.place(name) else {
            return None;
        };
        let defined = self.defined(unit);
        let named = symbol.and_then(|symbol| defined.rule(symbol, count));
        let is_start = last_part(self.text(name)) == "start";
        let start = || {
            let mut rules = defined.start_rules();
            rules.find(|index| defined.rules[*index].arity == count)
        };
        let found = named.or_else(|| is_start.then(start).flatten());
        found.map(|index| (unit, index))
    }

    fn rule_call(&mut self, call: &Call, rule: Option<(usize, usize)>) {
        // What an unknown operation takes is not known either.
        let words = if rule.is_some() { NONE } else { ANY };
        for arg in call.args() {
            self.unsized_arg(arg, words);
        }
        match rule {
            Some((unit, index)) => {
                self.resolve_rule(&call.name, unit, index);
                if let Some(block) = &call.block {
                    let message =
                        format!("`{}` is a rule and takes no block", self.text(&call.name));
                    self.diagnostics.error(block.span(), message);
                    self.any_block(block);
                }
            }
            None => {
                self.report_no_rule(call);
                call.block.iter().for_each(|block| self.any_block(block));
            }
        }
    }

    /// A name without a rule is a leaf, and worth a warning. With a block, or with arguments and
    /// in lower case as operations are, it is an error, and in alternatives one where it is reached.
    fn report_no_rule(&mut self, call: &Call) {
        let name = &call.name;
        let place = self.place(name);
        if let Place::Missing { unit, link } = place {
            return self.reach.miss(unit, link, name.span);
        }
        if call.block.is_none() && self.is_grafted(name, call.args().len()) {
            return self.resolve(name, Target::Leaf);
        }
        let text = self.text(name);
        if let Place::In {
            unit,
            name: Some(symbol),
        } = place
        {
            let defined = self.defined(unit);
            let overloads = defined.rules_named(symbol).iter();
            let mut counts: Vec<usize> = overloads.map(|one| defined.rules[*one].arity).collect();
            if !counts.is_empty() {
                counts.sort_unstable();
                return self.report_count(name, &counts, call.args().len());
            }
        }
        let is_full = self.diagnostics.is_full();
        let hint = if is_full {
            None
        } else {
            self.suggest_rule(name)
        };
        let is_operation = text.starts_with(|first: char| first.is_ascii_lowercase())
            && (text.contains('.') || !call.args().is_empty());
        if call.block.is_some() || is_operation {
            let message = format!("there is no operation or rule `{text}`");
            if self.branching == 0 {
                let fault = Diagnostic::error(name.span, message);
                return self.diagnostics.add(fault.with_hint(hint));
            }
            // Which branch is taken is known as late as one derives.
            let message = format!("{message}; a derivation that takes this branch stops");
            let told = Diagnostic::warning(name.span, message).with_hint(hint);
            self.reach.stops.push(told.clone());
            return self.diagnostics.add(told);
        }
        self.resolve(name, Target::Leaf);
        if self.is_broken || is_full {
            return;
        }
        let message = format!("there is no rule `{text}`: the shape is left as it is");
        let hint = hint.unwrap_or_else(|| format!("write `{text}.` if that is meant"));
        self.diagnostics
            .add(Diagnostic::warning(name.span, message).with_hint(hint));
    }

    /// Whether a file of the program defines a rule of this name for one that it imports.
    fn is_grafted(&self, name: &Ident, count: usize) -> bool {
        self.grafts.contains(&(last_part(self.text(name)), count))
    }

    fn operation(&mut self, call: &Call, index: usize, operation: &Operation) {
        self.resolve(&call.name, Target::Operation(index));
        let count = call.args().len();
        if !takes(operation, count) {
            let counts: Vec<usize> = operation
                .counts
                .iter()
                .map(|one| usize::from(*one))
                .collect();
            self.report_count(&call.name, &counts, count);
        }
        for (position, arg) in call.args().iter().enumerate() {
            self.expr(arg, words_at(operation.words, position));
        }
        if operation.name == "set" {
            self.settable(call);
        }
        self.older_form(call, operation.name, count);
        self.operation_block(call, operation.block);
    }

    /// Forms that the reference no longer lists: they derive, and it is said how.
    fn older_form(&mut self, call: &Call, name: &str, count: usize) {
        let message = match (name, count) {
            ("setupProjection", 5) => "an older form: the fifth argument moves the texture along u",
            ("alignScopeToGeometry", 2) => "an older form: the longest edge is taken",
            ("innerRect", _) => "an older form of `innerRectangle(scope) { shape : … }`",
            ("offsetUV", _) => "the older name of `translateUV`",
            _ => return,
        };
        self.diagnostics
            .add(Diagnostic::warning(call.name.span, message));
    }

    /// `set` changes attributes only.
    fn settable(&mut self, call: &Call) {
        let Some(first) = call.args().first() else {
            return;
        };
        let name = match &first.kind {
            ExprKind::Name(name) => name,
            // Which attribute a text names, shows when it is evaluated.
            ExprKind::Call { name, .. } if self.text(name) == "sel" => return,
            _ => {
                let message = "`set` takes the name of an attribute";
                return self.diagnostics.error(first.span, message);
            }
        };
        let is_attribute = match self.targets.get(&name.span.start) {
            Some(Target::Value { unit, index }) => {
                self.defined(*unit).values[*index].role == Role::Attr
            }
            Some(Target::Attribute) => attributes::is_settable(self.text(name)),
            None => true, // has been reported
            Some(_) => false,
        };
        if !is_attribute {
            let message = format!("`{}` is no attribute that can be set", self.text(name));
            self.diagnostics.error(name.span, message);
        }
    }

    fn operation_block(&mut self, call: &Call, kind: BlockKind) {
        match (kind, &call.block) {
            (BlockKind::None, None) => {}
            (BlockKind::None, Some(block)) => {
                let message = format!("`{}` takes no block", self.text(&call.name));
                self.diagnostics.error(block.span(), message);
                self.any_block(block);
            }
            (BlockKind::Operations | BlockKind::Operand, Some(Block::Body { body, .. })) => {
                self.body(body);
            }
            (
                BlockKind::Operand,
                Some(Block::Operands {
                    first,
                    second,
                    span,
                }),
            ) => {
                self.body(first);
                self.body(second);
                if self.text(&call.name) == "inline" || !call.args().is_empty() {
                    let message = "two operands stand in the block of a boolean without arguments";
                    self.diagnostics.error(*span, message);
                }
            }
            (BlockKind::Sizes, Some(Block::Cells { cells, .. })) => self.size_cells(cells),
            (
                BlockKind::Selectors { words, rest },
                Some(Block::Cells {
                    cells,
                    repeat,
                    span,
                }),
            ) => {
                self.repeats_nothing(*repeat, *span);
                self.selector_cells(cells, words, rest, Self::body);
            }
            (BlockKind::Depths, Some(Block::Cells { cells, .. })) => {
                self.size_cells(cells);
                self.rest_block(call);
            }
            (wanted, found) => {
                self.report_block(&call.name, wanted, found.as_ref().map(Block::span));
                found.iter().for_each(|block| self.any_block(block));
            }
        }
    }

    fn rest_block(&mut self, call: &Call) {
        match &call.rest {
            Some(Block::Cells { cells, .. }) => {
                self.selector_cells(cells, REST_SELECTORS, NONE, Self::body);
            }
            Some(block) => self.any_block(block),
            None => {
                let message = "expected a second block `{ remainder : operations }`";
                self.diagnostics.error(call.name.span, message);
            }
        }
    }

    fn report_block(&mut self, name: &Ident, wanted: BlockKind, found: Option<Span>) {
        let form = match wanted {
            BlockKind::Sizes => "{ size : operations | … }",
            BlockKind::Depths => "{ length : depth : operations | … }",
            BlockKind::Selectors { .. } => "{ selector : operations | … }",
            _ => "{ operations }",
        };
        let message = format!("`{}` takes a block `{form}`", self.text(name));
        self.diagnostics.error(found.unwrap_or(name.span), message);
    }

    /// Checks what is inside a block that does not belong there.
    fn any_block(&mut self, block: &Block) {
        match block {
            Block::Body { body, .. } => self.body(body),
            Block::Operands { first, second, .. } => {
                self.body(first);
                self.body(second);
            }
            Block::Cells { cells, .. } => self.cell_bodies(cells),
        }
    }

    fn cell_bodies(&mut self, cells: &[Cell<Body>]) {
        for cell in cells {
            match cell {
                Cell::Part { body, .. } => self.body(body),
                Cell::Group { cells, .. } => self.cell_bodies(cells),
            }
        }
    }
}

/// Whether an operation can be called with a number of arguments.
pub(super) fn takes(operation: &Operation, count: usize) -> bool {
    operation
        .counts
        .iter()
        .any(|one| usize::from(*one) == count)
}
