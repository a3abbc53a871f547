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
    pub(super) seeding: Seeding,
    pub(super) children: u32,
    pub(super) draws: Draws,
    pub(super) fate: Fate,
}

/// Where the children's streams come from: the rule's own draws do not move them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Seeding {
    origin: Stream,
    /// The number of the first child that gets its stream from here.
    first: u32,
}

impl Seeding {
    pub fn new(origin: Stream) -> Self {
        Self { origin, first: 0 }
    }

    /// The stream of the child with this number.
    pub fn child(self, place: u32) -> Stream {
        self.origin.child(place - self.first)
    }
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

    /// `set(seedian, …)`: from here on chances hang on the number and on nothing else, here and in
    /// the shapes that are made until the end of the brackets or of the cell.
    pub(super) fn reseed(&mut self, seed: f64) {
        self.state.seed = seed;
        self.stream = Stream::new((seed + 0.0).to_bits());
        self.seeding = Seeding {
            origin: self.stream,
            first: self.children,
        };
    }

    /// Goes back to where the streams came from before a part of the rule.
    pub(super) fn seed_again(&mut self, (seeding, stream): (Seeding, Stream)) {
        if self.seeding != seeding {
            (self.seeding, self.stream) = (seeding, stream);
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
