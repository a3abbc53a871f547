//! Files as they are imported: each import statement makes a file of its own of what it names, with
//! its own values, styles and extensions.

use std::collections::HashSet;

use crate::ast::{Import, ItemKind, Override};
use crate::{Checked, Definitions, Program, Role, Symbol, Variant};

/// The most files that imports may make, each counted as often as it is imported.
pub(super) const MAX_INSTANCES: usize = 4096;

/// A file as one import statement has it; the first is the main file.
#[derive(Debug, Clone, Default)]
pub(super) struct Instance {
    pub unit: usize,
    /// The instance that imports it, and the import statement in the items of its file.
    pub from: Option<(usize, usize)>,
    /// What stands before its attributes' names: `lib.`
    pub prefix: String,
    /// Its style, and those that this extends, the nearest first.
    styles: Vec<usize>,
    /// The instance that each import of the file makes, by its name.
    imports: Vec<(Symbol, usize)>,
}

impl Instance {
    /// The instance in which a dotted name ends, from `at` on; None where there is no such import.
    pub fn end_of(all: &[Self], at: usize, name: &str, program: &Program) -> Option<usize> {
        let mut at = at;
        let mut rest = name;
        while let Some((first, after)) = rest.split_once('.') {
            let id = program.names.find(first)?;
            let imports = &all[at].imports;
            at = imports.iter().find(|(name, _)| *name == id)?.1;
            rest = after;
        }
        Some(at)
    }

    /// The rule that an importing file defines for a rule of the instance `at`, as `lib.Facade`:
    /// the number of that instance and of its rule. The farthest above has the last word.
    pub fn graft(
        all: &[Self],
        at: usize,
        name: &str,
        arity: usize,
        program: &Program,
        checked: &Checked,
    ) -> Option<(usize, usize)> {
        let own = &all[at].prefix;
        let mut found = None;
        let mut above = at;
        while let Some((parent, _)) = all[above].from {
            above = parent;
            let dotted = format!("{}{name}", own.strip_prefix(&all[above].prefix)?);
            let rule = program.names.find(&dotted).and_then(|symbol| {
                let defined = &checked.definitions[all[above].unit];
                defined.rule(symbol, arity)
            });
            found = rule.map(|rule| (above, rule)).or(found);
        }
        found
    }

    /// The variant of a definition that the style takes. One that is in other styles only is
    /// that of the first of them.
    pub fn variant(&self, variants: &[Variant]) -> Variant {
        let mut wanted = self.styles.iter();
        let found = wanted.find_map(|style| variants.iter().find(|one| one.style == *style));
        *found.unwrap_or(&variants[0])
    }

    /// The import statement that made it.
    pub fn import<'a>(&self, all: &[Self], program: &'a Program) -> Option<&'a Import> {
        let (parent, item) = self.from?;
        let file = &program.units[all[parent].unit].parse.file;
        match &file.items.get(item)?.kind {
            ItemKind::Import(import) => Some(import),
            _ => None,
        }
    }

    /// The attributes that the import keeps from those of the importing file, by name; None where
    /// it keeps all.
    pub fn protected(&self, import: &Import) -> Option<HashSet<Symbol>> {
        let overrides = import.overrides.iter().flatten();
        let names = overrides.filter_map(|one| match one {
            Override::Protect(name) | Override::Value { name, .. } => Some(name.symbol),
            Override::Rule { .. } => None,
        });
        match &import.overrides {
            Some(all) if all.is_empty() => None,
            _ => Some(names.collect()),
        }
    }
}

/// All instances of a program, those that import before those that they import; None where there
/// are more than [`MAX_INSTANCES`]. `style` is that of the main file.
pub(super) fn instances(
    program: &Program,
    checked: &Checked,
    style: usize,
) -> Option<Vec<Instance>> {
    let mut all = vec![Instance {
        styles: chain(&checked.definitions[0], style),
        ..Instance::default()
    }];
    let mut next = 0;
    while next < all.len() {
        let unit = all[next].unit;
        for link in &program.units[unit].imports {
            let Some(target) = link.unit else {
                continue;
            };
            if all.len() >= MAX_INSTANCES {
                return None;
            }
            let id = program.names.text(link.id);
            let mut made = Instance {
                unit: target,
                from: Some((next, link.item)),
                prefix: format!("{}{id}.", all[next].prefix),
                ..Instance::default()
            };
            let defined = &checked.definitions[target];
            let import = made.import(&all, program);
            let named = import.and_then(|import| import.styles.as_ref()?.first());
            let style = named.and_then(|name| defined.style(name.symbol, &program.names));
            made.styles = chain(defined, style.unwrap_or(0));
            let number = all.len();
            all[next].imports.push((link.id, number));
            all.push(made);
        }
        next += 1;
    }
    Some(all)
}

/// A style and those that it extends; the last is `Default`.
fn chain(defined: &Definitions, style: usize) -> Vec<usize> {
    let mut found = vec![style];
    let mut at = style;
    while at != 0 {
        at = defined.styles.get(at).map_or(0, |one| one.base);
        found.push(at);
    }
    found
}

/// The number of the attribute of a name among the values of a file.
pub(super) fn attribute(defined: &Definitions, name: Symbol) -> Option<usize> {
    let index = defined.value(name, 0)?;
    (defined.values[index].role == Role::Attr).then_some(index)
}
