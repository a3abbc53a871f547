//! Rules' bodies to steps.

use std::sync::Arc;

use crate::ast::{self, Block, Branches, Call, ExprKind, Size, Test};
use crate::Target;

use super::code::{Arg, Body, Cell, Choice, Expr, Operation, Selector, Sizing, Step};
use super::lower::Lowering;
use super::operations::OperationId;

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
            ast::Operation::Push { body, .. } => Step::Push(self.body(body)),
            ast::Operation::Call(call) => self.call(call),
        }
    }

    /// A rule, an operation, or, where the name is neither, a leaf.
    fn call(&mut self, call: &Call) -> Step {
        let target = self.target(call.name);
        let is_rule = matches!(target, Some(Target::Rule { .. } | Target::Leaf)) && !call.leaf;
        if let Some(rule) = self
            .grafted(call.name, call.args().len())
            .filter(|_| is_rule)
        {
            return Step::Rule {
                rule,
                args: self.exprs(call.args()),
                span: call.span,
            };
        }
        match target {
            Some(Target::Rule { index, .. }) => Step::Rule {
                rule: self.numbers.rule(self.place(call.name), index),
                args: self.exprs(call.args()),
                span: call.span,
            },
            Some(Target::Operation(_)) => match OperationId::named(self.text(call.name)) {
                Some(id) => Step::Operation(Box::new(self.operation(id, call))),
                None => {
                    let name = self.text(call.name);
                    let built = "the shape stays as it is";
                    self.warn(call.name.span, format!("`{name}` does not derive: {built}"));
                    Step::Push(Body::Steps(Vec::new()))
                }
            },
            None => {
                let name = self.text(call.name);
                Step::Broken {
                    message: format!("there is no operation or rule `{name}`").into(),
                    span: call.name.span,
                }
            }
            Some(_) => Step::Leaf {
                symbol: call.name.symbol,
            },
        }
    }

    fn operation(&mut self, id: OperationId, call: &Call) -> Operation {
        let mut args = call.args();
        self.trims |= id.trims();
        self.tags |= id.tags();
        self.asks |= id.asks();
        let (fewest, most) = id.arguments();
        let name = self.text(call.name);
        if args.len() < fewest {
            let message = format!("`{name}` with {} arguments does not derive yet", args.len());
            self.fault(call.span, message);
        } else if args.len() > most {
            let message = format!("`{name}` derives without what follows its argument {most}");
            self.warn(call.span, message);
            args = &args[..most];
        }
        let (mut cells, repeat) = match &call.block {
            Some(Block::Cells { cells, repeat, .. }) => (self.cells(cells), *repeat),
            Some(Block::Body { body, .. }) => (vec![self.whole(body)], false),
            Some(Block::Operands { first, second, .. }) => {
                (vec![self.whole(first), self.whole(second)], false)
            }
            None => (Vec::new(), false),
        };
        if let Some(Block::Cells { cells: rest, .. }) = &call.rest {
            cells.extend(self.cells(rest));
        }
        self.tells_pivot |= id.turns_about_pivot();
        let mut lowered = Vec::with_capacity(args.len());
        for (index, arg) in args.iter().enumerate() {
            lowered.push(match (&arg.kind, self.word(arg)) {
                (ExprKind::Name(name), _) if id.attribute_argument() == Some(index) => {
                    let attribute = self.attribute_name(*name);
                    self.tells_pivot |= self.text(*name).starts_with("scope.");
                    Arg::Word(attribute.unwrap_or_else(|| self.shared(*name)))
                }
                (_, Some(word)) => {
                    self.tells_pivot |= word.as_ref() == "pivot";
                    Arg::Word(word)
                }
                (_, None) => {
                    // Which attribute a computed name means is known as late as it is set.
                    self.tells_pivot |= id.attribute_argument() == Some(index);
                    let (sizing, expr) = self.sized(arg);
                    Arg::Value(sizing, expr)
                }
            });
        }
        Operation {
            id,
            args: lowered,
            cells,
            repeat,
            span: call.span,
        }
    }

    /// A block without selectors as a cell.
    fn whole(&mut self, body: &ast::Body) -> Cell {
        Cell::Part {
            selector: Selector::Word("all".into()),
            depth: None,
            joining: ast::Joining::Each,
            body: self.body(body),
        }
    }

    fn cells(&mut self, cells: &[ast::Cell<ast::Body>]) -> Vec<Cell> {
        let mut lowered = Vec::with_capacity(cells.len());
        for cell in cells {
            self.cell(cell, &mut lowered);
        }
        lowered
    }

    /// Appends the cell; those of a group that does not repeat stand where it stands.
    fn cell(&mut self, cell: &ast::Cell<ast::Body>, lowered: &mut Vec<Cell>) {
        match cell {
            ast::Cell::Group {
                cells,
                repeats: true,
                ..
            } => {
                let inner = self.cells(cells);
                lowered.push(Cell::Repeat(inner));
            }
            ast::Cell::Group { cells, .. } => {
                for cell in cells {
                    self.cell(cell, lowered);
                }
            }
            ast::Cell::Part {
                selector,
                depth,
                joining,
                body,
                ..
            } => {
                let part = Cell::Part {
                    selector: self.selector(selector),
                    depth: depth.as_ref().map(|depth| self.expr(depth)),
                    joining: *joining,
                    body: self.body(body),
                };
                lowered.push(part);
            }
        }
    }

    pub fn selector(&mut self, selector: &ast::Expr) -> Selector {
        match self.word(selector) {
            Some(word) => Selector::Word(word),
            None => {
                let (sizing, expr) = self.sized(selector);
                Selector::Value(sizing, expr)
            }
        }
    }

    /// The word that an expression is, if it is one and no value.
    fn word(&self, expr: &ast::Expr) -> Option<Arc<str>> {
        match &expr.kind {
            ExprKind::Name(name) if self.target(*name) == Some(Target::Word) => {
                Some(self.shared(*name))
            }
            _ => None,
        }
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
