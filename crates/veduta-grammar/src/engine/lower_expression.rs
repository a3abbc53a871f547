//! Expressions with their names resolved.

use crate::ast::{self, ExprKind as Ast, Ident};
use crate::Span;

use super::functions::Function;
use super::lower::{Lowering, Meaning};
use super::program::{Expr, ExprKind};
use super::shape_attributes::ShapeAttribute;

impl Lowering<'_> {
    pub fn expr(&mut self, expr: &ast::Expr) -> Expr {
        let kind = match &expr.kind {
            Ast::Number(number) => ExprKind::Number(*number),
            Ast::Text(text) => ExprKind::Text(text.as_str().into()),
            Ast::Bool(is) => ExprKind::Bool(*is),
            Ast::Name(name) => self.name(*name),
            Ast::Call { name, args } => self.function_call(*name, args, expr.span),
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
            Ast::Cells { .. } => {
                self.unresolved(expr.span, "`comp` as a function does not derive yet")
            }
        };
        Expr {
            kind,
            span: expr.span,
        }
    }

    fn exprs(&mut self, exprs: &[ast::Expr]) -> Vec<Expr> {
        exprs.iter().map(|expr| self.expr(expr)).collect()
    }

    /// Whether a name is that of a value here, and no word.
    pub fn is_value(&self, name: Ident) -> bool {
        self.slots.contains(&name.symbol)
            || matches!(
                self.meanings.get(&name.symbol),
                Some(Meaning::Global(_) | Meaning::Function(..))
            )
            || ShapeAttribute::named(self.text(name)).is_some()
    }

    fn name(&mut self, name: Ident) -> ExprKind {
        if let Some(slot) = self.slots.iter().rposition(|slot| *slot == name.symbol) {
            return ExprKind::Slot(slot);
        }
        match self.meanings.get(&name.symbol).copied() {
            Some(Meaning::Global(global)) => return ExprKind::Global(global),
            Some(Meaning::Function(function, params)) => {
                self.check_count(name, name.span, params, 0);
                return ExprKind::Call {
                    function,
                    args: Vec::new(),
                };
            }
            _ => {}
        }
        match ShapeAttribute::named(self.text(name)) {
            Some(attribute) => ExprKind::Attribute(attribute),
            None => {
                let message = format!("`{}` is not known here", self.text(name));
                self.unresolved(name.span, message)
            }
        }
    }

    fn function_call(&mut self, name: Ident, args: &[ast::Expr], span: Span) -> ExprKind {
        let lowered = self.exprs(args);
        if let Some(Meaning::Function(function, params)) = self.meanings.get(&name.symbol).copied()
        {
            self.check_count(name, span, params, args.len());
            return ExprKind::Call {
                function,
                args: lowered,
            };
        }
        let text = self.text(name);
        let Some((function, fewest, most)) = Function::named(text) else {
            return self.unresolved(
                name.span,
                format!("the function `{text}` does not derive yet"),
            );
        };
        if args.len() < fewest || args.len() > most {
            let message = format!("`{text}` does not take {} arguments", args.len());
            return self.unresolved(span, message);
        }
        ExprKind::Builtin {
            function,
            args: lowered,
        }
    }

    fn unresolved(&mut self, span: Span, message: impl Into<String>) -> ExprKind {
        self.fault(span, message);
        ExprKind::Number(0.0)
    }
}
