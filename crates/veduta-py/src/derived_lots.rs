//! Lots that were derived and stay on this side, for tiles and for CityJSON.

use std::collections::HashMap;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::city::city;
use crate::derivation::GivenEdit;
use crate::derived_lot::{lot_to_python, Derived, DerivedLot};
use crate::given::{Given, GivenBack};
use crate::grammar::{GrammarRules, Rings};
use crate::interruptible::of_each_lot;
use crate::limits::{limits_of, GrammarLimits};
use crate::lot_outcome::Failed;
use crate::standing::box_of;
use crate::surroundings::{neighbours, Beside, Surroundings};
use crate::tiles::{tile, Codes, Textures, TileBuffers};

/// Lots that were derived and stay on this side: columns are made for what is asked.
#[pyclass(frozen, module = "veduta._core")]
pub struct DerivedLots {
    lots: Vec<Result<Derived, Failed>>,
}

/// Derives lots as `GrammarRules.derive` does. `beside`: per lot, which lots of `around` stand beside
/// it, and how far their frames lie from its own (m, z up).
#[pyfunction]
#[pyo3(signature = (rules, lots, seeds, *, start=None, attributes, edits, around=None, beside=None, limits=None))]
#[allow(clippy::too_many_arguments)] // as Python calls it: with names
fn derive_lots(
    py: Python<'_>,
    rules: &GrammarRules,
    lots: Vec<Rings>,
    seeds: Vec<u64>,
    start: Option<&str>,
    attributes: Vec<HashMap<String, Given>>,
    edits: Vec<Vec<GivenEdit>>,
    around: Option<&Surroundings>,
    beside: Option<Vec<Beside>>,
    limits: Option<&GrammarLimits>,
) -> PyResult<DerivedLots> {
    let rule = rules.start_rule(start)?;
    let limits = limits_of(limits);
    let mut options = rules.options_of(&seeds, attributes, edits, limits)?;
    let beside = neighbours(around, beside, lots.len())?;
    for (options, beside) in options.iter_mut().zip(beside) {
        options.neighbours = beside;
    }
    let lots = of_each_lot(py, &lots, &options, |lot, options| {
        rules.one(lot, options, rule)
    })?;
    Ok(DerivedLots { lots })
}

/// Red, green and blue, sRGB, 0 to 1.
type Colour = (f32, f32, f32);
/// Lower and upper corner, and how much there is.
type Extent = (Point, Point, usize);
type Point = (f64, f64, f64);
/// Geometry, installations, vertices.
type CityTexts = (String, Vec<(u8, String, String, String)>, String, CityLooks);
/// Pictures (number, tint of sRGB) in order, `materials`, `vertices-texture`.
type CityLooks = (Vec<(u32, (u8, u8, u8))>, String, String);

#[pymethods]
impl DerivedLots {
    fn __len__(&self) -> usize {
        self.lots.len()
    }

    fn __repr__(&self) -> String {
        let failed = self.lots.iter().filter(|lot| lot.is_err()).count();
        format!("DerivedLots(lots={}, failed={failed})", self.lots.len())
    }

    /// Why a lot has no shapes; None where it has.
    fn fault(&self, lot: usize) -> PyResult<Option<String>> {
        let failed = self.lot(lot)?.as_ref().err();
        Ok(failed.map(|failed| failed.why.clone()))
    }

    /// The asset that a lot's rules want and that is not known; None where nothing is wanted.
    fn missing_asset(&self, lot: usize) -> PyResult<Option<String>> {
        let failed = self.lot(lot)?.as_ref().err();
        Ok(failed.and_then(|failed| failed.missing_asset.clone()))
    }

    /// Path and fault of each edit of a lot that could not be done.
    fn edit_faults(&self, lot: usize) -> PyResult<Vec<(Vec<u32>, String)>> {
        let found = self.lot(lot)?.as_ref();
        Ok(found
            .map(|derived| derived.edit_faults.clone())
            .unwrap_or_default())
    }

