//! Rule files to trees: hand-worked truth, and what must hold of any derivation.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

use glam::DVec3;
use proptest::prelude::*;
use veduta_grammar::engine::{
    derive, lower, Code, Edit, Fault, Limits, Options, Overrides, State, Tree, Value,
};
use veduta_grammar::shape::{Form, Geometry, Scope};
use veduta_grammar::{check, Program, Source};

fn code(text: &str) -> Code {
    let program = Program::single(Source::new("test.cga", text));
    let checked = check(&program);
    assert!(!checked.has_errors(), "{}", checked.render(&program));
    let lowered = lower(&program, &checked);
    assert!(!lowered.has_errors(), "{:?}", lowered.diagnostics);
    lowered.code
}

/// A lot of 10 m by 6 m.
fn lot() -> State {
    let form = Form {
        scope: Scope::of_size(DVec3::new(10.0, 0.0, 6.0)),
        geometry: Geometry::Rectangle(1),
    };
    State::new(form, 0)
}

fn try_derive(text: &str, options: &Options) -> Result<Tree, Fault> {
    let code = code(text);
    derive(&code, code.start.unwrap(), lot(), options)
}

fn tree(text: &str) -> Tree {
    try_derive(text, &Options::default()).unwrap()
}

fn fault(text: &str) -> String {
    let options = Options {
        limits: Limits {
            depth: 50,
            shapes: 1000,
            ..Limits::default()
        },
        ..Options::default()
    };
    try_derive(text, &options).unwrap_err().message
}

/// Names and sizes of the leaves, in order.
fn leaves(tree: &Tree) -> Vec<(String, [f64; 3])> {
    let size = |form: &Form| form.scope.size.to_array().map(|s| (s * 1e6).round() / 1e6);
    tree.leaves()
        .map(|leaf| (leaf.name.to_string(), size(&leaf.state.form)))
        .collect()
}

fn names(tree: &Tree) -> Vec<String> {
    tree.leaves().map(|leaf| leaf.name.to_string()).collect()
}

#[test]
fn alternatives_in_brackets() {
    // As the reference has them in its example of `minimumDistance`.
    let lot = "Lot --> split(x) { ~2 : Cell(split.index) }*\n\
               Cell(x) --> [ case x == 1 : t(0, 1, 0) A. else : NIL ] B.";
    assert_eq!(names(&tree(lot)), ["B", "A", "B", "B", "B", "B"]);
    let chances = tree("Lot --> [ 100% : A. else : B. ] C.");
    assert_eq!(names(&chances), ["A", "C"]);
    let nested = tree("Lot --> [ case true : [ case false : A. else : B. ] C. else : D. ] E.");
    assert_eq!(names(&nested), ["B", "C", "E"]);
}

#[test]
fn the_first_rule_without_parameters_starts() {
    let found = tree("Wall(x) --> print(x) Brick.\nLot --> Wall(3)\nOther --> Other.");
    assert_eq!(
        (names(&found), found.messages),
        (vec!["Brick".into()], vec!["3".into()])
    );
    let named = tree("Lot --> Lot.\n@StartRule Other --> Here.");
    assert_eq!(names(&named), ["Here"]);
    assert!(fault("Wall(x) --> Brick.").contains("needs 1 argument: write --start"));
}

#[test]
fn a_house_of_two_floors() {
    let tree = tree(
        "Lot --> extrude(7) comp(f) { front : Front | top : Roof. | side : NIL }
         Front --> split(y) { 4 : Shop. | ~1 : Floor }
         Floor --> split(x) { 1 : Wall. | { ~2 : Wall. | 1 : Window. }* | 1 : Wall. }",
    );
    let found = leaves(&tree);
    assert_eq!(found[0], ("Roof".into(), [10.0, 6.0, 0.0]));
    assert_eq!(found[1], ("Shop".into(), [10.0, 4.0, 0.0]));
    let windows = found.iter().filter(|leaf| leaf.0 == "Window");
    assert_eq!(windows.count(), 3);
    let sum: f64 = found.iter().skip(2).map(|leaf| leaf.1[0]).sum();
    assert!((sum - 10.0).abs() < 1e-6);
}

