//! The steps of a rule's body, and the shapes that they make.

use std::sync::Arc;

use crate::Span;

use super::code::{Body, Step};
use super::draws::LogSum;
use super::evaluate::alternative;
use super::fault::Fault;
use super::frame::{Fate, Frame};
use super::limits::Limit;
use super::occluders::Trail;
use super::overrides::Edited;
use super::run::{Run, Waiting};
use super::state::State;
use super::tree::Node;
use super::value::Value;

/// What a shape costs, in steps of work.
const STEPS_PER_SHAPE: usize = 32;

impl Run<'_> {
    /// Runs a body on the frame's shape; `frame.fate` tells what became of it.
    pub fn run_body(&mut self, body: &Body, frame: &mut Frame) -> Result<(), Fault> {
        match body {
            Body::Steps(steps) => self.run_steps(steps, frame),
            Body::Choice(choice) => match self.choose(choice, &mut frame.scene())? {
                Some(taken) => self.run_body(alternative(choice, taken), frame),
                None => Ok(()),
            },
        }
    }

    fn run_steps(&mut self, steps: &[Step], frame: &mut Frame) -> Result<(), Fault> {
        for step in steps {
            match step {
                Step::Rule { rule, args, span } => {
                    let mut values = Vec::with_capacity(args.len());
                    for arg in args {
                        values.push(self.evaluate(arg, frame)?);
                    }
                    self.call(*rule, values, *span, frame)?;
                    frame.consumed();
                }
                Step::Leaf { symbol } => {
                    let code = self.code;
                    self.leave(&code.names[symbol.index()], frame)?;
                    frame.consumed();
                }
                Step::Broken { message, span } => {
                    return Err(Fault::at(*span, message.as_ref()));
                }
                Step::Push(inner) => self.run_pushed(inner, frame)?,
                Step::Operation(operation) => super::operations::run(self, operation, frame)?,
            }
        }
        Ok(())
    }

    /// `[ ... ]`: what is left of the copy at its end stays as a leaf, if anything was done to it.
    fn run_pushed(&mut self, body: &Body, frame: &mut Frame) -> Result<(), Fault> {
        let kept = (frame.state.clone(), frame.fate);
        let seeding = (frame.seeding, frame.stream);
        frame.fate = Fate::Done;
        self.enter();
        self.run_body(body, frame)?;
        if frame.fate == Fate::Changed {
            self.leave_under_rule(frame)?;
        }
        self.back();
        (frame.state, frame.fate) = kept;
        frame.seed_again(seeding);
        Ok(())
    }

    /// Runs a cell's body on a shape of its own; what is left of it stays as a leaf.
    pub fn run_cell(&mut self, body: &Body, state: State, frame: &mut Frame) -> Result<(), Fault> {
        let kept = std::mem::replace(&mut frame.state, state);
        let seeding = (frame.seeding, frame.stream);
        let children = frame.children;
        frame.fate = Fate::Untouched;
        self.hold(frame.state.form.geometry.byte_count(), frame.span)?;
        self.enter();
        self.run_body(body, frame)?;
        if frame.stays(children) {
            self.leave_under_rule(frame)?;
        }
        self.back();
        frame.state = kept;
        frame.seed_again(seeding);
        frame.consumed();
        Ok(())
    }

    fn call(
        &mut self,
        rule: usize,
        args: Vec<Value>,
        span: Span,
        frame: &mut Frame,
    ) -> Result<(), Fault> {
        let depth = frame.depth + 1;
        if depth > self.options.limits.depth {
            let message = format!("rules apply one within another over {} deep", depth - 1);
            return Err(Fault::over(Limit::Depth, span, message));
        }
        let name = self.code.rules[rule].name.clone();
        let trail = self.trail.as_mut().map(Trail::child).unwrap_or_default();
        let Some(node) = self.add(name, Some(rule as u32), args, frame, span)? else {
            return Ok(());
        };
        self.wait(Waiting { node, depth, trail });
        Ok(())
    }

    fn leave_under_rule(&mut self, frame: &mut Frame) -> Result<(), Fault> {
        let name = self.tree.nodes[frame.node as usize].name.clone();
        self.leave(&name, frame)
    }

    /// The current shape stays as a leaf.
    pub(super) fn leave(&mut self, name: &Arc<str>, frame: &mut Frame) -> Result<(), Fault> {
        self.enter();
        if self.nested == 0 {
            self.record(None, &frame.state, frame.span)?;
        }
        self.back();
        self.add(name.clone(), None, Vec::new(), frame, frame.span)?;
        Ok(())
    }

    /// A child of the frame's node with its current shape; None where an override deletes it.
    fn add(
        &mut self,
        name: Arc<str>,
        rule: Option<u32>,
        args: Vec<Value>,
        frame: &mut Frame,
        span: Span,
    ) -> Result<Option<u32>, Fault> {
        let place = frame.children;
        frame.children += 1;
        let overrides = &self.options.overrides;
        if let Some((path, edit)) = overrides.edited_child(&self.tree, frame.node, place) {
            if edit.delete && edit.misnamed(&name).is_none() {
                self.tree.edited.push(Edited { path, fault: None });
                return Ok(None);
            }
        }
        let count = self.tree.nodes.len();
        if self.made >= self.options.limits.shapes {
            let message = format!("more than {} shapes", self.made);
            return Err(Fault::over(Limit::Shapes, span, message));
        }
        self.made += 1;
        self.take(STEPS_PER_SHAPE, span)?;
        let values: usize = args.iter().map(Value::element_count).sum();
        self.hold(size_of::<Node>() + size_of::<Value>() * values, span)?;
        self.tree.nodes.push(Node {
            parent: Some(frame.node),
            place,
            name,
            rule,
            args: args.into(),
            stream: frame.seeding.child(place),
            choices: Vec::new(),
            inlined: LogSum::default(),
            state: frame.state.clone(),
            first_child: 0,
            child_count: 0,
        });
        Ok(Some(count as u32))
    }
}
