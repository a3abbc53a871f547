//! Expressions to values, for the current shape.

use std::sync::Arc;

use crate::ast::BinaryOp;

use super::code::{Choice, Expr, ExprKind};
use super::draws::Draws;
use super::fault::Fault;
use super::functions::Function;
use super::indexing::{beside, indexed};
use super::marks::Tags;
use super::operators::{binary, unary};
use super::random::Stream;
use super::run::Run;
use super::state::State;
use super::value::{or_zero, Array, Value, MAX_ELEMENTS};
use crate::Span;

/// What a call costs, in steps of work.
const STEPS_PER_CALL: usize = 16;
/// How deep functions may call one another.
const MAX_CALLS: usize = 200;

/// Where an expression is evaluated: the values in the rule's slots, the shape, its random
/// numbers.
pub struct Scene<'a> {
    pub slots: &'a mut Vec<Value>,
    pub state: &'a State,
    pub stream: &'a mut Stream,
    pub draws: &'a mut Draws,
}

impl Scene<'_> {
    /// The same scene with another shape.
    pub fn of<'b>(&'b mut self, state: &'b State) -> Scene<'b> {
        Scene {
            slots: self.slots,
            state,
            stream: self.stream,
            draws: self.draws,
        }
    }
}

impl Run<'_> {
    /// The value of an expression.
    pub fn value(&mut self, expr: &Expr, scene: &mut Scene<'_>) -> Result<Value, Fault> {
        match &expr.kind {
            ExprKind::Number(number) => Ok(Value::Number(*number)),
            ExprKind::Bool(is) => Ok(Value::Bool(*is)),
            ExprKind::Text(text) => Ok(Value::Text(text.clone())),
            ExprKind::Broken(why) => Err(Fault::at(expr.span, why.as_ref())),
            ExprKind::Slot(slot) => Ok(scene.slots[*slot].clone()),
            ExprKind::Global(global) => self.global(*global, scene.state),
            ExprKind::Word(word) => Ok(Value::Text(word.clone())),
            ExprKind::Attribute(attribute) => {
                let path = || self.tree.path(self.at);
                Ok(attribute.of(scene.state, self.first(), path))
            }
            ExprKind::Measure { measure, args } => {
                let values = self.values(args, scene)?;
                let tags = match measure.is_of_tags() {
                    true => self.edge_tags(scene.state),
                    false => Tags::new(),
                };
                let object = self.first().state.form.scope.axes;
                measure
                    .of(scene.state, object, tags, &values)
                    .map_err(|message| Fault::at(expr.span, message))
            }
            ExprKind::Files { function, args } => {
                let values = self.values(args, scene)?;
                let files = self.options.files.clone();
                self.take(files.names.len(), expr.span)?;
                if let Some(told) = function.missing(&files, &values) {
                    self.write(&Value::text(&told), expr.span)?;
                }
                let value = function.call(&files, &values, || scene.stream.draw());
                value.map_err(|message| Fault::at(expr.span, message))
            }
            ExprKind::Sorting { sorting, args } => {
                let values = self.values(args, scene)?;
                self.sorted(*sorting, &values, expr.span, scene)
            }
            ExprKind::Query { query, args } => {
                let values = self.values(args, scene)?;
                self.answer(*query, &values, scene.state, expr.span)
            }
            ExprKind::Components {
                kind,
                aligned,
                cells,
            } => {
                let values = self.component_values((*kind, *aligned), cells, expr.span, scene)?;
                let columns = values.len();
                Ok(Value::Array(Arc::new(Array::new(columns, values))))
            }
            ExprKind::Call { function, args } => self.called(*function, args, expr, scene),
            ExprKind::Builtin { function, args } => {
                let values = self.values(args, scene)?;
                if let Function::Print = function {
                    self.write(&values[0], expr.span)?;
                }
                self.take(values.iter().map(Value::element_count).sum(), expr.span)?;
                function
                    .call(&values, || scene.stream.draw())
                    .map_err(|message| Fault::at(expr.span, message))
            }
            ExprKind::Unary { op, operand } => {
                let value = self.value(operand, scene)?;
                unary(*op, value).map_err(|message| Fault::at(expr.span, message))
            }
            ExprKind::Binary { op, left, right } => self.binary(*op, left, right, expr, scene),
            ExprKind::Array(rows) => self.array(rows, expr, scene),
            ExprKind::Range { .. } => {
                self.array(std::slice::from_ref(&vec![expr.clone()]), expr, scene)
            }
            ExprKind::Index { array, indices } => self.element(array, indices, expr, scene),
            ExprKind::Choice(choice) => {
                let taken = self.choose(choice, scene)?;
                match taken {
                    Some(index) => self.value(alternative(choice, index), scene),
                    None => Err(Fault::at(expr.span, "no case holds, and there is no else")),
                }
            }
        }
    }

    /// The value of an expression as a number.
    pub fn number(&mut self, expr: &Expr, scene: &mut Scene<'_>) -> Result<f64, Fault> {
        if let ExprKind::Number(number) = expr.kind {
            return Ok(number);
        }
        let value = self.value(expr, scene)?;
        let number = value.number();
        number.ok_or_else(|| {
            Fault::at(
                expr.span,
                format!("a number is needed, not {}", value.kind()),
            )
        })
    }

    /// The value of an expression as a number that an operation may take.
    pub fn finite(&mut self, expr: &Expr, scene: &mut Scene<'_>) -> Result<f64, Fault> {
        let number = self.number(expr, scene)?;
        self.without_bounds(number, expr.span)
    }

    /// The number for an operation; 0 stands for what is no number or has no bounds, as it does in
    /// CityEngine, and a message says so once for each place in a rule.
    pub(super) fn without_bounds(&mut self, number: f64, span: Span) -> Result<f64, Fault> {
        let bounded = or_zero(number);
        if bounded == number {
            return Ok(number);
        }
        if !self.zeroed.contains(&span) {
            self.zeroed.push(span);
            let rule = &self.tree.nodes[self.at as usize].name;
            let told = format!("in the rule {rule}, 0 stands for a value that is {number}");
            self.write(&Value::text(&told), span)?;
        }
        Ok(bounded)
    }

    pub fn values(&mut self, args: &[Expr], scene: &mut Scene<'_>) -> Result<Vec<Value>, Fault> {
        args.iter().map(|arg| self.value(arg, scene)).collect()
    }

    /// Which alternative is taken: its number; that of `else` is the number of branches. None
    /// where no condition holds and there is no `else`.
    pub fn choose<T>(
        &mut self,
        choice: &Choice<T>,
        scene: &mut Scene<'_>,
    ) -> Result<Option<usize>, Fault> {
        if choice.by_chance {
            return self.drawn(choice, scene).map(Some);
        }
        for (index, (test, _)) in choice.branches.iter().enumerate() {
            let value = self.value(test, scene)?;
            let holds = value.truth();
            let needed = || {
                Fault::at(
                    test.span,
                    format!("a condition is needed, not {}", value.kind()),
                )
            };
            if holds.ok_or_else(needed)? {
                return Ok(Some(index));
            }
        }
        Ok(choice.otherwise.as_ref().map(|_| choice.branches.len()))
    }

    /// An alternative at random. Where there is no `else`, the chances are taken in proportion.
    fn drawn<T>(&mut self, choice: &Choice<T>, scene: &mut Scene<'_>) -> Result<usize, Fault> {
        let mut chances = Vec::with_capacity(choice.branches.len() + 1);
        for (test, _) in &choice.branches {
            chances.push(self.number(test, scene)?.max(0.0) / 100.0);
        }
        let given: f64 = chances.iter().sum();
        if choice.otherwise.is_some() {
            chances.push((1.0 - given).max(0.0));
        }
        let sum: f64 = chances.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(Fault::at(choice.span, "the chances are all zero"));
        }
        let mut rest = scene.stream.draw() * sum;
        let last = chances
            .iter()
            .rposition(|&chance| chance > 0.0)
            .unwrap_or(0);
        let found = chances.iter().position(|&chance| {
            rest -= chance;
            rest < 0.0
        });
        // Drawn even where an edit asks for another: what the rule draws next stays the same.
        Ok(scene.draws.take(found.unwrap_or(last), &chances, sum))
    }

    fn called(
        &mut self,
        function: usize,
        args: &[Expr],
        expr: &Expr,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        let mut slots = self.values(args, scene)?;
        if self.calls >= MAX_CALLS {
            return Err(Fault::at(
                expr.span,
                format!("functions call one another {MAX_CALLS} deep"),
            ));
        }
        self.calls += 1;
        self.take(STEPS_PER_CALL, expr.span)?;
        let code = self.code;
        let called = &code.functions[function];
        let mut inner = Scene {
            slots: &mut slots,
            state: scene.state,
            stream: scene.stream,
            draws: scene.draws,
        };
        let value = self.with_locals(&called.locals, &called.value, &mut inner);
        self.calls -= 1;
        value.map_err(|fault| fault.within(called.unit))
    }

    /// The value of an expression after those of its `with`, which it may use.
    pub(super) fn with_locals(
        &mut self,
        locals: &[Expr],
        expr: &Expr,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        for local in locals {
            let value = self.value(local, scene)?;
            scene.slots.push(value);
        }
        self.value(expr, scene)
    }

    fn binary(
        &mut self,
        op: BinaryOp,
        left: &Expr,
        right: &Expr,
        expr: &Expr,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        let a = self.value(left, scene)?;
        if let (BinaryOp::And, Some(false)) | (BinaryOp::Or, Some(true)) = (op, a.truth()) {
            return Ok(Value::Bool(op == BinaryOp::Or));
        }
        let b = self.value(right, scene)?;
        self.take(a.element_count() + b.element_count(), expr.span)?;
        let value = binary(op, &a, &b).map_err(|message| Fault::at(expr.span, message))?;
        match &value {
            Value::Text(text) if text.len() > MAX_ELEMENTS => Err(Fault::at(
                expr.span,
                format!("a string of {} bytes", text.len()),
            )),
            _ => Ok(value),
        }
    }

    fn array(
        &mut self,
        rows: &[Vec<Expr>],
        expr: &Expr,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        let mut array = Array::default();
        for row in rows {
            let mut parts = Vec::with_capacity(row.len());
            let mut count = array.values.len();
            for element in row {
                let part = self.part(element, scene)?;
                count += part.values.len();
                if count > MAX_ELEMENTS {
                    let message = format!("an array of more than {MAX_ELEMENTS} elements");
                    return Err(Fault::at(element.span, message));
                }
                parts.push(part);
            }
            let row = beside(parts).map_err(|message| Fault::at(expr.span, message))?;
            if row.values.is_empty() {
                array = array.or(row.kind);
                continue;
            }
            if !array.values.is_empty() && row.columns != array.columns {
                let message = format!(
                    "a row has {} elements, the first {}",
                    row.columns, array.columns
                );
                return Err(Fault::at(expr.span, message));
            }
            array.columns = row.columns;
            array.kind = row.kind;
            array.values.extend(row.values);
        }
        self.take(array.values.len(), expr.span)?;
        Ok(Value::Array(Arc::new(array)))
    }

    /// What stands between commas in an array: a value, a range, or an array.
    fn part(&mut self, element: &Expr, scene: &mut Scene<'_>) -> Result<Array, Fault> {
        let values = if let ExprKind::Range { from, step, to } = &element.kind {
            let (from, to) = (self.finite(from, scene)?, self.finite(to, scene)?);
            let step = match step {
                Some(step) => self.finite(step, scene)?,
                None => 1.0,
            };
            let count = match step {
                0.0 => 0.0,
                _ => ((to - from) / step + 1e-9).floor() + 1.0,
            };
            if !count.is_finite() || count > MAX_ELEMENTS as f64 {
                return Err(Fault::at(
                    element.span,
                    format!("a range of {count} elements"),
                ));
            }
            let numbers = (0..count.max(0.0) as usize).map(|k| from + step * k as f64);
            numbers.map(Value::Number).collect()
        } else {
            match self.value(element, scene)? {
                Value::Array(array) => return Ok(Array::clone(&array)),
                value => vec![value],
            }
        };
        Ok(Array::new(values.len(), values))
    }

    fn element(
        &mut self,
        array: &Expr,
        indices: &[Expr],
        expr: &Expr,
        scene: &mut Scene<'_>,
    ) -> Result<Value, Fault> {
        let value = self.value(array, scene)?;
        let Value::Array(array) = value else {
            let message = format!("an array is needed before `[`, not {}", value.kind());
            return Err(Fault::at(expr.span, message));
        };
        let indices = self.values(indices, scene)?;
        indexed(&array, &indices).map_err(|message| Fault::at(expr.span, message))
    }
}

/// The alternative with this number.
pub fn alternative<T>(choice: &Choice<T>, index: usize) -> &T {
    match (choice.branches.get(index), &choice.otherwise) {
        (Some((_, then)), _) => then,
        (None, Some(otherwise)) => otherwise,
        (None, None) => &choice.branches[choice.branches.len() - 1].1,
    }
}
