//! Rule files in the language of CityEngine (CGA shape grammar): reading, checking, formatting.
//!
//! [`parse`] makes a syntax tree ([`ast`]) of a text. [`Program::load`] parses a file with all
//! that it imports, which the caller fetches; [`check`](check()) says what is wrong with a
//! program, and what each of its names refers to; [`format`](format()) lays a text out, and
//! [`print`](print()) makes the text of a tree. [`engine`] derives [`shape`]s
//! with a program. Nothing here reads files.

pub mod ast;
pub mod builtins;
mod check;
mod diagnostic;
pub mod engine;
mod format;
mod lexer;
pub mod limits;
mod names;
mod parser;
mod print;
mod program;
pub mod shape;
mod source;
mod suggest;
pub mod token;

pub use check::{
    check, check_from, Checked, Definition, Definitions, Resolution, Role, Style, Target, Variant,
};
pub use diagnostic::{Diagnostic, Severity};
pub use format::format;
pub use names::{Names, Symbol};
pub use parser::{parse, Parse};
pub use print::print;
pub use program::{Link, Program, Unit};
pub use source::{Position, Source, Span};
