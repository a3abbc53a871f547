//! The texts of rule files for Python: what they import, what is wrong with them, their layout.

use pyo3::prelude::*;
use veduta_grammar::ast::ItemKind;
use veduta_grammar::engine::{lower, operation_names};
use veduta_grammar::{check, format, parse, Diagnostic, Names, Program, Severity, Source};

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
        let name = beside(main, importer.name(), path)
            .ok_or_else(|| "it is not in the folder of the rule file".to_string())?;
        let found = files.iter().find(|(known, _)| *known == name);
        let (name, text) = found.ok_or_else(|| "it is not there".to_string())?;
        Ok(Source::new(name.clone(), text.clone()))
    }))
}

/// The name of the file that `importer` calls `path`; None where it is outside of the folder of
/// `main`.
fn beside(main: &str, importer: &str, path: &str) -> Option<String> {
    let root = main.rfind('/').map_or("", |end| &main[..=end]);
    let mut parts: Vec<&str> = importer.strip_prefix(root)?.split('/').collect();
    parts.pop();
    if path.contains(['\\', ':', '\0']) || path.starts_with('/') {
        return None;
    }
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            name => parts.push(name),
        }
    }
    (!parts.is_empty()).then(|| format!("{root}{}", parts.join("/")))
}

/// The names of the files that the file `name` imports; `main` is the first file of the program.
/// What lies outside of its folder is left out, and reported when the program is checked.
#[pyfunction]
fn grammar_imports(py: Python<'_>, main: &str, name: &str, text: &str) -> Vec<String> {
    py.detach(|| {
        let file = parse(text, &mut Names::new()).file;
        let paths = file.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Import(import) => Some(import.path.value.to_string()),
            _ => None,
        });
        paths.filter_map(|path| beside(main, name, &path)).collect()
    })
}

#[pyfunction]
fn grammar_check(py: Python<'_>, files: Files) -> PyResult<Verdict> {
    let verdict = py.detach(|| {
        let program = program_of(&files)?;
        let checked = check(&program);
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
