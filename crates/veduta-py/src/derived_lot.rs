//! What was derived of one lot, for Python: columns.

use std::collections::HashMap;
use std::sync::Arc;

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;
use veduta_grammar::engine::{pack, pieces, surfaces, Code, Packed, Surfaces, Tree, Value};
use veduta_grammar::shape::Asset;

use crate::assets::MissingAsset;
use crate::derivation::edit_faults;
use crate::lot_outcome::Failed;

/// Polygons of a piece that may be repeated: a window has some dozens.
const MOST_IN_PIECE: u32 = 96;

#[derive(Clone)]
pub struct Derived {
    pub packed: Packed,
    pub surfaces: Surfaces,
    /// Leaves that rules may have made several times together, by packed feature.
    pub pieces: Vec<u32>,
    pub names: Vec<String>,
    pub log_prior: f64,
    pub messages: Vec<String>,
    pub reports: Vec<(Arc<str>, Value)>,
    pub edit_faults: Vec<(Vec<u32>, String)>,
}

/// The columns of the leaves of a tree.
pub fn derived_of(tree: &Tree, code: &Code) -> Derived {
    let packed = pack(tree);
    let surfaces = surfaces(tree, &packed, code);
    let name = |&node: &u32| tree.nodes[node as usize].name.to_string();
    Derived {
        names: surfaces.node.iter().map(name).collect(),
        pieces: pieces(tree, &packed, &surfaces, MOST_IN_PIECE),
        packed,
        surfaces,
        log_prior: tree.log_prior,
        messages: tree.messages.clone(),
        reports: reports_by_key(&tree.reports),
        edit_faults: edit_faults(tree),
    }
}

/// What was reported under each key, in the order of their first values: the sum of numbers, of all
/// else the last.
fn reports_by_key(reports: &[(Arc<str>, Value)]) -> Vec<(Arc<str>, Value)> {
    let mut found: Vec<(Arc<str>, Value)> = Vec::new();
    let mut places = HashMap::new();
    for (key, value) in reports {
        let place = *places.entry(key).or_insert(found.len());
        match found.get_mut(place) {
            None => found.push((key.clone(), value.clone())),
            Some((_, sum)) => match (&mut *sum, value) {
                (Value::Number(sum), Value::Number(more)) => *sum += more,
                (last, value) => *last = value.clone(),
            },
        }
    }
    found
}

/// The columns of one lot.
#[pyclass(frozen, get_all, module = "veduta._core")]
pub struct DerivedLot {
    positions_m: Py<PyArray2<f64>>,
    uv: Py<PyArray2<f32>>,
    ring_offsets: Py<PyArray1<i64>>,
    polygon_offsets: Py<PyArray1<i64>>,
    /// The surface that each polygon belongs to.
    polygon_feature: Py<PyArray1<i32>>,
    polygon_look: Py<PyArray1<i32>>,
    feature_name: Vec<String>,
    /// What each surface is, as the rules have it; empty where they do not say it.
    feature_class: Vec<String>,
    feature_size_m: Py<PyArray2<f64>>,
    /// What the rules say of each surface in the attributes `surface`, `solid` and `provenance`,
    /// and which `surface` it was made in; empty where they say nothing.
    feature_surface: Vec<String>,
    feature_within: Vec<String>,
    feature_solid: Vec<String>,
    feature_provenance: Vec<String>,
    /// Red, green, blue, opacity (0 to 1), texture and class of each look.
    looks: Vec<(f32, f32, f32, f32, Option<String>, String)>,
    /// The surface that each asset belongs to, its look, its place in `asset_names`, and where it
    /// stands: 3 x 4 by rows, from the asset's frame (m, z up) to the lot's.
    instance_feature: Py<PyArray1<i32>>,
    instance_look: Py<PyArray1<i32>>,
    instance_asset: Py<PyArray1<i32>>,
    instance_transform: Py<PyArray2<f64>>,
    asset_names: Vec<String>,
    /// Of each asset, whether it is its own mirror image, and whether it is inside out.
    asset_views: Vec<(bool, bool)>,
    log_prior: f64,
    messages: Vec<String>,
    /// Path and fault of each edit that could not be done.
    edit_faults: Vec<(Vec<u32>, String)>,
}

