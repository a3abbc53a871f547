//! Expressions.

use super::{Branches, Cell, Ident};
use crate::Span;

#[derive(Debug, Clone, PartialEq)]
pub struct Expr {
    pub kind: ExprKind,
    pub span: Span,
    height: u16,
}

impl Expr {
    pub fn new(kind: ExprKind, span: Span) -> Self {
        let height = kind.height_below().saturating_add(1);
        Self { kind, span, height }
    }

    /// Levels of the tree.
    pub fn height(&self) -> u16 {
        self.height
    }
}

#[derive(Debug, Clone, PartialEq)]
pub enum ExprKind {
    Number(f64),
    Text(String),
    Bool(bool),
    /// A parameter, attribute, constant, function without arguments, shape attribute or selector.
    Name(Ident),
    Call {
        name: Ident,
        args: Vec<Expr>,
    },
    /// `comp(f) { selector : value | … }`: an array with a value for each component.
    Cells {
        name: Ident,
        args: Vec<Expr>,
        cells: Vec<Cell<Expr>>,
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
    /// `[a, b ; c, d]`: one row or more, each with at least one element.
    Array(Vec<Vec<Expr>>),
    /// `from : to` or `from : step : to` as an element of an array or an index.
    Range {
        from: Box<Expr>,
        step: Option<Box<Expr>>,
        to: Box<Expr>,
    },
    /// `array[index]` or `array[row, column]`
    Index {
        array: Box<Expr>,
        indices: Vec<Expr>,
    },
    /// `case … : … else : …` and `30% : … else : …`
    Branches(Box<Branches<Expr>>),
    /// `'0.5`, `~2` or `~'0.5` as an argument or the size of a cell. The prefix is for all of the
    /// expression after it: `~2*w` floats by `2*w`.
    Sized {
        size: Size,
        value: Box<Expr>,
    },
}

impl ExprKind {
    fn height_below(&self) -> u16 {
        match self {
            ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Bool(_) | ExprKind::Name(_) => 0,
            ExprKind::Call { args, .. } => highest(args),
            ExprKind::Cells { args, cells, .. } => highest(args).max(highest_cell(cells)),
            ExprKind::Unary { operand, .. } => operand.height,
            ExprKind::Binary { left, right, .. } => left.height.max(right.height),
            ExprKind::Array(rows) => rows.iter().map(|row| highest(row)).max().unwrap_or(0),
            ExprKind::Range { from, step, to } => {
                let step = step.as_ref().map_or(0, |step| step.height);
                from.height.max(to.height).max(step)
            }
            ExprKind::Index { array, indices } => array.height.max(highest(indices)),
            ExprKind::Branches(branches) => {
                let each = branches.branches.iter();
                let highest = each.map(|one| one.test.height.max(one.then.height)).max();
                let otherwise = branches.otherwise.as_ref().map_or(0, |other| other.height);
                highest.unwrap_or(0).max(otherwise)
            }
            ExprKind::Sized { value, .. } => value.height,
        }
    }
}

fn highest(list: &[Expr]) -> u16 {
    list.iter().map(|one| one.height).max().unwrap_or(0)
}

fn highest_cell(cells: &[Cell<Expr>]) -> u16 {
    let each = cells.iter().map(|cell| match cell {
        Cell::Part { selector, body, .. } => selector.height.max(body.height),
        Cell::Group { cells, .. } => highest_cell(cells).saturating_add(1),
    });
    each.max().unwrap_or(0)
}

/// How the size of a cell or an argument is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// `'`: times the size of the scope.
    Relative,
    /// `~`: a share of what the other cells leave.
    Floating,
    /// `~'`: as floating, with a size relative to the scope.
    FloatingRelative,
}

/// An operator with `Each` in its name is written with a dot and works on each element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnaryOp {
    Not,
    Minus,
    Plus,
    EachNot,
    EachMinus,
    EachPlus,
}

/// An operator with `Each` in its name is written with a dot and works on each element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BinaryOp {
    Or,
    And,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    EachOr,
    EachAnd,
    EachEqual,
    EachNotEqual,
    EachLess,
    EachLessEqual,
    EachGreater,
    EachGreaterEqual,
    EachAdd,
    EachSubtract,
    EachMultiply,
    EachDivide,
    EachRemainder,
}

impl UnaryOp {
    pub fn sign(self) -> &'static str {
        match self {
            UnaryOp::Not => "!",
            UnaryOp::Minus => "-",
            UnaryOp::Plus => "+",
            UnaryOp::EachNot => ".!",
            UnaryOp::EachMinus => ".-",
            UnaryOp::EachPlus => ".+",
        }
    }
}

impl BinaryOp {
    pub fn sign(self) -> &'static str {
        match self {
            BinaryOp::Or => "||",
            BinaryOp::And => "&&",
            BinaryOp::Equal => "==",
            BinaryOp::NotEqual => "!=",
            BinaryOp::Less => "<",
            BinaryOp::LessEqual => "<=",
            BinaryOp::Greater => ">",
            BinaryOp::GreaterEqual => ">=",
            BinaryOp::Add => "+",
            BinaryOp::Subtract => "-",
            BinaryOp::Multiply => "*",
            BinaryOp::Divide => "/",
            BinaryOp::Remainder => "%",
            BinaryOp::EachOr => ".||",
            BinaryOp::EachAnd => ".&&",
            BinaryOp::EachEqual => ".==",
            BinaryOp::EachNotEqual => ".!=",
            BinaryOp::EachLess => ".<",
            BinaryOp::EachLessEqual => ".<=",
            BinaryOp::EachGreater => ".>",
            BinaryOp::EachGreaterEqual => ".>=",
            BinaryOp::EachAdd => ".+",
            BinaryOp::EachSubtract => ".-",
            BinaryOp::EachMultiply => ".*",
            BinaryOp::EachDivide => "./",
            BinaryOp::EachRemainder => ".%",
        }
    }

    /// How tightly the operator binds; all group to the left.
    pub fn precedence(self) -> u8 {
        match self {
            BinaryOp::Or | BinaryOp::EachOr => 1,
            BinaryOp::And | BinaryOp::EachAnd => 2,
            BinaryOp::Equal | BinaryOp::NotEqual | BinaryOp::EachEqual | BinaryOp::EachNotEqual => {
                3
            }
            BinaryOp::Less
            | BinaryOp::LessEqual
            | BinaryOp::Greater
            | BinaryOp::GreaterEqual
            | BinaryOp::EachLess
            | BinaryOp::EachLessEqual
            | BinaryOp::EachGreater
            | BinaryOp::EachGreaterEqual => 4,
            BinaryOp::Add | BinaryOp::Subtract | BinaryOp::EachAdd | BinaryOp::EachSubtract => 5,
            BinaryOp::Multiply
            | BinaryOp::Divide
            | BinaryOp::Remainder
            | BinaryOp::EachMultiply
            | BinaryOp::EachDivide
            | BinaryOp::EachRemainder => 6,
        }
    }
}
