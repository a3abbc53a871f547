//! A rule at work on one shape.

use crate::Span;

use super::draws::Draws;
use super::evaluate::Scene;
use super::random::Stream;
use super::state::State;
use super::value::Value;

/// A rule at work on one shape.
pub struct Frame {
    pub node: u32,
    /// The name of the rule in its file.
    pub span: Span,
    pub state: State,
    pub slots: Vec<Value>,
    pub stream: Stream,
    pub depth: usize,
    /// Where the children's streams come from: the rule's own draws do not move them.
    pub(super) origin: Stream,
    pub(super) children: u32,
    pub(super) draws: Draws,
    pub(super) fate: Fate,
}

/// What becomes of the current shape at the end of its body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fate {
    /// Nothing has been done with it: it stays as a leaf, unless brackets made shapes in its place.
    Untouched,
    /// It has been changed since it was last handed on: it stays as a leaf.
    Changed,
    /// It lives on in its children, or is gone.
    Done,
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
    pub(super) fn stays(&self, children: u32) -> bool {
        match self.fate {
            Fate::Untouched => self.children == children,
            Fate::Changed => true,
            Fate::Done => false,
        }
    }
}
