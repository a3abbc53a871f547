//! The assets that stand in lots, as meshes that tiles share.

use std::collections::HashMap;
use std::sync::Arc;

use veduta_geometry::{triangulate_sound, PolygonSet};
use veduta_grammar::engine::{Look, Packed};
use veduta_grammar::shape::{Asset, AssetFaces, Lies, Slot};
use veduta_tiles::Standing;

use crate::derived_lot::Derived;

/// Faces of swept curves are a little warped (m).
pub const WARP_M: f64 = 5e-3;

/// The material of a slot, and whether it shows the slot's texture.
type SlotLook = (u32, bool);

/// The assets so far: each once in each look.
#[derive(Default)]
pub struct Stands {
    /// By the asset and the materials of its slots.
    known: HashMap<(*const Asset, Vec<SlotLook>), usize>,
    found: Vec<(Arc<Asset>, Vec<SlotLook>, Standing)>,
}

impl Stands {
    /// Adds the assets of a lot that stands at `offset` and whose surfaces count from `first`.
    /// `material` is the number of a slot's look in that of a leaf, and whether it shows a texture.
    pub fn add(
        &mut self,
        lot: &Derived,
        offset: [f64; 3],
        first: u32,
        mut material: impl FnMut(usize, &Look, &Slot) -> SlotLook,
    ) {
        let packed = &lot.packed;
        for (row, &leaf) in packed.instance_feature.iter().enumerate() {
            let asset = &packed.assets[packed.instance_asset[row] as usize];
            let look = &packed.looks[packed.feature_look[leaf as usize] as usize];
            let slots = asset.slots().iter();
            let materials: Vec<SlotLook> = slots
                .map(|slot| material(leaf as usize, look, slot))
                .collect();
            let key = (Arc::as_ptr(asset), materials);
            let next = self.found.len();
            let number = *self.known.entry(key.clone()).or_insert(next);
            if number == next {
                let made = Standing::default();
                self.found.push((asset.clone(), key.1, made));
            }
            let stand = &mut self.found[number].2;
            let mut place = packed.instance_transform[row];
            for axis in 0..3 {
                place[4 * axis + 3] += offset[axis];
            }
            stand.places.push(place);
            let surface = lot.surfaces.of_feature[leaf as usize];
            stand.feature.push(first + surface);
        }
    }

    /// All of them with their triangles.
    pub fn finish(self) -> Result<Vec<Standing>, String> {
        let each = self.found.into_iter();
        each.map(|(asset, materials, mut made)| {
            let faces = asset.faces();
            let set = PolygonSet::of_any_rings(
                &faces.positions,
                &faces.ring_offsets,
                &faces.polygon_offsets,
            );
            let cut = triangulate_sound(&set.map_err(|error| error.to_string())?, WARP_M);
            let of_face = cut.triangle_polygon.iter();
            let of_triangle: Vec<usize> = of_face.map(|&face| face as usize).collect();
            let look_of = |face: usize| materials[faces.slot[face] as usize];
            made.material = of_triangle.iter().map(|&face| look_of(face).0).collect();
            if materials.iter().any(|(_, shows)| *shows) {
                let each = of_triangle.iter().zip(&cut.triangles);
                made.uv = each
                    .map(|(&face, triangle)| {
                        let slot = &asset.slots()[faces.slot[face] as usize];
                        let texture = slot.texture.as_ref().filter(|_| look_of(face).1)?;
                        let normal = cut.normals[face];
                        Some(triangle.map(|v| match texture.lies {
                            Lies::InMetres(size_m) => boxed(&faces, v as usize, normal, size_m),
                            Lies::ByCorners { .. } => own(&faces, v as usize),
                        }))
                    })
                    .collect();
            }
            made.triangles = cut.triangles;
            made.points = faces.positions;
            Ok(made)
        })
        .collect()
    }
}

/// Where a corner of a face lies on its picture, by the asset's own coordinates.
fn own(faces: &AssetFaces, vertex: usize) -> [f32; 2] {
    faces.uv.get(vertex).copied().unwrap_or_default()
}

/// Where a corner of a face lies on a texture of this size (m): seen from the side of a box that the
/// face looks to most. As `boxed` of `veduta.grammar.assets.asset` has it, but from the lower left.
fn boxed(faces: &AssetFaces, vertex: usize, normal: [f64; 3], size_m: [f64; 2]) -> [f32; 2] {
    // z up: to the asset's own frame, which has y up.
    let own = |[x, y, z]: [f64; 3]| [x, z, -y];
    let ([x, y, z], normal) = (own(faces.positions[vertex]), own(normal));
    let longest = |a: usize, b: usize| {
        if normal[b].abs() > normal[a].abs() {
            b
        } else {
            a
        }
    };
    let axis = longest(longest(0, 1), 2);
    let sign = if normal[axis] < 0.0 { -1.0 } else { 1.0 };
    let to_right = [-z * sign, x, x * sign][axis];
    let upward = [y, -z * sign, y][axis];
    [(to_right / size_m[0]) as f32, (upward / size_m[1]) as f32]
}

/// The box around all polygons and assets (m); `low` is above `high` where there is nothing.
pub fn box_of(packed: &Packed) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut reach = |point: [f64; 3]| {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    };
    packed.positions.iter().for_each(|&point| reach(point));
    let corners: Vec<[[f64; 3]; 8]> = packed.assets.iter().map(|asset| corners(asset)).collect();
    for (place, &asset) in packed.instance_transform.iter().zip(&packed.instance_asset) {
        for corner in corners[asset as usize] {
            reach(placed(place, corner));
        }
    }
    (low, high)
}

/// The corners of the box around an asset's points.
fn corners(asset: &Asset) -> [[f64; 3]; 8] {
    let (low, high) = asset.reach();
    std::array::from_fn(|k| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low } else { high }[axis]))
}

/// A point of an asset at its place: 3 x 4 by rows.
pub fn placed(place: &[f64; 12], point: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row| {
        let by = &place[4 * row..4 * row + 4];
        by[0] * point[0] + by[1] * point[1] + by[2] * point[2] + by[3]
    })
}
