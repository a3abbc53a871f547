//! The texts of rule files for Python: what they import, what is wrong with them, their layout.

use pyo3::prelude::*;
use veduta_grammar::ast::ItemKind;
use veduta_grammar::engine::{lower, operation_names};
use veduta_grammar::{check_from, format, parse, Diagnostic, Names, Program, Severity, Source};

use crate::grammar::GrammarFault;

/// Name and text of each file, the main one first.
pub type Files = Vec<(String, String)>;

/// What is wrong with a rule file: the faults as text, how many are errors and warnings, and, where
/// there is no error, what it asks for that does not derive.
type Verdict = (String, usize, usize, String);

/// A program of files that were read before; what is not among them is not there.
pub fn program_of(files: &Files) -> Option<Program> {
    let (main, text) = files.first()?;
    let source = Source::new(main.clone(), text.clone());
    Some(Program::load(source, |path, importer| {
        let found = imported(files, importer.name(), path);
        let (name, text) = found.ok_or_else(|| "it is not there".to_string())?;
        Ok(Source::new(name.clone(), text.clone()))
    }))
}

/// The file that `importer` calls `path`: beside it, else wherever in the project it was found. Only
/// files that were read before are found; who reads them sees to where they may lie.
fn imported<'a>(files: &'a Files, importer: &str, path: &str) -> Option<&'a (String, String)> {
    let path = path.replace('\\', "/");
    let own = beside(importer, &path);
    let found = files.iter().find(|(known, _)| *known == own);
    let ends = |rest: &str| {
        let end = format!("/{rest}");
        let fitting = files
            .iter()
            .filter(|(known, _)| *known == rest || known.ends_with(&end));
        fitting.min_by_key(|(known, _)| known.len())
    };
    let plain = beside("", path.trim_start_matches('/'));
    // A path of the workspace begins with the name of a project, which need not be its folder's.
    let of_workspace = || plain.split_once('/').filter(|_| path.starts_with('/'));
    found
        .or_else(|| ends(&plain))
        .or_else(|| of_workspace().and_then(|(_, rest)| ends(rest)))
}

/// The path of what lies beside `importer`, without `.` and `..` where they can be done.
fn beside(importer: &str, path: &str) -> String {
    let folder = importer.rfind('/').map_or("", |end| &importer[..=end]);
    let whole = match path.starts_with('/') {
        true => path.to_string(),
        false => format!("{folder}{path}"),
    };
    let mut parts: Vec<&str> = Vec::new();
    for part in whole.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => {
                parts.pop();
            }
            name => parts.push(name),
        }
    }
    let start = if whole.starts_with('/') { "/" } else { "" };
    format!("{start}{}", parts.join("/"))
}

/// The paths that the import statements of a text name, as they stand there.
#[pyfunction]
fn grammar_imports(py: Python<'_>, text: &str) -> Vec<String> {
    py.detach(|| {
        let file = parse(text, &mut Names::new()).file;
        let paths = file.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Import(import) => Some(import.path.value.to_string()),
            _ => None,
        });
        paths.collect()
    })
}

#[pyfunction]
#[pyo3(signature = (files, start=None))]
fn grammar_check(py: Python<'_>, files: Files, start: Option<&str>) -> PyResult<Verdict> {
    let verdict = py.detach(|| {
        let program = program_of(&files)?;
        let checked = check_from(&program, start);
        let count = |severity: Severity| {
            let all = checked.diagnostics.iter().flatten();
            all.filter(|one| one.severity == severity).count()
        };
        let underived = if checked.has_errors() {
            String::new()
        } else {
            rendered(&program, &lower(&program, &checked).diagnostics)
        };
        let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
        Some((checked.render(&program), errors, warnings, underived))
    });
    verdict.ok_or_else(|| GrammarFault::new_err("no rule file is given"))
}

/// All faults of a program as text, file by file.
pub fn rendered(program: &Program, faults: &[Vec<Diagnostic>]) -> String {
    let files = program.units.iter().zip(faults);
    let each = files.flat_map(|(unit, all)| all.iter().map(|one| one.render(&unit.source)));
    each.collect()
}

/// The text of a rule file in the house style; GrammarFault where it does not parse.
#[pyfunction]
fn grammar_format(py: Python<'_>, name: &str, text: &str) -> PyResult<String> {
    py.detach(|| {
        format(text).map_err(|faults| {
            let source = Source::new(name, text);
            faults.iter().map(|one| one.render(&source)).collect()
        })
    })
    .map_err(|told: String| GrammarFault::new_err(told))
}

/// The names of the operations that derive.
#[pyfunction]
fn grammar_operations() -> Vec<&'static str> {
    operation_names().collect()
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(grammar_imports, m)?)?;
    m.add_function(wrap_pyfunction!(grammar_check, m)?)?;
    m.add_function(wrap_pyfunction!(grammar_format, m)?)?;
    m.add_function(wrap_pyfunction!(grammar_operations, m)?)
}
