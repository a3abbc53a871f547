//! What is never reached refuses nothing: faults there are told as warnings.

use crate::diagnostics::compare;
use veduta_grammar::{check, Program, Source};

#[test]
fn what_nothing_reaches_refuses_nothing() {
    compare(&[
        ("Lot --> A.\nOld --> boxx(3)", &[
            "2:1 warning: nothing calls the rule `Old`",
            "2:9 warning: there is no operation or rule `boxx`; nothing reaches this rule",
        ]),
        ("Lot --> A.\nOld --> Older\nOlder --> s(1)", &[
            "2:1 warning: nothing calls the rule `Old`",
            "3:11 warning: `s` takes 3 arguments, 1 is given; nothing reaches this rule",
        ]),
        ("Lot --> case 1 > 2 : New else : A.\nNew --> boxx(3)", &["2:9 error: there is no operation or rule `boxx`"]),
        ("Lot --> A.\n@StartRule\nOld --> boxx(3)", &["3:9 error: there is no operation or rule `boxx`"]),
        ("import a : \"none.cga\"\nLot --> A.\nOld --> a.B extrude(a.c)", &[
            "1:12 warning: cannot import `none.cga`: there is no such file; nothing that is reached uses it",
        ]),
        ("import a : \"none.cga\"\nattr h = a.height\nLot --> A.", &["1:12 error: cannot import `none.cga`: there is no such file"]),
        ("import l : \"lib.cga\"\nLot --> A.\nl.Roof(a) --> Old\nOld --> boxx(3)", &["4:9 error: there is no operation or rule `boxx`"]),
    ]);
}

#[test]
fn an_unknown_operation_stops_where_its_branch_is_taken() {
    let told = "there is no operation or rule `boxx`; a derivation that takes this branch stops";
    let warning = format!("1:27 warning: {told}");
    compare(&[(
        "Lot --> case 1 > 2 : s(1) boxx(3) else : A.",
        &[
            "1:22 error: `s` takes 3 arguments, 1 is given",
            warning.as_str(),
        ],
    )]);
    let derived = |text: &str| {
        let program = Program::single(Source::new("a", text));
        let checked = check(&program);
        assert!(!checked.has_errors(), "{}", checked.render(&program));
        assert_eq!(checked.unreached[0].len(), 1);
        let code = veduta_grammar::engine::lower(&program, &checked).code;
        let options = veduta_grammar::engine::Options::default();
        let lot = crate::support::lot();
        let tree = veduta_grammar::engine::derive(&code, code.start.unwrap(), lot, &options);
        tree.map(|tree| tree.messages)
            .map_err(|fault| fault.message.to_string())
    };
    let spared = derived("Lot --> case 1 > 2 : boxx(3) else : print(7)");
    assert_eq!(spared, Ok(vec!["7".to_string()]));
    let stopped = derived("Lot --> case 1 < 2 : boxx(3) else : print(7)");
    assert_eq!(
        stopped,
        Err("there is no operation or rule `boxx`".to_string())
    );
}

#[test]
fn many_warnings_hide_no_error() {
    use veduta_grammar::check_from;
    let old: String = (0..150)
        .map(|number| format!("Old{number} --> boxxN(3)\n"))
        .collect();
    let text = format!("Lot --> Mid\n{old}Mid --> extrud(3) B.");
    let program = Program::single(Source::new("a", &text));
    for (start, wanted) in [(None, "extrud"), (Some("Old110"), "boxxN")] {
        let checked = check_from(&program, start);
        let errors: Vec<&str> = (checked.diagnostics.iter().flatten())
            .filter(|one| one.is_error())
            .map(|one| one.message.as_str())
            .collect();
        assert_eq!(errors.len(), 1, "{start:?}");
        assert!(errors[0].contains(wanted), "{errors:?}");
        assert_eq!(checked.diagnostics[0].len(), 100);
    }
}
