//! `veduta_tiles` for Python: lots in, the buffers of tiles out as bytes.

use std::collections::HashMap;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use veduta_tiles::{batch, Batch, Building, Repeated};

use crate::city::city;
use crate::grammar::{limits_of, Derived, Given, GrammarRules, Rings};

/// Lots that were derived and stay on this side: columns are made for what is asked.
#[pyclass(frozen, module = "veduta._core")]
pub(crate) struct DerivedLots {
    pub lots: Vec<Result<Derived, String>>,
}

/// Derives lots as `GrammarRules.derive` does.
#[pyfunction]
#[pyo3(signature = (rules, lots, seeds, *, start=None, attributes, seconds=60.0, shapes=5_000_000))]
#[allow(clippy::too_many_arguments)] // as Python calls it: with names
fn derive_lots(
    py: Python<'_>,
    rules: &GrammarRules,
    lots: Vec<Rings>,
    seeds: Vec<u64>,
    start: Option<&str>,
    attributes: Vec<HashMap<String, Given>>,
    seconds: f64,
    shapes: usize,
) -> PyResult<DerivedLots> {
    let rule = rules.start_rule(start)?;
    if seeds.len() != lots.len() || attributes.len() != lots.len() {
        return Err(PyValueError::new_err(
            "each lot needs a seed and attributes",
        ));
    }
    let limits = limits_of(seconds, shapes);
    let mut found = Vec::with_capacity(lots.len());
    let mut given = attributes.into_iter();
    for (some, seeds) in lots.chunks(AT_ONCE).zip(seeds.chunks(AT_ONCE)) {
        let given: Vec<_> = given.by_ref().take(some.len()).collect();
        found.extend(py.detach(|| rules.all(some, seeds, given, rule, limits)));
        py.check_signals()?;
    }
    Ok(DerivedLots { lots: found })
}

/// Lots that are derived before Ctrl-C is heard.
const AT_ONCE: usize = 4;
/// Red, green and blue, sRGB, 0 to 1.
type Colour = [f32; 3];

#[pymethods]
impl DerivedLots {
    fn __len__(&self) -> usize {
        self.lots.len()
    }

    /// Why a lot has no shapes; None where it has.
    fn fault(&self, lot: usize) -> PyResult<Option<String>> {
        Ok(self.lot(lot)?.as_ref().err().cloned())
    }

    /// What the rules said of a lot.
    fn messages(&self, lot: usize) -> PyResult<Vec<String>> {
        let found = self.lot(lot)?.as_ref();
        Ok(found
            .map(|derived| derived.messages.clone())
            .unwrap_or_default())
    }

