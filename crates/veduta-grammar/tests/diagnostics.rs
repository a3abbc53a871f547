//! What is said about faulty files, with the place and the hint.

use veduta_grammar::{check, Program, Source};

/// The faults of a file, one per line: `line:column severity: message (hint)`.
fn faults(text: &str) -> Vec<String> {
    let program = Program::load(Source::new("test.cga", text), |path, _| match path {
        "lib.cga" => Ok(Source::new(
            path,
            "attr height = 2\nRoof(a) --> NIL\nextension Top --> NIL",
        )),
        _ => Err("there is no such file".to_string()),
    });
    let source = &program.units[0].source;
    let faults = check(&program).diagnostics.remove(0);
    let line = |one: veduta_grammar::Diagnostic| {
        let at = one.position(source);
        let hint = one.hint.map_or(String::new(), |hint| format!(" ({hint})"));
        let word = one.severity.word();
        format!("{}:{} {word}: {}{hint}", at.line, at.column, one.message)
    };
    faults.into_iter().map(line).collect()
}

/// Texts, each with its faults.
pub(crate) type Table<'a> = &'a [(&'a str, &'a [&'a str])];

pub(crate) fn compare(table: Table) {
    for (text, expected) in table {
        assert_eq!(faults(text), *expected, "\n{text}");
    }
}

#[test]
fn words_that_are_not_cga() {
    compare(&[
        (
            "a = 1 & 2",
            &["1:7 error: `&` is not part of CGA (did you mean `&&`?)"],
        ),
        (
            "A -> NIL",
            &["1:3 error: `->` is not part of CGA (did you mean `-->`?)"],
        ),
        (
            "A --> s(’1, 1, 1)",
            &["1:9 error: `’` is not part of CGA (did you mean `'`?)"],
        ),
        (
            "a = 1 ? 2 : 3",
            &["1:7 error: `?` is not part of CGA \
               (write `case condition : value else : other` instead of `? :`)"],
        ),
        (
            "a = \"b\nc = 1",
            &["1:5 error: this string does not end (close it with `\"` on the same line)"],
        ),
        (
            "a = 1 /* b",
            &["1:7 error: this comment does not end (close it with `*/`)"],
        ),
        ("a = 1e999", &["1:5 error: this number is too large"]),
    ]);
}

#[test]
fn statements_that_do_not_parse() {
    compare(&[
        ("a = ", &["1:5 error: expected a value, found the end of the file"]),
        ("a = (1", &["1:7 error: expected `)` to close `(`, found the end of the file"]),
        ("a = [1,\nb = 2", &["2:3 error: expected `,`, `;` or `]` in an array, found `=`"]),
        ("attr a --> NIL", &["1:8 error: expected `=` after the name of a value, found `-->`"]),
        ("A.b = 3", &["1:1 error: expected the name of a definition, which has no dots, found `A.b`"]),
        ("A.b --> NIL", &["1:1 error: nothing is imported as `A`"]),
        ("A --> ) B", &["1:7 error: nothing is open here, found `)`"]),
        ("A --> comp(f) { all A | top : B }",
            &["1:21 error: expected `:`, `=` or `=:` after a selector or size, found `A`"]),
        ("A --> comp(f) { all : B. ; }", &["1:26 error: expected `|` or `}` after a cell, found `;`"]),
        ("A --> split(x) { { 1 : B. } }", &[]),
        ("A --> comp(f) { { all : B. }* }", &["1:17 error: only the cells of splits can be repeated"]),
        ("@Handle(shape=A^2, axis=y) attr a = 1", &[]),
        ("@Handle(translate={?, `}) attr a = 1 +", &["1:39 error: expected a value, found the end of the file"]),
        ("A --> split(x) { 1 : B.\nC --> NIL", &["2:1 error: expected `|` or `}` after a cell, found `C`"]),
        ("A --> [ B.\nC --> NIL", &["2:1 error: expected `]` at the end of `[ … ]`, found `C`"]),
        ("A --> inline(append)", &["1:21 error: expected a rule, an operation or `{`, found the end of the file"]),
        // `A` is defined, where it does not parse: that it is missing would be a false follow-up.
        ("Lot --> A\nA --> split(x) { 1 B. }",
            &["2:20 error: expected `:`, `=` or `=:` after a selector or size, found `B.`"]),
        ("import a \"b\"", &["1:10 error: expected `:` after the name of an import, found `\"b\"`"]),
        ("@Range(0, 1)", &["1:13 error: expected the statement to which the annotations belong, found the end of the file"]),
        (
            "A --> t(0, -'0.5, 0)",
            &["1:13 error: expected a value, found `'` \
               (a size prefix stands before the whole argument: `'-0.5`)"],
        ),
    ]);
}

#[test]
fn alternatives_after_operations() {
    compare(&[
        (
            "A --> trim() case 1 > 2 : NIL else : NIL",
            &["1:14 error: expected the next statement, found `case` \
               (operations cannot go before `case`: move the cases to a rule of their own)"],
        ),
        (
            "A --> trim() 30% : NIL else : NIL",
            &["1:14 error: expected the next statement, found `30` \
               (operations cannot go before percentages: move these to a rule of their own)"],
        ),
        (
            "A --> NIL else : NIL",
            &["1:11 error: expected the next statement, found `else` \
               (there is no open `case` or percentage for this `else`)"],
        ),
        (
            "A --> 30% : NIL case 1 > 2 : NIL else : NIL",
            &[
                "1:17 error: `case` and percentages cannot be mixed in one choice, found `case` \
               (put the inner choice with its own `else` into one branch of the other)",
            ],
        ),
    ]);
}

#[test]
fn several_statements_are_reported() {
    let text = "a = (\nb = 1\nA --> split(y) { 1 }\nB --> extrude(b\nC --> comp(f) {\n  front = X. |\n  ]\nattr d = +\nD --> NIL";
    let found = faults(text);
    let found: Vec<&str> = found
        .iter()
        .filter_map(|one| one.split(' ').next())
        .collect();
    assert_eq!(found, ["2:3", "3:20", "5:1", "7:3", "9:1", "9:3"]);
}

#[test]
fn names_that_nothing_defines() {
    compare(&[
        ("A --> cmop(f) { all : B. }", &["1:7 error: there is no operation or rule `cmop` (did you mean `comp`?)"]),
        ("A --> extrude(hight)\nattr height = 1", &["1:15 error: there is no attribute, constant, parameter or function `hight` (did you mean `height`?)"]),
        ("A(width) --> extrude(widht)", &["1:22 error: there is no attribute, constant, parameter or function `widht` (did you mean `width`?)"]),
        ("a = scope.xs", &["1:5 error: there is no attribute, constant, parameter or function `scope.xs` (did you mean `scope.sx`?)"]),
        ("a = sqr(2)", &["1:5 error: there is no function `sqr` (did you mean `sqrt`?)"]),
        ("A --> comp(f) { frnt : B. }", &["1:17 error: there is no selector or value `frnt` (did you mean `front`?)"]),
        ("A --> split(w) { 1 : B. }", &["1:13 error: there is no attribute, constant, parameter or function `w`"]),
        ("A --> Wal\nWall --> A", &["1:7 warning: there is no rule `Wal`: the shape is left as it is (did you mean `Wall`?)", "2:1 warning: nothing calls the rule `Wall`"]),
        ("A --> Box", &["1:7 warning: there is no rule `Box`: the shape is left as it is (write `Box.` if that is meant)"]),
        ("A --> Box(3)", &["1:7 warning: there is no rule `Box`: the shape is left as it is (write `Box.` if that is meant)"]),
        ("A --> wall", &["1:7 warning: there is no rule `wall`: the shape is left as it is (write `wall.` if that is meant)"]),
        ("A --> boxx(3)", &["1:7 error: there is no operation or rule `boxx`"]),
        ("A --> Wall.", &[]),
        ("a = A\nA --> NIL", &["1:5 error: `A` is a rule, not a value"]),
        ("@Rnage(0, 1) attr a = 1", &["1:2 warning: there is no annotation `@Rnage` (did you mean `@Range`?)"]),
        ("style B extends C", &["1:17 error: there is no style `C` before this"]),
    ]);
}

#[test]
fn wrong_numbers_of_arguments() {
    compare(&[
        (
            "A --> extrude()",
            &["1:7 error: `extrude` takes 1 or 2 arguments, 0 are given"],
        ),
        (
            "A --> t(1, 2)",
            &["1:7 error: `t` takes 3 arguments, 2 are given"],
        ),
        (
            "A --> B(1)\nB(a, b) --> NIL\nB --> A",
            &[
                "1:7 error: `B` takes 0 or 2 arguments, 1 is given",
                "2:1 warning: nothing calls the rule `B`",
                "3:1 warning: nothing calls the rule `B`",
            ],
        ),
        (
            "f(a) = a\nb = f",
            &["2:5 error: `f` takes 1 argument, 0 are given"],
        ),
        (
            "a = sin(1, 2)",
            &["1:5 error: `sin` takes 1 argument, 2 are given"],
        ),
        (
            "a = seedian(1)",
            &["1:5 error: there is no function `seedian`"],
        ),
        (
            "A --> NIL(1)",
            &["1:7 error: `NIL` takes no arguments, 1 is given"],
        ),
    ]);
}

#[test]
fn blocks_and_cells() {
    compare(&[
        (
            "A --> split(x)",
            &["1:7 error: `split` takes a block `{ size : operations | … }`"],
        ),
        (
            "A --> extrude(1) { B. }",
            &["1:18 error: `extrude` takes no block"],
        ),
        (
            "A --> B { C. }\nB --> A",
            &["1:9 error: `B` is a rule and takes no block"],
        ),
        (
            "A --> scatter(surface, 3, uniform) { all : B. }",
            &["1:36 error: `scatter` takes a block `{ operations }`"],
        ),
        (
            "A --> comp(f) { all : B. | top : C. }",
            &["1:28 warning: nothing is left for this cell: `all` before it takes everything"],
        ),
        (
            "A --> comp(f) { 1 : B. | 1 : C. }",
            &["1:26 warning: nothing is left for this cell: one before it has the same selector"],
        ),
        ("A --> setback(1) { all : B. | remainder : C. }", &[]),
        (
            "A --> comp(f) { all : B. }*",
            &["1:15 error: only the cells of splits can be repeated"],
        ),
        (
            "A --> comp(f) { ~1 : B. }",
            &["1:17 error: sizes are for the cells of splits, not for selectors"],
        ),
        (
            "A --> split(x) { 1 = B. }",
            &["1:18 error: `=` combines what a selector selects; sizes take `:`"],
        ),
        (
            "A --> splitAndSetbackPerimeter(0) { 1 : 2 : B. }",
            &["1:7 error: expected a second block `{ remainder : operations }`"],
        ),
        (
            "f(a) = a\nb = f('2)",
            &["2:7 error: `'` is for sizes of operations and cells"],
        ),
        (
            "A --> set(scope.sx, 1) set(comp.index, 1)",
            &["1:28 error: `comp.index` is no attribute that can be set"],
        ),
        (
            "const a = 1\nA --> set(a, 2) set(B, 1)\nB --> NIL",
            &[
                "2:11 error: `a` is no attribute that can be set",
                "2:21 error: `B` is a rule, not a value",
                "3:1 warning: nothing calls the rule `B`",
            ],
        ),
    ]);
}

#[test]
fn definitions_that_clash() {
    compare(&[
        ("a = 1\na = 2", &["2:1 error: `a` is defined twice"]),
        (
            "f(a) = 1\nf(b) = 2",
            &["2:1 error: `f` with 1 parameters is defined twice \
               (definitions of the same name must differ in their number of parameters)"],
        ),
        (
            "A --> NIL\nA(b) --> NIL\nstyle S\nA --> trim()",
            &["2:1 warning: nothing calls the rule `A`"],
        ),
        (
            "A(b, b) --> NIL",
            &["1:6 error: there are two parameters `b`"],
        ),
        (
            "A(b) with (b := 1) --> NIL",
            &["1:12 error: `b` is a parameter or local variable already"],
        ),
        (
            "A --> NIL\nstyle S\nstart B --> A",
            &["3:7 error: start and extension rules belong before the first style"],
        ),
        (
            "A --> NIL\nextrude(a) --> extrude(a)",
            &[
                "2:1 warning: calls of `extrude` mean the operation, not this rule",
                "2:1 warning: nothing calls the rule `extrude`",
            ],
        ),
        ("roofHip --> roofHip(30)", &[]),
    ]);
}

#[test]
fn alternatives() {
    compare(&[
        (
            "A --> case 1 > 2 : NIL",
            &["1:7 error: these alternatives lack an `else` (end them with `else : NIL`)"],
        ),
        (
            "a = 30% : 1",
            &["1:5 error: these alternatives lack an `else` (end them with `else : value`)"],
        ),
        (
            "a = 60% : 1 50.5% : 2 else : 3",
            &["1:5 error: the chances sum to 110.5 %; 100 % are the most"],
        ),
        ("a = 60% : 1 40% : 2 else : 3", &[]),
        (
            "a = -60% : 1 else : 3",
            &["1:5 error: a chance cannot be negative"],
        ),
        (
            "a = case true : 1 case 1 > 2 : 2 else : 3",
            &["1:19 warning: this branch is never taken: a condition before it is always true"],
        ),
    ]);
}

#[test]
fn values_that_need_themselves() {
    let hint = "(a function may call itself in a branch of a `case`)";
    let needs = |at: &str, name: &str| format!("{at} error: `{name}` needs its own value {hint}");
    assert_eq!(faults("f(x) = f(x - 1) + 1"), [needs("1:1", "f")]);
    assert_eq!(
        faults("attr a = b\nattr b = c\nattr c = a + 1\nd = a"),
        [needs("1:6", "a"), needs("2:6", "b"), needs("3:6", "c")]
    );
    assert_eq!(
        faults("f(x) = case f(1) > 2 : 1 else : 2"),
        [needs("1:1", "f")]
    );
    assert_eq!(
        faults("f(x) = case x > 2 : f(x - 1) else : 2"),
        Vec::<String>::new()
    );
    assert_eq!(faults("f(x) = x > 2 && f(x - 1)"), Vec::<String>::new());
    assert_eq!(faults("A --> A"), Vec::<String>::new());
}

#[test]
fn imports() {
    compare(&[
        ("import a : \"none.cga\"\nA --> a.B(a.c)", &["1:12 error: cannot import `none.cga`: there is no such file"]),
        ("import l : \"lib.cga\"\nA --> l.Rof(1)", &["2:7 error: there is no operation or rule `l.Rof` (did you mean `l.Roof`?)"]),
        ("import l : \"lib.cga\"\nA --> l.Roof", &["2:7 error: `l.Roof` takes 1 argument, 0 are given"]),
        ("import l : \"lib.cga\"\na = l.hight", &["2:5 error: there is no attribute, constant, parameter or function `l.hight` (did you mean `l.height`?)"]),
        ("import lib : \"lib.cga\"\na = lob.height", &["2:5 error: there is no attribute, constant, parameter or function `lob.height` (did you mean `lib`?)"]),
        ("import l : \"lib.cga\" (hight = 2)", &["1:23 error: the file has no attribute `hight` (did you mean `height`?)"]),
        ("import l : \"lib.cga\" (Roof(a) --> NIL, Top --> NIL)", &["1:23 error: the file has no extension `Roof` of 1 parameters (only rules with the keyword `extension` can be replaced)"]),
        ("import l (S) : \"lib.cga\"", &["1:11 error: the file has no style `S`"]),
        ("import l : \"lib.cga\"\nimport l : \"lib.cga\"", &["2:8 error: there are two imports `l`"]),
    ]);
}

#[test]
fn files_that_import_each_other() {
    let program = Program::load(Source::new("a", "import b : \"b\""), |path, _| {
        Ok(Source::new(path, "import a : \"a\""))
    });
    assert_eq!(program.units.len(), 2);
    let checked = check(&program);
    let messages = checked.diagnostics.iter().flatten();
    let messages: Vec<&str> = messages.map(|one| one.message.as_str()).collect();
    assert_eq!(messages, ["this import leads back to this file"; 2]);
}

#[test]
fn a_broken_rule_stops_the_derivation_that_reaches_it() {
    use veduta_grammar::engine::{derive, lower, Options};
    let text = "Lot --> A.\nOld --> Older\nOlder --> extrud(3) B.";
    let program = Program::single(Source::new("a", text));
    let checked = check(&program);
    assert!(!checked.has_errors());
    let code = lower(&program, &checked).code;
    let from = |name: &str| {
        let rule = code.rule_named(name).expect("the rule is there");
        derive(&code, rule, crate::support::lot(), &Options::default())
    };
    assert_eq!(from("Lot").map(|tree| tree.nodes.len()), Ok(2));
    let fault = from("Old").expect_err("it cannot be derived");
    let wanted = "there is no operation or rule `extrud`: did you mean `extrude`?";
    assert_eq!((fault.message.as_str(), fault.span.start), (wanted, 35));
}
