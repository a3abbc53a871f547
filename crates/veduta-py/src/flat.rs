//! Polygons and assets of a lot as polygons alone.

use std::borrow::Cow;
use std::collections::HashMap;

use veduta_geometry::{triangulate_sound, PolygonSet};
use veduta_grammar::engine::Packed;
use veduta_grammar::shape::{Asset, AssetFaces};

use crate::standing::{placed, WARP_M};

/// A vertex of a face that is taken as it is may lie this far off its plane (m).
const PLANE_TOLERANCE_M: f64 = 1e-3;

/// Columns of polygons: vertices (m), first vertex of each ring, first ring of each polygon, leaf.
pub struct Flat<'a> {
    pub positions: Cow<'a, [[f64; 3]]>,
    pub rings: Cow<'a, [i64]>,
    pub polygons: Cow<'a, [i64]>,
    pub feature: Cow<'a, [i32]>,
    /// Of each face of an asset, the asset and the slot that has most of its surface: an asset is
    /// one thing. These come last.
    pub slots: Vec<(u32, u32)>,
}

impl<'a> Flat<'a> {
    /// The polygons, and after them the faces of all assets at their places.
    pub fn of(packed: &'a Packed) -> Result<Self, String> {
        let mut flat = Self {
            positions: (&packed.positions).into(),
            rings: (&packed.ring_offsets).into(),
            polygons: (&packed.polygon_offsets).into(),
            feature: (&packed.polygon_feature).into(),
            slots: Vec::new(),
        };
        let shapes: Vec<Vec<(u32, Outline)>> = packed
            .assets
            .iter()
            .map(|asset| shapes(asset))
            .collect::<Result<_, String>>()?;
        let each = packed.instance_transform.iter();
        let each = each.zip(&packed.instance_asset);
        for ((place, &asset), &feature) in each.zip(&packed.instance_feature) {
            let main = main_slot(&shapes[asset as usize]);
            for (_, outline) in &shapes[asset as usize] {
                flat.push(outline.iter().map(|&point| placed(place, point)), feature);
                flat.slots.push((asset, main));
            }
        }
        Ok(flat)
    }

    fn push(&mut self, outline: impl Iterator<Item = [f64; 3]>, feature: i32) {
        self.positions.to_mut().extend(outline);
        self.rings.to_mut().push(self.positions.len() as i64);
        self.polygons.to_mut().push(self.rings.len() as i64 - 1);
        self.feature.to_mut().push(feature);
    }
}

type Outline = Vec<[f64; 3]>;

/// The slot that covers most.
fn main_slot(shapes: &[(u32, Outline)]) -> u32 {
    let mut areas: HashMap<u32, f64> = HashMap::new();
    for (slot, outline) in shapes {
        *areas.entry(*slot).or_default() += area(outline);
    }
    let most = areas.into_iter();
    let most = most.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    most.map_or(0, |(slot, _)| slot)
}

/// Of a flat outline.
fn area(outline: &[[f64; 3]]) -> f64 {
    let mut sum = [0.0; 3];
    for (at, a) in outline.iter().enumerate() {
        let b = outline[(at + 1) % outline.len()];
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            sum[axis] += a[u] * b[v] - a[v] * b[u];
        }
    }
    0.5 * sum.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// The outlines of an asset's faces with their slots; those that are warped or have holes as
/// triangles.
fn shapes(asset: &Asset) -> Result<Vec<(u32, Outline)>, String> {
    let faces = asset.faces();
    let set = set_of(&faces)?;
    let even = triangulate_sound(&set, PLANE_TOLERANCE_M);
    let is_whole = |face: usize| even.is_sound[face] && set.rings(face).count() == 1;
    let whole = (0..set.len()).filter(|&face| is_whole(face));
    let outline = |face: usize| set.rings(face).flatten().map(|v| set.position_m(v));
    let mut found: Vec<(u32, Outline)> = whole
        .map(|face| (faces.slot[face], outline(face).collect()))
        .collect();
    let cut = triangulate_sound(&set, WARP_M);
    let others = cut.triangles.iter().zip(&cut.triangle_polygon);
    let others = others.filter(|(_, &face)| !is_whole(face as usize));
    found.extend(others.map(|(triangle, &face)| {
        let corners = triangle
            .iter()
            .map(|&vertex| faces.positions[vertex as usize]);
        (faces.slot[face as usize], corners.collect())
    }));
    Ok(found)
}

fn set_of(faces: &AssetFaces) -> Result<PolygonSet<'_>, String> {
    let (rings, polygons) = (&faces.ring_offsets, &faces.polygon_offsets);
    PolygonSet::of_any_rings(&faces.positions, rings, polygons).map_err(|error| error.to_string())
}
