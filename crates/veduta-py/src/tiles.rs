//! `veduta_tiles` for Python: derived lots in, the buffers of a tile out as bytes.

use std::collections::HashMap;

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use veduta_tiles::{batch, Batch, Building, Repeated};

use crate::grammar::Derived;

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
pub(crate) struct TileBuffers {
    batch: Batch,
    surfaces: Surfaces,
    /// Class and colour.
    materials: Vec<(u8, [f32; 3])>,
    /// Surfaces of each class, by lot.
    counts: Vec<Vec<u32>>,
}

/// The tile of some lots at their places (m, z up); `classes` as `DerivedLots.tile` has them.
pub(crate) fn tile(
    lots: &[&Derived],
    places: &[[f64; 3]],
    classes: &[String],
) -> Result<TileBuffers, String> {
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

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<TileBuffers>()
}