    /// Lower and upper corner (m, z up) about the lot's anchor, and how many polygons there are;
    /// None where nothing is left.
    fn extent(&self, lot: usize) -> PyResult<Option<([f64; 3], [f64; 3], usize)>> {
        let Ok(derived) = self.lot(lot)?.as_ref() else {
            return Ok(None);
        };
        let points = &derived.packed.positions;
        let Some(&first) = points.first() else {
            return Ok(None);
        };
        let (mut low, mut high) = (first, first);
        for point in points {
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let is_finite = low.iter().chain(&high).all(|c| c.abs() < 1e6);
        let polygons = derived.packed.polygon_feature.len();
        Ok(is_finite.then_some((low, high, polygons)))
    }

    /// The sRGB colour that most leaves of a class have; None where there is no such class.
    fn colour(&self, lot: usize, class: &str) -> PyResult<Option<Colour>> {
        let Ok(derived) = self.lot(lot)?.as_ref() else {
            return Ok(None);
        };
        let mut counts = vec![0usize; derived.packed.looks.len()];
        for &look in &derived.packed.feature_look {
            counts[look as usize] += 1;
        }
        let looks = derived.packed.looks.iter().zip(counts);
        let own = looks.filter(|(look, _)| look.class.as_ref() == class);
        Ok(own
            .max_by_key(|(_, count)| *count)
            .map(|(look, _)| look.colour))
    }

    /// Geometry, installations (class, rule, geometry) and vertices (mm) of a lot at its place, as
    /// texts of CityJSON; `kinds` has the semantic surface of each class, "" for installations.
    fn city(
        &self,
        py: Python<'_>,
        lot: usize,
        place: [f64; 3],
        classes: Vec<String>,
        kinds: Vec<String>,
    ) -> PyResult<(String, Vec<(u8, String, String)>, String)> {
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
        let made = py.detach(|| city(derived, place, &kinds, code));
        let text = made.map_err(PyValueError::new_err)?;
        Ok((text.body, text.installations, text.vertices))
    }

    /// The buffers of a tile with these lots, each at its place (m, z up); `classes` are the
    /// classes that are known, the last of them for all others.
    fn tile(
        &self,
        py: Python<'_>,
        lots: Vec<usize>,
        places: Vec<[f64; 3]>,
        classes: Vec<String>,
    ) -> PyResult<TileBuffers> {
        let mut chosen = Vec::new();
        for &lot in &lots {
            let Ok(derived) = self.lot(lot)?.as_ref() else {
                return Err(PyValueError::new_err("a lot that failed has no tile"));
            };
            chosen.push(derived);
        }
        if places.len() != lots.len() || classes.is_empty() {
            return Err(PyValueError::new_err("each lot needs a place"));
        }
        py.detach(|| tile(&chosen, &places, &classes))
            .map_err(PyValueError::new_err)
    }
}

impl DerivedLots {
    fn lot(&self, lot: usize) -> PyResult<&Result<Derived, String>> {
        let missing = || PyValueError::new_err(format!("there is no lot {lot}"));
        self.lots.get(lot).ok_or_else(missing)
    }
}

/// A surface without a size that 16 bits hold in millimetres.
const NO_SIZE: u16 = u16::MAX;

/// The surfaces of a tile as columns.
#[derive(Default)]
struct Surfaces {
    class: Vec<u8>,
    building: Vec<u16>,
    rule: Vec<u16>,
    width_mm: Vec<u16>,
    height_mm: Vec<u16>,
    rules: Vec<String>,
}

/// The columns of the buildings that go into a tile.
#[derive(Default)]
struct Columns {
    feature: Vec<u32>,
    material: Vec<u32>,
    piece: Vec<u32>,
    part: Vec<u32>,
}

/// The buffers of one tile.
#[pyclass(frozen, module = "veduta._core")]
struct TileBuffers {
    batch: Batch,
    surfaces: Surfaces,
    /// Class and colour.
    materials: Vec<(u8, [f32; 3])>,
    /// Surfaces of each class, by lot.
    counts: Vec<Vec<u32>>,
}

fn tile(lots: &[&Derived], places: &[[f64; 3]], classes: &[String]) -> Result<TileBuffers, String> {
    let mut surfaces = Surfaces::default();
    let mut materials = Materials::default();
    let mut rules = HashMap::new();
    let code_of: HashMap<&str, u8> = classes.iter().map(String::as_str).zip(0..).collect();
    let other = (classes.len() - 1) as u8;
    let code = |name: &str| code_of.get(name).copied().unwrap_or(other);
    let mut counts = Vec::new();
    let mut all = Vec::new();
    for (number, lot) in lots.iter().enumerate() {
        let first = surfaces.class.len() as u32;
        let mut count = vec![0; classes.len()];
        for (row, name) in lot.names.iter().enumerate() {
            let class = code(&lot.surfaces.class[row]);
            count[usize::from(class)] += 1;
            surfaces.class.push(class);
            surfaces.building.push(number as u16);
            let next = rules.len();
            let rule = *rules.entry(name.as_str()).or_insert(next);
            surfaces.rule.push(rule.min(usize::from(u16::MAX)) as u16);
            let [width, height] = lot.surfaces.size[row];
            surfaces.width_mm.push(millimetres(width));
            surfaces.height_mm.push(millimetres(height));
        }
        counts.push(count);
        let looks: Vec<u32> = lot
            .packed
            .looks
            .iter()
            .map(|look| materials.number(code(&look.class), look.colour))
            .collect();
        let leaves = &lot.packed.polygon_feature;
        let of = |column: &[u32]| leaves.iter().map(|&leaf| column[leaf as usize]).collect();
        all.push(Columns {
            feature: leaves
                .iter()
                .map(|&leaf| first + lot.surfaces.of_feature[leaf as usize])
                .collect(),
            material: leaves
                .iter()
                .map(|&leaf| looks[lot.packed.feature_look[leaf as usize] as usize])
                .collect(),
            piece: of(&lot.pieces),
            part: leaves.iter().map(|&leaf| leaf as u32).collect(),
        });
    }
    let mut named: Vec<(&str, usize)> = rules.into_iter().collect();
    named.sort_by_key(|(_, number)| *number);
    surfaces.rules = named
        .into_iter()
        .map(|(name, _)| name.to_string())
        .collect();
    let buildings: Vec<Building<'_>> = lots
        .iter()
        .zip(&all)
        .zip(places)
        .map(|((lot, columns), &offset)| Building {
            positions: &lot.packed.positions,
            ring_offsets: &lot.packed.ring_offsets,
            polygon_offsets: &lot.packed.polygon_offsets,
            feature: &columns.feature,
            material: &columns.material,
            piece: &columns.piece,
            part: &columns.part,
            offset,
        })
        .collect();
    let batch = batch(&buildings).map_err(|error| error.to_string())?;
    Ok(TileBuffers {
        batch,
        surfaces,
        materials: materials.rows,
        counts,
    })
}

fn millimetres(size_m: f64) -> u16 {
    let size = (size_m * 1000.0).round();
    if size.is_finite() && (0.0..f64::from(NO_SIZE)).contains(&size) {
        size as u16
    } else {
        NO_SIZE
    }
}

/// Looks that are told apart: of another class, or of another colour of 8 bits.
#[derive(Default)]
struct Materials {
    rows: Vec<(u8, [f32; 3])>,
    known: HashMap<(u8, [u8; 3]), u32>,
}

impl Materials {
    fn number(&mut self, class: u8, colour: [f32; 3]) -> u32 {
        let bytes = colour.map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8);
        let next = self.rows.len() as u32;
        let number = *self.known.entry((class, bytes)).or_insert(next);
        if number == next {
            self.rows.push((class, bytes.map(|c| f32::from(c) / 255.0)));
        }
        number
    }
}

