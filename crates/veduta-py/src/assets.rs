//! Assets as Python gives them, and those that it has still to give.

use std::collections::HashMap;
use std::sync::Arc;

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use veduta_geometry::solid::Mesh;
use veduta_grammar::shape::{Asset, Labels, Lies, Slot, SlotTexture};

pub type Assets = HashMap<Arc<str>, Arc<Asset>>;
/// The metres that textures of a known size cover to the right and up.
pub type Textures = HashMap<Arc<str>, [f64; 2]>;
/// The colour (sRGB) of each slot or None for that of the shape, the colour where the shape has none,
/// and the texture.
pub type GivenSlots = Vec<(Option<[f32; 3]>, [f32; 3], Option<GivenTexture>)>;
/// The name of a texture, the metres that it covers to the right and up, or None where it lies by the
/// coordinates of the asset's corners, and its mean colour (sRGB).
pub type GivenTexture = (String, Option<[f64; 2]>, [f32; 3]);
/// The name of each slot's material, the group of each face, and the names of the groups.
pub type GivenLabels = (Vec<String>, Vec<u32>, Vec<String>);

/// The names of an asset's parts as the engine has them.
pub fn labels_of((materials, face_group, groups): GivenLabels) -> Labels {
    let shared = |names: Vec<String>| names.into_iter().map(Into::into).collect();
    Labels {
        materials: shared(materials),
        face_group,
        groups: shared(groups),
    }
}

/// An asset of these columns; None where they do not fit together.
pub fn asset_of(
    name: &str,
    points: &PyReadonlyArray2<'_, f64>,
    corners: &[u32],
    offsets: &[i64],
    box_m: &PyReadonlyArray2<'_, f64>,
    looks: Option<(PyReadonlyArray1<'_, i32>, GivenSlots)>,
) -> Option<Asset> {
    let mesh = mesh_of(points, corners, offsets)?;
    let ends = places(box_m)?;
    let [low, high] = ends[..] else {
        return None;
    };
    let asset = Asset::new(name.into(), mesh, (low.into(), high.into()))?;
    let Some((of_face, slots)) = looks else {
        return Some(asset);
    };
    let of_face = of_face.as_slice().ok()?.iter();
    let of_face: Option<Vec<u32>> = of_face.map(|&slot| u32::try_from(slot).ok()).collect();
    let slots = slots.into_iter().map(|(colour, fallback, texture)| Slot {
        colour,
        fallback,
        texture: texture.map(texture_of),
    });
    asset.with_slots(of_face?, slots.collect())
}

fn texture_of((name, size_m, mean): GivenTexture) -> SlotTexture {
    SlotTexture {
        name: name.into(),
        lies: size_m.map_or(Lies::ByCorners { mean }, Lies::InMetres),
    }
}

/// The rows of two numbers; None where they have another count.
pub fn pairs(uv: &PyReadonlyArray2<'_, f32>) -> Option<Vec<[f32; 2]>> {
    let rows = uv.as_array();
    let pair = |row: usize| [rows[[row, 0]], rows[[row, 1]]];
    (rows.ncols() == 2).then(|| (0..rows.nrows()).map(pair).collect())
}

/// The rows of three numbers; None where they have another count.
fn places(points: &PyReadonlyArray2<'_, f64>) -> Option<Vec<[f64; 3]>> {
    let rows = points.as_array();
    let place = |row: usize| [rows[[row, 0]], rows[[row, 1]], rows[[row, 2]]];
    (rows.ncols() == 3).then(|| (0..rows.nrows()).map(place).collect())
}

/// Faces over points; None where a number leads to none.
fn mesh_of(points: &PyReadonlyArray2<'_, f64>, corners: &[u32], offsets: &[i64]) -> Option<Mesh> {
    let places = places(points)?;
    if corners
        .iter()
        .any(|&corner| corner as usize >= places.len())
    {
        return None;
    }
    let mut mesh = Mesh::with_points(places.into_iter().map(Into::into).collect());
    for ends in offsets.windows(2) {
        let range = usize::try_from(ends[0]).ok()?..usize::try_from(ends[1]).ok()?;
        let face = corners.get(range).filter(|face| face.len() >= 3)?;
        mesh.push_face(&[face]);
    }
    Some(mesh)
}

/// An asset that a lot's rules want and that is not known yet: add it and derive again.
#[pyclass(frozen, get_all, module = "veduta._core")]
pub struct MissingAsset {
    pub name: String,
    /// What the lot's failure is where there is no such asset.
    pub why: String,
}

#[pymethods]
impl MissingAsset {
    fn __repr__(&self) -> String {
        format!("MissingAsset({:?})", self.name)
    }
}
