//! The statements of a file: version, imports, styles, values and rules.

use super::cursor::{Parsed, Parser};
use crate::ast::{
    Ident, Import, Item, ItemKind, Local, Override, Rule, RuleKeyword, Style, Text, Value,
    ValueKeyword,
};
use crate::lexer::unescape;
use crate::token::TokenKind;
use crate::Span;

/// The words before `=` or `-->`.
struct LeftSide {
    name: Ident,
    params: Vec<Ident>,
    locals: Vec<Local>,
}

impl Parser<'_> {
    pub fn item(&mut self) -> Parsed<Item> {
        let annotations = self.annotations()?;
        let start = self.span();
        let kind = self.item_kind()?;
        Ok(Item {
            annotations,
            kind,
            span: self.since(start),
        })
    }

    fn item_kind(&mut self) -> Parsed<ItemKind> {
        let next = self.kind_at(self.at() + 1);
        let is_keyword = self.is(TokenKind::Name)
            && !matches!(
                next,
                TokenKind::Arrow | TokenKind::Assign | TokenKind::OpenParen
            );
        let word = if is_keyword {
            self.slice(self.span())
        } else {
            ""
        };
        match word {
            "version" => self.version(),
            "import" => self.import(),
            "style" => self.style(),
            "attr" => self.keyword_value(ValueKeyword::Attr),
            "const" => self.keyword_value(ValueKeyword::Const),
            "start" => self.keyword_rule(RuleKeyword::Start),
            "extension" => self.keyword_rule(RuleKeyword::Extension),
            _ => self.definition(),
        }
    }

    fn version(&mut self) -> Parsed<ItemKind> {
        self.advance();
        Ok(ItemKind::Version(self.text("after `version`")?))
    }

    fn style(&mut self) -> Parsed<ItemKind> {
        self.advance();
        let name = self.plain_name("of a style")?;
        let mut base = None;
        if self.is(TokenKind::Name) && self.slice(self.span()) == "extends" {
            self.advance();
            base = Some(self.plain_name("of a style after `extends`")?);
        }
        Ok(ItemKind::Style(Style { name, base }))
    }

    fn import(&mut self) -> Parsed<ItemKind> {
        self.advance();
        let id = self.plain_name("after `import`")?;
        let styles = if self.is(TokenKind::OpenParen) {
            Some(self.name_list("of a style")?)
        } else {
            None
        };
        self.expect(TokenKind::Colon, "after the name of an import")?;
        let path = self.text("with the path of an import")?;
        let overrides = if self.is(TokenKind::OpenParen) {
            Some(self.list(TokenKind::CloseParen, Self::override_)?)
        } else {
            None
        };
        Ok(ItemKind::Import(Import {
            id,
            styles,
            path,
            overrides,
        }))
    }

    fn override_(&mut self) -> Parsed<Override> {
        let name = self.plain_name("of an attribute or extension rule")?;
        match self.kind() {
            TokenKind::Assign => {
                self.advance();
                let value = self.value()?;
                Ok(Override::Value { name, value })
            }
            TokenKind::Arrow | TokenKind::OpenParen => {
                let params = self.params()?;
                self.expect(TokenKind::Arrow, "in an extension")?;
                let body = self.body()?;
                Ok(Override::Rule { name, params, body })
            }
            _ => Ok(Override::Protect(name)),
        }
    }

    fn keyword_value(&mut self, keyword: ValueKeyword) -> Parsed<ItemKind> {
        self.advance();
        let left = self.left_side()?;
        self.value_item(keyword, left)
    }

    fn keyword_rule(&mut self, keyword: RuleKeyword) -> Parsed<ItemKind> {
        self.advance();
        let left = self.left_side()?;
        self.rule_item(keyword, left)
    }

    fn definition(&mut self) -> Parsed<ItemKind> {
        if !matches!(self.kind(), TokenKind::Name | TokenKind::Leaf) {
            return self.fail("expected a rule, a function or `attr`".to_string());
        }
        let name = self.dotted_rule_name()?;
        let left = self.left_side_after(name)?;
        match self.kind() {
            TokenKind::Assign => self.value_item(ValueKeyword::Function, left),
            TokenKind::Arrow => self.rule_item(RuleKeyword::None, left),
            _ => self.fail("expected `-->` or `=` after the name of a definition".to_string()),
        }
    }

    fn value_item(&mut self, keyword: ValueKeyword, left: LeftSide) -> Parsed<ItemKind> {
        self.expect(TokenKind::Assign, "after the name of a value")?;
        let value = self.value()?;
        Ok(ItemKind::Value(Value {
            keyword,
            name: left.name,
            params: left.params,
            locals: left.locals,
            value,
        }))
    }

    fn rule_item(&mut self, keyword: RuleKeyword, left: LeftSide) -> Parsed<ItemKind> {
        self.expect(TokenKind::Arrow, "after the name of a rule")?;
        let body = self.body()?;
        Ok(ItemKind::Rule(Rule {
            keyword,
            name: left.name,
            params: left.params,
            locals: left.locals,
            body,
        }))
    }

    /// The name of a definition. Before `-->` it may be that of an import's rule: `lib.Facade`.
    fn dotted_rule_name(&mut self) -> Parsed<Ident> {
        let after = match self.kind_at(self.at() + 1) {
            TokenKind::OpenParen => self.after_partner(self.at() + 1),
            _ => Some(self.at() + 1),
        };
        if self.is(TokenKind::Name) && after.is_some_and(|at| self.kind_at(at) == TokenKind::Arrow)
        {
            let span = self.advance().span;
            return Ok(self.ident(span));
        }
        self.plain_name("of a definition")
    }

    fn left_side(&mut self) -> Parsed<LeftSide> {
        let name = self.plain_name("of a definition")?;
        self.left_side_after(name)
    }

    fn left_side_after(&mut self, name: Ident) -> Parsed<LeftSide> {
        let params = self.params()?;
        let locals = self.locals()?;
        Ok(LeftSide {
            name,
            params,
            locals,
        })
    }

    fn params(&mut self) -> Parsed<Vec<Ident>> {
        if self.is(TokenKind::OpenParen) {
            self.name_list("of a parameter")
        } else {
            Ok(Vec::new())
        }
    }

    /// `with ( name := value name := value … )`
    fn locals(&mut self) -> Parsed<Vec<Local>> {
        let mut locals = Vec::new();
        if self.eat(TokenKind::With) {
            self.expect(TokenKind::OpenParen, "after `with`")?;
            while !self.eat(TokenKind::CloseParen) {
                let name = self.plain_name("of a local variable")?;
                self.expect(TokenKind::Define, "after the name of a local variable")?;
                let value = self.value()?;
                locals.push(Local { name, value });
            }
        }
        Ok(locals)
    }

    fn name_list(&mut self, role: &'static str) -> Parsed<Vec<Ident>> {
        self.list(TokenKind::CloseParen, |parser| parser.plain_name(role))
    }

    /// Elements between brackets with commas between them; the opening bracket is next.
    pub fn list<T>(
        &mut self,
        close: TokenKind,
        element: impl Fn(&mut Self) -> Parsed<T>,
    ) -> Parsed<Vec<T>> {
        self.nested(|parser| {
            parser.advance();
            let mut list = Vec::new();
            if parser.eat(close) {
                return Ok(list);
            }
            loop {
                list.push(element(parser)?);
                if parser.eat(close) {
                    return Ok(list);
                }
                if !parser.eat(TokenKind::Comma) {
                    return parser.fail(format!("expected `,` or {}", close.describe()));
                }
            }
        })
    }

    pub fn text(&mut self, place: &str) -> Parsed<Text> {
        let token = self.expect(TokenKind::Text, place)?;
        Ok(Text {
            value: unescape(self.slice(token.span)),
            span: token.span,
        })
    }

    pub fn ident(&mut self, span: Span) -> Ident {
        let text = self.slice(span);
        let symbol = self.names.intern(text.strip_suffix('.').unwrap_or(text));
        Ident { symbol, span }
    }

    /// A name without dots, as definitions have.
    pub fn plain_name(&mut self, role: &str) -> Parsed<Ident> {
        if !matches!(self.kind(), TokenKind::Name | TokenKind::Leaf) {
            return self.fail(format!("expected the name {role}"));
        }
        let text = self.slice(self.span());
        if text.contains('.') {
            let message = format!("expected the name {role}, which has no dots");
            return self.fail(message);
        }
        let span = self.advance().span;
        Ok(self.ident(span))
    }
}
