//! Trees that are made at random: what is printed parses to the same tree, and formatting changes
//! neither the tree nor the comments, and nothing the second time.

use crate::trees;

use proptest::prelude::*;
use veduta_grammar::ast::File;
use veduta_grammar::{format, parse, print, Names};

/// The tree without its places, as text.
fn shape(file: &File) -> String {
    let text = format!("{file:?}");
    let mut parts = text.split('@');
    let first = parts.next().unwrap_or("").to_string();
    parts.fold(first, |all, part| {
        let digits = |c: char| c.is_ascii_digit() || c == '.';
        all + part.trim_start_matches(digits)
    })
}

fn parsed(text: &str, names: &mut Names) -> Result<File, TestCaseError> {
    let parse = parse(text, names);
    prop_assert!(!parse.has_errors(), "{:?}\n{text}", parse.diagnostics);
    Ok(parse.file)
}

fn formatted(text: &str) -> Result<String, TestCaseError> {
    format(text).map_err(|faults| TestCaseError::fail(format!("{faults:?}\n{text}")))
}

fn comments(text: &str) -> Vec<String> {
    let parse = parse(text, &mut Names::new());
    let spans = parse.tokens.comments.iter();
    spans
        .map(|one| text[one.span.range()].to_string())
        .collect()
}

/// The text with a comment, space or line break in place of some of the spaces. The choices do
/// not depend on what the spaces are between, so comments come to stand everywhere.
fn sprinkled(text: &str, choices: &[u8]) -> String {
    let mut choices = choices.iter().cycle();
    let mut line = String::new();
    let (mut in_string, mut escaped) = (false, false);
    for character in text.chars() {
        in_string ^= character == '"' && !escaped;
        escaped = in_string && character == '\\' && !escaped;
        if in_string || character != ' ' {
            line.push(character);
            continue;
        }
        line.push_str(match choices.next().unwrap_or(&0) % 24 {
            0 => " // to the end\n",
            1 => "\n# on a line\n",
            2 => " /* within */ ",
            3 => "\n/* over\n   two */\n",
            4 => " /* first */ // second\n// third\n",
            5 => "\n\n/* before */ ",
            6 => "\n\n\n",
            7 => "\t",
            _ => " ",
        });
    }
    line
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn what_is_printed_parses_to_the_same_tree(tree in trees::file()) {
        let mut names = trees::names();
        let text = print(&tree, &names);
        prop_assert_eq!(shape(&parsed(&text, &mut names)?), shape(&tree), "\n{}", text);
    }

    #[test]
    fn formatting_keeps_the_tree(tree in trees::file()) {
        let mut names = trees::names();
        let text = formatted(&print(&tree, &names))?;
        prop_assert_eq!(shape(&parsed(&text, &mut names)?), shape(&tree), "\n{}", text);
    }

    #[test]
    fn formatting_twice_is_formatting_once(tree in trees::file(), choices in trees::choices()) {
        let text = sprinkled(&print(&tree, &trees::names()), &choices);
        let once = formatted(&text)?;
        prop_assert_eq!(&formatted(&once)?, &once, "\n{}", text);
        prop_assert!(once.lines().all(|line| line.trim_end() == line), "{}", once);
    }

    #[test]
    fn formatting_keeps_comments_and_tree(tree in trees::file(), choices in trees::choices()) {
        let mut names = trees::names();
        let text = sprinkled(&print(&tree, &names), &choices);
        let once = formatted(&text)?;
        prop_assert_eq!(comments(&once), comments(&text));
        prop_assert_eq!(shape(&parsed(&once, &mut names)?), shape(&tree), "\n{}", once);
    }
}
