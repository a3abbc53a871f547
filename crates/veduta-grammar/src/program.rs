//! A rule file with the files that it imports.

use std::collections::HashMap;

use crate::ast::{Import, ItemKind};
use crate::limits::MAX_FILES;
use crate::{parse, Diagnostic, Names, Parse, Source, Span, Symbol};

/// Files that belong together: the first one, and those that it imports. Each file is there once,
/// however often it is imported.
#[derive(Debug, Default)]
pub struct Program {
    pub names: Names,
    pub units: Vec<Unit>,
}

/// One file of a program.
#[derive(Debug)]
pub struct Unit {
    pub source: Source,
    pub parse: Parse,
    /// In the order of the import statements.
    pub imports: Vec<Link>,
    /// Imports that could not be had, by their place in `imports`, and why.
    pub missing: Vec<(usize, Diagnostic)>,
}

/// An import statement and the file that it names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    pub id: Symbol,
    /// The index of the statement in the items of its file.
    pub item: usize,
    /// The index of the imported file; `None` where it could not be had.
    pub unit: Option<usize>,
    path: Span,
}

impl Program {
    /// Parses `main` and all that it imports. `fetch` gets the path of an import as it is written
    /// and the file in which it stands, and gives the file, or why there is none; files of the
    /// same name are taken for the same file.
    pub fn load(
        main: Source,
        mut fetch: impl FnMut(&str, &Source) -> Result<Source, String>,
    ) -> Program {
        let mut program = Program::default();
        let mut known = HashMap::from([(main.name().to_string(), 0)]);
        program.add(main);
        let mut next = 0;
        while next < program.units.len() {
            program.link(next, &mut known, &mut fetch);
            next += 1;
        }
        program.report_cycles();
        program
    }

    /// A program of one file, whose imports are not looked for.
    pub fn single(main: Source) -> Program {
        Self::load(main, |_, _| Err("imports are not read here".to_string()))
    }

    fn add(&mut self, source: Source) {
        let parse = parse(source.text(), &mut self.names);
        self.units.push(Unit {
            source,
            parse,
            imports: Vec::new(),
            missing: Vec::new(),
        });
    }

    fn link(
        &mut self,
        unit: usize,
        known: &mut HashMap<String, usize>,
        fetch: &mut impl FnMut(&str, &Source) -> Result<Source, String>,
    ) {
        let items = self.units[unit].parse.file.items.iter().enumerate();
        let statements: Vec<(usize, Import)> = items
            .filter_map(|(index, item)| match &item.kind {
                ItemKind::Import(import) => Some((index, import.clone())),
                _ => None,
            })
            .collect();
        for (item, import) in statements {
            if self.units[unit].imports.len() >= MAX_FILES {
                let message = format!("{MAX_FILES} imports are the most");
                let fault = Diagnostic::error(import.id.span, message);
                return self.units[unit].parse.diagnostics.push(fault);
            }
            let found = self.find(unit, &import, known, fetch);
            let target = found.unwrap_or_else(|reason| {
                let message = format!("cannot import `{}`: {reason}", import.path.value);
                let fault = Diagnostic::error(import.path.span, message);
                let at = self.units[unit].imports.len();
                self.units[unit].missing.push((at, fault));
                None
            });
            self.units[unit].imports.push(Link {
                id: import.id.symbol,
                item,
                unit: target,
                path: import.path.span,
            });
        }
    }

    fn find(
        &mut self,
        unit: usize,
        import: &Import,
        known: &mut HashMap<String, usize>,
        fetch: &mut impl FnMut(&str, &Source) -> Result<Source, String>,
    ) -> Result<Option<usize>, String> {
        let source = fetch(&import.path.value, &self.units[unit].source)?;
        if let Some(index) = known.get(source.name()) {
            return Ok(Some(*index));
        }
        if self.units.len() >= MAX_FILES {
            return Err(format!("{MAX_FILES} files are the most"));
        }
        known.insert(source.name().to_string(), self.units.len());
        self.add(source);
        Ok(Some(self.units.len() - 1))
    }

    /// A file that imports itself, over others or not, could not be evaluated.
    fn report_cycles(&mut self) {
        let reached: Vec<Vec<bool>> = (0..self.units.len()).map(|one| self.reach(one)).collect();
        for (unit, file) in self.units.iter_mut().enumerate() {
            for link in &file.imports {
                if link.unit.is_some_and(|target| reached[target][unit]) {
                    let fault = Diagnostic::error(link.path, "this import leads back to this file");
                    file.parse.diagnostics.push(fault);
                }
            }
        }
    }

    /// For each file whether imports lead to it from the file `from`, which reaches itself.
    fn reach(&self, from: usize) -> Vec<bool> {
        let mut reached = vec![false; self.units.len()];
        let mut open = vec![from];
        while let Some(unit) = open.pop() {
            if !std::mem::replace(&mut reached[unit], true) {
                open.extend(self.units[unit].imports.iter().filter_map(|link| link.unit));
            }
        }
        reached
    }
}
