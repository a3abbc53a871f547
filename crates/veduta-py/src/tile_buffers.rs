//! The buffers of a tile for Python, as bytes.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use veduta_tiles::Repeated;

use crate::tiles::{MaterialRow, TileBuffers};

type Box3 = (Point, Point);
type Point = (f64, f64, f64);
/// Material, positions, features, indices, lowest and highest position; texture coordinates.
type MergedMesh<'py> = (
    u32,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    [u16; 3],
    [u16; 3],
    Bound<'py, PyBytes>,
);
/// Material, positions, indices, lowest and highest position; translations, rotations, features,
/// scales; texture coordinates.
type RepeatedMesh<'py> = (
    u32,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    [i16; 3],
    [i16; 3],
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
);

#[pymethods]
impl TileBuffers {
    fn __repr__(&self) -> String {
        let (lots, surfaces) = (self.counts.len(), self.surfaces.class.len());
        let triangles = self.batch.triangles;
        format!("TileBuffers(lots={lots}, surfaces={surfaces}, triangles={triangles})")
    }

    /// Lower and upper corner (m, z up); None where there is nothing to draw.
    #[getter]
    fn bounds(&self) -> Option<Box3> {
        let is_some = self.batch.triangles > 0;
        is_some.then_some((self.batch.low.into(), self.batch.high.into()))
    }

    /// Where merged positions count from, and their steps (m, y-up).
    #[getter]
    fn grid(&self) -> Box3 {
        (self.batch.grid_low.into(), self.batch.grid_step.into())
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

    /// How many surfaces of each rule are none: too thin, or their lines cross.
    #[getter]
    fn dropped(&self) -> BTreeMap<String, usize> {
        let mut counts = BTreeMap::new();
        for feature in &self.batch.dropped {
            let rule = usize::from(self.surfaces.rule[*feature as usize]);
            let name = self.surfaces.rules.get(rule).cloned().unwrap_or_default();
            *counts.entry(name).or_default() += 1;
        }
        counts
    }

    /// Class, provenance, sRGB colour, opacity and number of the texture of each material.
    #[getter]
    fn materials(&self) -> Vec<MaterialRow> {
        self.materials.clone()
    }

    /// What a step of texture coordinates is, by material: shares of a texture.
    #[getter]
    fn uv_steps(&self) -> BTreeMap<u32, f64> {
        self.batch.uv_steps.clone()
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

    /// Columns of the surfaces: class (u8), building, rule, width and height in mm (u16),
    /// provenance (u8).
    #[getter]
    fn surfaces<'py>(&self, py: Python<'py>) -> [Bound<'py, PyBytes>; 6] {
        let all = &self.surfaces;
        let sixteen = |column: &[u16]| bytes(py, column.iter().map(|v| v.to_le_bytes()));
        [
            PyBytes::new(py, &all.class),
            sixteen(&all.building),
            sixteen(&all.rule),
            sixteen(&all.width_mm),
            sixteen(&all.height_mm),
            PyBytes::new(py, &all.provenance),
        ]
    }

    /// Positions are four u16 (the last is zero), features f32, indices u16 or else u32, texture
    /// coordinates two u16 or empty.
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
                bytes(py, mesh.uv.iter().map(|v| v.to_le_bytes())),
            )
        })
        .collect()
    }

    /// Positions are four i16, indices u16, translations three f32, rotations four i16, features
    /// u16 where all surfaces of the tile fit, or else f32, scales three f32 or empty, texture
    /// coordinates two u16 or empty.
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
                bytes(py, mesh.scales.iter().map(|v| v.to_le_bytes())),
                bytes(py, mesh.uv.iter().map(|v| v.to_le_bytes())),
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
