//! Rule files as the engine runs them: every name is a number.

use std::sync::Arc;

use crate::ast::{BinaryOp, Joining, UnaryOp};
use crate::shape::Kind;
use crate::{Diagnostic, Span, Symbol};

use super::files::FileFunction;
use super::functions::Function;
use super::measures::Measure;
use super::operations::OperationId;
use super::queries::Query;
use super::shape_attributes::ShapeAttribute;
use super::sorting::Sorting;

/// Rule files that belong together, ready to run.
#[derive(Debug, Clone, Default)]
pub struct Code {
    pub rules: Vec<Rule>,
    /// Attributes and constants, each evaluated once for a start shape.
    pub globals: Vec<Global>,
    pub functions: Vec<UserFunction>,
    /// The rule that a derivation begins with where none is named.
    pub start: Option<usize>,
    /// Whether something hangs on the pivots of shapes.
    pub tells_pivot: bool,
    /// Whether a rule asks about other shapes.
    pub asks: bool,
    /// Whether one asks about shapes of other lots.
    pub asks_beside: bool,
    /// Whether they ask which files there are.
    pub lists_files: bool,
    /// Whether they read what stands in files.
    pub reads_files: bool,
    /// Whether they ask where shapes lie on Earth.
    pub asks_place: bool,
    /// Whether a rule trims shapes.
    pub trims: bool,
    /// Whether they ask for tags.
    pub tags: bool,
    /// The texts of all symbols.
    pub names: Vec<Arc<str>>,
}

impl Code {
    pub fn symbol_text(&self, symbol: Symbol) -> Arc<str> {
        self.names[symbol.index()].clone()
    }

    /// The number of the rule of this name.
    pub fn rule_named(&self, name: &str) -> Option<usize> {
        self.rules
            .iter()
            .position(|rule| rule.name.as_ref() == name)
    }

    /// The number of the attribute of this name.
    pub fn attribute_named(&self, name: &str) -> Option<usize> {
        self.globals
            .iter()
            .position(|global| global.is_attribute && global.name.as_ref() == name)
    }
}

#[derive(Debug, Clone)]
pub struct Rule {
    pub name: Arc<str>,
    /// The number of its file, and its name there.
    pub unit: usize,
    pub span: Span,
    pub symbol: Symbol,
    /// The names of its parameters, which are in the first slots.
    pub params: Vec<Arc<str>>,
    /// Values of `with`, in the slots after the parameters.
    pub locals: Vec<Expr>,
    pub body: Body,
}

#[derive(Debug, Clone)]
pub struct Global {
    pub name: Arc<str>,
    pub unit: usize,
    /// Whether it may be set from outside.
    pub is_attribute: bool,
    /// Values of `with`, by slot.
    pub locals: Vec<Expr>,
    pub value: Expr,
}

#[derive(Debug, Clone)]
pub struct UserFunction {
    pub name: Arc<str>,
    pub unit: usize,
    pub params: usize,
    pub locals: Vec<Expr>,
    pub value: Expr,
}

/// An expression with the place to name when it fails.
#[derive(Debug, Clone)]
pub struct Expr {
    pub kind: ExprKind,
    pub span: Span,
}

impl Expr {
    /// One that stops the derivation where it is evaluated.
    pub fn broken(fault: &Diagnostic) -> Self {
        let kind = ExprKind::Broken(fault.message.as_str().into());
        let span = fault.span;
        Self { kind, span }
    }
}

