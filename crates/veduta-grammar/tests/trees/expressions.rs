//! Random expressions.

use proptest::prelude::*;
use proptest::sample::select;
use veduta_grammar::ast::*;

use super::{dotted, nowhere, string};

const JOININGS: &[Joining] = &[Joining::Each, Joining::All, Joining::Connected];

fn expr_of(kind: ExprKind) -> Expr {
    Expr::new(kind, nowhere())
}

fn number() -> impl Strategy<Value = Expr> {
    let number = prop_oneof![
        (0..1000u32).prop_map(f64::from),
        (0.0..1e6f64),
        Just(1e-7),
        Just(1e200)
    ];
    number.prop_map(|number| expr_of(ExprKind::Number(number)))
}

fn leaf() -> impl Strategy<Value = Expr> {
    prop_oneof![
        number(),
        dotted().prop_map(|name| expr_of(ExprKind::Name(name))),
        string().prop_map(|text| expr_of(ExprKind::Text(text))),
        any::<bool>().prop_map(|value| expr_of(ExprKind::Bool(value))),
    ]
}

fn unary_op() -> impl Strategy<Value = UnaryOp> {
    use UnaryOp::*;
    select(vec![Not, Minus, Plus, EachNot, EachMinus, EachPlus])
}

fn binary_op() -> impl Strategy<Value = BinaryOp> {
    use BinaryOp::*;
    select(vec![
        Or,
        And,
        Equal,
        NotEqual,
        Less,
        LessEqual,
        Greater,
        GreaterEqual,
        Add,
        Subtract,
        Multiply,
        Divide,
        Remainder,
        EachOr,
        EachAnd,
        EachEqual,
        EachNotEqual,
        EachLess,
        EachLessEqual,
        EachGreater,
        EachGreaterEqual,
        EachAdd,
        EachSubtract,
        EachMultiply,
        EachDivide,
        EachRemainder,
    ])
}

/// A chance: it begins with a number, so that it can stand after anything.
fn chance() -> impl Strategy<Value = Expr> {
    (number(), prop::option::of(dotted())).prop_map(|(number, name)| match name {
        None => number,
        Some(name) => expr_of(ExprKind::Binary {
            op: BinaryOp::Multiply,
            left: Box::new(number),
            right: Box::new(expr_of(ExprKind::Name(name))),
        }),
    })
}

pub fn branches<T: std::fmt::Debug + Clone>(
    condition: impl Strategy<Value = Expr> + 'static,
    part: impl Strategy<Value = T> + Clone + 'static,
) -> impl Strategy<Value = Branches<T>> {
    let of = |test: Test, tests: BoxedStrategy<Expr>, part: BoxedStrategy<T>| {
        let branch = (tests, part.clone()).prop_map(|(test, then)| Branch {
            test,
            then,
            span: nowhere(),
        });
        (prop::collection::vec(branch, 1..3), part).prop_map(move |(branches, otherwise)| {
            Branches {
                test,
                branches,
                otherwise: Some(Box::new(otherwise)),
                span: nowhere(),
            }
        })
    };
    prop_oneof![
        of(Test::Case, condition.boxed(), part.clone().boxed()),
        of(Test::Chance, chance().boxed(), part.boxed()),
    ]
}

pub fn sized(value: impl Strategy<Value = Expr> + 'static) -> BoxedStrategy<Expr> {
    let size = select(vec![Size::Relative, Size::Floating, Size::FloatingRelative]);
    let sized = (prop::option::of(size), value).prop_map(|(size, value)| match size {
        None => value,
        Some(size) => expr_of(ExprKind::Sized {
            size,
            value: Box::new(value),
        }),
    });
    sized.boxed()
}

fn range(value: impl Strategy<Value = Expr> + Clone) -> impl Strategy<Value = Expr> {
    let step = prop::option::of(value.clone());
    (value.clone(), step, value).prop_map(|(from, step, to)| {
        expr_of(ExprKind::Range {
            from: Box::new(from),
            step: step.map(Box::new),
            to: Box::new(to),
        })
    })
}

pub fn cells<T: std::fmt::Debug + Clone + 'static>(
    selector: impl Strategy<Value = Expr> + Clone + 'static,
    part: impl Strategy<Value = T> + Clone + 'static,
    with_depth: bool,
) -> impl Strategy<Value = Vec<Cell<T>>> {
    let depth = if with_depth {
        selector.clone().prop_map(Some).boxed()
    } else {
        Just(None).boxed()
    };
    let cell =
        (selector, depth, select(JOININGS), part).prop_map(|(selector, depth, joining, body)| {
            Cell::Part {
                selector,
                depth,
                joining,
                body,
                span: nowhere(),
            }
        });
    let cell = cell.prop_recursive(2, 6, 3, |cell| {
        let inner = prop::collection::vec(cell, 1..3);
        (inner, any::<bool>()).prop_map(|(cells, repeats)| Cell::Group {
            cells,
            repeats,
            span: nowhere(),
        })
    });
    prop::collection::vec(cell, 1..4)
}

/// Whole values.
pub fn expr() -> impl Strategy<Value = Expr> + Clone {
    leaf().prop_recursive(4, 24, 3, |inner| {
        let some = |most: usize| prop::collection::vec(inner.clone(), 0..most);
        let element = prop_oneof![3 => inner.clone(), 1 => range(inner.clone())];
        let row = prop::collection::vec(element.clone(), 1..4);
        prop_oneof![
            (dotted(), prop::collection::vec(sized(inner.clone()), 0..3))
                .prop_map(|(name, args)| expr_of(ExprKind::Call { name, args })),
            (
                dotted(),
                some(2),
                cells(sized(inner.clone()), inner.clone(), false)
            )
                .prop_map(|(name, args, cells)| expr_of(ExprKind::Cells {
                    name,
                    args,
                    cells
                })),
            (unary_op(), inner.clone()).prop_map(|(op, operand)| expr_of(ExprKind::Unary {
                op,
                operand: Box::new(operand)
            })),
            (binary_op(), inner.clone(), inner.clone()).prop_map(|(op, left, right)| {
                expr_of(ExprKind::Binary {
                    op,
                    left: Box::new(left),
                    right: Box::new(right),
                })
            }),
            prop::collection::vec(row, 1..3).prop_map(|rows| expr_of(ExprKind::Array(rows))),
            (inner.clone(), prop::collection::vec(element, 1..3)).prop_map(|(array, indices)| {
                expr_of(ExprKind::Index {
                    array: Box::new(array),
                    indices,
                })
            }),
            branches(inner.clone(), inner.clone())
                .prop_map(|all| expr_of(ExprKind::Branches(Box::new(all)))),
        ]
    })
}
