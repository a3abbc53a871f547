//! Rules' bodies to steps.

use crate::ast::{self, Block, Branches, Call, ExprKind, Size, Test};

use super::lower::{Lowering, Meaning};
use super::operations::OperationId;
use super::program::{Arg, Body, Cell, Choice, Expr, Operation, Selector, Sizing, Step};

impl Lowering<'_> {
    pub fn body(&mut self, body: &ast::Body) -> Body {
        match body {
            ast::Body::Operations(operations) => Body::Steps(self.steps(operations)),
            ast::Body::Branches(branches) => {
                Body::Choice(Box::new(self.choice(branches, Self::body)))
            }
        }
    }

    pub fn choice<T, U>(
        &mut self,
        branches: &Branches<T>,
        lower: impl Fn(&mut Self, &T) -> U,
    ) -> Choice<U> {
        let each = &branches.branches;
        let lowered = each
            .iter()
            .map(|one| (self.expr(&one.test), lower(self, &one.then)));
        Choice {
            by_chance: branches.test == Test::Chance,
            branches: lowered.collect(),
            otherwise: branches.otherwise.as_ref().map(|other| lower(self, other)),
            span: branches.span,
        }
    }

    fn steps(&mut self, operations: &[ast::Operation]) -> Vec<Step> {
        operations
            .iter()
            .map(|operation| self.step(operation))
            .collect()
    }

    fn step(&mut self, operation: &ast::Operation) -> Step {
        match operation {
            ast::Operation::Push { operations, .. } => Step::Push(self.steps(operations)),
            ast::Operation::Call(call) => self.call(call),
        }
    }

    /// A rule, an operation, or, where the name is neither, a leaf.
    fn call(&mut self, call: &Call) -> Step {
        if let (false, Some(Meaning::Rule(rule, params))) =
            (call.leaf, self.meanings.get(&call.name.symbol).copied())
        {
            self.check_count(call.name, call.span, params, call.args().len());
            let args = call.args().iter().map(|arg| self.expr(arg)).collect();
            return Step::Rule {
                rule,
                args,
                span: call.span,
            };
        }
        if let (false, Some(id)) = (call.leaf, OperationId::named(self.text(call.name))) {
            return Step::Operation(Box::new(self.operation(id, call)));
        }
        Step::Leaf {
            symbol: call.name.symbol,
        }
    }

    fn operation(&mut self, id: OperationId, call: &Call) -> Operation {
        let (args, entry) = (call.args(), id.entry());
        if args.len() < entry.args.0 || args.len() > entry.args.1 {
            let message = format!(
                "`{}` takes {} to {} arguments, not {}",
                self.text(call.name),
                entry.args.0,
                entry.args.1,
                args.len()
            );
            self.fault(call.span, message);
        }
        let (cells, repeat) = match &call.block {
            Some(Block::Cells { cells, repeat, .. }) => (self.cells(cells), *repeat),
            Some(Block::Body { span, .. }) => {
                self.fault(*span, "a block without selectors does not derive yet");
                (Vec::new(), false)
            }
            None => (Vec::new(), false),
        };
        let lowered = args.iter().enumerate().map(|(index, arg)| match &arg.kind {
            ExprKind::Name(name) if entry.is_word(index, args.len()) => {
                Arg::Word(self.shared(*name))
            }
            _ => {
                let (sizing, expr) = self.sized(arg);
                Arg::Value(sizing, expr)
            }
        });
        Operation {
            id,
            args: lowered.collect(),
            cells,
            repeat,
            span: call.span,
        }
    }

    fn cells(&mut self, cells: &[ast::Cell<ast::Body>]) -> Vec<Cell> {
        cells.iter().map(|cell| self.cell(cell)).collect()
    }

    fn cell(&mut self, cell: &ast::Cell<ast::Body>) -> Cell {
        match cell {
            ast::Cell::Repeat { cells, .. } => Cell::Repeat(self.cells(cells)),
            ast::Cell::Part {
                selector,
                combined,
                body,
                ..
            } => Cell::Part {
                selector: self.selector(selector),
                combined: *combined,
                body: self.body(body),
            },
        }
    }

    /// A word, unless it is the name of a value.
    fn selector(&mut self, selector: &ast::Expr) -> Selector {
        if let ExprKind::Name(name) = &selector.kind {
            if !self.is_value(*name) {
                return Selector::Word(self.shared(*name));
            }
        }
        let (sizing, expr) = self.sized(selector);
        Selector::Value(sizing, expr)
    }

    fn sized(&mut self, expr: &ast::Expr) -> (Sizing, Expr) {
        match &expr.kind {
            ExprKind::Sized { size, value } => {
                let sizing = match size {
                    Size::Relative => Sizing::Relative,
                    Size::Floating => Sizing::Floating,
                    Size::FloatingRelative => Sizing::FloatingRelative,
                };
                (sizing, self.expr(value))
            }
            _ => (Sizing::Absolute, self.expr(expr)),
        }
    }
}
