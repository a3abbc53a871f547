//! Rule files in the language of CityEngine (CGA shape grammar): reading, checking, formatting.
//!
//! [`parse`] makes a syntax tree ([`ast`]) of a text. [`Program::load`] parses a file with all
//! that it imports, which the caller fetches; [`check`](check()) says what is wrong with a
//! program, and what each of its names refers to; [`engine`] derives [`shape`]s with a file. Nothing
//! here reads files or prints.

pub mod ast;
pub mod builtins;
mod check;
mod diagnostic;
pub mod engine;
mod lexer;
pub mod limits;
mod names;
mod parser;
mod program;
pub mod shape;
mod source;
mod suggest;
pub mod token;

pub use check::{
    check, Checked, Definition, Definitions, Resolution, Role, Style, Target, Variant,
};
pub use diagnostic::{Diagnostic, Severity};
pub use names::{Names, Symbol};
pub use parser::{parse, Parse};
pub use program::{Link, Program, Unit};
pub use source::{Position, Source, Span};
