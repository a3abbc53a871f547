//! Functions about the files of a project: which there are, what tables hold, how large pictures are.
//!
//! Nothing here opens a file: the caller says what there is ([`Files`]).

use std::collections::HashMap;
use std::sync::Arc;

use super::functions::text;
use super::material_files;
use super::value::{Array, Kind, Value, MAX_ELEMENTS};

/// What the files of a project are, by the names that rule files have for them.
#[derive(Debug, Clone, Default)]
pub struct Files {
    /// All names, in the order of the alphabet.
    pub names: Vec<Arc<str>>,
    /// The content of those that are text.
    pub texts: HashMap<Arc<str>, Arc<str>>,
    /// Width and height of those that are pictures (px).
    pub pictures: HashMap<Arc<str>, [f64; 2]>,
    /// What those that are assets say besides, by their keys.
    pub metadata: HashMap<Arc<str>, HashMap<String, Value>>,
}

/// A function of the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileFunction {
    Exists,
    /// As a list in a string.
    Search,
    /// As an array.
    SearchAll,
    Random,
    Text,
    Numbers,
    Strings,
    Picture,
    Material,
    Metadata,
}

/// Names, functions, and the fewest and most arguments.
pub const TABLE: &[(&str, FileFunction, usize, usize)] = &[
    ("fileExists", FileFunction::Exists, 1, 1),
    ("fileSearch", FileFunction::Search, 1, 1),
    ("filesSearch", FileFunction::SearchAll, 1, 1),
    ("fileRandom", FileFunction::Random, 1, 1),
    ("readTextFile", FileFunction::Text, 1, 1),
    ("readFloatTable", FileFunction::Numbers, 1, 1),
    ("readStringTable", FileFunction::Strings, 1, 1),
    ("readMaterial", FileFunction::Material, 1, 1),
    ("imageInfo", FileFunction::Picture, 2, 2),
    ("assetMetadata", FileFunction::Metadata, 3, 3),
];

impl FileFunction {
    /// The function of this name, with its fewest and most arguments.
    pub fn named(name: &str) -> Option<(Self, usize, usize)> {
        let found = TABLE.iter().find(|entry| entry.0 == name)?;
        Some((found.1, found.2, found.3))
    }

    /// Whether it wants what stands in files.
    pub fn reads(self) -> bool {
        matches!(
            self,
            Self::Text | Self::Numbers | Self::Strings | Self::Material | Self::Metadata
        )
    }

    /// What to say where a text file is not there, which is taken for an empty one.
    pub fn missing(self, files: &Files, args: &[Value]) -> Option<String> {
        let name = args.first()?.to_string();
        let is_wanted = matches!(self, Self::Text | Self::Strings | Self::Numbers);
        let is_missing = is_wanted && !files.texts.contains_key(plain(&name));
        is_missing.then(|| format!("there is no text file {name}: it is taken for empty"))
    }

    /// The value for these arguments; Err says what is wrong. `draw` gives a number from 0 to 1.
    pub fn call(
        self,
        files: &Files,
        args: &[Value],
        draw: impl FnOnce() -> f64,
    ) -> Result<Value, String> {
        let name = text(args, 0)?;
        match self {
            Self::Exists => Ok(Value::Bool(matching(files, name).next().is_some())),
            Self::Search => {
                let found: Vec<&str> = matching(files, name).collect();
                Ok(Value::text(&found.join(";")))
            }
            Self::SearchAll => Ok(Value::texts(
                matching(files, name).map(Value::text).collect(),
            )),
            Self::Random => {
                let drawn = draw(); // also where there is nothing: what follows stays the same
                let found: Vec<&str> = matching(files, name).collect();
                let last = found.len().saturating_sub(1);
                let place = ((drawn * found.len() as f64) as usize).min(last);
                Ok(Value::text(found.get(place).copied().unwrap_or("")))
            }
            Self::Text => Ok(Value::text(content(files, name).unwrap_or(""))),
            Self::Metadata => {
                let (key, default) = (args[1].to_string(), &args[2]);
                let told = files
                    .metadata
                    .get(plain(name))
                    .and_then(|all| all.get(&key));
                let told = told.filter(|told| told.kind() == default.kind());
                Ok(told.unwrap_or(default).clone())
            }
            // Of a format that nobody has written down there is nothing to tell.
            Self::Material if !is_mtl(name) => Ok(material_files::properties("", "")),
            Self::Material => {
                let folder = &plain(name)[..plain(name).rfind('/').map_or(0, |at| at + 1)];
                Ok(material_files::properties(content(files, name)?, folder))
            }
            Self::Strings => table(content(files, name).unwrap_or(""), Value::text),
            Self::Numbers => table(content(files, name).unwrap_or(""), |cell| {
                Value::Number(cell.trim().parse().unwrap_or(f64::NAN))
            }),
            Self::Picture => {
                let size = files.pictures.get(plain(name));
                let &[width, height] = size.ok_or_else(|| format!("there is no picture {name}"))?;
                match text(args, 1)? {
                    "sx" => Ok(Value::Number(width)),
                    "sy" => Ok(Value::Number(height)),
                    "ratio" => Ok(Value::Number(width / height)),
                    other => Err(format!("`{other}` is not told of a picture: sx, sy")),
                }
            }
        }
    }
}

