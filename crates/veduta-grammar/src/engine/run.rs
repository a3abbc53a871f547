//! Rules to shapes: one derivation from a start shape.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Instant;

use crate::shape::Asset;
use crate::Span;

use super::code::{Body, Code, Expr, Operation, Rule, Step};
use super::draws::Draws;
use super::evaluate::{alternative, Scene};
use super::fault::Fault;
use super::globals::Global;
use super::limits::Limits;
use super::overrides::{Edit, Edited, Overrides};
use super::random::Stream;
use super::state::State;
use super::tree::{Node, Told, Tree};
use super::value::Value;

/// How often the clock is looked at: every so many shapes.
const SHAPES_PER_LOOK: usize = 1024;

/// The most messages and reports of a derivation; what is beyond is dropped.
pub const MOST_MESSAGES: usize = 100_000;

/// What a derivation starts from, besides the shape.
#[derive(Debug, Clone, Default)]
pub struct Options {
    pub seed: u64,
    pub limits: Limits,
    /// Values of attributes by name, instead of those in the file.
    pub attributes: HashMap<String, Value>,
    pub overrides: Overrides,
    /// What `i` may insert, by name.
    pub assets: Arc<HashMap<Arc<str>, Arc<Asset>>>,
}

/// A derivation at work.
pub struct Run<'a> {
    pub(super) code: &'a Code,
    pub(super) options: &'a Options,
    pub(super) tree: Tree,
    /// Functions being called now, one in another.
    pub(super) calls: usize,
    pub(super) globals: Vec<Global>,
    waiting: Vec<Waiting>,
    started: Instant,
}

/// A shape that its rule has still to be applied to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Waiting {
    pub node: u32,
    pub stream: Stream,
    pub depth: usize,
}

/// A rule at work on one shape.
pub struct Frame {
    pub node: u32,
    pub state: State,
    pub slots: Vec<Value>,
    pub stream: Stream,
    pub depth: usize,
    /// Where the children's streams come from: the rule's own draws do not move them.
    origin: Stream,
    children: u32,
    draws: Draws,
    fate: Fate,
}

/// What becomes of the current shape at the end of its body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    /// Nothing has been done with it: it stays as a leaf, unless brackets made shapes in its place.
    Untouched,
    /// It has been changed since it was last handed on: it stays as a leaf.
    Changed,
    /// It lives on in its children, or is gone.
    Done,
}

/// Derives the tree of `rule` from a start shape.
pub fn derive(code: &Code, rule: usize, start: State, options: &Options) -> Result<Tree, Fault> {
    let mut run = Run::new(code, options, Tree::default());
    run.start(rule, start)?;
    run.work()?;
    run.know_all();
    run.tree.settle();
    options.overrides.report_missed(&mut run.tree, &[]);
    Ok(run.tree)
}

impl<'a> Run<'a> {
    pub(super) fn new(code: &'a Code, options: &'a Options, tree: Tree) -> Self {
        let mut globals = vec![Global::Unknown; code.globals.len()];
        for known in &tree.globals {
            globals[known.global as usize] = Global::Known(known.value.clone());
        }
        Self {
            code,
            options,
            tree,
            calls: 0,
            globals,
            waiting: Vec::new(),
            started: Instant::now(),
        }
    }

    /// What is to be derived next.
    pub(super) fn wait(&mut self, next: Waiting) {
        self.waiting.push(next);
    }

    /// Applies rules until no shape waits.
    pub(super) fn work(&mut self) -> Result<(), Fault> {
        while let Some(next) = self.waiting.pop() {
            self.apply(next)?;
        }
        Ok(())
    }

    fn start(&mut self, rule: usize, state: State) -> Result<(), Fault> {
        let called = &self.code.rules[rule];
        if !called.params.is_empty() {
            let message = format!(
                "{} needs {} arguments and cannot start",
                called.name,
                called.params.len()
            );
            return Err(Fault::at(Span::default(), message));
        }
        self.tree.nodes.push(Node {
            parent: None,
            place: 0,
            name: called.name.clone(),
            rule: Some(rule as u32),
            args: Box::default(),
            choices: Vec::new(),
            state,
            first_child: 0,
            child_count: 0,
        });
        self.wait(Waiting {
            node: 0,
            stream: Stream::new(self.options.seed),
            depth: 0,
        });
        Ok(())
    }

