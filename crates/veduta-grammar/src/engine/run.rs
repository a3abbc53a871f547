//! Rules to shapes: one derivation from a start shape.

use std::collections::HashMap;
use std::sync::Arc;

use veduta_geometry::{Budget, Spent};

use crate::shape::Asset;
use crate::Span;

use super::clock::{Clock, Over};
use super::code::{Code, Expr, Rule};
use super::draws::{Draws, LogSum};
use super::fault::Fault;
use super::files::Files;
use super::frame::{Fate, Frame, Seeding};
use super::globals::Global;
use super::limits::{Limit, Limits};
use super::occluders::{Neighbour, Occluder, Trail};
use super::overrides::{Edit, Edited, Overrides};
use super::random::Stream;
use super::state::State;
use super::tree::{Node, Told, Tree};
use super::value::Value;

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
    /// Textures of known sizes by name: metres to the right and up, all above 0. They lie in
    /// metres where no rule says how they lie.
    pub textures: Arc<HashMap<Arc<str>, [f64; 2]>>,
    /// The files of the project, where the rules ask for them.
    pub files: Arc<Files>,
    /// What stands around the start shape.
    pub neighbours: Vec<Neighbour>,
}

/// A derivation at work.
pub struct Run<'a> {
    pub(super) code: &'a Code,
    pub(super) options: &'a Options,
    pub(super) tree: Tree,
    /// Functions being called now, one in another.
    pub(super) calls: usize,
    pub(super) globals: Vec<Global>,
    pub(super) waiting: Vec<Waiting>,
    /// Shapes made so far, those of inlined rules included.
    pub(super) made: usize,
    /// Operations that inline others now, one in another.
    pub(super) nested: usize,
    /// The node whose rule is at work.
    pub(super) at: u32,
    /// Where in that rule 0 was taken for a value that is no number.
    pub(super) zeroed: Vec<Span>,
    /// Where the current shape stands; None where no rule asks about other shapes.
    pub(super) trail: Option<Trail>,
    /// What the first of two passes collects.
    pub(super) recorded: Option<Vec<Occluder>>,
    /// What the first pass has collected, in the second.
    pub(super) around: Vec<Occluder>,
    clock: Clock,
}

/// A shape that its rule has still to be applied to.
pub(super) struct Waiting {
    pub node: u32,
    pub depth: usize,
    /// Where the shape stands; empty where no rule asks about other shapes.
    pub trail: Vec<u32>,
}

/// Derives the tree of `rule` from a start shape.
///
/// Rules that ask about other shapes are derived twice: at first every question has the answer
/// that there is nothing, then it is about the shapes that the first pass made. So no answer
/// depends on the order of the work.
pub fn derive(code: &Code, rule: usize, start: State, options: &Options) -> Result<Tree, Fault> {
    let mut clock = Clock::starting(options.limits);
    let mut around = Vec::new();
    if code.asks {
        let mut first = Run::new(code, options, Tree::default(), clock);
        first.recorded = Some(Vec::new());
        first.all(rule, start.clone())?;
        around = first.recorded.unwrap_or_default();
        clock = first.clock;
    }
    let mut run = Run::new(code, options, Tree::default(), clock);
    run.around = around;
    run.all(rule, start)?;
    run.know_all();
    run.tree.settle();
    options.overrides.report_missed(&mut run.tree, &[]);
    Ok(run.tree)
}

/// What a start shape puts in the way of others, for [`Neighbour`]: the first of the two passes.
///
/// No clock stops it, but the other limits do: what stands beside a lot must not depend on how busy
/// the machine is.
pub fn occluders(
    code: &Code,
    rule: usize,
    start: State,
    options: &Options,
) -> Result<Vec<Occluder>, Fault> {
    let limits = Limits {
        seconds: f64::INFINITY,
        ..options.limits
    };
    let mut run = Run::new(code, options, Tree::default(), Clock::starting(limits));
    run.trail = Some(Trail::default());
    run.recorded = Some(Vec::new());
    run.all(rule, start)?;
    Ok(run.recorded.unwrap_or_default())
}