#[test]
fn what_nothing_follows_stays() {
    assert_eq!(leaves(&tree("Lot -->")), [("Lot".into(), [10.0, 0.0, 6.0])]);
    assert_eq!(names(&tree("Lot --> extrude(1)")), ["Lot"]);
    assert_eq!(names(&tree("Lot --> A. B.")), ["A", "B"]);
    assert_eq!(names(&tree("Lot --> NIL")), [""; 0]);
    assert_eq!(names(&tree("Lot --> A. extrude(1)")), ["A", "Lot"]);
    assert_eq!(names(&tree("Lot --> [ extrude(1) ] A.")), ["Lot", "A"]);
    assert_eq!(names(&tree("Lot --> [ extrude(1) A. ] NIL")), ["A"]);
    assert_eq!(names(&tree("Lot --> [ A. ] [ B. ]")), ["A", "B"]);
    assert_eq!(names(&tree("Lot --> color(1) [ A. ]")), ["A", "Lot"]);
    assert_eq!(
        names(&tree("Lot --> split(x) { ~1 : [ A. ] | ~1 : }")),
        ["A", "Lot"]
    );
}

#[test]
fn pushed_changes_end_with_their_bracket() {
    let tree = tree("Lot --> [ s(1, 2, 3) t(5, 0, 0) primitiveCube() A. ] B.");
    assert_eq!(leaves(&tree)[0].1, [1.0, 2.0, 3.0]);
    assert_eq!(leaves(&tree)[1].1, [10.0, 0.0, 6.0]);
    let places: Vec<_> = tree.leaves().map(|l| l.state.form.scope.origin.x).collect();
    assert_eq!(places, [5.0, 0.0]);
}

#[test]
fn parameters_functions_and_attributes() {
    let text = "attr height = 3
         const twice = 2 * height
         area(w, d) with ( a := w * d ) = a / 2
         Lot --> A(area(scope.sx, scope.sz), twice)
         A(size, up) with ( all := size + up ) --> s(all, up, 1) primitiveCube() X.";
    assert_eq!(leaves(&tree(text))[0].1, [36.0, 6.0, 1.0]);
    let mut options = Options::default();
    options
        .attributes
        .insert("height".into(), Value::Number(5.0));
    options
        .attributes
        .insert("twice".into(), Value::Number(99.0));
    let tall = try_derive(text, &options).unwrap();
    assert_eq!(leaves(&tall)[0].1, [40.0, 10.0, 1.0]);
}

#[test]
fn set_holds_for_the_shape_and_below_it() {
    let found = tree(
        "attr height = 3
         Lot --> [ set(height, 8) A ] A
         A --> s('1, height, '1) primitiveCube() X.",
    );
    let heights: Vec<_> = leaves(&found).iter().map(|leaf| leaf.1[1]).collect();
    assert_eq!(heights, [8.0, 3.0]);
}

#[test]
fn the_first_case_that_holds_is_taken() {
    let text = |n: i32| {
        format!(
            "Lot --> A({n})
             A(n) --> case n > 2 && n != 5 : B. case n == 5 : C. else : D."
        )
    };
    let name = |n| names(&tree(&text(n))).join("");
    assert_eq!([name(3), name(5), name(1)], ["B", "C", "D"]);
}

