//! Real rule files with random faults put in: they are read without a panic, what is said about them
//! lies in the text, and what can still be read is formatted without a change of meaning.
//!
//! The same files each time; `FUZZ_CASES` of the environment asks for as many others, from
//! `FUZZ_FIRST` on.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::draw;

use std::path::Path;

use veduta_grammar::{check, format, parse, print, Names, Program, Source, Span};

use draw::Draw;

const FILES: u64 = 6_000;

/// The most characters of a file, so that there are many files rather than long ones.
const LONGEST: usize = 1_500;

/// What is put in, besides parts of other files.
const WORDS: &[&str] = &[
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "|",
    ":",
    "-->",
    "else",
    "case",
    "with",
    "%",
    "\"",
    "/*",
    "*/",
    "//",
    "'",
    "~",
    "=",
    ":=",
    ",",
    ".",
    "1e",
    "1e999",
    "@",
    "@Range(",
    "import",
    "style",
    "attr",
    "\u{0}",
    "\u{e9}",
    "\u{1f3e0}",
    "\r",
    "\t",
    "\\",
    "&&",
    "comp(f) {",
    "split(x) {",
    "}*",
    "NIL",
    "-",
    "!",
    "a.b",
];

impl Draw {
    /// A place between characters.
    fn place(&mut self, text: &str) -> usize {
        let mut at = self.below(text.len() + 1);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }

    /// From one place to another that is not far behind it.
    fn range(&mut self, text: &str) -> std::ops::Range<usize> {
        let from = self.place(text);
        let most = [2, 10, 100][self.below(3)];
        let mut to = (from + self.below(most)).min(text.len());
        while !text.is_char_boundary(to) {
            to += 1;
        }
        from..to
    }

    /// Some rules of a file.
    fn rules(&mut self, files: &[String]) -> String {
        let file = &files[self.below(files.len())];
        let lines: Vec<&str> = file.split_inclusive('\n').collect();
        let starts: Vec<usize> = (0..lines.len())
            .filter(|&k| k == 0 || lines[k - 1].trim().is_empty())
            .collect();
        let mut text = String::new();
        for line in &lines[starts[self.below(starts.len())]..] {
            if text.len() + line.len() > LONGEST {
                break;
            }
            text.push_str(line);
        }
        text
    }

    fn faulty(&mut self, files: &[String]) -> String {
        let mut text = self.rules(files);
        for _ in 0..self.below(5) {
            match self.below(5) {
                0 => text.replace_range(self.range(&text.clone()), ""),
                1 => {
                    let again = text[self.range(&text)].to_string();
                    text.insert_str(self.place(&text.clone()), &again);
                }
                2 => {
                    let other = self.rules(files);
                    let part = &other[self.range(&other)];
                    text.insert_str(self.place(&text.clone()), part);
                }
                3 => {
                    let range = self.range(&text);
                    text.replace_range(range, WORDS[self.below(WORDS.len())]);
                }
                _ => {
                    let at = self.place(&text);
                    text.insert_str(at, WORDS[self.below(WORDS.len())]);
                }
            }
        }
        text
    }
}

/// The rule files of the tests and of the styles.
fn files() -> Vec<String> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = [
        "tests/rules",
        "../../python/veduta/grammar/styles",
        "../../python/veduta/grammar/styles/parts",
    ];
    let mut paths: Vec<_> = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(here.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "cga"))
        .collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| std::fs::read_to_string(path).unwrap();
    paths.iter().map(read).collect()
}

fn is_within(span: Span, text: &str) -> bool {
    span.start <= span.end && text.get(span.range()).is_some()
}

fn check_one(text: &str, of: &str) -> bool {
    let mut names = Names::new();
    let read = parse(text, &mut names);
    let tokens = read.tokens.tokens.iter().map(|token| token.span);
    let comments = read.tokens.comments.iter().map(|comment| comment.span);
    for span in tokens.chain(comments) {
        assert!(is_within(span, text), "a word beyond the text: {of}");
    }
    let program = Program::single(Source::new("faulty.cga", text));
    let checked = check(&program);
    for fault in &checked.diagnostics[0] {
        assert!(
            is_within(fault.span, text),
            "{fault:?} lies beyond the text: {of}"
        );
        assert!(!fault.message.is_empty(), "{of}");
    }
    let _ = checked.render(&program);
    let Ok(formatted) = format(text) else {
        assert!(read.has_errors(), "sound, but not formatted: {of}");
        return false;
    };
    assert!(!read.has_errors(), "faulty, but formatted: {of}");
    assert_eq!(format(&formatted).as_ref(), Ok(&formatted), "{of}");
    let again = parse(&formatted, &mut names);
    assert_eq!(
        print(&again.file, &names),
        print(&read.file, &names),
        "{of}"
    );
    true
}

#[test]
fn faulty_files_are_read() {
    let told = |name: &str| {
        std::env::var(name)
            .ok()
            .and_then(|told| told.parse::<u64>().ok())
    };
    let (first, count) = (
        told("FUZZ_FIRST").unwrap_or(0),
        told("FUZZ_CASES").unwrap_or(FILES),
    );
    let files = files();
    let mut sound = 0;
    for number in first..first + count {
        let text = Draw(number.wrapping_mul(0xd134_2543_de82_ef95)).faulty(&files);
        sound += u64::from(check_one(&text, &format!("FUZZ_FIRST={number}\n{text}")));
    }
    // Both kinds are many.
    assert!(
        count < 100 || (sound * 20 > count && sound * 20 < 19 * count),
        "{sound} of {count}"
    );
}