#[derive(Debug, Clone)]
pub enum ExprKind {
    Number(f64),
    Bool(bool),
    Text(Arc<str>),
    /// What cannot be evaluated, and nothing was thought to reach: why.
    Broken(Arc<str>),
    /// A word that is no value (`front`, `uvSpace`).
    Word(Arc<str>),
    /// A parameter or a value of `with`.
    Slot(usize),
    Global(usize),
    Attribute(ShapeAttribute),
    Call {
        function: usize,
        args: Vec<Expr>,
    },
    Builtin {
        function: Function,
        args: Vec<Expr>,
    },
    /// A function of the current shape's geometry.
    Measure {
        measure: Measure,
        args: Vec<Expr>,
    },
    /// A function of the project's files.
    Files {
        function: FileFunction,
        args: Vec<Expr>,
    },
    /// A function that chooses files by how well they fit the scope.
    Sorting {
        sorting: Sorting,
        args: Vec<Expr>,
    },
    /// A question about other shapes.
    Query {
        query: Query,
        args: Vec<Expr>,
    },
    /// `comp(f) { selector : value | ... }`: an array of a value for each component.
    Components {
        kind: Kind,
        /// Whether scopes lie along the components.
        aligned: bool,
        cells: Vec<ComponentValue>,
    },
    Unary {
        op: UnaryOp,
        operand: Box<Expr>,
    },
    Binary {
        op: BinaryOp,
        left: Box<Expr>,
        right: Box<Expr>,
    },
    Array(Vec<Vec<Expr>>),
    Range {
        from: Box<Expr>,
        step: Option<Box<Expr>>,
        to: Box<Expr>,
    },
    Index {
        array: Box<Expr>,
        indices: Vec<Expr>,
    },
    Choice(Box<Choice<Expr>>),
}

/// Alternatives of which one is taken.
#[derive(Debug, Clone)]
pub struct Choice<T> {
    /// At random, by chances in per cent; else the first whose condition holds.
    pub by_chance: bool,
    pub branches: Vec<(Expr, T)>,
    pub otherwise: Option<T>,
    pub span: Span,
}

#[derive(Debug, Clone)]
pub enum Body {
    Steps(Vec<Step>),
    Choice(Box<Choice<Body>>),
}

#[derive(Debug, Clone)]
pub enum Step {
    /// The current shape goes on under a rule.
    Rule {
        rule: usize,
        args: Vec<Expr>,
        span: Span,
    },
    /// The current shape is a leaf of this name.
    Leaf {
        symbol: Symbol,
    },
    Push(Body),
    Operation(Box<Operation>),
    /// What cannot be derived, and nothing was thought to reach.
    Broken {
        message: Arc<str>,
        span: Span,
    },
}

#[derive(Debug, Clone)]
pub struct Operation {
    pub id: OperationId,
    pub args: Vec<Arg>,
    pub cells: Vec<Cell>,
    /// `*` after the block.
    pub repeat: bool,
    pub span: Span,
}

/// An argument: a value, or a word that is none (`front`, `noAdjust`, `color.r`).
#[derive(Debug, Clone)]
pub enum Arg {
    Value(Sizing, Expr),
    Word(Arc<str>),
}

/// How a number is meant: `'` and `~`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sizing {
    Absolute,
    Relative,
    Floating,
    FloatingRelative,
}

/// A cell of the function `comp`.
#[derive(Debug, Clone)]
pub struct ComponentValue {
    pub selector: Selector,
    /// `=` and `=:`: the value is that of what is selected as one shape.
    pub joining: Joining,
    pub value: Expr,
}

#[derive(Debug, Clone)]
pub enum Cell {
    Part {
        selector: Selector,
        /// The second size of a cell of `splitAndSetbackPerimeter`.
        depth: Option<Expr>,
        joining: Joining,
        body: Body,
    },
    Repeat(Vec<Cell>),
}

impl Cell {
    /// Selector, how shapes become of it, and body; None of cells that repeat.
    pub fn part(&self) -> Option<(&Selector, Joining, &Body)> {
        match self {
            Self::Part {
                selector,
                joining,
                body,
                ..
            } => Some((selector, *joining, body)),
            Self::Repeat(_) => None,
        }
    }
}

#[derive(Debug, Clone)]
pub enum Selector {
    Word(Arc<str>),
    Value(Sizing, Expr),
}

impl Selector {
    /// What `comp.sel` is of what it selects.
    pub fn name(&self) -> Arc<str> {
        match self {
            Self::Word(word) => word.clone(),
            Self::Value(..) => "".into(),
        }
    }
}
