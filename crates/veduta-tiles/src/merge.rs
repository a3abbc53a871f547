//! What is not repeated: one mesh for each material, vertices of a surface shared.

use std::collections::BTreeMap;

use foldhash::HashMap;
use glam::DVec3;

use crate::building::Building;
use crate::mapping::Mapping;
use crate::repeats::{Cut, Piece};
use crate::standing::Standing;

/// A mesh of many surfaces.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Merged {
    pub material: u32,
    /// x, y, z (y-up) and a zero for each vertex, in steps from the tile's lower corner.
    pub positions: Vec<u16>,
    /// Two texture coordinates of each vertex, in the steps of the material; empty where it has no
    /// texture.
    pub uv: Vec<u16>,
    /// The surface of each vertex.
    pub features: Vec<u32>,
    pub indices: Vec<u32>,
}

/// The grid of positions: y-up, from `low` in steps of `step` (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    pub low: DVec3,
    pub step: DVec3,
}

impl Grid {
    /// The grid that fills a box (z up); a side without length gets steps of a metre.
    pub fn over(low: DVec3, high: DVec3) -> Self {
        let size = DVec3::new(high.x - low.x, high.z - low.z, high.y - low.y);
        let step = size / f64::from(u16::MAX);
        Self {
            low: y_up(DVec3::new(low.x, high.y, low.z)),
            step: DVec3::select(step.cmpgt(DVec3::ZERO), step, DVec3::ONE),
        }
    }

    fn place(&self, point: DVec3) -> [u16; 3] {
        let steps = (y_up(point) - self.low) / self.step;
        steps
            .to_array()
            .map(|c| c.round().clamp(0.0, f64::from(u16::MAX)) as u16)
    }
}

/// (x, y, z) with z up as y-up has it.
pub(crate) fn y_up(point: DVec3) -> DVec3 {
    DVec3::new(point.x, point.z, -point.y)
}

/// One mesh for each material, in the order of materials.
pub(crate) fn merge(
    buildings: &[Building<'_>],
    cuts: &[Cut],
    uv_steps: &BTreeMap<u32, f64>,
    pieces: &[Piece],
    alone: &[&Standing],
    grid: &Grid,
) -> Vec<Merged> {
    let mut meshes = Meshes::default();
    for piece in pieces {
        let building = &buildings[piece.building];
        let offset = DVec3::from_array(building.offset);
        let mapping = Mapping::of(building, &piece.polygons, uv_steps);
        for &polygon in &piece.polygons {
            let look = (building.material[polygon], building.feature[polygon]);
            for triangle in &cuts[piece.building].triangles[polygon] {
                let corners = triangle.map(|vertex| {
                    let vertex = vertex as usize;
                    let point = DVec3::from_array(building.positions[vertex]) + offset;
                    let uv = mapping.as_ref().map(|m| m.at(building.uv[vertex]));
                    (grid.place(point), uv)
                });
                meshes.push(look, corners);
            }
        }
    }
    for one in alone {
        let mappings = one.mappings(uv_steps);
        for (place, &feature) in one.places.iter().zip(&one.feature) {
            for (number, triangle) in one.triangles.iter().enumerate() {
                let uv = one.steps_at(number, &mappings);
                let corners = std::array::from_fn(|k| {
                    let point = one.points[triangle[k] as usize];
                    (grid.place(one.at(place, point)), uv[k])
                });
                meshes.push((one.material[number], feature), corners);
            }
        }
    }
    let all = meshes.of_material.into_values().map(|(mesh, _)| mesh);
    all.filter(|mesh| !mesh.indices.is_empty()).collect()
}

/// The meshes so far, with the vertices that each surface has.
#[derive(Default)]
struct Meshes {
    of_material: BTreeMap<u32, (Merged, Known)>,
}

/// Place and texture coordinates, in steps.
type Corner = ([u16; 3], Option<[u16; 2]>);
/// The vertex at each corner of a surface.
type Known = HashMap<(u32, Corner), u32>;

impl Meshes {
    /// Adds a triangle of a material and a surface.
    fn push(&mut self, (material, feature): (u32, u32), corners: [Corner; 3]) {
        let [(a, _), (b, _), (c, _)] = corners;
        if a == b || b == c || c == a {
            return;
        }
        let (mesh, known) = self.of_material.entry(material).or_default();
        mesh.material = material;
        let corners = corners.map(|(place, uv)| {
            *known.entry((feature, (place, uv))).or_insert_with(|| {
                mesh.positions.extend(place);
                mesh.positions.push(0);
                mesh.uv.extend(uv.into_iter().flatten());
                mesh.features.push(feature);
                mesh.features.len() as u32 - 1
            })
        });
        mesh.indices.extend(corners);
    }
}
