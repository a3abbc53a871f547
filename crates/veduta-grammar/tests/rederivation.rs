//! A shape that is derived anew is what a full derivation makes of it, and so is the whole tree.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests

use crate::support::{code, lot};
use proptest::prelude::*;
use veduta_grammar::engine::{derive, rederive, Code, Edit, Options, Overrides, Tree, Value};

const HOUSE: &str = "attr tall = 40% : 3 else : 5
    attr word = \"a\"
    const side = 50% : 1 else : 2
    Lot --> report(\"lot\", tall) extrude(tall) comp(f) { side : Wall(side) | top : Roof | bottom : NIL }
    Wall(w) --> print(w) split(x) { { ~w : Bay(split.index) }* }
    Bay(i) -->
        30% : NIL
        40% : split(y) { 1 : Sill. | ~1 : Window(i) }
        else : Plain.
    Window(i) --> print(word + i) report(\"window\", i) Glass Glass
    Glass --> 30% : set(seedian, 7) Lit [ set(seedian, split.index) Lit ] Lit else : Plate
    Lit --> 50% : print(seedian) NIL else : color(0, rand(), 0) Lamp Lamp
    Lamp --> 50% : A. else : B.
    Plate --> 50% : color(rand(), 0, 0) Pane. 20% : NIL else : [ t(0, 0, p(0.5)) Frame. ] Pane.
    Roof --> 50% : Flat. else : Tiles";

fn options(seed: u64, edits: Vec<(Vec<u32>, Edit)>) -> Options {
    Options {
        seed,
        overrides: Overrides::new(edits),
        ..Options::default()
    }
}

fn full(code: &Code, options: &Options) -> Tree {
    derive(code, code.start.unwrap(), lot(), options).unwrap()
}

fn edit(kind: u8, value: f64) -> Edit {
    let mut edit = Edit::default();
    match kind % 5 {
        0 => edit.delete = true,
        1 => edit.choices = vec![Some(value as u16 % 4)],
        2 => edit.values = vec![("w".into(), Value::Number(1.0 + value.abs()))],
        3 => edit.values = vec![("word".into(), Value::text("b"))],
        _ => edit.values = vec![("nothing".into(), Value::Number(value))],
    }
    edit
}

proptest! {
    /// Edits come one after the other, each with the derivation of one shape; at the end they go.
    #[test]
    fn it_is_the_tree_of_a_full_derivation(
        seed in any::<u64>(),
        picks in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0.0..4.0), 1..6),
    ) {
        let code = code(HOUSE);
        let mut tree = full(&code, &options(seed, Vec::new()));
        let first = tree.clone();
        let mut edits: Vec<(Vec<u32>, Edit)> = Vec::new();
        for (pick, kind, value) in picks {
            let path = tree.path(pick.index(tree.nodes.len()) as u32);
            edits.retain(|(other, _)| *other != path);
            edits.push((path.clone(), edit(kind, value)));
            let options = options(seed, edits.clone());
            prop_assert!(rederive(&code, &mut tree, &path, &options).unwrap());
            prop_assert_eq!(&tree, &full(&code, &options));
        }
        // From the deepest up: what lies below an edited shape may be gone meanwhile.
        edits.sort_by_key(|(path, _)| path.len());
        while let Some((path, _)) = edits.pop() {
            let options = options(seed, edits.clone());
            let found = rederive(&code, &mut tree, &path, &options).unwrap();
            let whole = full(&code, &options);
            if found {
                prop_assert_eq!(&tree, &whole);
            } else {
                prop_assert!(whole.find(&path).is_none());
                rederive(&code, &mut tree, &[], &options).unwrap();
            }
        }
        prop_assert_eq!(tree, first);
    }

    #[test]
    fn what_is_below_a_shape_stands_together(seed in any::<u64>()) {
        let tree = full(&code(HOUSE), &options(seed, Vec::new()));
        for number in 0..tree.nodes.len() as u32 {
            let own = tree.path(number);
            prop_assert_eq!(tree.find(&own), Some(number));
            let below: Vec<u32> = tree.below(number).collect();
            let truth: Vec<u32> = (0..tree.nodes.len() as u32)
                .filter(|&other| other != number && tree.path(other).starts_with(&own))
                .collect();
            prop_assert_eq!(below, truth);
        }
    }
}

#[test]
fn an_edit_that_cannot_be_done_is_told() {
    let code = code("attr a = 1\nLot --> A(2) A(3)\nA(n) --> 50% : B. else : split(x) { ~1 : C. }");
    let mut named = Edit {
        name: Some("Wall".into()),
        delete: true,
        ..Edit::default()
    };
    let choices = |taken: Vec<Option<u16>>| Edit {
        choices: taken,
        ..Edit::default()
    };
    let value = |name: &str| Edit {
        values: vec![(name.into(), Value::Number(1.0))],
        ..Edit::default()
    };
    let told = |path: Vec<u32>, edit: Edit| {
        let tree = full(&code, &options(1, vec![(path.clone(), edit)]));
        let [one] = &tree.edited[..] else {
            panic!("{:?}", tree.edited)
        };
        assert_eq!(one.path, path);
        one.fault.clone()
    };
    assert_eq!(told(vec![0], choices(vec![Some(1)])), None);
    assert_eq!(told(vec![0], value("n")), None);
    assert_eq!(told(vec![0], value("a")), None);
    let missing = told(vec![7, 1], value("n"));
    assert_eq!(missing.as_deref(), Some("there is no such shape"));
    let leaf = told(vec![0, 0], value("n")).unwrap();
    assert!(leaf.contains("no rule is applied"), "{leaf}");
    let other = told(vec![1], named.clone()).unwrap();
    assert_eq!(other, "it is no `Wall` any more but `A`");
    let third = told(vec![1], choices(vec![None, Some(0)])).unwrap();
    assert_eq!(third, "choice 2 is set, but it has 1 random choice");
    let beyond = told(vec![1], choices(vec![Some(2)])).unwrap();
    assert!(beyond.contains("has 2 alternatives"), "{beyond}");
    let unknown = told(vec![1], value("m")).unwrap();
    assert_eq!(unknown, "`m` is neither a parameter of A nor an attribute");
    named.name = None;
    let whole = told(Vec::new(), named).unwrap();
    assert!(whole.contains("start shape"), "{whole}");
}

#[test]
fn the_prior_is_the_product_of_all_chances() {
    let text = "attr a = 20% : 1 else : 2
        const b = 30% : 1 else : 2
        Lot --> 40% : A A else : B
        A --> 50% : C. else : D.
        B --> E.";
    let code = code(text);
    for seed in 0..20 {
        let tree = full(&code, &options(seed, Vec::new()));
        let of = |name: &str| {
            let found = tree
                .globals
                .iter()
                .find(|known| known.name.as_ref() == name);
            found.unwrap().value.number().unwrap()
        };
        let mut chance = if of("a") == 1.0 { 0.2 } else { 0.8 };
        chance *= if of("b") == 1.0 { 0.3 } else { 0.7 };
        chance *= match tree.leaves.len() {
            2 => 0.4 * 0.25,
            _ => 0.6,
        };
        assert!((tree.log_prior - f64::ln(chance)).abs() < 1e-12);
    }
}
