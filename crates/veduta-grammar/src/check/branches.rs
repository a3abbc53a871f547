//! Alternatives.

use super::Checker;
use crate::ast::{Body, Branches, Expr, ExprKind, Operation, Test};
use crate::builtins::NONE;
use crate::Diagnostic;

impl Checker<'_> {
    pub fn body(&mut self, body: &Body) {
        match body {
            Body::Operations(list) => self.operations(list),
            Body::Branches(branches) => {
                self.branches(branches, "`else : NIL`", Self::body);
            }
        }
    }

    pub fn operations(&mut self, list: &[Operation]) {
        for operation in list {
            match operation {
                Operation::Call(call) => self.call(call),
                Operation::Push { body, .. } => self.body(body),
            }
        }
    }

    pub fn branches<T>(&mut self, all: &Branches<T>, missing: &str, part: fn(&mut Self, &T)) {
        self.branching += 1;
        for branch in &all.branches {
            self.expr(&branch.test, NONE);
            // What is not the first test may not be evaluated.
            self.calls.enter_branch();
            part(self, &branch.then);
        }
        match &all.otherwise {
            Some(otherwise) => part(self, otherwise),
            None => {
                let message = "these alternatives lack an `else`";
                let hint = format!("end them with {missing}");
                self.diagnostics
                    .add(Diagnostic::error(all.span, message).with_hint(hint));
            }
        }
        for _ in &all.branches {
            self.calls.leave_branch();
        }
        self.branching -= 1;
        match all.test {
            Test::Chance => self.chances(all),
            Test::Case => self.cases(all),
        }
    }

    fn chances<T>(&mut self, all: &Branches<T>) {
        let mut sum = 0.0;
        for branch in &all.branches {
            match branch.test.kind {
                ExprKind::Number(chance) => sum += chance,
                ExprKind::Unary { .. } => {
                    let message = "a chance cannot be negative";
                    self.diagnostics.error(branch.test.span, message);
                }
                _ => {}
            }
        }
        if sum > 100.0 + 1e-9 {
            let message = format!("the chances sum to {sum} %; 100 % are the most");
            self.diagnostics.error(all.span, message);
        }
    }

    fn cases<T>(&mut self, all: &Branches<T>) {
        let always = |test: &Expr| matches!(test.kind, ExprKind::Bool(true));
        let Some(first) = all.branches.iter().position(|one| always(&one.test)) else {
            return;
        };
        for branch in &all.branches[first + 1..] {
            let message = "this branch is never taken: a condition before it is always true";
            self.diagnostics
                .add(Diagnostic::warning(branch.span, message));
        }
    }
}
