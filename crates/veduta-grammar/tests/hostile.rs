//! Text that no author would write: it is refused, without a panic, a full stack or a long wait.

use proptest::prelude::*;
use veduta_grammar::{check, format, limits, Program, Source};

/// The messages about a text. It is formatted, too.
fn messages(text: &str) -> Vec<String> {
    if let Ok(formatted) = format(text) {
        assert_eq!(format(&formatted).as_ref(), Ok(&formatted), "{text}");
    }
    let program = Program::single(Source::new("hostile.cga", text));
    let faults = check(&program).diagnostics.remove(0);
    faults.into_iter().map(|one| one.message).collect()
}

fn repeated(before: &str, part: &str) -> Vec<String> {
    messages(&format!("{before}{}", part.repeat(100_000 / part.len())))
}

#[test]
fn deep_nesting_is_an_error() {
    let openings = [
        ("a = ", "("),
        ("a = ", "["),
        ("a = ", "-"),
        ("a = ", "f("),
        ("a = ", "case "),
        ("a = ", "case 1 : "),
        ("a = ", "case 1 : 2 else : "),
        ("a = ", "30% : "),
        ("a = ", "comp(f) { 1 : "),
        ("a = ", "comp(f) { {"),
        ("A --> ", "["),
        ("A --> ", "split(x) { 1 : "),
        ("A --> ", "split(x) { {"),
        ("A --> ", "inline "),
        ("A --> ", "inline {"),
        ("A --> ", "30% : "),
        ("A --> ", "case 1 : "),
        ("A --> ", "case 1 : X else : "),
        ("A --> ", "A("),
        ("import a : \"b\" (", "c --> d("),
        ("@A(", "{"),
    ];
    for (before, part) in openings {
        let found = repeated(before, part);
        assert!(!found.is_empty(), "{before}{part}");
    }
    let million = messages(&format!("a = {}", "(".repeat(1_000_000)));
    assert!(million[0].contains("within each other"));
}

/// As deep as is allowed, or nearly: the stack is enough for reading, checking and formatting.
#[test]
fn allowed_nesting_is_read() {
    let depths = [
        ("a = ", "(", "1", ")", 120),
        ("a = ", "[", "1", "]", 120),
        ("a = ", "sin(", "1", ")", 120),
        ("a = ", "-", "1", "", 120),
        ("a = ", "case 1 > 2 : ", "1", " else : 2", 60),
        ("a = ", "comp(f) { all : ", "1", " }", 60),
        ("A --> ", "[ ", "B.", " ]", 120),
        ("A --> ", "split(x) { 1 : ", "B.", " }", 120),
        ("A --> split(x) { ", "{ ", "1 : B.", " }*", 120),
        ("A --> ", "inline(append) ", "B.", "", 120),
        ("A --> ", "30% : ", "B.", " else : C.", 120),
    ];
    for (before, open, inside, close, depth) in depths {
        let (open, close) = (open.repeat(depth), close.repeat(depth));
        let end = if before.ends_with("{ ") { " }" } else { "" };
        let text = format!("{before}{open}{inside}{close}{end}");
        assert_eq!(messages(&text), Vec::<String>::new(), "{before}{open}");
    }
}

#[test]
fn high_expressions_are_an_error() {
    for part in ["1 + ", "f + ", "1 || ", "x[0] * "] {
        assert!(repeated("a = ", part)[0].contains("levels"), "{part}");
    }
    assert!(repeated("a = b", "[0]")[0].contains("levels"));
    let allowed = format!("a = 1{}", " + 1".repeat(500));
    assert_eq!(messages(&allowed), Vec::<String>::new());
}

#[test]
fn a_file_has_a_largest_size() {
    let found = messages(&" ".repeat(limits::MAX_BYTES + 1));
    assert!(found[0].contains("bytes"));
}

/// What takes time with the square of its number would take minutes here.
#[test]
fn many_of_a_kind_are_read() {
    let kinds = [
        ("", "a = 1\n"),
        ("", "A --> B\n"),
        ("", "style a\n"),
        ("", "import a : \"b\"\n"),
        ("", "@A "),
        ("a = [1", ", 1"),
        ("a = [1", "; 1"),
        ("a(b", ", b"),
        ("a(b) = f(b", ", b"),
        ("A --> comp(f) { 0 : B", " | 0 : B"),
        ("A --> split(x) { 0 : B", " | { 0 : B }*"),
        ("A --> ", "B "),
        ("A --> ", "B { } "),
        ("A --> ", "[ B ] "),
        ("a = ", "case b : 1 "),
        ("A --> ", "1% : B "),
        ("a with ( b := 1 ", "b := 1 "),
    ];
    for (before, part) in kinds {
        repeated(before, part);
    }
}

#[test]
fn the_number_of_faults_is_bounded() {
    assert_eq!(repeated("", "?\n").len(), limits::MAX_DIAGNOSTICS);
    assert_eq!(repeated("", "A --> (\n").len(), limits::MAX_DIAGNOSTICS);
}

/// Words in any order, with more of those that open something.
fn soup() -> impl Strategy<Value = String> {
    let words = prop::sample::select(vec![
        "case",
        "else",
        "with",
        ":",
        ":",
        "|",
        "{",
        "}",
        "(",
        ")",
        "[",
        "]",
        "*",
        "%",
        "-->",
        "=",
        ":=",
        ",",
        ";",
        "~",
        "'",
        "A",
        "b.c",
        "X.",
        "1",
        "0.5",
        "30%",
        "\"s\"",
        "\"",
        "attr",
        "const",
        "import",
        "version",
        "style",
        "start",
        "extension",
        "inline",
        "comp(f)",
        "@A",
        "true",
        "!",
        "-",
        "+",
        "&&",
        ".+",
        ".",
        "//",
        "/*",
        "*/",
        "#",
        "\n",
        "\n",
        "é",
        "\\",
    ]);
    prop::collection::vec(words, 0..200).prop_map(|words| words.join(" "))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_words_are_read(text in soup()) {
        messages(&text);
        messages(&text.replace(' ', ""));
    }

    #[test]
    fn any_text_is_read(text in any::<String>()) {
        messages(&text);
    }

    #[test]
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        messages(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_cut_file_is_read(cut in 0..4000usize, length in 0..4000usize) {
        let text = include_str!("rules/everything.cga");
        let part: String = text.chars().skip(cut).take(length).collect();
        messages(&part);
    }
}