    /// Applies the rule of a waiting shape; its children wait in turn, the first on top.
    fn apply(&mut self, next: Waiting) -> Result<(), Fault> {
        let code = self.code;
        let node = &self.tree.nodes[next.node as usize];
        let Some(rule) = node.rule.map(|rule| &code.rules[rule as usize]) else {
            return Ok(());
        };
        let overrides = &self.options.overrides;
        let edit = overrides.edit(&self.tree, next.node);
        let mut frame = Frame {
            node: next.node,
            state: node.state.clone(),
            slots: node.args.to_vec(),
            stream: next.stream,
            depth: next.depth,
            origin: next.stream,
            children: 0,
            draws: Draws::of(edit.filter(|edit| edit.fits(node))),
            fate: Fate::Untouched,
        };
        let unfit = edit.and_then(|edit| self.set_values(edit, rule, &mut frame));
        let (waiting, first) = (self.waiting.len(), self.tree.nodes.len());
        let told = (self.tree.messages.len(), self.tree.reports.len());
        for local in &rule.locals {
            let value = self.evaluate(local, &mut frame)?;
            frame.slots.push(value);
        }
        self.run_body(&rule.body, &mut frame)?;
        if frame.stays(0) {
            self.leave(&rule.name, &mut frame)?;
        }
        self.waiting[waiting..].reverse();
        self.tell(next.node, told);
        if edit.is_some() {
            let path = self.tree.path(next.node);
            let fault = unfit.or_else(|| frame.draws.fault());
            self.tree.edited.push(Edited { path, fault });
        }
        let count = self.tree.nodes.len() - first;
        let node = &mut self.tree.nodes[next.node as usize];
        node.choices = frame.draws.taken;
        (node.first_child, node.child_count) = (first as u32, count as u32);
        Ok(())
    }

    /// Sets what an edit gives: parameters of the rule, or attributes. Gives what it cannot set.
    fn set_values(&self, edit: &Edit, rule: &Rule, frame: &mut Frame) -> Option<String> {
        let name = &self.tree.nodes[frame.node as usize].name;
        if let Some(fault) = edit.misnamed(name) {
            return Some(fault);
        }
        if edit.delete {
            return Some("the start shape cannot be deleted".into());
        }
        for (name, value) in &edit.values {
            let parameter = rule.params.iter().position(|one| one == name);
            if let Some(slot) = parameter {
                frame.slots[slot] = value.clone();
                continue;
            }
            let Some(global) = self.code.attribute_named(name) else {
                let rule = &rule.name;
                return Some(format!(
                    "`{name}` is neither a parameter of {rule} nor an attribute"
                ));
            };
            let set = frame.state.set.get_or_insert_default();
            Arc::make_mut(set).insert(global, value.clone());
        }
        None
    }

