//! What the extension declares, and how a stub says it.

use std::collections::HashMap;

use syn::parse::Parser;
use syn::punctuated::Punctuated;
use syn::{
    Attribute, Expr, File, Ident, ImplItem, ImplItemFn, Item, ItemFn, ItemStruct, Lit, Meta, Path,
    Token, Type,
};

use crate::signature::{signature, words, Unwritten};
use crate::types::{text_of, Names, Way};
use crate::StubError;

/// The base classes of exceptions that PyO3 names otherwise.
const BUILT_IN: [(&str, &str); 3] = [
    ("PyValueError", "ValueError"),
    ("PyRuntimeError", "RuntimeError"),
    ("PyException", "Exception"),
];

/// All declarations, by their files.
pub struct Items<'a> {
    exceptions: Vec<(&'a str, String, String)>,
    functions: Vec<(&'a str, &'a ItemFn)>,
    classes: Vec<(&'a str, &'a ItemStruct)>,
    /// By the name of the class in Rust: the file that has it, and the method.
    methods: HashMap<String, Vec<(&'a str, &'a ImplItemFn)>>,
}

/// What the files declare, each with its file.
pub fn each_item<'a>(files: &'a [(&'a str, File)]) -> impl Iterator<Item = (&'a str, &'a Item)> {
    let own = |(name, file): &'a (&'a str, File)| file.items.iter().map(move |item| (*name, item));
    files.iter().flat_map(own)
}

impl<'a> Items<'a> {
    pub fn of(files: &'a [(&'a str, File)]) -> Result<Self, StubError> {
        let mut found = Self {
            exceptions: Vec::new(),
            functions: Vec::new(),
            classes: Vec::new(),
            methods: HashMap::new(),
        };
        for (file, item) in each_item(files) {
            match item {
                Item::Macro(one) if one.mac.path.is_ident("create_exception") => {
                    let (name, base) = exception(&one.mac.tokens).ok_or_else(|| {
                        let why = "an exception has a module, a name and a base".to_string();
                        StubError::Syntax {
                            file: file.to_string(),
                            why,
                        }
                    })?;
                    found.exceptions.push((file, name, base));
                }
                Item::Fn(one) if has(&one.attrs, "pyfunction") => found.functions.push((file, one)),
                Item::Struct(one) if has(&one.attrs, "pyclass") => found.classes.push((file, one)),
                Item::Impl(one) if has(&one.attrs, "pymethods") => {
                    let own = found.methods.entry(text_of(&one.self_ty)).or_default();
                    own.extend(one.items.iter().filter_map(|item| match item {
                        ImplItem::Fn(method) => Some((file, method)),
                        _ => None,
                    }));
                }
                _ => {}
            }
        }
        Ok(found)
    }

    /// The part of the stub that one file gives; empty where it declares nothing.
    pub fn written(&self, file: &str, names: &Names<'_>) -> Result<String, StubError> {
        let mut text = String::new();
        for (_, name, base) in self.exceptions.iter().filter(|one| one.0 == file) {
            text += &format!("class {name}({base}): ...\n");
        }
        for (_, class) in self.classes.iter().filter(|one| one.0 == file) {
            text += &self.class(file, class, names)?;
        }
        for (_, function) in self.functions.iter().filter(|one| one.0 == file) {
            let (attrs, sig) = (&function.attrs, &function.sig);
            let told = signature(file, names, attrs, sig, None, None)
                .map_err(|why| fault(file, &sig.ident, why))?;
            text += &format!("def {}{told}:{}", sig.ident, body(&doc(attrs), 1));
        }
        Ok(text)
    }

    fn class(
        &self,
        file: &str,
        class: &ItemStruct,
        names: &Names<'_>,
    ) -> Result<String, StubError> {
        let name = python_name(&class.attrs, &class.ident).unwrap_or_default();
        let mut inner = String::new();
        if words_of(&class.attrs, "pyclass").any(|word| word.path().is_ident("get_all")) {
            for field in &class.fields {
                let own = field
                    .ident
                    .as_ref()
                    .map(ToString::to_string)
                    .unwrap_or_default();
                inner += &property(file, names, &own, &field.ty, &doc(&field.attrs))?;
            }
        }
        let own = self.methods.get(&class.ident.to_string());
        for (home, method) in own.into_iter().flatten() {
            inner += &written_method(home, names, method, &name)?;
        }
        let told = match doc(&class.attrs) {
            lines if lines.is_empty() => String::new(),
            lines => docstring(&lines, 1),
        };
        Ok(format!("class {name}:\n{told}{inner}"))
    }
}

