//! Operations with their arguments and blocks.

use super::cursor::{Parsed, Parser};
use crate::ast::{Block, Body, Call, Cell, Expr, ExprKind, Joining, Operation, Size};
use crate::token::TokenKind;
use crate::Span;

/// Operations that work with the shapes of a rule: the operation that follows them, or a block.
pub(crate) const TAKES_OPERATION: [&str; 4] = ["inline", "union", "subtract", "intersect"];

/// Has cells with two sizes (`length : depth : …`), and a second block.
pub(crate) const TAKES_DEPTHS: &str = "splitAndSetbackPerimeter";

/// Its cells have sizes, which older files leave out where a cell takes all that is left.
const SPLIT: &str = "split";

/// Whether the cells of a block have one size or selector, or two sizes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sizes {
    One,
    Two,
}

impl Parser<'_> {
    /// As many operations as there are; they end at what is none.
    pub fn operations(&mut self) -> Parsed<Vec<Operation>> {
        let mut operations = Vec::new();
        while self.starts_operation() {
            operations.push(self.operation()?);
        }
        Ok(operations)
    }

    fn starts_operation(&self) -> bool {
        match self.kind() {
            TokenKind::OpenBracket => true,
            TokenKind::Name | TokenKind::Leaf => {
                !self.starts_item(self.at()) && !self.starts_chance(self.at())
            }
            _ => false,
        }
    }

    fn operation(&mut self) -> Parsed<Operation> {
        if self.is(TokenKind::OpenBracket) {
            return self.nested(Self::push);
        }
        self.call().map(Operation::Call)
    }

    fn push(&mut self) -> Parsed<Operation> {
        let start = self.advance().span;
        let body = self.body()?;
        self.expect(TokenKind::CloseBracket, "at the end of `[ … ]`")?;
        Ok(Operation::Push {
            body,
            span: self.since(start),
        })
    }

    fn call(&mut self) -> Parsed<Call> {
        let leaf = self.is(TokenKind::Leaf);
        let start = self.advance().span;
        let name = self.ident(start);
        let args = if self.is(TokenKind::OpenParen) && !leaf {
            Some(self.list(TokenKind::CloseParen, Self::argument)?)
        } else {
            None
        };
        let sizes = match self.slice(start) {
            TAKES_DEPTHS => Sizes::Two,
            _ => Sizes::One,
        };
        let takes_operation = TAKES_OPERATION.contains(&self.slice(start));
        let block = if self.is(TokenKind::OpenBrace) {
            let block = self.nested(|parser| parser.block(sizes, takes_operation))?;
            Some(match block {
                Block::Body { body, span } if self.slice(start) == SPLIT => {
                    self.one_cell(*body, span)
                }
                block => block,
            })
        } else if takes_operation {
            Some(self.nested(Self::operation_as_block)?)
        } else {
            None
        };
        let rest = if sizes == Sizes::Two && self.is(TokenKind::OpenBrace) {
            Some(self.nested(|parser| parser.block(Sizes::One, false))?)
        } else {
            None
        };
        Ok(Call {
            name,
            leaf,
            args,
            block,
            rest,
            span: self.since(start),
        })
    }

    fn operation_as_block(&mut self) -> Parsed<Block> {
        if !self.starts_operation() || self.is(TokenKind::OpenBracket) {
            return self.fail("expected a rule, an operation or `{`".to_string());
        }
        let operation = self.operation()?;
        let span = operation.span();
        let body = Box::new(Body::Operations(vec![operation]));
        Ok(Block::Body { body, span })
    }

    /// `operands` says whether the block may be `{ operations | operations }`.
    fn block(&mut self, sizes: Sizes, operands: bool) -> Parsed<Block> {
        let open = self.span();
        if !self.holds_cells(self.at()) || (operands && self.holds_operands(self.at())) {
            self.advance();
            let body = Box::new(self.body()?);
            let second = if operands && self.eat(TokenKind::Bar) {
                Some(Box::new(self.body()?))
            } else {
                None
            };
            self.expect(TokenKind::CloseBrace, "at the end of a block")?;
            let span = self.since(open);
            return Ok(match second {
                None => Block::Body { body, span },
                Some(second) => Block::Operands {
                    first: body,
                    second,
                    span,
                },
            });
        }
        let cells = self.cells(sizes, Self::body)?;
        let repeat = self.eat(TokenKind::Star);
        Ok(Block::Cells {
            cells,
            repeat,
            span: self.since(open),
        })
    }

    /// `{ cell | cell … }`; the brace is next.
    pub fn cells<T>(
        &mut self,
        sizes: Sizes,
        part: fn(&mut Self) -> Parsed<T>,
    ) -> Parsed<Vec<Cell<T>>> {
        self.advance();
        let mut cells = Vec::new();
        loop {
            cells.push(self.cell(sizes, part)?);
            if self.eat(TokenKind::CloseBrace) {
                return Ok(cells);
            }
            if !self.eat(TokenKind::Bar) {
                return self.fail("expected `|` or `}` after a cell".to_string());
            }
        }
    }

    fn cell<T>(&mut self, sizes: Sizes, part: fn(&mut Self) -> Parsed<T>) -> Parsed<Cell<T>> {
        let start = self.span();
        if self.is(TokenKind::OpenBrace) {
            let cells = self.nested(|parser| parser.cells(sizes, part))?;
            let repeats = self.eat(TokenKind::Star);
            let span = self.since(start);
            return Ok(Cell::Group {
                cells,
                repeats,
                span,
            });
        }
        if sizes == Sizes::One && self.starts_split() {
            let body = part(self)?;
            return Ok(Cell::Part {
                selector: share_at(start),
                depth: None,
                joining: Joining::Each,
                body,
                span: self.since(start),
            });
        }
        let selector = self.selector()?;
        let joining = match self.kind() {
            TokenKind::Colon => Joining::Each,
            TokenKind::Assign => Joining::All,
            TokenKind::AssignEach => Joining::Connected,
            _ => {
                return self.fail("expected `:`, `=` or `=:` after a selector or size".to_string())
            }
        };
        self.advance();
        let mut depth = None;
        if sizes == Sizes::Two {
            depth = Some(self.selector()?);
            self.expect(TokenKind::Colon, "after the depth of a cell")?;
        }
        let body = part(self)?;
        Ok(Cell::Part {
            selector,
            depth,
            joining,
            body,
            span: self.since(start),
        })
    }

    /// Whether `split(x) {` is next, as no size or selector begins.
    fn starts_split(&self) -> bool {
        self.slice(self.span()) == SPLIT
            && self.kind_at(self.at() + 1) == TokenKind::OpenParen
            && (self.after_partner(self.at() + 1))
                .is_some_and(|after| self.kind_at(after) == TokenKind::OpenBrace)
    }

    /// `{ operations }` where cells with sizes are meant.
    fn one_cell(&mut self, body: Body, span: Span) -> Block {
        let part = Cell::Part {
            selector: share_at(span),
            depth: None,
            joining: Joining::Each,
            body,
            span,
        };
        Block::Cells {
            cells: vec![part],
            repeat: self.eat(TokenKind::Star),
            span: self.since(span),
        }
    }
}

/// `~1` for a cell that says no size; its place is empty.
fn share_at(start: Span) -> Expr {
    let span = Span::new(start.range().start, start.range().start);
    let value = Box::new(Expr::new(ExprKind::Number(1.0), span));
    let size = Size::Floating;
    Expr::new(ExprKind::Sized { size, value }, span)
}
