//! What import statements and styles change, against hand-worked truth.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::lot;
use veduta_grammar::engine::{derive, lower, lower_in_style, Code, Options, Tree, Value};
use veduta_grammar::{check, Program, Source};

/// The program of a main file and others, by name.
fn program(main: &str, others: &[(&str, &str)]) -> Program {
    let others: Vec<(String, String)> = others
        .iter()
        .map(|(name, text)| (name.to_string(), text.to_string()))
        .collect();
    Program::load(Source::new("main.cga", main), |path, _| {
        let found = others.iter().find(|(name, _)| name == path);
        let (name, text) = found.ok_or("it is not there")?;
        Ok(Source::new(name.clone(), text.clone()))
    })
}

fn code(main: &str, others: &[(&str, &str)], style: usize) -> Code {
    let program = program(main, others);
    let checked = check(&program);
    assert!(!checked.has_errors(), "{}", checked.render(&program));
    let lowered = lower_in_style(&program, &checked, style);
    assert!(!lowered.has_errors(), "{:?}", lowered.diagnostics);
    lowered.code
}

fn tree(code: &Code, attributes: &[(&str, f64)]) -> Tree {
    let options = Options {
        attributes: attributes
            .iter()
            .map(|(name, value)| (name.to_string(), Value::Number(*value)))
            .collect(),
        ..Options::default()
    };
    derive(code, code.start.unwrap(), lot(), &options).unwrap()
}

fn said(main: &str, others: &[(&str, &str)]) -> Vec<String> {
    tree(&code(main, others, 0), &[]).messages
}