    /// The columns of a lot.
    fn columns<'py>(&self, py: Python<'py>, lot: usize) -> PyResult<Bound<'py, DerivedLot>> {
        match self.lot(lot)? {
            Ok(derived) => lot_to_python(py, derived.clone()),
            Err(failed) => Err(PyValueError::new_err(failed.why.clone())),
        }
    }

    /// What the rules said of a lot.
    fn messages(&self, lot: usize) -> PyResult<Vec<String>> {
        let found = self.lot(lot)?.as_ref();
        Ok(found
            .map(|derived| derived.messages.clone())
            .unwrap_or_default())
    }

    /// What the rules reported of a lot by its key: the sum of numbers, of all else the last.
    fn reports(&self, lot: usize) -> PyResult<Vec<(String, GivenBack)>> {
        let found = self.lot(lot)?.as_ref();
        let all = found.map(|derived| derived.reports.as_slice());
        let all = all.unwrap_or_default().iter();
        Ok(all
            .map(|(key, value)| (key.to_string(), value.into()))
            .collect())
    }

    /// Lower and upper corner (m, z up) about the lot's anchor, and how many polygons and assets
    /// there are; None where nothing is left.
    fn extent(&self, lot: usize) -> PyResult<Option<Extent>> {
        let Ok(derived) = self.lot(lot)?.as_ref() else {
            return Ok(None);
        };
        let (low, high) = box_of(&derived.packed);
        let is_finite = low.iter().chain(&high).all(|c| c.abs() < 1e6);
        let own = derived.packed.polygon_feature.len();
        let polygons = own + derived.packed.instance_feature.len();
        Ok(is_finite.then_some((low.into(), high.into(), polygons)))
    }

    /// The sRGB colour that most leaves of a class have, with the mean colours of textures; None
    /// where there is no such class.
    #[pyo3(signature = (lot, kind, textures=Vec::new()))]
    fn colour(
        &self,
        lot: usize,
        kind: &str,
        textures: Vec<(String, [f32; 3])>,
    ) -> PyResult<Option<Colour>> {
        let Ok(derived) = self.lot(lot)?.as_ref() else {
            return Ok(None);
        };
        let mut counts = vec![0usize; derived.packed.looks.len()];
        for &look in &derived.packed.feature_look {
            counts[look as usize] += 1;
        }
        let looks = derived.packed.looks.iter().zip(counts);
        let own = looks.filter(|(look, _)| look.class.as_ref() == kind);
        Ok(own.max_by_key(|(_, count)| *count).map(|(look, _)| {
            let named = textures;
            Textures {
                named,
                shown: false,
            }
            .seen(look)
            .0
            .into()
        }))
    }

    /// Geometry, installations (class, rule, colour, geometry), vertices (mm) and looks (pictures with
    /// their tints, `materials`, `vertices-texture`) of a lot at its place, as texts of CityJSON; `kinds` has the semantic surface of each class, "" for installations.
    /// `textures` have their mean colours (sRGB). `volumes`: the same lots at their lowest level of detail, whose closed volumes become further
    /// geometries of LoD 1.2 and 2.2.
    #[pyo3(signature = (lot, place, classes, kinds, textures=Vec::new(), volumes=None))]
    #[allow(clippy::too_many_arguments)] // as Python calls it
    fn city(
        &self,
        py: Python<'_>,
        lot: usize,
        place: [f64; 3],
        classes: Vec<String>,
        kinds: Vec<String>,
        textures: Vec<(String, [f32; 3])>,
        volumes: Option<&DerivedLots>,
    ) -> PyResult<CityTexts> {
        let Ok(derived) = self.lot(lot)?.as_ref() else {
            return Err(PyValueError::new_err("a lot that failed has no surfaces"));
        };
        if classes.is_empty() || classes.len() != kinds.len() {
            return Err(PyValueError::new_err("each class needs a kind"));
        }
        let other = classes.len() - 1;
        let code = |name: &str| {
            let found = classes.iter().position(|class| class == name);
            found.unwrap_or(other) as u8
        };
        let volume = match volumes {
            Some(volumes) => volumes.lot(lot)?.as_ref().ok(),
            None => None,
        };
        let textures = Textures {
            named: textures,
            shown: false,
        };
        let made = py.detach(|| city(derived, volume, place, &kinds, &textures, code));
        let text = made.map_err(PyValueError::new_err)?;
        let tinted = text.textures.into_iter();
        let tinted = tinted.map(|(number, [r, g, b])| (number, (r, g, b)));
        let looks = (tinted.collect(), text.materials, text.corners);
        Ok((text.body, text.installations, text.vertices, looks))
    }

    /// The buffers of a tile with these lots, each at its place (m, z up); `classes` and
    /// `provenances` are those that are known, the last of them for all others. `textures` have
    /// their mean colours (sRGB); a tile that is not `mapped` has these instead. In one that is
    /// `whole`, the cells of a surface are one face, without cracks between them.
    #[pyo3(signature = (lots, places, classes, provenances, textures=Vec::new(), *, mapped=false, whole=false))]
    #[allow(clippy::too_many_arguments)] // as Python calls it
    fn tile(
        &self,
        py: Python<'_>,
        lots: Vec<usize>,
        places: Vec<[f64; 3]>,
        classes: Vec<String>,
        provenances: Vec<String>,
        textures: Vec<(String, [f32; 3])>,
        mapped: bool,
        whole: bool,
    ) -> PyResult<TileBuffers> {
        let mut chosen = Vec::new();
        for &lot in &lots {
            let Ok(derived) = self.lot(lot)?.as_ref() else {
                return Err(PyValueError::new_err("a lot that failed has no tile"));
            };
            chosen.push(derived);
        }
        if places.len() != lots.len() || classes.is_empty() || provenances.is_empty() {
            return Err(PyValueError::new_err("each lot needs a place"));
        }
        let codes = Codes {
            classes,
            provenances,
        };
        let textures = Textures {
            named: textures,
            shown: mapped,
        };
        py.detach(|| tile(&chosen, &places, &codes, &textures, whole))
            .map_err(PyValueError::new_err)
    }
}

impl DerivedLots {
    fn lot(&self, lot: usize) -> PyResult<&Result<Derived, Failed>> {
        let missing = || PyValueError::new_err(format!("there is no lot {lot}"));
        self.lots.get(lot).ok_or_else(missing)
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<DerivedLots>()?;
    m.add_function(wrap_pyfunction!(derive_lots, m)?)
}