/// Whether a name is that of a file of materials that can be read.
pub fn is_mtl(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".mtl")
}

/// A name without what leads to the project's own folder.
pub(super) fn plain(name: &str) -> &str {
    let name = name.strip_prefix("./").unwrap_or(name);
    name.strip_prefix('/').unwrap_or(name)
}

/// The files whose names a pattern fits: `*` is any part of a name within a folder, `$` any folders.
pub(super) fn matching<'a>(files: &'a Files, pattern: &'a str) -> impl Iterator<Item = &'a str> {
    let each = pattern.split(';').map(|one| plain(one.trim()));
    let patterns: Vec<&str> = each.filter(|one| !one.is_empty()).collect();
    let names = files.names.iter().map(AsRef::as_ref);
    names.filter(move |name: &&str| patterns.iter().any(|pattern| fits(pattern, name)))
}

/// Greedy with one place to go back to for each kind of wildcard: no more work than both lengths
/// multiplied.
fn fits(pattern: &str, name: &str) -> bool {
    let (pattern, name) = (pattern.as_bytes(), name.as_bytes());
    let mut reached = vec![false; name.len() + 1];
    reached[0] = true;
    for &sign in pattern {
        let mut next = vec![false; name.len() + 1];
        for at in 0..=name.len() {
            if sign == b'*' || sign == b'$' {
                let goes_on = at > 0 && next[at - 1] && (sign == b'$' || name[at - 1] != b'/');
                next[at] = reached[at] || goes_on;
            } else {
                next[at] = at > 0 && reached[at - 1] && name[at - 1].eq_ignore_ascii_case(&sign);
            }
        }
        reached = next;
    }
    reached[name.len()]
}

fn content<'a>(files: &'a Files, name: &str) -> Result<&'a str, String> {
    let found = files.texts.get(plain(name));
    found
        .map(AsRef::as_ref)
        .ok_or_else(|| format!("there is no text file {name}"))
}

/// Rows of lines, columns between semicolons, tabs or commas, whichever the first line has; between
/// spaces where it has numbers alone, since names may have spaces.
fn table(text: &str, value: impl Fn(&str) -> Value) -> Result<Value, String> {
    let lines = || text.lines().filter(|line| !line.trim().is_empty());
    let first = lines().next().unwrap_or("");
    let between = [';', '\t', ',']
        .into_iter()
        .find(|sign| first.contains(*sign));
    let spaced = first
        .split_whitespace()
        .all(|cell| cell.parse::<f64>().is_ok());
    let cells = |line: &'_ str| -> Vec<String> {
        let own = |cell: &str| cell.trim().trim_matches('"').to_string();
        match between {
            Some(sign) => line.split(sign).map(own).collect(),
            None if spaced => line.split_whitespace().map(own).collect(),
            None => vec![own(line)],
        }
    };
    let columns = lines().map(|line| cells(line).len()).max().unwrap_or(0);
    if columns * lines().count() > MAX_ELEMENTS {
        return Err(format!("a table of more than {MAX_ELEMENTS} cells"));
    }
    let mut values = Vec::with_capacity(columns * lines().count());
    for line in lines() {
        let row = cells(line);
        values.extend((0..columns).map(|at| value(row.get(at).map_or("", String::as_str))));
    }
    let array = Array::new(columns, values).or(Kind::of(&value("")));
    Ok(Value::Array(Arc::new(array)))
}
