//! Realistic files parse without faults.

use veduta_grammar::{parse, Names, Source};

fn faults(name: &str, text: &str) -> String {
    let source = Source::new(name, text);
    let parse = parse(source.text(), &mut Names::new());
    let faults = parse.diagnostics.iter();
    faults.map(|one| one.render(&source)).collect()
}

#[test]
fn the_haussmann_facade_parses() {
    let text = include_str!("rules/haussmann.cga");
    assert_eq!(faults("haussmann.cga", text), "");
}

#[test]
fn the_house_parses() {
    assert_eq!(faults("house.cga", include_str!("rules/house.cga")), "");
}

#[test]
fn the_file_with_everything_parses() {
    let text = include_str!("rules/everything.cga");
    assert_eq!(faults("everything.cga", text), "");
}
