//! The layout of the house style.

use veduta_grammar::{format, parse, Names};

fn formatted(text: &str) -> String {
    format(text).unwrap_or_else(|faults| format!("{faults:?}"))
}

/// Files that are in the house style already.
#[test]
fn files_in_the_style_stay_as_they_are() {
    let files = [
        include_str!("rules/haussmann.cga"),
        include_str!("rules/house.cga"),
        include_str!("rules/everything.formatted.cga"),
    ];
    for file in files {
        assert_eq!(formatted(file), file);
    }
}

#[test]
fn a_file_is_put_into_the_style() {
    let file = include_str!("rules/everything.cga");
    assert_eq!(
        formatted(file),
        include_str!("rules/everything.formatted.cga")
    );
}

#[test]
fn words_are_spaced() {
    let table = [
        ("a=-1+2*( 3-b )[0 ]", "a = -1 + 2 * (3 - b)[0]\n"),
        ("a=[1,2;3,4]", "a = [1, 2 ; 3, 4]\n"),
        ("a=f( )", "a = f()\n"),
        (
            "@Range( min = 0,max=1 )attr a=1",
            "@Range(min=0, max=1)\nattr a = 1\n",
        ),
        ("A-->s('1,~'2,~ 3)B.", "A --> s('1, ~'2, ~3) B.\n"),
        (
            "A-->split(x){1:B.|{~2:C.}*}*",
            "A --> split(x) { 1 : B. | { ~2 : C. }* }*\n",
        ),
        ("A-->[B. C.]", "A --> [ B. C. ]\n"),
        ("A-->30%:B. else:C.", "A -->\n    30% : B.\n    else : C.\n"),
        ("a=30%:1 else:2", "a = 30% : 1 else : 2\n"),
        (
            "f(a,b)with(c:=1 d:=2)=a",
            "f(a, b) with (c := 1 d := 2) = a\n",
        ),
        ("", ""),
    ];
    for (text, expected) in table {
        assert_eq!(formatted(text), expected);
    }
}

#[test]
fn long_lines_are_broken() {
    let long = |name: &str| format!("{name}{}", "x".repeat(40));
    let [a, b, c] = ["a", "b", "c"].map(long);
    let table = [
        (
            format!("A --> {a} {b} {c}"),
            format!("A -->\n    {a}\n    {b}\n    {c}\n"),
        ),
        (
            format!("f = g({a}, {b}, {c})"),
            format!("f = g(\n        {a},\n        {b},\n        {c}\n    )\n"),
        ),
        (
            format!("f = {a} + {b} * {c}"),
            format!("f = {a}\n    + {b}\n    * {c}\n"),
        ),
        (
            format!("A --> comp(f) {{ {a} : B. | {b} : C. | {c} = D. }}"),
            format!(
                "A -->\n    comp(f) {{\n        {a} : B.\n        | {b} : C.\n        | {c} = D.\n    }}\n"
            ),
        ),
        (
            format!("f = case {a} : 1 case {b} : 2 else : {c}"),
            format!("f =\n    case {a} : 1\n    case {b} : 2\n    else : {c}\n"),
        ),
    ];
    for (text, expected) in table {
        assert_eq!(formatted(&text), expected);
    }
}

#[test]
fn comments_stay_at_their_words() {
    let table = [
        ("a=1//one\nb=2", "a = 1 //one\nb = 2\n"),
        ("//head\n\n\n\na=1", "//head\n\na = 1\n"),
        ("a=1\n\n\n//b\nb=2\n//end", "a = 1\n\n//b\nb = 2\n//end\n"),
        ("A-->//does\nB.", "A --> //does\n    B.\n"),
        ("A-->B./*why*/C.", "A --> B. /*why*/ C.\n"),
        (
            "A-->comp(f){//cells\n1:B.//one\n//two\n|2:C.}",
            "A -->\n    comp(f) { //cells\n        1 : B. //one\n        //two\n        | 2 : C.\n    }\n",
        ),
        ("a=(1/*x*/)", "a = (1 /*x*/ )\n"),
    ];
    for (text, expected) in table {
        assert_eq!(formatted(text), expected);
    }
}

#[test]
fn empty_lines_are_kept_once_and_put_around_tall_rules() {
    let text = "a = 1\n\n\nb = 2\nA --> 5% : B. else : C.\nB --> C.\nC --> D.\n";
    let expected = "a = 1\n\nb = 2\n\nA -->\n    5% : B.\n    else : C.\n\nB --> C.\nC --> D.\n";
    assert_eq!(formatted(text), expected);
}

#[test]
fn a_faulty_file_is_refused() {
    let faults = format("A --> (").err().unwrap_or_default();
    assert_eq!(faults, parse("A --> (", &mut Names::new()).diagnostics);
    assert!(!faults.is_empty());
}
