//! Random syntax trees. They are such as can be written: what has no text of its own (an empty
//! alternative before a percentage) is not made.

mod expressions;

use proptest::prelude::*;
use proptest::sample::select;
use veduta_grammar::ast::*;
use veduta_grammar::{Names, Span};

use expressions::{branches, cells, expr, sized};

const NAMES: [&str; 8] = ["a", "Beta", "_c", "$d", "e1", "lib.f", "scope.sx", "g.h.I"];
const PLAIN: usize = 5;
const FIXED: [&str; 3] = ["inline", "splitAndSetbackPerimeter", "union"];

/// The names that the trees use.
pub fn names() -> Names {
    let mut names = Names::new();
    NAMES.iter().chain(&FIXED).for_each(|name| {
        names.intern(name);
    });
    names
}

/// Numbers that decide where comments go.
pub fn choices() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 1..60)
}

fn nowhere() -> Span {
    Span::default()
}

fn ident_of(name: &str) -> Ident {
    Ident {
        symbol: names().intern(name),
        span: nowhere(),
    }
}

fn dotted() -> impl Strategy<Value = Ident> {
    select(&NAMES[..]).prop_map(ident_of)
}

fn ident() -> impl Strategy<Value = Ident> {
    select(&NAMES[..PLAIN]).prop_map(ident_of)
}

fn idents() -> impl Strategy<Value = Vec<Ident>> {
    prop::collection::vec(ident(), 0..3)
}

fn string() -> impl Strategy<Value = String> {
    "[ a-z\"\\\\\n\t#/*é]{0,8}"
}

fn text() -> impl Strategy<Value = Text> {
    string().prop_map(|value| Text {
        value,
        span: nowhere(),
    })
}

fn call(name: Ident, args: Option<Vec<Expr>>, block: Option<Block>) -> Call {
    Call {
        name,
        leaf: false,
        args,
        block,
        rest: None,
        span: nowhere(),
    }
}

fn args() -> impl Strategy<Value = Option<Vec<Expr>>> {
    prop::option::of(prop::collection::vec(sized(expr()), 0..3))
}

fn cell_block(body: BoxedStrategy<Body>, with_depth: bool) -> impl Strategy<Value = Block> {
    let cells = cells(sized(expr()), body, with_depth);
    (cells, any::<bool>()).prop_map(|(cells, repeat)| Block::Cells {
        cells,
        repeat,
        span: nowhere(),
    })
}

fn body_block(body: BoxedStrategy<Body>) -> impl Strategy<Value = Block> {
    body.prop_map(|body| Block::Body {
        body: Box::new(body),
        span: nowhere(),
    })
}

fn operation(body: BoxedStrategy<Body>) -> impl Strategy<Value = Operation> {
    let named = (dotted(), args()).prop_map(|(name, args)| call(name, args, None));
    let leaf = dotted().prop_map(|name| Call {
        leaf: true,
        ..call(name, None, None)
    });
    let block = prop_oneof![cell_block(body.clone(), false), body_block(body.clone())];
    let with_block =
        (dotted(), args(), block).prop_map(|(name, args, block)| call(name, args, Some(block)));
    let inline = (args(), body_block(body.clone()))
        .prop_map(|(args, block)| call(ident_of("inline"), args, Some(block)));
    let operands = (body.clone(), body.clone()).prop_map(|(first, second)| Block::Operands {
        first: Box::new(first),
        second: Box::new(second),
        span: nowhere(),
    });
    let boolean = operands.prop_map(|block| call(ident_of("union"), None, Some(block)));
    let both = (
        cell_block(body.clone(), true),
        cell_block(body.clone(), false),
    );
    let perimeter = (args(), both).prop_map(|(args, (block, rest))| Call {
        rest: Some(rest),
        ..call(ident_of("splitAndSetbackPerimeter"), args, Some(block))
    });
    let push = body.prop_map(|body| Operation::Push {
        body,
        span: nowhere(),
    });
    prop_oneof![
        prop_oneof![4 => named, 2 => leaf, 2 => with_block, 1 => inline, 1 => boolean, 1 => perimeter]
            .prop_map(Operation::Call),
        push,
    ]
}

