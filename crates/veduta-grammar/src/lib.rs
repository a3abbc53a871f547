//! Rule files in the language of CityEngine (CGA shape grammar): reading, checking, formatting.
//!
//! [`parse`] makes a syntax tree ([`ast`]) of a text; [`engine`] derives [`shape`]s with it.
//! Nothing here reads files or prints.

pub mod ast;
mod diagnostic;
pub mod engine;
mod lexer;
pub mod limits;
mod names;
mod parser;
pub mod shape;
mod source;
pub mod token;

pub use diagnostic::{Diagnostic, Severity};
pub use names::{Names, Symbol};
pub use parser::{parse, Parse};
pub use source::{Position, Source, Span};
