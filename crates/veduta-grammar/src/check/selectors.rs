//! Cells of blocks: selectors, sizes, and cells that no shape can reach.

use std::collections::HashSet;

use super::Checker;
use crate::ast::{Body, Cell, Expr, ExprKind, Joining};
use crate::builtins::{is_word, Words, NONE};
use crate::{Diagnostic, Span, Symbol};

impl Checker<'_> {
    /// Cells with selectors: each component goes to the first cell that selects it. `rest` are
    /// selectors outside of this competition.
    pub fn selector_cells<T>(
        &mut self,
        cells: &[Cell<T>],
        words: Words,
        rest: Words,
        part: fn(&mut Self, &T),
    ) {
        let mut taken = HashSet::new();
        for cell in cells {
            let (selector, body) = match cell {
                Cell::Part { selector, body, .. } => (selector, body),
                Cell::Group {
                    cells,
                    repeats,
                    span,
                } => {
                    self.repeats_nothing(*repeats, *span);
                    self.selector_cells(cells, words, rest, part);
                    continue;
                }
            };
            self.selector(selector, words, rest);
            if let Some(what) = self.taken_by(selector, rest) {
                self.report_taken(selector, what, &taken);
                taken.insert(what);
            }
            self.calls.enter_branch();
            part(self, body);
            self.calls.leave_branch();
        }
    }

    fn no_repeat(&mut self, span: Span) {
        let message = "only the cells of splits can be repeated";
        self.diagnostics.error(span, message);
    }

    fn taken_by(&self, selector: &Expr, rest: Words) -> Option<Taken> {
        match &selector.kind {
            ExprKind::Name(name) if is_word(rest, self.text(name)) => None,
            ExprKind::Name(name) if self.text(name) == "all" => Some(Taken::All),
            ExprKind::Name(name) => Some(Taken::Named(name.symbol)),
            ExprKind::Number(index) => Some(Taken::Index(index.to_bits())),
            _ => None,
        }
    }

    fn report_taken(&mut self, selector: &Expr, what: Taken, before: &HashSet<Taken>) {
        let message = if before.contains(&Taken::All) {
            "nothing is left for this cell: `all` before it takes everything"
        } else if before.contains(&what) {
            "nothing is left for this cell: one before it has the same selector"
        } else {
            return;
        };
        self.diagnostics
            .add(Diagnostic::warning(selector.span, message));
    }

    /// Cells with sizes, as splits have.
    pub fn size_cells(&mut self, cells: &[Cell<Body>]) {
        for cell in cells {
            match cell {
                Cell::Group { cells, .. } => self.size_cells(cells),
                Cell::Part {
                    selector,
                    depth,
                    joining,
                    body,
                    ..
                } => {
                    self.expr(selector, NONE);
                    self.says_a_size(selector.span);
                    depth.iter().for_each(|depth| self.expr(depth, NONE));
                    if *joining != Joining::Each {
                        let message = format!(
                            "`{}` combines what a selector selects; sizes take `:`",
                            joining.sign()
                        );
                        self.diagnostics.error(selector.span, message);
                    }
                    self.body(body);
                }
            }
        }
    }

    fn says_a_size(&mut self, size: Span) {
        if size.range().is_empty() {
            let message = "an older form: a cell without a size is one of `~1`";
            self.diagnostics.add(Diagnostic::warning(size, message));
        }
    }

    /// The block of `operation` must have cells without a repeat.
    pub fn repeats_nothing(&mut self, repeat: bool, span: Span) {
        if repeat {
            self.no_repeat(span);
        }
    }
}

/// What a cell takes away from those after it.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Taken {
    All,
    Named(Symbol),
    /// The bits of the number.
    Index(u64),
}
