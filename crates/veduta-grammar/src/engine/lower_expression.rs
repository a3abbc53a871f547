//! Expressions with their names resolved.

use crate::ast::{self, ExprKind as Ast, Ident};
use crate::{Span, Target};

use super::code::{ComponentValue, Expr, ExprKind};
use super::files::{is_mtl, FileFunction};
use super::functions::Function;
use super::lower::{Lowering, Number};
use super::measures::Measure;
use super::queries::Query;
use super::selection::kind_named;
use super::shape_attributes::ShapeAttribute;
use super::sorting::Sorting;

impl Lowering<'_> {
    pub fn expr(&mut self, expr: &ast::Expr) -> Expr {
        let kind = match &expr.kind {
            Ast::Number(number) => ExprKind::Number(*number),
            Ast::Text(text) => ExprKind::Text(text.as_str().into()),
            Ast::Bool(is) => ExprKind::Bool(*is),
            Ast::Name(name) => self.name(*name),
            Ast::Call { name, args } => self.function_call(*name, args),
            Ast::Unary { op, operand } => ExprKind::Unary {
                op: *op,
                operand: Box::new(self.expr(operand)),
            },
            Ast::Binary { op, left, right } => ExprKind::Binary {
                op: *op,
                left: Box::new(self.expr(left)),
                right: Box::new(self.expr(right)),
            },
            Ast::Array(rows) => ExprKind::Array(rows.iter().map(|row| self.exprs(row)).collect()),
            Ast::Range { from, step, to } => ExprKind::Range {
                from: Box::new(self.expr(from)),
                step: step.as_ref().map(|step| Box::new(self.expr(step))),
                to: Box::new(self.expr(to)),
            },
            Ast::Index { array, indices } => ExprKind::Index {
                array: Box::new(self.expr(array)),
                indices: self.exprs(indices),
            },
            Ast::Branches(branches) => {
                ExprKind::Choice(Box::new(self.choice(branches, Self::expr)))
            }
            Ast::Sized { .. } => self.unresolved(expr.span, "`'` and `~` have no meaning here"),
            Ast::Cells { name, args, cells } => self.components(*name, args, cells),
        };
        Expr {
            kind,
            span: expr.span,
        }
    }

    pub fn exprs(&mut self, exprs: &[ast::Expr]) -> Vec<Expr> {
        exprs.iter().map(|expr| self.expr(expr)).collect()
    }

    fn name(&mut self, name: Ident) -> ExprKind {
        match self.target(name) {
            Some(Target::Local(slot)) => ExprKind::Slot(slot),
            Some(Target::Value { index, .. }) => self.defined(name, index, Vec::new()),
            Some(Target::Attribute) => match ShapeAttribute::named(self.text(name)) {
                Some(attribute) => {
                    self.tells_pivot |= attribute.tells_pivot();
                    ExprKind::Attribute(attribute)
                }
                None => self.not_yet(name),
            },
            Some(Target::Function(_)) => self.function_call(name, &[]),
            Some(Target::Word) => ExprKind::Word(self.shared(name)),
            _ => self.not_yet(name),
        }
    }

    fn components(
        &mut self,
        name: Ident,
        args: &[ast::Expr],
        cells: &[ast::Cell<ast::Expr>],
    ) -> ExprKind {
        let kind = match args {
            [ast::Expr {
                kind: Ast::Name(word),
                ..
            }, ..] => kind_named(self.text(*word)),
            _ => None,
        };
        let Some(kind) = kind else {
            return self.not_yet(name);
        };
        let mut lowered = Vec::with_capacity(cells.len());
        for cell in cells {
            if let ast::Cell::Part {
                selector,
                joining,
                body,
                ..
            } = cell
            {
                lowered.push(ComponentValue {
                    selector: self.selector(selector),
                    joining: *joining,
                    value: self.expr(body),
                });
            }
        }
        let unaligned = |arg: &ast::Expr| match arg.kind {
            Ast::Name(word) => self.text(word) == "noAlign",
            _ => false,
        };
        ExprKind::Components {
            kind,
            aligned: !args.get(1).is_some_and(unaligned),
            cells: lowered,
        }
    }

    fn function_call(&mut self, name: Ident, args: &[ast::Expr]) -> ExprKind {
        let lowered = self.exprs(args);
        match self.target(name) {
            Some(Target::Value { index, .. }) => self.defined(name, index, lowered),
            Some(Target::Function(_)) => match Function::named(self.text(name)) {
                Some((function, fewest, most)) if args.len() >= fewest && args.len() <= most => {
                    ExprKind::Builtin {
                        function,
                        args: lowered,
                    }
                }
                Some(_) => self.not_yet(name),
                None => self.of_shape(name, lowered),
            },
            _ => self.not_yet(name),
        }
    }

    /// A function of the project's files, of the current shape, or of those around it.
    fn of_shape(&mut self, name: Ident, args: Vec<Expr>) -> ExprKind {
        if let Some((function, fewest, most)) = FileFunction::named(self.text(name)) {
            if let (
                FileFunction::Material,
                [Expr {
                    kind: ExprKind::Text(path),
                    ..
                }],
            ) = (function, &args[..])
            {
                if !is_mtl(path) {
                    let message = "`readMaterial` reads MTL files: of others it tells nothing, and shapes keep their material";
                    self.warn(name.span, message.to_string());
                }
            }
            if (fewest..=most).contains(&args.len()) {
                self.lists_files = true;
                self.reads_files |= function.reads();
                return ExprKind::Files { function, args };
            }
        }
        if let Some((sorting, fewest, most)) = Sorting::named(self.text(name)) {
            if (fewest..=most).contains(&args.len()) {
                self.lists_files = true;
                return ExprKind::Sorting { sorting, args };
            }
        }
        if let Some(measure) = Measure::named(self.text(name)) {
            self.tags |= measure.is_of_tags();
            return ExprKind::Measure { measure, args };
        }
        match Query::named(self.text(name)) {
            Some(query) => {
                self.tells_pivot |= query == Query::Convert;
                self.asks_place |= query == Query::Geographic;
                self.asks |= query.is_about_others();
                self.asks_beside |= query.is_about_others() && !is_within(&args);
                ExprKind::Query { query, args }
            }
            None => self.not_yet(name),
        }
    }

    fn defined(&self, name: Ident, index: usize, args: Vec<Expr>) -> ExprKind {
        match self.numbers.value(self.place(name), index) {
            Number::Global(global) => ExprKind::Global(global),
            Number::Function(function) => ExprKind::Call { function, args },
        }
    }

    fn not_yet(&mut self, name: Ident) -> ExprKind {
        let name_told = self.text(name);
        let message = format!("`{name_told}` does not derive: it is taken for 0");
        self.warn(name.span, message);
        ExprKind::Number(0.0)
    }

    fn unresolved(&mut self, span: Span, message: impl Into<String>) -> ExprKind {
        self.fault(span, message);
        ExprKind::Number(0.0)
    }
}

/// Whether the first argument of a question says that it is about the same lot.
fn is_within(args: &[Expr]) -> bool {
    match args.first().map(|first| &first.kind) {
        Some(ExprKind::Word(word) | ExprKind::Text(word)) => word.as_ref() == "intra",
        _ => false,
    }
}
