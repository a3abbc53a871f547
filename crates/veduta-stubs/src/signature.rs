//! What a function takes and gives, as Python has it.

use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, FnArg, Lit, Meta, Pat, ReturnType, Signature, Token, Type};

use crate::types::{text_of, Names, Way};

/// Why a function has no signature: what is wrong, or the type that is not known.
pub enum Unwritten {
    Type(String),
    Other(String),
}

/// `(self, a: int, *, b: float = 1.0) -> str`; `first` is what comes before what is given.
pub fn signature(
    file: &str,
    names: &Names<'_>,
    attrs: &[Attribute],
    sig: &Signature,
    first: Option<&str>,
    returns: Option<&str>,
) -> Result<String, Unwritten> {
    let taken: Vec<(String, &Type)> = sig.inputs.iter().filter_map(argument).collect();
    let mut parts: Vec<String> = first.map(str::to_string).into_iter().collect();
    let given = given_signature(attrs)?;
    let plain = || taken.iter().map(|(name, _)| (name.clone(), None)).collect();
    let mut seen = 0;
    for (name, default) in given.unwrap_or_else(plain) {
        if name == "*" {
            parts.push(name);
            continue;
        }
        seen += 1;
        let own = taken.iter().find(|(known, _)| *known == name);
        let Some((_, ty)) = own else {
            return Err(Unwritten::Other(format!("`{name}` is no argument of it")));
        };
        let python = names.python(file, ty, Way::In).map_err(Unwritten::Type)?;
        let default = default.map_or(String::new(), |value| format!(" = {value}"));
        parts.push(format!("{name}: {python}{default}"));
    }
    if seen != taken.len() {
        return Err(Unwritten::Other(
            "its signature leaves arguments out".into(),
        ));
    }
    let gives = match (returns, &sig.output) {
        (Some(told), _) => told.to_string(),
        (None, ReturnType::Default) => "None".to_string(),
        (None, ReturnType::Type(_, ty)) => {
            names.python(file, ty, Way::Out).map_err(Unwritten::Type)?
        }
    };
    Ok(format!("({}) -> {gives}", parts.join(", ")))
}

/// Name and type of an argument that Python gives: neither `self` nor the interpreter.
fn argument(input: &FnArg) -> Option<(String, &Type)> {
    let FnArg::Typed(typed) = input else {
        return None;
    };
    let Pat::Ident(name) = &*typed.pat else {
        return None;
    };
    let is_interpreter = matches!(&*typed.ty, Type::Path(path)
        if path.path.segments.last().is_some_and(|last| last.ident == "Python"));
    (!is_interpreter).then(|| (name.ident.to_string(), &*typed.ty))
}

type Given = Vec<(String, Option<String>)>;

/// The names and defaults of `#[pyo3(signature = (...))]`, with `*`; None where there is none.
fn given_signature(attrs: &[Attribute]) -> Result<Option<Given>, Unwritten> {
    let bad = |why: syn::Error| Unwritten::Other(why.to_string());
    for attribute in attrs.iter().filter(|one| one.path().is_ident("pyo3")) {
        let mut found = None;
        let read = |meta: syn::meta::ParseNestedMeta<'_>| {
            if !meta.path.is_ident("signature") {
                return Ok(());
            }
            let within;
            meta.value()?;
            syn::parenthesized!(within in meta.input);
            let mut all = Vec::new();
            while !within.is_empty() {
                if within.parse::<Option<Token![*]>>()?.is_some() {
                    all.push(("*".to_string(), None));
                } else {
                    let name: syn::Ident = within.parse()?;
                    let default = match within.parse::<Option<Token![=]>>()? {
                        Some(_) => Some(default_of(&within.parse::<Expr>()?)),
                        None => None,
                    };
                    all.push((name.to_string(), default));
                }
                within.parse::<Option<Token![,]>>()?;
            }
            found = Some(all);
            Ok(())
        };
        attribute.parse_nested_meta(read).map_err(bad)?;
        if found.is_some() {
            return Ok(found);
        }
    }
    Ok(None)
}

/// A default as Python writes it; `...` for what Python has no words for.
fn default_of(value: &Expr) -> String {
    match value {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Bool(truth) => if truth.value { "True" } else { "False" }.into(),
            _ => text_of(value),
        },
        Expr::Path(_) | Expr::Unary(_) => text_of(value),
        _ => "...".into(),
    }
}

/// The words in the brackets of an attribute: `frozen`, `get_all`, `name = "X"`.
pub fn words(attribute: &Attribute) -> Vec<Meta> {
    let parser = Punctuated::<Meta, Token![,]>::parse_terminated;
    let found = attribute.parse_args_with(parser);
    found.map_or_else(|_| Vec::new(), |all| all.into_iter().collect())
}
