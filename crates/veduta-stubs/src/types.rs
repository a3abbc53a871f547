//! A type of Rust as Python has it.

use std::collections::{BTreeSet, HashMap};

use quote::ToTokens;
use syn::{Fields, File, GenericArgument, Item, PathArguments, PathSegment, Type};

use crate::items::{each_item, python_name};

/// Whether Python gives a value or gets it: PyO3 takes any sequence where it gives a list.
#[derive(Clone, Copy, PartialEq)]
pub enum Way {
    In,
    Out,
}

/// The names that types may have beside those of Rust and PyO3.
pub struct Names<'a> {
    /// By file and name; a name that one file alone has is known in the others too, and one that
    /// several have is not (None).
    aliases: HashMap<(&'a str, String), (&'a str, &'a Type)>,
    shared: HashMap<String, Option<(&'a str, &'a Type)>>,
    /// Enums that are one of several types: the file and the types of their variants.
    unions: HashMap<String, (&'a str, Vec<&'a Type>)>,
    /// The name in Python of each class.
    classes: HashMap<String, String>,
}

impl<'a> Names<'a> {
    pub fn of(files: &'a [(&'a str, File)]) -> Self {
        let mut names = Self {
            aliases: HashMap::new(),
            shared: HashMap::new(),
            unions: HashMap::new(),
            classes: HashMap::new(),
        };
        for (file, item) in each_item(files) {
            match item {
                Item::Type(alias) => {
                    let (name, known) = (alias.ident.to_string(), (file, &*alias.ty));
                    names.aliases.insert((file, name.clone()), known);
                    let shared = names.shared.entry(name);
                    shared.and_modify(|one| *one = None).or_insert(Some(known));
                }
                Item::Enum(one) => {
                    let types = one
                        .variants
                        .iter()
                        .filter_map(|variant| match &variant.fields {
                            Fields::Unnamed(fields) if fields.unnamed.len() == 1 => {
                                Some(&fields.unnamed[0].ty)
                            }
                            _ => None,
                        });
                    let types: Vec<&Type> = types.collect();
                    if types.len() == one.variants.len() {
                        names.unions.insert(one.ident.to_string(), (file, types));
                    }
                }
                Item::Struct(one) => {
                    if let Some(name) = python_name(&one.attrs, &one.ident) {
                        names.classes.insert(one.ident.to_string(), name);
                    }
                }
                _ => {}
            }
        }
        names
    }

    /// The type in Python; the text of the innermost that is not known where there is one.
    pub fn python(&self, file: &str, ty: &Type, way: Way) -> Result<String, String> {
        let each = |types: &mut dyn Iterator<Item = &Type>| -> Result<Vec<String>, String> {
            types.map(|one| self.python(file, one, way)).collect()
        };
        match ty {
            Type::Reference(to) => match &*to.elem {
                Type::Slice(slice) if text_of(&slice.elem) == "u8" => Ok("bytes".to_string()),
                other => self.python(file, other, way),
            },
            Type::Tuple(tuple) if tuple.elems.is_empty() => Ok("None".to_string()),
            Type::Tuple(tuple) => {
                let parts = each(&mut tuple.elems.iter())?;
                Ok(format!("tuple[{}]", parts.join(", ")))
            }
            // PyO3 takes a sequence of that length, and gives a list.
            Type::Array(array) => {
                let part = self.python(file, &array.elem, way)?;
                match (way, text_of(&array.len).parse::<usize>()) {
                    (Way::In, Ok(count)) => Ok(format!("tuple[{}]", vec![part; count].join(", "))),
                    _ => Ok(format!("list[{part}]")),
                }
            }
            Type::Path(path) => match path.path.segments.last() {
                Some(last) => self.named(file, last, way),
                None => Err(text_of(ty)),
            },
            _ => Err(text_of(ty)),
        }
    }

    fn named(&self, file: &str, segment: &PathSegment, way: Way) -> Result<String, String> {
        let name = segment.ident.to_string();
        let inner = arguments(segment);
        let python = |number: usize| match inner.get(number) {
            Some(one) => self.python(file, one, way),
            None => Err(text_of(segment)),
        };
        Ok(match name.as_str() {
            "bool" => "bool".into(),
            "f32" | "f64" => "float".into(),
            "u8" | "u16" | "u32" | "u64" | "usize" | "i16" | "i32" | "i64" => "int".into(),
            "str" | "String" => "str".into(),
            "PyBytes" => "bytes".into(),
            "PyResult" | "Py" | "Bound" => python(0)?,
            "Option" => format!("{} | None", python(0)?),
            "Vec" if way == Way::In => format!("Sequence[{}]", python(0)?),
            "Vec" => format!("list[{}]", python(0)?),
            "HashMap" | "BTreeMap" => format!("dict[{}, {}]", python(0)?, python(1)?),
            "PyReadonlyArray1" | "PyArray1" => format!("_Array1[{}]", dtype(segment)?),
            "PyReadonlyArray2" | "PyArray2" => format!("_Array2[{}]", dtype(segment)?),
            "PyReadonlyArray3" | "PyArray3" => format!("_Array3[{}]", dtype(segment)?),
            _ => return self.declared(file, &name, way),
        })
    }

    /// A type that the sources declare: an alias, a class, or an enum of several types.
    fn declared(&self, file: &str, name: &str, way: Way) -> Result<String, String> {
        let own = self.aliases.get(&(file, name.to_string()));
        let shared = || self.shared.get(name).and_then(Option::as_ref);
        if let Some((home, ty)) = own.or_else(shared) {
            return self.python(home, ty, way);
        }
        if let Some(class) = self.classes.get(name) {
            return Ok(class.clone());
        }
        let (home, types) = self.unions.get(name).ok_or_else(|| name.to_string())?;
        let parts: Result<Vec<String>, String> =
            types.iter().map(|ty| self.python(home, ty, way)).collect();
        let mut known = BTreeSet::new();
        let mut parts = parts?;
        parts.retain(|part| known.insert(part.clone()));
        Ok(parts.join(" | "))
    }
}

fn arguments(segment: &PathSegment) -> Vec<&Type> {
    let PathArguments::AngleBracketed(all) = &segment.arguments else {
        return Vec::new();
    };
    let types = all.args.iter().filter_map(|one| match one {
        GenericArgument::Type(ty) => Some(ty),
        _ => None,
    });
    types.collect()
}

fn dtype(segment: &PathSegment) -> Result<&'static str, String> {
    let element = arguments(segment).first().map(|ty| text_of(*ty));
    Ok(match element.as_deref() {
        Some("bool") => "np.bool_",
        Some("f32") => "np.float32",
        Some("f64") => "np.float64",
        Some("i32") => "np.int32",
        Some("i64") => "np.int64",
        Some("u8") => "np.uint8",
        Some("u16") => "np.uint16",
        Some("u32") => "np.uint32",
        _ => return Err(text_of(segment)),
    })
}

pub fn text_of(tokens: impl ToTokens) -> String {
    tokens.to_token_stream().to_string()
}