impl<'a> Run<'a> {
    pub(super) fn new(code: &'a Code, options: &'a Options, tree: Tree, clock: Clock) -> Self {
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
            made: 0,
            nested: 0,
            at: 0,
            zeroed: Vec::new(),
            trail: code.asks.then(Trail::default),
            recorded: None,
            around: Vec::new(),
            clock,
        }
    }

    fn all(&mut self, rule: usize, start: State) -> Result<(), Fault> {
        self.start(rule, start)?;
        self.work()
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
            let count = called.params.len();
            let message = format!(
                "{name} needs {count} argument{s}: write --start \"{name}(...)\"",
                name = called.name,
                s = if count == 1 { "" } else { "s" },
            );
            return Err(Fault::at(called.span, message).within(called.unit));
        }
        self.tree.nodes.push(Node {
            parent: None,
            place: 0,
            name: called.name.clone(),
            rule: Some(rule as u32),
            args: Box::default(),
            stream: Stream::new(self.options.seed),
            choices: Vec::new(),
            inlined: LogSum::default(),
            state,
            first_child: 0,
            child_count: 0,
        });
        self.wait(Waiting {
            node: 0,
            depth: 0,
            trail: Vec::new(),
        });
        Ok(())
    }

    /// Applies the rule of a waiting shape; its children wait in turn, the first on top.
    pub(super) fn apply(&mut self, next: Waiting) -> Result<(), Fault> {
        let code = self.code;
        let node = &self.tree.nodes[next.node as usize];
        let Some(rule) = node.rule.map(|rule| &code.rules[rule as usize]) else {
            return Ok(());
        };
        let edit = self.options.overrides.edit(&self.tree, next.node);
        let mut frame = Frame {
            node: next.node,
            span: rule.span,
            state: node.state.clone(),
            slots: node.args.to_vec(),
            stream: node.stream,
            depth: next.depth,
            seeding: Seeding::new(node.stream),
            children: 0,
            draws: Draws::of(edit.filter(|edit| edit.fits(node))),
            fate: Fate::Untouched,
        };
        if let Some(trail) = &mut self.trail {
            *trail = Trail::at(next.trail);
        }
        self.at = next.node;
        self.zeroed.clear();
        let unfit = edit.and_then(|edit| self.set_values(edit, rule, &mut frame));
        let (waiting, first) = (self.waiting.len(), self.tree.nodes.len());
        let told = (self.tree.messages.len(), self.tree.reports.len());
        self.run_rule(rule, &mut frame)
            .map_err(|fault| fault.within(rule.unit))?;
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
        node.inlined = frame.draws.inlined;
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

    /// Keeps whose the messages and reports are that came after `before`. Those of inlined rules
    /// belong to the shape that stays.
    fn tell(&mut self, node: u32, before: (usize, usize)) {
        let messages = self.tree.messages.len() - before.0;
        let reports = self.tree.reports.len() - before.1;
        if self.nested == 0 && messages + reports > 0 {
            self.tree.told.push(Told {
                node,
                messages,
                reports,
            });
        }
    }

    fn run_rule(&mut self, rule: &Rule, frame: &mut Frame) -> Result<(), Fault> {
        for local in &rule.locals {
            let value = self.evaluate(local, frame)?;
            frame.slots.push(value);
        }
        self.run_body(&rule.body, frame)?;
        if frame.stays(0) {
            self.leave(&rule.name, frame)?;
        }
        Ok(())
    }

    pub fn evaluate(&mut self, expr: &Expr, frame: &mut Frame) -> Result<Value, Fault> {
        self.value(expr, &mut frame.scene())
    }

    pub fn evaluate_finite(&mut self, expr: &Expr, frame: &mut Frame) -> Result<f64, Fault> {
        self.finite(expr, &mut frame.scene())
    }

    /// What `print` is given; what is beyond the most messages is dropped.
    pub(super) fn write(&mut self, value: &Value, span: Span) -> Result<(), Fault> {
        if self.tree.messages.len() < MOST_MESSAGES {
            let text = value.printed().map_err(|why| Fault::at(span, why))?;
            self.hold(text.len(), span)?;
            self.tree.messages.push(text);
        }
        Ok(())
    }

    /// The shape that the derivation began with.
    pub(super) fn first(&self) -> &Node {
        &self.tree.nodes[0]
    }

    /// A fault where the derivation takes too long, or too much work or memory.
    pub(super) fn check_time(&self, span: Span) -> Result<(), Fault> {
        match self.clock.look() {
            None => Ok(()),
            Some(Over::Time) => {
                let limit = self.options.limits.seconds;
                let message = format!("takes longer than {limit} s: make fewer or simpler shapes");
                Err(Fault::over(Limit::Seconds, span, message))
            }
            Some(Over::Work) => {
                let limit = self.options.limits.work;
                let message =
                    format!("takes more than {limit} steps of work: make fewer or simpler shapes");
                Err(Fault::over(Limit::Work, span, message))
            }
            Some(Over::Memory) => {
                let limit = self.options.limits.memory >> 20;
                let message =
                    format!("takes more than {limit} MiB of memory: make fewer or simpler shapes");
                Err(Fault::over(Limit::Memory, span, message))
            }
        }
    }

    /// The fault of more than `most` parts: of the limit, or of less than that.
    pub(super) fn too_many_parts(&self, most: usize, span: Span, told: &impl ToString) -> Fault {
        if most < self.options.limits.parts {
            return Fault::at(span, told.to_string());
        }
        Fault::over(Limit::Parts, span, told.to_string())
    }

    /// Takes steps from the limit, before they are done.
    pub(super) fn take(&self, steps: usize, span: Span) -> Result<(), Fault> {
        match self.clock.take(steps) {
            Ok(()) => Ok(()),
            Err(Spent) => self.check_time(span),
        }
    }

    /// Takes bytes for what is made and stays.
    pub(super) fn hold(&self, bytes: usize, span: Span) -> Result<(), Fault> {
        match self.clock.hold(bytes) {
            Ok(()) => Ok(()),
            Err(Spent) => self.check_time(span),
        }
    }

    /// What long work takes its steps from.
    pub(super) fn budget(&self) -> &dyn Budget {
        &self.clock
    }

    /// The fault for work that came to nothing: that its limit is reached, or what `told` says.
    pub(super) fn failed(&self, span: Span, told: impl std::fmt::Display) -> Fault {
        let over = self.check_time(span).err();
        over.unwrap_or_else(|| Fault::at(span, told.to_string()))
    }

    /// The shape as the frame's rule got it.
    pub(super) fn start_of(&self, frame: &Frame) -> &State {
        &self.tree.nodes[frame.node as usize].state
    }
}
