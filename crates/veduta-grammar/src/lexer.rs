//! Text to words. Comments are kept apart, for the formatter.

use crate::diagnostic::Diagnostics;
use crate::token::{Comment, EachOperator, Token, TokenKind, Tokens};
use crate::{Diagnostic, Span};

/// Splits `text` into words. A character that the language does not have is reported and kept
/// as [`TokenKind::Unknown`], or as the word that its author will have meant.
pub(crate) fn lex(text: &str, diagnostics: &mut Diagnostics) -> Tokens {
    let mut lexer = Lexer {
        text,
        at: if text.starts_with('\u{feff}') { 3 } else { 0 },
        tokens: Tokens::default(),
        diagnostics,
        annotated: 0,
        over_lines: strings_end(text),
    };
    while lexer.at < text.len() {
        lexer.step();
    }
    let end = Span::new(text.len(), text.len());
    lexer.tokens.tokens.push(Token {
        kind: TokenKind::EndOfFile,
        span: end,
    });
    lexer.tokens
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Tokens,
    diagnostics: &'a mut Diagnostics,
    /// How many brackets are open in the arguments of an annotation, which are for a user interface:
    /// what they say is never a fault.
    annotated: usize,
    /// Whether a string may go on over the ends of lines.
    over_lines: bool,
}

/// Whether every string has its end where strings may go on over the ends of lines. Where one has not,
/// a quote is missing somewhere, and strings are taken to end with their lines: so the fault is
/// reported where it is.
fn strings_end(text: &str) -> bool {
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text.as_bytes()[at..];
        let past = |end: &[u8]| {
            let found = rest.windows(end.len()).skip(1).position(|one| one == end);
            found.map(|before| before + 1 + end.len())
        };
        at += match rest {
            [b'#', ..] | [b'/', b'/', ..] => past(b"\n").unwrap_or(rest.len()),
            [b'/', b'*', ..] => past(b"*/").unwrap_or(rest.len()),
            [b'"', ..] => match string_length(rest, true) {
                Some(length) => length,
                None => return false,
            },
            _ => 1,
        };
    }
    true
}

/// The bytes of the string at the beginning, with its quotes; None where it has no end.
fn string_length(bytes: &[u8], over_lines: bool) -> Option<usize> {
    let mut at = 1;
    loop {
        match (bytes.get(at)?, bytes.get(at + 1)) {
            (b'"', _) => return Some(at + 1),
            (b'\n', _) if !over_lines => return None,
            (b'\\', Some(b'\n')) if !over_lines => return None,
            (b'\\', Some(_)) => at += 2,
            _ => at += 1,
        }
    }
}

/// Longest first, as a prefix of one word may be another.
const SIGNS: [(&str, TokenKind); 34] = {
    use TokenKind::*;
    [
        ("-->", Arrow),
        (":=", Define),
        ("==", Equal),
        ("!=", NotEqual),
        ("<=", LessEqual),
        (">=", GreaterEqual),
        ("&&", And),
        ("||", Or),
        ("->", Unknown),
        ("=:", AssignEach),
        ("=", Assign),
        (":", Colon),
        (";", Semicolon),
        (",", Comma),
        ("|", Bar),
        ("'", Quote),
        ("~", Tilde),
        ("!", Not),
        ("+", Plus),
        ("-", Minus),
        ("*", Star),
        ("/", Slash),
        ("%", Percent),
        ("<", Less),
        (">", Greater),
        ("(", OpenParen),
        (")", CloseParen),
        ("[", OpenBracket),
        ("]", CloseBracket),
        ("{", OpenBrace),
        ("}", CloseBrace),
        ("@", At),
        ("&", Unknown),
        ("?", Unknown),
    ]
};

const EACH_SIGNS: [(&str, EachOperator); 14] = {
    use EachOperator::*;
    [
        (".==", Equal),
        (".!=", NotEqual),
        (".<=", LessEqual),
        (".>=", GreaterEqual),
        (".&&", And),
        (".||", Or),
        (".!", Not),
        (".+", Plus),
        (".-", Minus),
        (".*", Star),
        ("./", Slash),
        (".%", Percent),
        (".<", Less),
        (".>", Greater),
    ]
};

fn starts_name(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_' || byte == b'$'
}

