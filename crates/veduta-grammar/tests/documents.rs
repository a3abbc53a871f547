//! The pages on the language and its operations keep up with the reader and the engine.

#![allow(clippy::panic, clippy::unwrap_used)] // helpers of tests

use veduta_grammar::builtins::operations::OPERATIONS;
use veduta_grammar::engine::operation_names;
use veduta_grammar::{check, format, limits, Program, Source};

use crate::support;

/// The pages on operations.
const PAGES: &[&str] = &[
    include_str!("../../../docs/operations/context.md"),
    include_str!("../../../docs/operations/creation.md"),
    include_str!("../../../docs/operations/flow.md"),
    include_str!("../../../docs/operations/inlining.md"),
    include_str!("../../../docs/operations/manipulation.md"),
    include_str!("../../../docs/operations/roofs.md"),
    include_str!("../../../docs/operations/subdivision.md"),
    include_str!("../../../docs/operations/textures.md"),
    include_str!("../../../docs/operations/transformations.md"),
];
const OPERATIONS_PAGE: &str = include_str!("../../../docs/operations/index.md");

const PAGE: &str = include_str!("../../../docs/grammar-language.md");

#[test]
fn every_operation_has_its_row() {
    for operation in OPERATIONS {
        let counts: Vec<String> = operation.counts.iter().map(ToString::to_string).collect();
        let counts = match counts.split_last() {
            Some((last, others)) if !others.is_empty() => {
                format!("{} or {last}", others.join(", "))
            }
            _ => counts.concat(),
        };
        let row = format!("| `{}` | {counts} | ", operation.name);
        assert!(PAGE.contains(&row), "{row}");
    }
    let rows = PAGE.lines().filter(|line| line.contains(" | yes | "));
    assert_eq!(rows.count(), OPERATIONS.len());
}

#[test]
fn the_page_says_what_derives() {
    for operation in OPERATIONS {
        let start = format!("| `{}` | ", operation.name);
        let row = PAGE.lines().find(|line| line.starts_with(&start));
        let cells: Vec<&str> = row.unwrap_or_default().split('|').collect();
        let derives = operation_names().any(|name| name == operation.name);
        assert_eq!(cells[5].trim().starts_with("yes"), derives, "{start}");
    }
}

#[test]
fn examples_print_what_their_pages_say() {
    for page in PAGES {
        for section in page.split("\n## ").skip(1) {
            let name = section.lines().next().unwrap_or_default();
            let example = section.split("```cga\n").nth(1);
            let example = example.and_then(|rest| rest.split("```").next());
            let said = section.split("\nprints `").nth(1);
            let said = said.and_then(|rest| rest.split('`').next());
            let (Some(example), Some(said)) = (example, said) else {
                panic!("{name} has no example with what it prints");
            };
            assert!(
                example.contains(name),
                "the example of {name} does not use it"
            );
            assert_eq!(support::said(example).join(", "), said, "{name}");
        }
    }
}

#[test]
fn every_operation_that_derives_has_a_section_and_no_other() {
    let sections = PAGES.iter().flat_map(|page| page.split("\n## ").skip(1));
    let sections: Vec<&str> = sections
        .filter_map(|section| section.lines().next())
        .collect();
    for operation in OPERATIONS {
        let derives = operation_names().any(|name| name == operation.name);
        let is_missing = OPERATIONS_PAGE.contains(&format!("`{}`", operation.name));
        let has_section = sections.contains(&operation.name);
        assert_eq!(has_section, derives, "{}", operation.name);
        assert!(
            derives || is_missing,
            "{} is not named as missing",
            operation.name
        );
    }
}

#[test]
fn the_limits_are_those_of_the_reader() {
    for limit in [
        format!("{} MiB", limits::MAX_BYTES >> 20),
        format!("{} blocks", limits::MAX_NESTING),
        format!("{} levels", limits::MAX_HEIGHT),
        format!("{} imports", limits::MAX_FILES),
    ] {
        assert!(PAGE.replace('\n', " ").contains(&limit), "{limit}");
    }
}

#[test]
fn the_example_is_sound_and_in_the_house_style() {
    let example = PAGE
        .split("```cga\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let example = example.unwrap_or_default();
    assert_eq!(format(example).as_deref(), Ok(example));
    let program = Program::load(Source::new("example.cga", example), |path, _| {
        let roofs = "attr angle = 30\nextension Tile --> NIL\nRoof --> roofHip(angle) Tile\n";
        Ok(Source::new(path, roofs))
    });
    assert_eq!(check(&program).render(&program), "");
}