fn written_method(
    file: &str,
    names: &Names<'_>,
    method: &ImplItemFn,
    class: &str,
) -> Result<String, StubError> {
    let (attrs, sig) = (&method.attrs, &method.sig);
    let own = sig.ident.to_string();
    let failed = |why| fault(file, &sig.ident, why);
    if has(attrs, "getter") {
        let gives = signature(file, names, &[], sig, Some("self"), None).map_err(failed)?;
        let told = body(&doc(attrs), 2);
        return Ok(format!("    @property\n    def {own}{gives}:{told}"));
    }
    let (shown, first, returns) = if has(attrs, "new") {
        ("__new__", "cls", Some(class))
    } else {
        (own.as_str(), "self", None)
    };
    let told = signature(file, names, attrs, sig, Some(first), returns).map_err(failed)?;
    Ok(format!("    def {shown}{told}:{}", body(&doc(attrs), 2)))
}

/// A field that can be read.
fn property(
    file: &str,
    names: &Names<'_>,
    name: &str,
    ty: &Type,
    told: &[String],
) -> Result<String, StubError> {
    let python = names.python(file, ty, Way::Out).map_err(|what| {
        let (file, name) = (file.to_string(), name.to_string());
        StubError::Type { file, name, what }
    })?;
    let told = body(told, 2);
    Ok(format!(
        "    @property\n    def {name}(self) -> {python}:{told}"
    ))
}

fn fault(file: &str, name: &Ident, why: Unwritten) -> StubError {
    let (file, name) = (file.to_string(), name.to_string());
    match why {
        Unwritten::Type(what) => StubError::Type { file, name, what },
        Unwritten::Other(why) => StubError::Declaration { file, name, why },
    }
}

fn has(attrs: &[Attribute], name: &str) -> bool {
    attrs.iter().any(|one| one.path().is_ident(name))
}

fn words_of<'a>(attrs: &'a [Attribute], name: &'a str) -> impl Iterator<Item = Meta> + 'a {
    let own = attrs.iter().filter(move |one| one.path().is_ident(name));
    own.flat_map(words)
}

/// The name of a class in Python; None where it is none.
pub fn python_name(attrs: &[Attribute], ident: &Ident) -> Option<String> {
    if !has(attrs, "pyclass") {
        return None;
    }
    let named = words_of(attrs, "pyclass").find_map(|word| match word {
        Meta::NameValue(pair) if pair.path.is_ident("name") => literal(&pair.value),
        _ => None,
    });
    Some(named.unwrap_or_else(|| ident.to_string()))
}

fn literal(value: &Expr) -> Option<String> {
    match value {
        Expr::Lit(one) => match &one.lit {
            Lit::Str(text) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

/// Name and base of `create_exception!(module, Name, Base)`.
fn exception(tokens: &(impl quote::ToTokens + ?Sized)) -> Option<(String, String)> {
    let parser = Punctuated::<Path, Token![,]>::parse_terminated;
    let parts = parser.parse2(tokens.to_token_stream()).ok()?;
    let name = parts.get(1)?.get_ident()?.to_string();
    let base = parts.get(2)?.segments.last()?.ident.to_string();
    let known = BUILT_IN.iter().find(|(rust, _)| *rust == base);
    Some((
        name,
        known.map_or(base, |(_, python)| (*python).to_string()),
    ))
}

/// The lines of a doc comment.
fn doc(attrs: &[Attribute]) -> Vec<String> {
    let lines = attrs.iter().filter_map(|one| match &one.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => literal(&pair.value),
        _ => None,
    });
    lines
        .map(|line| line.trim_end().trim_start_matches(' ').to_string())
        .collect()
}

/// What stands after the colon of a function: its docstring, or nothing.
fn body(told: &[String], depth: usize) -> String {
    if told.is_empty() {
        " ...\n".to_string()
    } else {
        format!("\n{}", docstring(told, depth))
    }
}

fn docstring(lines: &[String], depth: usize) -> String {
    let indent = "    ".repeat(depth);
    let text = lines.join("\n").replace('\\', "\\\\");
    let text = text.replace('\n', &format!("\n{indent}"));
    let end = if lines.len() > 1 {
        format!("\n{indent}")
    } else {
        String::new()
    };
    format!("{indent}\"\"\"{text}{end}\"\"\"\n")
}