fn continues_name(byte: u8) -> bool {
    starts_name(byte) || byte.is_ascii_digit()
}

impl Lexer<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    /// The byte `ahead` of the present one; 0 after the end.
    fn byte(&self, ahead: usize) -> u8 {
        *self.text.as_bytes().get(self.at + ahead).unwrap_or(&0)
    }

    fn push(&mut self, kind: TokenKind, length: usize) {
        let span = Span::new(self.at, self.at + length);
        match kind {
            TokenKind::OpenParen if self.annotated > 0 || self.is_annotation() => {
                self.annotated += 1;
            }
            TokenKind::CloseParen => self.annotated = self.annotated.saturating_sub(1),
            _ => {}
        }
        self.tokens.tokens.push(Token { kind, span });
        self.at += length;
    }

    /// Whether the last words are `@` and a name.
    fn is_annotation(&self) -> bool {
        matches!(
            self.tokens.tokens[..],
            [
                ..,
                Token {
                    kind: TokenKind::At,
                    ..
                },
                Token {
                    kind: TokenKind::Name,
                    ..
                }
            ]
        )
    }

    fn step(&mut self) {
        match (self.byte(0), self.byte(1)) {
            (b' ' | b'\t' | b'\r' | b'\n' | 0x0c, _) => self.at += 1,
            (b'/', b'/') | (b'#', _) => self.line_comment(),
            (b'/', b'*') => self.block_comment(),
            (b'"', _) => self.string(),
            (b'.', second) if second.is_ascii_digit() => self.number(),
            (first, _) if first.is_ascii_digit() => self.number(),
            (first, _) if starts_name(first) => self.name(),
            _ => self.sign(),
        }
    }

    fn line_comment(&mut self) {
        let rest = self.rest();
        let length = rest.find('\n').unwrap_or(rest.len());
        let length = rest[..length].trim_end().len();
        self.comment(length, true);
    }

    fn block_comment(&mut self) {
        match self.rest()[2..].find("*/") {
            Some(inside) => self.comment(inside + 4, false),
            None => {
                let opening = Span::new(self.at, self.at + 2);
                let hint = "close it with `*/`".to_string();
                self.diagnostics
                    .add(Diagnostic::error(opening, "this comment does not end").with_hint(hint));
                self.comment(self.rest().len(), false);
            }
        }
    }

    fn comment(&mut self, length: usize, to_line_end: bool) {
        let span = Span::new(self.at, self.at + length);
        self.tokens.comments.push(Comment { span, to_line_end });
        self.at += length;
    }

    /// A string ends at its quote, or, where that is missing, with its line.
    fn string(&mut self) {
        let rest = self.rest();
        let length = match string_length(rest.as_bytes(), self.over_lines) {
            Some(length) => length,
            None => {
                let line = rest.find('\n').unwrap_or(rest.len());
                let opening = Span::new(self.at, self.at + 1);
                let fault = Diagnostic::error(opening, "this string does not end");
                let hint = "close it with `\"` on the same line".to_string();
                self.diagnostics.add(fault.with_hint(hint));
                line
            }
        };
        self.push(TokenKind::Text, length);
    }

    fn digits(&self, mut from: usize) -> usize {
        while self.byte(from).is_ascii_digit() {
            from += 1;
        }
        from
    }

    fn number(&mut self) {
        let mut length = self.digits(0);
        let dot = self.byte(length) == b'.';
        if dot && self.each_sign(length).is_none() && !starts_name(self.byte(length + 1)) {
            length = self.digits(length + 1);
        }
        if matches!(self.byte(length), b'e' | b'E') {
            let sign = usize::from(matches!(self.byte(length + 1), b'+' | b'-'));
            let end = self.digits(length + 1 + sign);
            if end > length + 1 + sign {
                length = end;
            }
        }
        self.push(TokenKind::Number, length);
    }

    /// A name goes on over a dot that another letter follows. A dot at its very end makes it a
    /// leaf, unless that dot begins an operator such as `.+`.
    fn name(&mut self) {
        let mut length = 1;
        loop {
            while continues_name(self.byte(length)) {
                length += 1;
            }
            if self.byte(length) != b'.' || !starts_name(self.byte(length + 1)) {
                break;
            }
            length += 1;
        }
        let is_leaf = self.byte(length) == b'.' && self.each_sign(length).is_none();
        let kind = match &self.rest()[..length] {
            _ if is_leaf => TokenKind::Leaf,
            "case" => TokenKind::Case,
            "else" => TokenKind::Else,
            "with" => TokenKind::With,
            "true" => TokenKind::True,
            "false" => TokenKind::False,
            _ => TokenKind::Name,
        };
        self.push(kind, length + usize::from(is_leaf));
    }

    /// An operator with a dot. A dot before a comment is none.
    fn each_sign(&self, ahead: usize) -> Option<(&'static str, EachOperator)> {
        let rest = self.rest().get(ahead..)?;
        if rest.starts_with(".//") || rest.starts_with("./*") {
            return None;
        }
        let found = EACH_SIGNS.iter().find(|(sign, _)| rest.starts_with(sign));
        found.copied()
    }

    fn sign(&mut self) {
        if let Some((sign, operator)) = self.each_sign(0) {
            return self.push(TokenKind::Each(operator), sign.len());
        }
        let rest = self.rest();
        if let Some((sign, kind)) = SIGNS.iter().find(|(sign, _)| rest.starts_with(sign)) {
            if *kind == TokenKind::Unknown {
                return self.misspelt(sign);
            }
            return self.push(*kind, sign.len());
        }
        self.unknown_character();
    }

    /// Signs of other languages.
    fn misspelt(&mut self, sign: &str) {
        let (kind, hint) = match sign {
            "->" => (TokenKind::Arrow, "did you mean `-->`?"),
            "&" => (TokenKind::And, "did you mean `&&`?"),
            _ => (
                TokenKind::Unknown,
                "write `case condition : value else : other` instead of `? :`",
            ),
        };
        self.report(sign.len(), format!("`{sign}` is not part of CGA"), hint);
        self.push(kind, sign.len());
    }

    fn unknown_character(&mut self) {
        let character = self.rest().chars().next().unwrap_or(' ');
        let length = character.len_utf8();
        let (kind, hint) = match character {
            '\u{2018}' | '\u{2019}' | '`' | '\u{b4}' => (TokenKind::Quote, "did you mean `'`?"),
            '\u{201c}' | '\u{201d}' => (TokenKind::Unknown, "did you mean `\"`?"),
            '\u{2013}' | '\u{2212}' => (TokenKind::Minus, "did you mean `-`?"),
            '\u{a0}' => return self.at += length, // a space that does not break
            _ => (TokenKind::Unknown, ""),
        };
        let shown = character.escape_debug();
        self.report(length, format!("`{shown}` is not part of CGA"), hint);
        self.push(kind, length);
    }

    fn report(&mut self, length: usize, message: String, hint: &str) {
        if self.annotated > 0 {
            return;
        }
        let span = Span::new(self.at, self.at + length);
        let hint = Some(hint.to_string()).filter(|hint| !hint.is_empty());
        self.diagnostics
            .add(Diagnostic::error(span, message).with_hint(hint));
    }
}

/// The character that four hexadecimal digits at the beginning of `text` name.
fn code_point(text: &str) -> Option<char> {
    let digits = text.get(..4)?;
    let is_number = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let number = is_number.then(|| u32::from_str_radix(digits, 16).ok())?;
    number.and_then(char::from_u32)
}

/// The value of a string from its text with the quotes. `\n`, `\t`, `\"`, `\\` and `\uHHHH` are
/// escapes; any other backslash stands for itself, as in paths.
pub(crate) fn unescape(text: &str) -> String {
    let inside = text.strip_prefix('"').unwrap_or(text);
    let mut value = String::with_capacity(inside.len());
    let mut characters = inside.chars();
    while let Some(character) = characters.next() {
        match character {
            '"' => break,
            '\\' => match characters.next() {
                Some('n') => value.push('\n'),
                Some('t') => value.push('\t'),
                Some(other @ ('"' | '\\')) => value.push(other),
                Some('u') => match code_point(characters.as_str()) {
                    Some(named) => {
                        value.push(named);
                        characters = characters.as_str()[4..].chars();
                    }
                    None => value.push_str("\\u"),
                },
                Some(other) => value.extend(['\\', other]),
                None => value.push('\\'),
            },
            other => value.push(other),
        }
    }
    value
}