#[pymethods]
impl DerivedLot {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let surfaces = self.feature_name.len();
        let polygons = self.polygon_feature.bind(py).len()?;
        let assets = self.instance_feature.bind(py).len()?;
        Ok(format!(
            "DerivedLot(surfaces={surfaces}, polygons={polygons}, assets={assets})"
        ))
    }
}

/// What became of a lot: its columns, an asset that it wants, or why there is nothing.
#[derive(IntoPyObject)]
pub enum Outcome<'py> {
    Lot(Bound<'py, DerivedLot>),
    Wanting(Bound<'py, MissingAsset>),
    Fault(String),
}

pub fn to_python(py: Python<'_>, found: Result<Derived, Failed>) -> PyResult<Outcome<'_>> {
    Ok(match found {
        Ok(derived) => Outcome::Lot(lot_to_python(py, derived)?),
        Err(Failed { why, missing_asset }) => match missing_asset {
            Some(name) => Outcome::Wanting(Bound::new(py, MissingAsset { name, why })?),
            None => Outcome::Fault(why),
        },
    })
}

pub fn lot_to_python(py: Python<'_>, derived: Derived) -> PyResult<Bound<'_, DerivedLot>> {
    let (packed, surfaces) = (derived.packed, derived.surfaces);
    let of = |leaves: &[i32], column: &[u32]| -> Vec<i32> {
        let each = leaves.iter();
        each.map(|&leaf| column[leaf as usize] as i32).collect()
    };
    let of_polygon = |column: &[u32]| of(&packed.polygon_feature, column);
    let of_instance = |column: &[u32]| of(&packed.instance_feature, column);
    let assets: Vec<i32> = packed.instance_asset.iter().map(|&a| a as i32).collect();
    let name = |asset: &Arc<Asset>| asset.name.to_string();
    let view = |asset: &Arc<Asset>| (asset.view().mirrored, asset.view().inside_out);
    let looks = packed.looks.iter().map(|look| {
        let [r, g, b] = look.colour;
        let texture = look.texture.as_ref().map(ToString::to_string);
        (r, g, b, look.opacity, texture, look.class.to_string())
    });
    let lot = DerivedLot {
        positions_m: rows(&packed.positions).into_pyarray(py).unbind(),
        uv: rows(&packed.uv).into_pyarray(py).unbind(),
        ring_offsets: packed.ring_offsets.into_pyarray(py).unbind(),
        polygon_offsets: packed.polygon_offsets.into_pyarray(py).unbind(),
        polygon_feature: of_polygon(&surfaces.of_feature).into_pyarray(py).unbind(),
        polygon_look: of_polygon(&packed.feature_look).into_pyarray(py).unbind(),
        feature_name: derived.names,
        feature_class: texts(&surfaces.class),
        feature_surface: texts(&surfaces.name),
        feature_within: texts(&surfaces.within),
        feature_solid: texts(&surfaces.solid),
        feature_provenance: texts(&surfaces.provenance),
        feature_size_m: rows(&surfaces.size).into_pyarray(py).unbind(),
        looks: looks.collect(),
        instance_feature: of_instance(&surfaces.of_feature).into_pyarray(py).unbind(),
        instance_look: of_instance(&packed.feature_look).into_pyarray(py).unbind(),
        instance_asset: assets.into_pyarray(py).unbind(),
        instance_transform: rows(&packed.instance_transform).into_pyarray(py).unbind(),
        asset_names: packed.assets.iter().map(name).collect(),
        asset_views: packed.assets.iter().map(view).collect(),
        log_prior: derived.log_prior,
        messages: derived.messages,
        edit_faults: derived.edit_faults,
    };
    Bound::new(py, lot)
}

fn texts(column: &[Arc<str>]) -> Vec<String> {
    column.iter().map(ToString::to_string).collect()
}

pub fn rows<T: Copy, const N: usize>(tuples: &[[T; N]]) -> Array2<T> {
    Array2::from_shape_fn((tuples.len(), N), |(row, column)| tuples[row][column])
}