type Box3 = ([f64; 3], [f64; 3]);
/// Material, positions, features, indices, lowest and highest position.
type MergedMesh<'py> = (
    u32,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    [u16; 3],
    [u16; 3],
);
/// Material, positions, indices, lowest and highest position; translations, rotations, features.
type RepeatedMesh<'py> = (
    u32,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    [i16; 3],
    [i16; 3],
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
);

#[pymethods]
impl TileBuffers {
    /// Lower and upper corner (m, z up); None where there is nothing to draw.
    #[getter]
    fn bounds(&self) -> Option<Box3> {
        let is_some = self.batch.triangles > 0;
        is_some.then_some((self.batch.low, self.batch.high))
    }

    /// Where merged positions count from, and their steps (m, y-up).
    #[getter]
    fn grid(&self) -> Box3 {
        (self.batch.grid_low, self.batch.grid_step)
    }

    /// Metres of a step of repeated positions.
    #[getter]
    fn step_m(&self) -> f64 {
        Repeated::step_m()
    }

    #[getter]
    fn triangles(&self) -> usize {
        self.batch.triangles
    }

    #[getter]
    fn dropped(&self) -> usize {
        self.batch.dropped
    }

    /// Class and sRGB colour of each material.
    #[getter]
    fn materials(&self) -> Vec<(u8, [f32; 3])> {
        self.materials.clone()
    }

    /// Surfaces of each class, by lot.
    #[getter]
    fn counts(&self) -> Vec<Vec<u32>> {
        self.counts.clone()
    }

    /// The names of the rules that surfaces come from.
    #[getter]
    fn rules(&self) -> Vec<String> {
        self.surfaces.rules.clone()
    }

