//! What rules make of one lot, and how a fault in it is told.

use pyo3::PyErr;
use veduta_grammar::engine::{derive, lot_form, Fault, Options, State};

use crate::derived_lot::{derived_of, Derived};
use crate::grammar::{AssetWanted, GrammarFault, GrammarRules, Rings};
use crate::limits::option_of;

/// Why there is nothing, and the asset that is wanted where one is.
#[derive(Debug, Clone)]
pub struct Failed {
    pub why: String,
    pub missing_asset: Option<String>,
}

impl GrammarRules {
    /// What the rules make of a lot.
    pub fn one(&self, lot: &Rings, options: &Options, rule: usize) -> Result<Derived, Failed> {
        let start = self.start_shape(lot, options)?;
        let tree = derive(&self.code, rule, start, options);
        let tree = tree.map_err(|fault| self.failed(fault))?;
        Ok(derived_of(&tree, &self.code))
    }

    /// The shape that a lot's derivation starts with.
    pub fn start_shape(&self, lot: &Rings, options: &Options) -> Result<State, Failed> {
        let form = lot_form(lot).ok_or_else(|| Failed {
            why: "the lot encloses nothing".to_string(),
            missing_asset: None,
        })?;
        Ok(State::new(form, (options.seed & 0xffff_ffff) as u32))
    }

    pub fn failed(&self, fault: Fault) -> Failed {
        Failed {
            why: self.told(&fault),
            missing_asset: fault.missing_asset.map(|name| name.to_string()),
        }
    }

    /// A fault with its place in the file, and the option that would allow more.
    pub fn told(&self, fault: &Fault) -> String {
        let source = &self.sources[fault.unit.unwrap_or(0)];
        let place = source.position(fault.span.start);
        let (name, message) = (source.name(), &fault.message);
        let told = format!("{name}:{}:{}: {message}", place.line, place.column);
        match fault.over {
            Some(limit) => format!("{told}; {} allows more", option_of(limit)),
            None => told,
        }
    }

    /// A fault as Python has it: with the name of the asset where one is wanted.
    pub fn raised(&self, fault: &Fault) -> PyErr {
        match &fault.missing_asset {
            Some(name) => AssetWanted::new_err((self.told(fault), name.to_string())),
            None => GrammarFault::new_err(self.told(fault)),
        }
    }
}
