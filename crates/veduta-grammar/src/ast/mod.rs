//! The syntax tree of a rule file.
//!
//! **For an evaluator.** Every name is a [`Symbol`]: a small number that is the same in all files
//! that were parsed with the same [`Names`](crate::Names), and serves as an index of a side table.
//! What a name refers to is resolved once, by [`check`](crate::check()): its
//! [`Resolution`](crate::Resolution) maps the place of a name (`Ident::span.start`, unique in its
//! file) to the slot of a parameter, the index of a definition, or an entry of the tables of
//! built-in names. An evaluator lowers the tree once with these and never looks at text again.
//!
//! **Bounds.** No tree is nested deeper than [`MAX_NESTING`](crate::limits::MAX_NESTING) blocks
//! and no expression higher than [`MAX_HEIGHT`](crate::limits::MAX_HEIGHT), so recursion is safe.
//!
//! Parentheses of expressions are no nodes: the tree's shape says what they said. They are part of
//! the span of what they enclose.

mod block;
mod expression;

pub use block::{Block, Body, Branch, Branches, Call, Cell, Joining, Operation, Test};
pub use expression::{BinaryOp, Expr, ExprKind, Size, UnaryOp};

use crate::{Span, Symbol};

/// A name where it stands in the text. A dotted name is one symbol.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ident {
    pub symbol: Symbol,
    pub span: Span,
}

/// A string where it stands in the text, without quotes and escapes.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    pub value: String,
    pub span: Span,
}

/// A rule file. What stands in `items` between two [`ItemKind::Style`] belongs to the first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct File {
    pub items: Vec<Item>,
}

/// A statement of a file with the annotations before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    pub annotations: Vec<Annotation>,
    pub kind: ItemKind,
    /// Without the annotations.
    pub span: Span,
}

#[derive(Debug, Clone, PartialEq)]
pub enum ItemKind {
    /// `version "2024.0"`
    Version(Text),
    Import(Import),
    Style(Style),
    Value(Value),
    Rule(Rule),
}

/// `import id (style, …) : "file.cga" (override, …)`
#[derive(Debug, Clone, PartialEq)]
pub struct Import {
    pub id: Ident,
    /// The styles that are imported; all of them where there is no list.
    pub styles: Option<Vec<Ident>>,
    pub path: Text,
    /// `None` without parentheses. Empty parentheses protect all attributes of the imported file.
    pub overrides: Option<Vec<Override>>,
}

/// What an import says of a definition of the imported file.
#[derive(Debug, Clone, PartialEq)]
pub enum Override {
    /// `height`: keeps its value, whatever the importing file calls `height`.
    Protect(Ident),
    /// `height = 8`
    Value { name: Ident, value: Expr },
    /// `Roof(angle) --> roofGable(angle)`
    Rule {
        name: Ident,
        params: Vec<Ident>,
        body: Body,
    },
}

/// `style Name extends Base`
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    pub name: Ident,
    pub base: Option<Ident>,
}

/// An attribute, a constant or a function: a name with an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Value {
    pub keyword: ValueKeyword,
    pub name: Ident,
    pub params: Vec<Ident>,
    pub locals: Vec<Local>,
    pub value: Expr,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueKeyword {
    /// `attr`: evaluated once, and may be set from outside.
    Attr,
    /// `const`: evaluated once.
    Const,
    /// No keyword: evaluated where it is used, for the shape that is then current.
    Function,
}

/// `Name(params) with (locals) --> body`
#[derive(Debug, Clone, PartialEq)]
pub struct Rule {
    pub keyword: RuleKeyword,
    pub name: Ident,
    pub params: Vec<Ident>,
    pub locals: Vec<Local>,
    pub body: Body,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RuleKeyword {
    None,
    /// `start`: also to be called as `start`, and as `id.start` where the file is imported.
    Start,
    /// `extension`: an importing file may replace it.
    Extension,
}

/// `name := value` in a `with ( … )`. Evaluated once per call, in order, after the parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Local {
    pub name: Ident,
    pub value: Expr,
}

/// `@Name` or `@Name(args)`. Annotations do not change what a file derives.
#[derive(Debug, Clone, PartialEq)]
pub struct Annotation {
    pub name: Ident,
    /// `None` without parentheses.
    pub args: Option<Vec<AnnotationArg>>,
    pub span: Span,
}

/// `value`, or `name = value`.
#[derive(Debug, Clone, PartialEq)]
pub struct AnnotationArg {
    pub name: Option<Ident>,
    pub value: AnnotationValue,
}

#[derive(Debug, Clone, PartialEq)]
pub enum AnnotationValue {
    Expr(Expr),
    /// `{0, 1, 0}`
    List(Vec<Expr>),
}
