//! What a rule file may ask of the reader. Files from outside are hostile.

/// Bytes of one rule file. The largest files in use have some hundred kilobytes.
pub const MAX_BYTES: usize = 8 << 20;

/// Brackets, blocks and conditions within each other. Bounds the stack of the parser.
pub const MAX_NESTING: usize = 128;

/// Levels of an expression's tree. A sum of `n` terms has `n` levels. Bounds the stack of
/// everything that walks over a tree, its release included.
pub const MAX_HEIGHT: u16 = 512;

/// Errors and warnings that are kept of one file.
pub const MAX_DIAGNOSTICS: usize = 100;

/// Files of a program, and import statements of a file.
pub const MAX_FILES: usize = 256;
