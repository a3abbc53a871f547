//! What a rule does: operations, their blocks, and the choice between alternatives.

use super::{Expr, Ident};
use crate::Span;

/// The right side of a rule, of a cell and of an alternative.
#[derive(Debug, Clone, PartialEq)]
pub enum Body {
    /// May be empty: the shape is then left as it is.
    Operations(Vec<Operation>),
    Branches(Branches<Body>),
}

/// Alternatives, of which one is taken. For rules `T` is a [`Body`], for functions an [`Expr`].
#[derive(Debug, Clone, PartialEq)]
pub struct Branches<T> {
    pub test: Test,
    /// At least one.
    pub branches: Vec<Branch<T>>,
    /// What follows `else :`. Only a file with errors lacks it.
    pub otherwise: Option<Box<T>>,
    pub span: Span,
}

/// What decides between alternatives. The two are not mixed in one choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Test {
    /// `case condition : …`: the first whose condition holds.
    Case,
    /// `30% : …`: one at random; `else` has what is left of 100 %.
    Chance,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Branch<T> {
    /// The condition, or the chance in per cent.
    pub test: Expr,
    pub then: T,
    pub span: Span,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Operation {
    Call(Call),
    /// `[ … ]`: works on a copy of the current shape, which is as before afterwards.
    Push {
        body: Body,
        span: Span,
    },
}

impl Operation {
    pub fn span(&self) -> Span {
        match self {
            Operation::Call(call) => call.span,
            Operation::Push { span, .. } => *span,
        }
    }
}

/// `extrude(10)`, `Window(2)`, `NIL`, `Wall.`, `split(x) { … }*`: an operation or a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct Call {
    pub name: Ident,
    /// Written with a dot at its end, which is not part of the name: a leaf, which needs no rule
    /// and has no arguments.
    pub leaf: bool,
    /// `None` without parentheses.
    pub args: Option<Vec<Expr>>,
    pub block: Option<Block>,
    /// The second block of `splitAndSetbackPerimeter`: `{ remainder : … }`.
    pub rest: Option<Block>,
    pub span: Span,
}

impl Call {
    /// The arguments; none without parentheses.
    pub fn args(&self) -> &[Expr] {
        self.args.as_deref().unwrap_or(&[])
    }
}

/// What belongs to an operation beyond its arguments.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// `{ selector : body | … }`, and `*` where it is repeated.
    Cells {
        cells: Vec<Cell<Body>>,
        repeat: bool,
        span: Span,
    },
    /// `{ operations }` without selectors (`scatter`, `inline`, `union`), or, for the operations
    /// that take a rule, the one operation that follows (`inline(append) Pieces`).
    Body { body: Box<Body>, span: Span },
    /// `{ operations | operations }`: the two operands of a boolean.
    Operands {
        first: Box<Body>,
        second: Box<Body>,
        span: Span,
    },
}

impl Block {
    pub fn span(&self) -> Span {
        match self {
            Block::Cells { span, .. } | Block::Body { span, .. } | Block::Operands { span, .. } => {
                *span
            }
        }
    }
}

/// How what a cell selects becomes shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joining {
    /// `:`: a shape of each.
    Each,
    /// `=`: one shape of all.
    All,
    /// `=:`: one shape of all that hang together.
    Connected,
}

impl Joining {
    /// As it is written.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Each => ":",
            Self::All => "=",
            Self::Connected => "=:",
        }
    }
}

/// A cell of a block. `T` is a [`Body`], or an [`Expr`] in the function `comp`.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell<T> {
    Part {
        /// What the cell is for: a selector (`front`, `isTagged("a") && top`), an index, or a
        /// size, which may be an [`ExprKind::Sized`](super::ExprKind::Sized).
        selector: Expr,
        /// The second size of a cell of `splitAndSetbackPerimeter` (`length : depth : …`).
        depth: Option<Expr>,
        joining: Joining,
        body: T,
        span: Span,
    },
    /// `{ cell | … }*`: cells that are repeated as a group; without the star they stand once, as
    /// if the brackets were not there.
    Group {
        cells: Vec<Cell<T>>,
        repeats: bool,
        span: Span,
    },
}

impl<T> Cell<T> {
    pub fn span(&self) -> Span {
        match self {
            Cell::Part { span, .. } | Cell::Group { span, .. } => *span,
        }
    }
}
