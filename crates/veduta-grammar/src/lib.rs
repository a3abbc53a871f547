//! Rule files in the language of CityEngine (CGA shape grammar): reading, checking, formatting.
//!
//! [`parse`] makes a syntax tree ([`ast`]) of a text. Nothing here reads files, prints or
//! evaluates.

pub mod ast;
mod diagnostic;
mod lexer;
pub mod limits;
mod names;
mod parser;
mod source;
pub mod token;

pub use diagnostic::{Diagnostic, Severity};
pub use names::{Names, Symbol};
pub use parser::{parse, Parse};
pub use source::{Position, Source, Span};