const LIBRARY: &str = "attr height = 1
attr width = 2
twice = 2 * height
Say --> print(height) print(width) print(twice)
extension Top(a) --> print(\"own \" + a)
Both --> Top(7)";

#[test]
fn attributes_of_the_same_name_take_the_value_of_the_importing_file() {
    let lib = [("lib.cga", LIBRARY)];
    let main = |overrides: &str, own: &str| {
        format!("import lib : \"lib.cga\" {overrides}\n{own}\nLot --> lib.Say")
    };
    let own = "attr height = 5";
    assert_eq!(said(&main("", own), &lib), ["5", "2", "10"]);
    assert_eq!(said(&main("", "const height = 5"), &lib), ["1", "2", "2"]);
    assert_eq!(said(&main("()", own), &lib), ["1", "2", "2"]);
    assert_eq!(said(&main("(height)", own), &lib), ["1", "2", "2"]);
    assert_eq!(said(&main("(width)", own), &lib), ["5", "2", "10"]);
    let imposed = "(height = other + 1, width = 9)";
    let other = "attr height = 5\nattr other = 3";
    assert_eq!(said(&main(imposed, other), &lib), ["4", "9", "8"]);
}

#[test]
fn each_import_statement_has_values_of_its_own() {
    let main = "import a : \"lib.cga\" (height = 3)
import b : \"lib.cga\" (height = 4)
Lot --> a.Say b.Say print(a.height + 10 * b.height)";
    let found = said(main, &[("lib.cga", LIBRARY)]);
    assert_eq!(found, ["43", "3", "2", "6", "4", "2", "8"]);
}

#[test]
fn values_pass_through_a_file_between() {
    let middle = "import lib : \"lib.cga\"\nattr height = 8\nSay --> lib.Say";
    let others = [("middle.cga", middle), ("lib.cga", LIBRARY)];
    let main = "import m : \"middle.cga\"\nattr height = 6\nLot --> m.Say";
    assert_eq!(said(main, &others), ["6", "2", "12"]);
    let kept = "import m : \"middle.cga\" ()\nattr height = 6\nLot --> m.Say";
    assert_eq!(said(kept, &others), ["8", "2", "16"]);
}

#[test]
fn attributes_are_given_and_set_by_the_names_that_the_main_file_has_for_them() {
    let main = "import lib : \"lib.cga\"\nLot --> lib.Say set(lib.width, 5) lib.Say";
    let code = code(main, &[("lib.cga", LIBRARY)], 0);
    let names: Vec<&str> = code.globals.iter().map(|one| one.name.as_ref()).collect();
    assert_eq!(names, ["lib.height", "lib.width"]);
    let found = tree(&code, &[("lib.height", 4.0), ("height", 9.0)]);
    assert_eq!(found.messages, ["4", "2", "8", "4", "5", "8"]);
}

#[test]
fn what_a_file_sets_is_set_in_those_that_it_imports() {
    let main = "import lib : \"lib.cga\"\nattr height = 5\nLot --> set(height, 7) lib.Say";
    assert_eq!(said(main, &[("lib.cga", LIBRARY)])[0], "7");
    let own = "attr height = 1\nSay --> set(height, 4) Tell\nTell --> print(height)";
    let main = "import lib : \"lib.cga\" ()\nattr height = 5\nLot --> lib.Say print(height)";
    assert_eq!(said(main, &[("lib.cga", own)]), ["5", "4"]);
}

#[test]
fn an_extension_is_replaced_in_one_import_and_sees_the_importing_file() {
    let main = "import a : \"lib.cga\" (Top(x) --> print(word + x) Mine)
import b : \"lib.cga\"
const word = \"mine \"
Lot --> a.Both b.Both
Mine --> print(\"rule\")";
    let found = said(main, &[("lib.cga", LIBRARY)]);
    assert_eq!(found, ["mine 7", "rule", "own 7"]);
}

const MASSES: &str = "Lot --> print(\"mass\") Front Side(3) Stays.
Front --> print(\"plain front\")";

#[test]
fn an_importing_file_defines_rules_of_what_it_imports() {
    let main = "import a : \"m.cga\"
import b : \"m.cga\"
const word = \"mine \"
a.Front --> print(word + 1)
a.Side(x) --> print(word + x) b.Front
a.Stays --> print(\"never\")
Lot --> a.Lot b.Lot a.Front";
    let found = said(main, &[("m.cga", MASSES)]);
    let of_a = ["mass", "mine 1", "mine 3", "plain front"];
    assert_eq!(found[..4], of_a);
    assert_eq!(found[4..], ["mass", "plain front", "mine 1"]);
    let program = program(main, &[("m.cga", MASSES)]);
    assert_eq!(check(&program).render(&program), "");
}

#[test]
fn a_rule_that_only_the_importing_file_has_is_found_by_its_name_and_parameters() {
    let library = "Lot --> Front Roof(2) Roof Tip";
    let main = "import m : \"m.cga\"\nimport n : \"n.cga\"
m.Front --> NIL\nm.Roof(x) --> NIL\nn.m.Tip --> NIL\nLot --> m.Lot n.Lot";
    let middle = "import m : \"m.cga\"\nLot --> m.Lot";
    let program = program(main, &[("m.cga", library), ("n.cga", middle)]);
    let told = check(&program).render(&program);
    assert!(told.contains("there is no rule `Roof`"), "{told}");
    assert_eq!(told.matches("there is no rule").count(), 1, "{told}");
}

#[test]
fn a_rule_that_takes_the_place_of_an_imports_one_calls_itself() {
    let main =
        "import a : \"m.cga\"\na.Front --> print(\"mine\") a.Front\n@StartRule\nLot --> a.Lot";
    let code = code(main, &[("m.cga", MASSES)], 0);
    let fault = derive(&code, code.start.unwrap(), lot(), &Options::default()).unwrap_err();
    let wanted = "rules apply one within another over 1000 deep";
    assert!(fault.message.contains(wanted), "{}", fault.message);
}

#[test]
fn the_farthest_importing_file_has_the_last_word_on_a_rule() {
    let middle = "import m : \"m.cga\"\nm.Front --> print(\"middle\")\nLot --> m.Lot";
    let others = [("middle.cga", middle), ("m.cga", MASSES)];
    let main = |own: &str| format!("import n : \"middle.cga\"\n{own}\nLot --> n.Lot");
    assert_eq!(said(&main(""), &others)[1], "middle");
    let outer = "n.m.Front --> print(\"outer\")";
    assert_eq!(said(&main(outer), &others)[1], "outer");
}

#[test]
fn a_rule_of_an_import_that_is_not_there_is_a_fault() {
    let program = program("Lot --> A.\nlib.Top --> B.", &[]);
    let told = check(&program).render(&program);
    assert!(told.contains("nothing is imported as `lib`"), "{told}");
}

const STYLED: &str = "attr tall = 1
Lot --> print(tall) Roof
Roof --> print(\"plain\")
style High
attr tall = 2
style Higher extends High
Roof --> print(\"high\")";

#[test]
fn a_style_takes_its_own_definitions_and_those_that_it_extends() {
    for (style, truth) in [["1", "plain"], ["2", "plain"], ["2", "high"]]
        .iter()
        .enumerate()
    {
        let code = code(STYLED, &[], style);
        assert_eq!(tree(&code, &[]).messages, *truth);
    }
}

#[test]
fn an_import_takes_the_style_that_it_names() {
    let main = |styles: &str| format!("import s {styles} : \"s.cga\"\nLot --> s.Lot");
    let others = [("s.cga", STYLED)];
    assert_eq!(said(&main(""), &others), ["1", "plain"]);
    assert_eq!(said(&main("(Higher)"), &others), ["2", "high"]);
}

#[test]
fn imports_that_multiply_are_refused() {
    let double = |next: usize| {
        format!("import a : \"{next}.cga\"\nimport b : \"{next}.cga\"\nLot --> a.Lot b.Lot")
    };
    let mut others: Vec<(String, String)> = (1..14)
        .map(|level| (format!("{level}.cga"), double(level + 1)))
        .collect();
    others.push(("14.cga".into(), "Lot --> X.".into()));
    let others: Vec<(&str, &str)> = others
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    let program = program(&double(1), &others);
    let checked = check(&program);
    assert!(!checked.has_errors());
    let lowered = lower(&program, &checked);
    assert!(lowered.has_errors());
}

/// What a check and then a derivation say of a main file whose import `gone` is missing.
fn without_import(rest: &str) -> (bool, Result<Vec<String>, String>) {
    let program = program(&format!("import gone : \"gone.cga\"\n{rest}"), &[]);
    let checked = check(&program);
    if checked.has_errors() {
        return (false, Err(checked.render(&program)));
    }
    let lowered = lower(&program, &checked);
    assert!(!lowered.has_errors(), "{:?}", lowered.diagnostics);
    let code = lowered.code;
    let derived = derive(&code, code.start.unwrap(), lot(), &Options::default());
    let told = derived.map(|tree| tree.messages);
    (true, told.map_err(|fault| fault.message.to_string()))
}

#[test]
fn a_missing_import_refuses_what_names_it_and_is_reached() {
    let fine = Ok(vec!["7".to_string()]);
    for unused in [
        "const h = gone.height\nLot --> print(7)",
        "const h = gone.height\nconst twice = 2 * h\nLot --> print(7)",
        "high(a) = gone.height + a\nconst h = high(1)\nLot --> print(7)",
        "const h = gone.height\nLot --> print(7)\nOld --> print(h)",
    ] {
        assert_eq!(without_import(unused), (true, fine.clone()), "{unused}");
    }
    for used in [
        "const h = gone.height\nLot --> print(h)",
        "const h = gone.height\nconst twice = 2 * h\nLot --> Next\nNext --> print(twice)",
        "high(a) = gone.height + a\nLot --> case high(1) > 2 : A. else : B.",
        "const h = gone.height\nattr top = h\nLot --> print(7)",
    ] {
        let (is_fine, told) = without_import(used);
        assert!(!is_fine, "{used}");
        assert!(
            told.unwrap_err().contains("cannot import `gone.cga`"),
            "{used}"
        );
    }
}