    /// Columns of the surfaces: class (u8), building, rule, width and height in mm (u16).
    #[getter]
    fn surfaces<'py>(&self, py: Python<'py>) -> [Bound<'py, PyBytes>; 5] {
        let all = &self.surfaces;
        let sixteen = |column: &[u16]| bytes(py, column.iter().map(|v| v.to_le_bytes()));
        [
            PyBytes::new(py, &all.class),
            sixteen(&all.building),
            sixteen(&all.rule),
            sixteen(&all.width_mm),
            sixteen(&all.height_mm),
        ]
    }

    /// Positions are four u16 (the last is zero), features f32, indices u16 or else u32.
    #[getter]
    fn merged<'py>(&self, py: Python<'py>) -> Vec<MergedMesh<'py>> {
        let each = self.batch.merged.iter();
        each.map(|mesh| {
            let (low, high) = extremes(&mesh.positions);
            (
                mesh.material,
                bytes(py, mesh.positions.iter().map(|v| v.to_le_bytes())),
                bytes(py, mesh.features.iter().map(|v| (*v as f32).to_le_bytes())),
                indices(py, &mesh.indices, mesh.features.len()),
                low,
                high,
            )
        })
        .collect()
    }

    /// Positions are four i16, indices u16, translations three f32, rotations four i16, features
    /// u16 where all surfaces of the tile fit, or else f32.
    #[getter]
    fn repeated<'py>(&self, py: Python<'py>) -> Vec<RepeatedMesh<'py>> {
        let is_small = self.surfaces.class.len() <= usize::from(u16::MAX);
        let each = self.batch.repeated.iter();
        each.map(|mesh| {
            let (low, high) = extremes(&mesh.positions);
            let features = if is_small {
                bytes(py, mesh.features.iter().map(|v| (*v as u16).to_le_bytes()))
            } else {
                bytes(py, mesh.features.iter().map(|v| (*v as f32).to_le_bytes()))
            };
            (
                mesh.material,
                bytes(py, mesh.positions.iter().map(|v| v.to_le_bytes())),
                bytes(py, mesh.indices.iter().map(|v| v.to_le_bytes())),
                low,
                high,
                bytes(py, mesh.translations.iter().map(|v| v.to_le_bytes())),
                bytes(py, mesh.rotations.iter().map(|v| v.to_le_bytes())),
                features,
            )
        })
        .collect()
    }
}

fn indices<'py>(py: Python<'py>, all: &[u32], vertices: usize) -> Bound<'py, PyBytes> {
    if vertices <= usize::from(u16::MAX) {
        bytes(py, all.iter().map(|v| (*v as u16).to_le_bytes()))
    } else {
        bytes(py, all.iter().map(|v| v.to_le_bytes()))
    }
}

fn bytes<const N: usize>(
    py: Python<'_>,
    words: impl Iterator<Item = [u8; N]>,
) -> Bound<'_, PyBytes> {
    let content: Vec<u8> = words.flatten().collect();
    PyBytes::new(py, &content)
}

fn extremes<T: Copy + Ord + Default>(positions: &[T]) -> ([T; 3], [T; 3]) {
    let mut corners = positions.chunks_exact(4);
    let start = corners
        .next()
        .map_or([T::default(); 3], |p| [p[0], p[1], p[2]]);
    corners.fold((start, start), |(mut low, mut high), p| {
        for axis in 0..3 {
            low[axis] = low[axis].min(p[axis]);
            high[axis] = high[axis].max(p[axis]);
        }
        (low, high)
    })
}

/// A column as EXT_meshopt_compression has it, mode ATTRIBUTES; `stride` in bytes.
#[pyfunction]
fn compress_attributes(py: Python<'_>, data: &[u8], stride: usize) -> PyResult<Py<PyBytes>> {
    let found = py.detach(|| veduta_tiles::compress_attributes(data, stride));
    let bad = || PyValueError::new_err("the stride is no multiple of four, or cuts an element");
    Ok(PyBytes::new(py, &found.ok_or_else(bad)?).unbind())
}

/// The same for whole numbers of `stride` bytes (2 or 4), mode INDICES.
#[pyfunction]
fn compress_indices(py: Python<'_>, data: &[u8], stride: usize) -> PyResult<Py<PyBytes>> {
    if !(stride == 2 || stride == 4) || data.len() % stride != 0 {
        return Err(PyValueError::new_err("indices have two or four bytes"));
    }
    let made = py.detach(|| {
        let each = data.chunks_exact(stride).map(|word| {
            let bytes = word.iter().rev();
            bytes.fold(0u32, |number, byte| (number << 8) | u32::from(*byte))
        });
        veduta_tiles::compress_indices(each)
    });
    Ok(PyBytes::new(py, &made).unbind())
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<DerivedLots>()?;
    m.add_class::<TileBuffers>()?;
    m.add_function(wrap_pyfunction!(compress_attributes, m)?)?;
    m.add_function(wrap_pyfunction!(compress_indices, m)?)?;
    m.add_function(wrap_pyfunction!(derive_lots, m)?)
}
