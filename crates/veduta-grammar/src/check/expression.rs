//! Expressions.

use super::lookup::Place;
use super::reached::Named;
use super::{Checker, Target};
use crate::ast::{BinaryOp, Expr, ExprKind, Ident, Size};
use crate::builtins::{attributes, functions, is_word, words, words_at, Words, ANY, NONE};
use crate::Diagnostic;

impl Checker<'_> {
    /// Checks an expression that may also be one of `words`.
    pub fn expr(&mut self, expr: &Expr, words: Words) {
        match &expr.kind {
            ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Bool(_) => {}
            ExprKind::Name(name) => self.name(name, words),
            ExprKind::Call { name, args } => self.function(name, args),
            ExprKind::Cells { name, args, cells } => {
                self.function(name, args);
                if self.text(name) != "comp" {
                    let message = format!("`{}` has no block as a function", self.text(name));
                    self.diagnostics.error(name.span, message);
                }
                self.selector_cells(cells, words::COMPONENT_SELECTORS, NONE, Self::plain);
            }
            ExprKind::Unary { operand, .. } => self.expr(operand, NONE),
            ExprKind::Binary { op, left, right } => {
                self.expr(left, NONE);
                let skips = matches!(op, BinaryOp::And | BinaryOp::Or);
                if skips {
                    self.calls.enter_branch();
                }
                self.expr(right, NONE);
                if skips {
                    self.calls.leave_branch();
                }
            }
            ExprKind::Array(rows) => rows.iter().flatten().for_each(|one| self.plain(one)),
            ExprKind::Range { from, step, to } => {
                self.plain(from);
                step.iter().for_each(|step| self.plain(step));
                self.plain(to);
            }
            ExprKind::Index { array, indices } => {
                self.plain(array);
                indices.iter().for_each(|one| self.plain(one));
            }
            ExprKind::Branches(all) => self.branches(all, "`else : value`", Self::plain),
            ExprKind::Sized { value, .. } => self.expr(value, NONE),
        }
    }

    fn plain(&mut self, expr: &Expr) {
        self.expr(expr, NONE);
    }

    /// An argument of a rule or function, where sizes have no meaning.
    pub fn unsized_arg(&mut self, arg: &Expr, words: Words) {
        if let ExprKind::Sized { size, .. } = arg.kind {
            let sign = match size {
                Size::Relative => "'",
                Size::Floating => "~",
                Size::FloatingRelative => "~'",
            };
            let message = format!("`{sign}` is for sizes of operations and cells");
            self.diagnostics.error(arg.span, message);
        }
        self.expr(arg, words);
    }

    fn name(&mut self, name: &Ident, words: Words) {
        if words != ANY && is_word(words, self.text(name)) {
            return self.resolve(name, Target::Word);
        }
        if let Some(slot) = self.local(name) {
            return self.resolve(name, Target::Local(slot));
        }
        if attributes::is_attribute(self.text(name)) && !self.is_own_value(name) {
            return self.resolve(name, Target::Attribute);
        }
        self.value(name, 0, words);
    }

    fn is_own_value(&self, name: &Ident) -> bool {
        self.defined(self.unit).value(name.symbol, 0).is_some()
    }

    fn function(&mut self, name: &Ident, args: &[Expr]) {
        let words = match functions::find(self.text(name)) {
            Some((_, function)) => function.words,
            None => &[],
        };
        for (position, arg) in args.iter().enumerate() {
            self.unsized_arg(arg, words_at(words, position));
        }
        self.value(name, args.len(), NONE);
    }

    /// A value or function by its name and number of arguments.
    fn value(&mut self, name: &Ident, count: usize, words: Words) {
        let place = self.place(name);
        if let Place::In {
            unit,
            name: Some(symbol),
        } = place
        {
            if let Some(index) = self.defined(unit).value(symbol, count) {
                if unit == self.unit {
                    self.calls.call(index);
                }
                self.reach.name(Named::Value((unit, index)));
                return self.resolve(name, Target::Value { unit, index });
            }
        }
        let built_in = functions::find(self.text(name));
        if let Some((index, function)) = built_in {
            if (usize::from(function.least)..=usize::from(function.most)).contains(&count) {
                return self.resolve(name, Target::Function(index));
            }
        }
        if words == ANY {
            return self.resolve(name, Target::Word);
        }
        self.report_no_value(name, count, &place);
    }

    fn report_no_value(&mut self, name: &Ident, count: usize, place: &Place) {
        if let Place::In {
            unit,
            name: Some(symbol),
        } = place
        {
            let defined = self.defined(*unit);
            let overloads = defined.values_named(*symbol).iter();
            let mut counts: Vec<usize> = overloads.map(|one| defined.values[*one].arity).collect();
            if !counts.is_empty() {
                counts.sort_unstable();
                return self.report_count(name, &counts, count);
            }
            if !defined.rules_named(*symbol).is_empty() {
                let message = format!("`{}` is a rule, not a value", self.text(name));
                return self.diagnostics.error(name.span, message);
            }
        }
        if let Some((_, function)) = functions::find(self.text(name)) {
            let counts: Vec<usize> = (function.least..=function.most).map(usize::from).collect();
            return self.report_count(name, &counts, count);
        }
        if let Place::Missing { unit, link } = place {
            return self.reach.miss(*unit, *link, name.span);
        }
        let text = self.text(name);
        let message = match count {
            0 => format!("there is no attribute, constant, parameter or function `{text}`"),
            _ => format!("there is no function `{text}`"),
        };
        let may_be_told = attributes::tells_of_shape(text);
        let hint = if may_be_told || !self.diagnostics.is_full() {
            self.suggest_value(name)
        } else {
            None
        };
        // No slip of the pen: it is taken for 0 and told of where code is made of it.
        if hint.is_none() && may_be_told {
            return;
        }
        self.diagnostics
            .add(Diagnostic::error(name.span, message).with_hint(hint));
    }

    /// Checks what stands before the `:` of a cell with selectors.
    pub fn selector(&mut self, expr: &Expr, words: Words, rest: Words) {
        match &expr.kind {
            ExprKind::Name(name) => {
                let text = self.text(name);
                if is_word(words, text) || is_word(rest, text) {
                    return self.resolve(name, Target::Word);
                }
                if self.is_value(name) {
                    return self.name(name, NONE);
                }
                let message = format!("there is no selector or value `{text}`");
                let hint = self.suggest_selector(name, words);
                self.diagnostics
                    .add(Diagnostic::error(name.span, message).with_hint(hint));
            }
            ExprKind::Unary { operand, .. } => self.selector(operand, words, rest),
            ExprKind::Binary {
                op: BinaryOp::And | BinaryOp::Or,
                left,
                right,
            } => {
                self.selector(left, words, rest);
                self.selector(right, words, rest);
            }
            ExprKind::Sized { .. } => {
                let message = "sizes are for the cells of splits, not for selectors";
                self.diagnostics.error(expr.span, message);
            }
            _ => self.expr(expr, NONE),
        }
    }

    fn is_value(&self, name: &Ident) -> bool {
        let found = match self.place(name) {
            Place::In {
                unit,
                name: Some(symbol),
            } => self.defined(unit).value(symbol, 0).is_some(),
            Place::Missing { .. } => true,
            _ => false,
        };
        found
            || self.local(name).is_some()
            || attributes::is_attribute(self.text(name))
            || functions::find(self.text(name)).is_some()
    }
}