#[test]
fn arrays_and_strings() {
    let text = "const list = [1 : 2 : 7]
         const table = [1, 2 ; 3, 4]
         Lot --> print(size(list) + \",\" + list[3] + \",\" + table[1, 0]) print(list .* 2) print(.-table)
                 print(substring(\"gable roof\", 0, 5) + find(\"abcabc\", \"c\", 1))
                 print(max(max(2, 7), 3) + sum(list)) print(cos(60)) print(-2 < 1 || 1 / 0 > 3)";
    assert_eq!(
        tree(text).messages,
        [
            "4,7,3",
            "(4)[2,6,10,14]",
            "(2x2)\n   -1   -2\n   -3   -4",
            "gable5",
            "23",
            "0.5",
            "true"
        ]
    );
}

#[test]
fn split_and_comp_know_their_places() {
    let text = "Lot --> split(x) { { ~2 : print(split.index + \"/\" + split.total) NIL }* }";
    assert_eq!(tree(text).messages, ["0/5", "1/5", "2/5", "3/5", "4/5"]);
    let text = "Lot --> extrude(2) comp(f) { 3 : A. | side = B. | all : NIL }";
    let found = leaves(&tree(text));
    assert_eq!(found.len(), 2);
    assert_eq!(found[1], ("B".into(), [10.0, 2.0, 6.0]));
}

const CHANCES: &str = "Lot --> 20% : A. 30% : B. else : C.";

fn options_of(seed: u64) -> Options {
    Options {
        seed,
        ..Options::default()
    }
}

#[test]
fn chances_are_what_they_say() {
    let code = code(CHANCES);
    let mut counts = [0.0; 3];
    const DRAWS: u64 = 20_000;
    for seed in 0..DRAWS {
        let tree = derive(&code, 0, lot(), &options_of(seed)).unwrap();
        let index = ["A", "B", "C"].iter().position(|n| names(&tree)[0] == *n);
        let index = index.unwrap();
        counts[index] += 1.0 / DRAWS as f64;
        let chance: f64 = [0.2, 0.3, 0.5][index];
        assert!((tree.log_prior - chance.ln()).abs() < 1e-12);
    }
    for (count, chance) in counts.iter().zip([0.2, 0.3, 0.5]) {
        // Four standard deviations of a binomial count.
        assert!(
            (count - chance).abs() < 4.0 * (chance / DRAWS as f64).sqrt(),
            "{counts:?}"
        );
    }
}

#[test]
fn an_edit_takes_a_choice_or_a_shape_away() {
    let text = "Lot --> split(x) { { ~2 : A }* }
                A --> 50% : B. else : C.";
    let free = try_derive(text, &options_of(7)).unwrap();
    let wanted = if names(&free)[2] == "B" { 1 } else { 0 };
    let choose = Edit {
        choices: vec![Some(wanted)],
        ..Edit::default()
    };
    let delete = Edit {
        delete: true,
        ..Edit::default()
    };
    let mut options = options_of(7);
    options.overrides = Overrides::new([(vec![2], choose), (vec![4], delete)]);
    let edited = try_derive(text, &options).unwrap();
    assert_eq!(names(&edited).len(), 4);
    assert_ne!(names(&edited)[2], names(&free)[2]);
    for at in [0, 1, 3] {
        assert_eq!(names(&edited)[at], names(&free)[at]);
    }
}

#[test]
fn a_branch_does_not_change_another() {
    let second = "B --> s(rand(1, 5), 1, 1) primitiveCube() X.";
    let one = tree(&format!(
        "Lot --> A B\nA --> s(rand(1, 9), 1, 1) X.\n{second}"
    ));
    let other = tree(
        &format!("Lot --> A B\nA --> rand A. \n{second}")
            .replace("rand A.", "s(rand(1, 2) + rand(3), rand(7), 1) C D E"),
    );
    assert_eq!(leaves(&one).last(), leaves(&other).last());
}

#[test]
fn faults_say_what_is_wrong() {
    assert!(fault("Lot --> Lot").contains("over 50 deep"));
    assert!(fault("Lot --> split(x) { { 0.001 : A. }* }").contains("1000 shapes"));
    assert!(fault("Lot --> split(x) { { 0.00001 : A. }* }").contains("a split into"));
    let circle = "attr a = f(0)\nf(x) = case x > 0 : 1 else : a\nLot --> s(a, 1, 1)";
    assert!(fault(circle).contains("depends on itself"));
    assert!(
        fault("f(x) = case x > 0 : f(x) else : 0\nLot --> s(f(1), 1, 1)")
            .contains("functions call one another")
    );
    assert!(fault("Lot --> s([1, 2], 1, 1)").contains("a number is needed, not an array"));
    assert!(fault("Lot --> print([1, 2][\"a\"])").contains("an index is a number"));
    assert!(fault("Lot --> s('1e300, 1, 1) s('1e300, 1, 1)").contains("a shape that reaches"));
}

#[test]
fn what_does_not_derive_is_said_before_anything_is_derived() {
    let wrong = |text: &str| {
        let program = Program::single(Source::new("test.cga", text));
        let checked = check(&program);
        assert!(!checked.has_errors(), "{}", checked.render(&program));
        let lowered = lower(&program, &checked);
        assert!(!lowered.has_errors(), "what can be built is built");
        let faults = lowered.diagnostics.into_iter().flatten();
        faults.map(|fault| fault.message).collect::<Vec<_>>()
    };
    assert_eq!(
        wrong("Lot --> reduceGeometry(3)"),
        ["`reduceGeometry` does not derive: the shape stays as it is"]
    );
    assert_eq!(
        wrong("Lot --> setMaterial(readMaterial(\"a.cgamat\"))"),
        ["`readMaterial` reads MTL files: of others it tells nothing, and shapes keep their material"]
    );
    assert_eq!(wrong("Lot --> s(abs(1), 1, 1)"), [""; 0]);
}

#[test]
fn roofs_rise_over_what_lies() {
    let text = "Lot --> extrude(3) comp(f) { top : Top | all : NIL }
                Top --> roofGable(45) Roof.";
    let found = tree(text);
    let roof = &found.leaves().next().unwrap().state.form;
    assert!((roof.scope.size.y - 3.0).abs() < 1e-9);
    assert!((roof.world_mesh().volume() - 10.0 * 6.0 * 3.0 / 2.0).abs() < 1e-9);
    let hip = tree("Lot --> roofHip(byHeight, 2)");
    let form = &hip.leaves().next().unwrap().state.form;
    assert_eq!(
        form.scope.size.to_array().map(|s| (s * 1e6).round() / 1e6),
        [10.0, 2.0, 6.0]
    );
    assert!(fault("Lot --> roofHip(90)").contains("a slope"));
}

#[test]
fn solids_stay_closed_through_splits() {
    let text = "Lot --> extrude(world.up, 3) split(x) { 2 : A | ~1 : A }
                A --> r(0, 30, 0) split(y) { ~1 : B | ~2 : B }
                B --> split(z) { '0.3 : C. | ~1 : C. }";
    let found = tree(text);
    let volume: f64 = found
        .leaves()
        .map(|leaf| leaf.state.form.world_mesh())
        .map(|mesh| {
            assert!(mesh.is_closed());
            mesh.volume()
        })
        .sum();
    assert!((volume - 180.0).abs() < 1e-6);
}

proptest! {
    #[test]
    fn the_same_seed_gives_the_same_tree(seed in any::<u64>()) {
        let text = "Lot --> extrude(rand(3, 9)) comp(f) { all : F }
                    F --> 50% : split(x) { { ~rand(1, 3) : G }* } else : H.
                    G --> 10% : NIL else : color(rand(), 0.5, p(0.5)) I.";
        let one = try_derive(text, &options_of(seed)).unwrap();
        let other = try_derive(text, &options_of(seed)).unwrap();
        prop_assert_eq!(leaves(&one), leaves(&other));
        prop_assert_eq!(one.log_prior, other.log_prior);
        prop_assert!(one.log_prior <= 0.0);
    }
}