    /// Keeps whose the messages and reports are that came after `before`.
    fn tell(&mut self, node: u32, before: (usize, usize)) {
        let messages = self.tree.messages.len() - before.0;
        let reports = self.tree.reports.len() - before.1;
        if messages + reports > 0 {
            self.tree.told.push(Told {
                node,
                messages,
                reports,
            });
        }
    }

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
                    let name = self.code.symbol_text(*symbol);
                    self.leave(&name, frame)?;
                    frame.consumed();
                }
                Step::Push(inner) => self.run_pushed(inner, frame)?,
                Step::Operation(operation) => self.operate(operation, frame)?,
            }
        }
        Ok(())
    }

    /// `[ ... ]`: what is left of the copy at its end stays as a leaf, if anything was done to it.
    fn run_pushed(&mut self, steps: &[Step], frame: &mut Frame) -> Result<(), Fault> {
        let kept = (frame.state.clone(), frame.fate);
        frame.fate = Fate::Done;
        self.run_steps(steps, frame)?;
        if frame.fate == Fate::Changed {
            self.leave_under_rule(frame)?;
        }
        (frame.state, frame.fate) = kept;
        Ok(())
    }

    /// Runs a cell's body on a shape of its own; what is left of it stays as a leaf.
    pub fn run_cell(&mut self, body: &Body, state: State, frame: &mut Frame) -> Result<(), Fault> {
        let kept = std::mem::replace(&mut frame.state, state);
        let children = frame.children;
        frame.fate = Fate::Untouched;
        self.run_body(body, frame)?;
        if frame.stays(children) {
            self.leave_under_rule(frame)?;
        }
        frame.state = kept;
        frame.consumed();
        Ok(())
    }

    pub fn evaluate(&mut self, expr: &Expr, frame: &mut Frame) -> Result<Value, Fault> {
        self.value(expr, &mut frame.scene())
    }

    pub fn evaluate_number(&mut self, expr: &Expr, frame: &mut Frame) -> Result<f64, Fault> {
        self.number(expr, &mut frame.scene())
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
            return Err(Fault::at(span, message));
        }
        let name = self.code.rules[rule].name.clone();
        let stream = frame.origin.child(frame.children);
        let Some(node) = self.add(name, Some(rule as u32), args, frame, span)? else {
            return Ok(());
        };
        self.wait(Waiting {
            node,
            stream,
            depth,
        });
        Ok(())
    }

    fn leave_under_rule(&mut self, frame: &mut Frame) -> Result<(), Fault> {
        let name = self.tree.nodes[frame.node as usize].name.clone();
        self.leave(&name, frame)
    }

    /// The current shape stays as a leaf.
    fn leave(&mut self, name: &Arc<str>, frame: &mut Frame) -> Result<(), Fault> {
        self.add(name.clone(), None, Vec::new(), frame, Span::default())?;
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
        if count >= self.options.limits.shapes {
            return Err(Fault::at(span, format!("more than {count} shapes")));
        }
        if count % SHAPES_PER_LOOK == 0 {
            self.check_time(span)?;
        }
        self.tree.nodes.push(Node {
            parent: Some(frame.node),
            place,
            name,
            rule,
            args: args.into(),
            choices: Vec::new(),
            state: frame.state.clone(),
            first_child: 0,
            child_count: 0,
        });
        Ok(Some(count as u32))
    }

    /// What `print` is given; what is beyond the most messages is dropped.
    pub(super) fn write(&mut self, value: &Value) {
        if self.tree.messages.len() < MOST_MESSAGES {
            self.tree.messages.push(value.to_string());
        }
    }

    /// The shape that the derivation began with.
    pub(super) fn first(&self) -> &Node {
        &self.tree.nodes[0]
    }

    /// A fault where the derivation takes too long.
    pub(super) fn check_time(&self, span: Span) -> Result<(), Fault> {
        let limit = self.options.limits.seconds;
        if self.started.elapsed().as_secs_f64() > limit {
            return Err(Fault::at(span, format!("takes longer than {limit} s")));
        }
        Ok(())
    }

    /// The shape as the frame's rule got it.
    pub(super) fn start_of(&self, frame: &Frame) -> &State {
        &self.tree.nodes[frame.node as usize].state
    }

    fn operate(&mut self, operation: &Operation, frame: &mut Frame) -> Result<(), Fault> {
        super::operations::run(self, operation, frame)
    }
}

impl Frame {
    /// Where the rule's expressions are evaluated.
    pub fn scene(&mut self) -> Scene<'_> {
        Scene {
            slots: &mut self.slots,
            state: &self.state,
            stream: &mut self.stream,
            draws: &mut self.draws,
        }
    }

    /// The shape has been changed: it stays unless something follows.
    pub fn changed(&mut self) {
        self.fate = Fate::Changed;
    }

    /// The shape is gone: its parts have taken its place, or nothing has.
    pub fn consumed(&mut self) {
        self.fate = Fate::Done;
    }

    /// Whether the shape stays as a leaf; `children` is how many there were before its body.
    fn stays(&self, children: u32) -> bool {
        match self.fate {
            Fate::Untouched => self.children == children,
            Fate::Changed => true,
            Fate::Done => false,
        }
    }
}
