//! The names that the language brings along, as tables: operations, functions, shape attributes.

pub mod annotations;
pub mod attributes;
pub mod functions;
pub mod operations;
pub mod words;

/// Words that an argument may be, instead of a value. `ANY` accepts any word.
pub type Words = &'static [&'static str];

pub const NONE: Words = &[];
pub const ANY: Words = &["*"];

/// Whether a name is one of `words`.
pub fn is_word(words: Words, name: &str) -> bool {
    words.contains(&name) || words == ANY
}

/// The words that the argument at `position` may be.
pub fn words_at(words: &'static [Words], position: usize) -> Words {
    words.get(position).copied().unwrap_or(NONE)
}
