//! The words of the language.

use crate::Span;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TokenKind {
    /// A name, with the dots that are part of it: `height`, `scope.sx`, `lib.Roof`.
    Name,
    /// A name with a dot at its end: a shape that is left as it is (`Wall.`).
    Leaf,
    Number,
    Text,
    Case,
    Else,
    With,
    True,
    False,
    /// `@`
    At,
    /// `-->`
    Arrow,
    /// `:=`
    Define,
    /// `=`
    Assign,
    /// `=:`
    AssignEach,
    Colon,
    Semicolon,
    Comma,
    /// `|`
    Bar,
    /// `'`: relative to the size of the scope.
    Quote,
    /// `~`: floating.
    Tilde,
    Not,
    Plus,
    Minus,
    Star,
    Slash,
    Percent,
    And,
    Or,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    /// The same operator with a dot before it works on each element of an array.
    Each(EachOperator),
    OpenParen,
    CloseParen,
    OpenBracket,
    CloseBracket,
    OpenBrace,
    CloseBrace,
    /// A character that the language does not have; the lexer has reported it.
    Unknown,
    EndOfFile,
}

/// An operator that is written with a leading dot, such as `.+`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EachOperator {
    Not,
    Plus,
    Minus,
    Star,
    Slash,
    Percent,
    And,
    Or,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

impl TokenKind {
    /// How a message names this kind of word.
    pub fn describe(self) -> &'static str {
        match self {
            TokenKind::Name => "a name",
            TokenKind::Leaf => "a name with a dot at its end",
            TokenKind::Number => "a number",
            TokenKind::Text => "a string",
            TokenKind::Case => "`case`",
            TokenKind::Else => "`else`",
            TokenKind::With => "`with`",
            TokenKind::True => "`true`",
            TokenKind::False => "`false`",
            TokenKind::At => "`@`",
            TokenKind::Arrow => "`-->`",
            TokenKind::Define => "`:=`",
            TokenKind::Assign => "`=`",
            TokenKind::AssignEach => "`=:`",
            TokenKind::Colon => "`:`",
            TokenKind::Semicolon => "`;`",
            TokenKind::Comma => "`,`",
            TokenKind::Bar => "`|`",
            TokenKind::Quote => "`'`",
            TokenKind::Tilde => "`~`",
            TokenKind::Star => "`*`",
            TokenKind::Percent => "`%`",
            TokenKind::OpenParen => "`(`",
            TokenKind::CloseParen => "`)`",
            TokenKind::OpenBracket => "`[`",
            TokenKind::CloseBracket => "`]`",
            TokenKind::OpenBrace => "`{`",
            TokenKind::CloseBrace => "`}`",
            TokenKind::Unknown => "an unknown character",
            TokenKind::EndOfFile => "the end of the file",
            _ => "an operator",
        }
    }

    pub fn is_open(self) -> bool {
        matches!(
            self,
            TokenKind::OpenParen | TokenKind::OpenBracket | TokenKind::OpenBrace
        )
    }

    pub fn is_close(self) -> bool {
        matches!(
            self,
            TokenKind::CloseParen | TokenKind::CloseBracket | TokenKind::CloseBrace
        )
    }

    /// The bracket that closes this one.
    pub fn partner(self) -> TokenKind {
        match self {
            TokenKind::OpenParen => TokenKind::CloseParen,
            TokenKind::OpenBracket => TokenKind::CloseBracket,
            _ => TokenKind::CloseBrace,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token {
    pub kind: TokenKind,
    pub span: Span,
}

/// A comment with its markers. `// …` and `# …` end with their line, `/* … */` may go over many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Comment {
    pub span: Span,
    pub to_line_end: bool,
}

/// The words of a file, closed by one [`TokenKind::EndOfFile`], and its comments.
#[derive(Debug, Default)]
pub struct Tokens {
    pub tokens: Vec<Token>,
    pub comments: Vec<Comment>,
}
