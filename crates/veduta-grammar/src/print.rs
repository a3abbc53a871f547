//! A syntax tree as text. [`format`](crate::format()) makes it pretty.

use crate::ast::{
    Annotation, AnnotationArg, AnnotationValue, Block, Body, Branches, Call, Cell, Expr, ExprKind,
    File, Ident, Import, Item, ItemKind, Local, Operation, Override, Rule, RuleKeyword, Size, Test,
    Value, ValueKeyword,
};
use crate::Names;

/// The text of a tree: all words with single spaces between them, and a line per statement. Parsing
/// it gives the same tree, but for the places.
pub fn print(file: &File, names: &Names) -> String {
    let mut printer = Printer {
        names,
        text: String::new(),
    };
    file.items.iter().for_each(|item| printer.item(item));
    printer.text
}

struct Printer<'a> {
    names: &'a Names,
    text: String,
}

/// Where an expression stands, which decides about its parentheses.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// A whole value.
    Alone,
    /// A condition, chance, selector or part of a range: no alternatives.
    NoBranches,
    /// An operand of an operator that binds as tightly as this.
    Operand(u8),
}

const UNARY: u8 = 7;
const INDEXED: u8 = 8;

impl Printer<'_> {
    fn word(&mut self, word: &str) {
        if !self.text.is_empty() && !self.text.ends_with('\n') {
            self.text.push(' ');
        }
        self.text.push_str(word);
    }

    fn name(&mut self, name: &Ident) {
        self.word(self.names.text(name.symbol));
    }

    fn string(&mut self, value: &str) {
        let mut quoted = String::from("\"");
        for character in value.chars() {
            match character {
                '\n' => quoted.push_str("\\n"),
                '\t' => quoted.push_str("\\t"),
                '"' | '\\' => quoted.extend(['\\', character]),
                _ => quoted.push(character),
            }
        }
        self.word(&(quoted + "\""));
    }

    /// Elements between brackets, with a sign between each two.
    fn list<T>(&mut self, list: &[T], signs: [&str; 3], element: fn(&mut Self, &T)) {
        let [open, sign, close] = signs;
        self.word(open);
        for (index, one) in list.iter().enumerate() {
            if index > 0 {
                self.word(sign);
            }
            element(self, one);
        }
        self.word(close);
    }

    fn item(&mut self, item: &Item) {
        item.annotations.iter().for_each(|one| self.annotation(one));
        match &item.kind {
            ItemKind::Version(version) => {
                self.word("version");
                self.string(&version.value);
            }
            ItemKind::Style(style) => {
                self.word("style");
                self.name(&style.name);
                if let Some(base) = &style.base {
                    self.word("extends");
                    self.name(base);
                }
            }
            ItemKind::Import(import) => self.import(import),
            ItemKind::Value(value) => self.value(value),
            ItemKind::Rule(rule) => self.rule(rule),
        }
        self.text.push('\n');
    }

    fn annotation(&mut self, annotation: &Annotation) {
        self.word("@");
        self.name(&annotation.name);
        if let Some(args) = &annotation.args {
            self.list(args, ["(", ",", ")"], Self::annotation_arg);
        }
    }

    fn annotation_arg(&mut self, arg: &AnnotationArg) {
        if let Some(name) = &arg.name {
            self.name(name);
            self.word("=");
        }
        match &arg.value {
            AnnotationValue::Expr(value) => self.alone(value),
            AnnotationValue::List(list) => self.list(list, ["{", ",", "}"], Self::alone),
        }
    }

    fn import(&mut self, import: &Import) {
        self.word("import");
        self.name(&import.id);
        if let Some(styles) = &import.styles {
            self.list(styles, ["(", ",", ")"], Self::name);
        }
        self.word(":");
        self.string(&import.path.value);
        if let Some(overrides) = &import.overrides {
            self.list(overrides, ["(", ",", ")"], Self::override_);
        }
    }

    fn override_(&mut self, one: &Override) {
        match one {
            Override::Protect(name) => self.name(name),
            Override::Value { name, value } => {
                self.name(name);
                self.word("=");
                self.alone(value);
            }
            Override::Rule { name, params, body } => {
                self.name(name);
                self.params(params);
                self.word("-->");
                self.body(body);
            }
        }
    }

    fn value(&mut self, value: &Value) {
        match value.keyword {
            ValueKeyword::Attr => self.word("attr"),
            ValueKeyword::Const => self.word("const"),
            ValueKeyword::Function => {}
        }
        self.name(&value.name);
        self.params(&value.params);
        self.locals(&value.locals);
        self.word("=");
        self.alone(&value.value);
    }

    fn rule(&mut self, rule: &Rule) {
        match rule.keyword {
            RuleKeyword::Start => self.word("start"),
            RuleKeyword::Extension => self.word("extension"),
            RuleKeyword::None => {}
        }
        self.name(&rule.name);
        self.params(&rule.params);
        self.locals(&rule.locals);
        self.word("-->");
        self.body(&rule.body);
    }

    fn params(&mut self, params: &[Ident]) {
        if !params.is_empty() {
            self.list(params, ["(", ",", ")"], Self::name);
        }
    }

    fn locals(&mut self, locals: &[Local]) {
        if locals.is_empty() {
            return;
        }
        self.word("with");
        self.list(locals, ["(", "", ")"], |printer, local| {
            printer.name(&local.name);
            printer.word(":=");
            printer.alone(&local.value);
        });
    }

    fn body(&mut self, body: &Body) {
        match body {
            Body::Operations(list) => list.iter().for_each(|one| self.operation(one)),
            Body::Branches(all) => self.branches(all, Self::body),
        }
    }

    fn operation(&mut self, operation: &Operation) {
        match operation {
            Operation::Call(call) => self.call(call),
            Operation::Push { body, .. } => {
                self.word("[");
                self.body(body);
                self.word("]");
            }
        }
    }

    fn call(&mut self, call: &Call) {
        self.name(&call.name);
        if call.leaf {
            self.text.push('.');
        }
        if let Some(args) = &call.args {
            self.list(args, ["(", ",", ")"], Self::alone);
        }
        for block in call.block.iter().chain(&call.rest) {
            match block {
                Block::Body { body, .. } => {
                    self.word("{");
                    self.body(body);
                    self.word("}");
                }
                Block::Operands { first, second, .. } => {
                    self.word("{");
                    self.body(first);
                    self.word("|");
                    self.body(second);
                    self.word("}");
                }
                Block::Cells { cells, repeat, .. } => {
                    self.cells(cells, Self::body);
                    if *repeat {
                        self.word("*");
                    }
                }
            }
        }
    }

    fn cells<T>(&mut self, cells: &[Cell<T>], part: fn(&mut Self, &T)) {
        self.word("{");
        for (index, cell) in cells.iter().enumerate() {
            if index > 0 {
                self.word("|");
            }
            match cell {
                Cell::Group { cells, repeats, .. } => {
                    self.cells(cells, part);
                    if *repeats {
                        self.word("*");
                    }
                }
                Cell::Part {
                    selector,
                    depth,
                    joining,
                    body,
                    ..
                } => {
                    self.expr(selector, Place::NoBranches);
                    self.word(joining.sign());
                    if let Some(depth) = depth {
                        self.expr(depth, Place::NoBranches);
                        self.word(":");
                    }
                    part(self, body);
                }
            }
        }
        self.word("}");
    }

    fn branches<T>(&mut self, all: &Branches<T>, part: fn(&mut Self, &T)) {
        for branch in &all.branches {
            if all.test == Test::Case {
                self.word("case");
            }
            self.expr(&branch.test, Place::NoBranches);
            if all.test == Test::Chance {
                self.word("%");
            }
            self.word(":");
            part(self, &branch.then);
        }
        if let Some(otherwise) = &all.otherwise {
            self.word("else");
            self.word(":");
            part(self, otherwise);
        }
    }

    fn alone(&mut self, expr: &Expr) {
        self.expr(expr, Place::Alone);
    }

    fn expr(&mut self, expr: &Expr, place: Place) {
        let outer = match place {
            Place::Alone => None,
            Place::NoBranches => Some(0),
            Place::Operand(outer) => Some(outer),
        };
        let inner = match &expr.kind {
            ExprKind::Branches(_) => Some(0),
            ExprKind::Binary { op, .. } => Some(op.precedence()),
            ExprKind::Unary { .. } => Some(UNARY),
            _ => None,
        };
        let is_branches = matches!(expr.kind, ExprKind::Branches(_));
        let encloses = match (outer, inner) {
            (Some(outer), Some(inner)) => inner < outer || is_branches,
            _ => false,
        };
        if encloses {
            self.word("(");
        }
        self.kind(&expr.kind, place);
        if encloses {
            self.word(")");
        }
    }

    fn kind(&mut self, kind: &ExprKind, place: Place) {
        match kind {
            ExprKind::Number(number) => self.word(&number.to_string()),
            ExprKind::Text(text) => self.string(text),
            ExprKind::Bool(value) => self.word(if *value { "true" } else { "false" }),
            ExprKind::Name(name) => self.name(name),
            ExprKind::Call { name, args } => self.function(name, args),
            ExprKind::Cells { name, args, cells } => {
                self.function(name, args);
                self.cells(cells, Self::alone);
            }
            ExprKind::Unary { op, operand } => {
                self.word(op.sign());
                self.expr(operand, Place::Operand(UNARY));
            }
            ExprKind::Binary { op, left, right } => {
                self.expr(left, Place::Operand(op.precedence()));
                self.word(op.sign());
                self.expr(right, Place::Operand(op.precedence() + 1));
            }
            ExprKind::Array(rows) => {
                self.list(rows, ["[", ";", "]"], |printer, row| printer.row(row))
            }
            ExprKind::Range { from, step, to } => {
                for part in [Some(from), step.as_ref()].into_iter().flatten() {
                    self.expr(part, Place::NoBranches);
                    self.word(":");
                }
                self.expr(to, Place::NoBranches);
            }
            ExprKind::Index { array, indices } => {
                self.expr(array, Place::Operand(INDEXED));
                self.list(indices, ["[", ",", "]"], Self::alone);
            }
            ExprKind::Branches(all) => self.branches(all, Self::alone),
            ExprKind::Sized { size, value } => {
                self.word(match size {
                    Size::Relative => "'",
                    Size::Floating => "~",
                    Size::FloatingRelative => "~'",
                });
                self.expr(value, place);
            }
        }
    }

    fn function(&mut self, name: &Ident, args: &[Expr]) {
        self.name(name);
        self.list(args, ["(", ",", ")"], Self::alone);
    }

    fn row(&mut self, row: &[Expr]) {
        for (index, element) in row.iter().enumerate() {
            if index > 0 {
                self.word(",");
            }
            self.alone(element);
        }
    }
}
