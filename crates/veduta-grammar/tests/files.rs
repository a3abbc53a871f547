//! The rule files in `rules/` are without faults.

use veduta_grammar::{check, Program, Source};

const LIBRARY: &str = r#"
attr height = 3
attr crownColor = "green"
f(x) = [x]
Tree(size) --> s(size, size, size)
start Main --> Cap(2)
Cap(a) --> extrude(a)
extension Column --> NIL
extension Cap(a, b) --> NIL
attr width = 1
style Dark
"#;

/// The faults of a file whose imports all get [`LIBRARY`].
fn faults(name: &str, text: &str) -> String {
    let program = Program::load(Source::new(name, text), |path, _| {
        Ok(Source::new(path, LIBRARY))
    });
    check(&program).render(&program)
}

#[test]
fn the_haussmann_facade_is_sound() {
    let text = include_str!("rules/haussmann.cga");
    assert_eq!(faults("haussmann.cga", text), "");
}

#[test]
fn the_house_is_sound() {
    assert_eq!(faults("house.cga", include_str!("rules/house.cga")), "");
}

#[test]
fn the_file_with_everything_is_sound() {
    let text = include_str!("rules/everything.cga");
    assert_eq!(faults("everything.cga", text), "");
}
