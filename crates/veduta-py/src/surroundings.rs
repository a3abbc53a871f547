//! What lots put in the way of others, for Python: derived once, seen from each lot beside them.

use std::collections::HashMap;
use std::sync::Arc;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_grammar::engine::{from_place, occluders, Neighbour, Occluder};

use crate::derivation::GivenEdit;
use crate::given::Given;
use crate::grammar::{GrammarRules, Rings};
use crate::interruptible::of_each_lot;
use crate::limits::{limits_of, GrammarLimits};
use crate::lot_outcome::Failed;

/// Numbers of lots in `Surroundings`, and how far their frames lie from that of the lot beside them
/// (m, z up).
pub type Beside = Vec<(usize, [f64; 3])>;

/// The shapes that lots put in the way of others: those that the first of the two passes makes.
#[pyclass(frozen, module = "veduta._core")]
pub struct Surroundings {
    lots: Vec<Result<Arc<Vec<Occluder>>, Failed>>,
}

/// Derives what lots put in the way of others, as `derive_lots` derives them. A lot that fails puts
/// nothing there; that it takes long is no fault here.
#[pyfunction]
#[pyo3(signature = (rules, lots, seeds, *, start=None, attributes, edits, limits=None))]
#[allow(clippy::too_many_arguments)] // as Python calls it: with names
fn derive_surroundings(
    py: Python<'_>,
    rules: &GrammarRules,
    lots: Vec<Rings>,
    seeds: Vec<u64>,
    start: Option<&str>,
    attributes: Vec<HashMap<String, Given>>,
    edits: Vec<Vec<GivenEdit>>,
    limits: Option<&GrammarLimits>,
) -> PyResult<Surroundings> {
    let rule = rules.start_rule(start)?;
    let options = rules.options_of(&seeds, attributes, edits, limits_of(limits))?;
    let lots = of_each_lot(py, &lots, &options, |lot, options| {
        let start = rules.start_shape(lot, options)?;
        let shapes = occluders(&rules.code, rule, start, options);
        shapes.map(Arc::new).map_err(|fault| rules.failed(fault))
    })?;
    Ok(Surroundings { lots })
}

#[pymethods]
impl Surroundings {
    fn __len__(&self) -> usize {
        self.lots.len()
    }

    fn __repr__(&self) -> String {
        let failed = self.lots.iter().filter(|lot| lot.is_err()).count();
        format!("Surroundings(lots={}, failed={failed})", self.lots.len())
    }

    /// The asset that a lot's rules want and that is not known; None where nothing is wanted.
    fn missing_asset(&self, lot: usize) -> PyResult<Option<String>> {
        let found = self.lots.get(lot).ok_or_else(|| no_lot(lot))?;
        Ok(found
            .as_ref()
            .err()
            .and_then(|failed| failed.missing_asset.clone()))
    }
}

impl Surroundings {
    /// What stands beside a lot.
    fn seen(&self, beside: &Beside) -> PyResult<Vec<Neighbour>> {
        let mut all = Vec::with_capacity(beside.len());
        for &(lot, offset) in beside {
            let found = self.lots.get(lot).ok_or_else(|| no_lot(lot))?;
            if let Ok(shapes) = found {
                all.push(Neighbour::new(shapes.clone(), from_place(offset)));
            }
        }
        Ok(all)
    }
}

/// What stands beside each of `count` lots; nothing where nothing is given.
pub fn neighbours(
    around: Option<&Surroundings>,
    beside: Option<Vec<Beside>>,
    count: usize,
) -> PyResult<Vec<Vec<Neighbour>>> {
    let (Some(around), Some(beside)) = (around, beside) else {
        return Ok(vec![Vec::new(); count]);
    };
    if beside.len() != count {
        return Err(PyValueError::new_err("each lot needs the lots beside it"));
    }
    beside.iter().map(|one| around.seen(one)).collect()
}

fn no_lot(lot: usize) -> PyErr {
    PyValueError::new_err(format!("there is no lot {lot}"))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<Surroundings>()?;
    m.add_function(wrap_pyfunction!(derive_surroundings, m)?)
}