/// The right side of a rule. It is not empty, as it may stand in an alternative.
fn body() -> impl Strategy<Value = Body> {
    let plain = prop::collection::vec((dotted(), args()), 1..3).prop_map(|list| {
        let calls = list.into_iter().map(|(name, args)| call(name, args, None));
        Body::Operations(calls.map(Operation::Call).collect())
    });
    plain.prop_recursive(3, 12, 3, |inner| {
        let operations = prop::collection::vec(operation(inner.clone().boxed()), 1..3);
        prop_oneof![
            operations.prop_map(Body::Operations),
            branches(expr(), inner).prop_map(Body::Branches),
        ]
    })
}

fn locals() -> impl Strategy<Value = Vec<Local>> {
    let local = (ident(), expr()).prop_map(|(name, value)| Local { name, value });
    prop::collection::vec(local, 0..3)
}

fn annotation() -> impl Strategy<Value = Annotation> {
    let value = prop_oneof![
        3 => expr().prop_map(AnnotationValue::Expr),
        1 => prop::collection::vec(expr(), 0..3).prop_map(AnnotationValue::List),
    ];
    let arg =
        (prop::option::of(ident()), value).prop_map(|(name, value)| AnnotationArg { name, value });
    let args = prop::option::of(prop::collection::vec(arg, 0..3));
    (ident(), args).prop_map(|(name, args)| Annotation {
        name,
        args,
        span: nowhere(),
    })
}

fn import() -> impl Strategy<Value = ItemKind> {
    let one = prop_oneof![
        ident().prop_map(Override::Protect),
        (ident(), expr()).prop_map(|(name, value)| Override::Value { name, value }),
        (ident(), idents(), body()).prop_map(|(name, params, body)| Override::Rule {
            name,
            params,
            body
        }),
    ];
    let overrides = prop::option::of(prop::collection::vec(one, 0..3));
    let styles = prop::option::of(idents());
    (ident(), styles, text(), overrides).prop_map(|(id, styles, path, overrides)| {
        ItemKind::Import(Import {
            id,
            styles,
            path,
            overrides,
        })
    })
}

fn value() -> impl Strategy<Value = ItemKind> {
    use ValueKeyword::*;
    let keyword = select(vec![Attr, Const, Function]);
    (keyword, ident(), idents(), locals(), expr()).prop_map(
        |(keyword, name, params, locals, value)| {
            ItemKind::Value(Value {
                keyword,
                name,
                params,
                locals,
                value,
            })
        },
    )
}

fn rule() -> impl Strategy<Value = ItemKind> {
    let keyword = select(vec![
        RuleKeyword::None,
        RuleKeyword::Start,
        RuleKeyword::Extension,
    ]);
    let body = prop_oneof![6 => body(), 1 => Just(Body::Operations(Vec::new()))];
    (keyword, ident(), idents(), locals(), body).prop_map(
        |(keyword, name, params, locals, body)| {
            ItemKind::Rule(Rule {
                keyword,
                name,
                params,
                locals,
                body,
            })
        },
    )
}

fn style() -> impl Strategy<Value = ItemKind> {
    (ident(), prop::option::of(ident()))
        .prop_map(|(name, base)| ItemKind::Style(Style { name, base }))
}

pub fn file() -> impl Strategy<Value = File> {
    let kind = prop_oneof![
        1 => text().prop_map(ItemKind::Version),
        1 => style(),
        2 => import(),
        4 => value(),
        4 => rule(),
    ];
    let annotations = prop::collection::vec(annotation(), 0..2);
    let item = (annotations, kind).prop_map(|(annotations, kind)| Item {
        annotations,
        kind,
        span: nowhere(),
    });
    prop::collection::vec(item, 0..5).prop_map(|items| File { items })
}
