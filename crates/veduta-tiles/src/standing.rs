//! Meshes from outside that stand in many places, each stretched along the mesh's own axes.

use std::collections::{BTreeMap, HashMap};

use glam::{DMat3, DQuat, DVec3};

use crate::mapping::Mapping;
use crate::merge::y_up;
use crate::piece::STEP_M;
use crate::repeats::{Repeated, INSTANCE, MESH, TRIANGLE, VERTEX};

/// A mesh in one look, wherever it stands.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Standing {
    /// In the mesh's own frame (m), z up.
    pub points: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// The material of each triangle.
    pub material: Vec<u32>,
    /// Texture coordinates of each triangle's corners, from the lower left; None without a texture.
    /// It may be empty where no triangle has one.
    pub uv: Vec<Option<[[f32; 2]; 3]>>,
    /// 3 x 4 by rows, from the mesh's frame to the tile's (m, z up): a stretch along the mesh's
    /// axes, a turn, a move.
    pub places: Vec<[f64; 12]>,
    /// The surface of each place.
    pub feature: Vec<u32>,
}

/// Steps to either side of a mesh's middle.
const REACH: f64 = i16::MAX as f64;
/// What a stretch costs beside the rest of an instance (bytes).
const STRETCH: usize = 12;

impl Standing {
    /// A point at one of the places.
    pub(crate) fn at(&self, place: &[f64; 12], point: [f64; 3]) -> DVec3 {
        let (axes, by) = parts(place);
        axes * DVec3::from_array(point) + by
    }

    /// Whether to write the mesh once costs less than to write it at each place.
    pub(crate) fn is_worth_sharing(&self) -> bool {
        let alone = self.triangles.len() * TRIANGLE + self.points.len() * VERTEX;
        let meshes = self.by_material().len() * MESH;
        self.places.len() * alone > alone + self.places.len() * (INSTANCE + STRETCH) + meshes
    }

    fn by_material(&self) -> BTreeMap<u32, Vec<usize>> {
        let mut found: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (triangle, material) in self.material.iter().enumerate() {
            found.entry(*material).or_default().push(triangle);
        }
        found
    }

    /// The texture coordinates of the triangles of each material that has a texture.
    pub(crate) fn mapped(&self) -> BTreeMap<u32, Vec<[f32; 2]>> {
        let mut found: BTreeMap<u32, Vec<[f32; 2]>> = BTreeMap::new();
        for (uv, material) in self.uv.iter().zip(&self.material) {
            if let Some(uv) = uv {
                found.entry(*material).or_default().extend(uv);
            }
        }
        found
    }

    /// How each material lies on its texture.
    pub(crate) fn mappings(&self, steps: &BTreeMap<u32, f64>) -> BTreeMap<u32, Mapping> {
        let each = self.mapped().into_iter();
        each.filter_map(|(material, uv)| {
            let step = *steps.get(&material)?;
            Some((material, Mapping::over(uv.into_iter(), step)))
        })
        .collect()
    }

    /// The texture coordinates of a triangle's corners, in steps.
    pub(crate) fn steps_at(
        &self,
        triangle: usize,
        mappings: &BTreeMap<u32, Mapping>,
    ) -> [Option<[u16; 2]>; 3] {
        let mapping = mappings.get(&self.material[triangle]);
        let uv = self.uv.get(triangle).copied().flatten();
        let at = |k: usize| Some(mapping?.at(uv?[k]));
        [at(0), at(1), at(2)]
    }

    /// A mesh for each material, all with the same instances; None where one has too many vertices.
    pub(crate) fn repeated(&self, uv_steps: &BTreeMap<u32, f64>) -> Option<Vec<Repeated>> {
        let points: Vec<DVec3> = self.points.iter().map(|&point| point.into()).collect();
        let low = points.iter().fold(DVec3::INFINITY, |a, &b| a.min(b));
        let high = points.iter().fold(DVec3::NEG_INFINITY, |a, &b| a.max(b));
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        let step = DVec3::select(half.cmpgt(DVec3::ZERO), half / REACH, DVec3::splat(STEP_M));
        let placed = self.placed(middle, step);
        let mappings = self.mappings(uv_steps);
        let mut found = Vec::new();
        for (material, triangles) in self.by_material() {
            let mut made = Repeated {
                material,
                ..placed.clone()
            };
            let mut known: HashMap<([i16; 3], Option<[u16; 2]>), u16> = HashMap::new();
            for triangle in triangles {
                let mut corners = [0; 3];
                let uvs = self.steps_at(triangle, &mappings);
                let vertices = self.triangles[triangle].into_iter().zip(uvs);
                for (corner, (vertex, uv)) in corners.iter_mut().zip(vertices) {
                    let steps = (points[vertex as usize] - middle) / step;
                    let local = steps.to_array().map(|c| c.round() as i16);
                    let next = u16::try_from(known.len()).ok()?;
                    *corner = *known.entry((local, uv)).or_insert(next);
                    if *corner == next {
                        let [x, y, z] = local;
                        made.positions.extend([x, z, -y, 0]);
                        made.uv.extend(uv.into_iter().flatten());
                    }
                }
                let [a, b, c] = corners;
                if a != b && b != c && c != a {
                    made.indices.extend(corners);
                }
            }
            if !made.indices.is_empty() {
                found.push(made);
            }
        }
        Some(found)
    }

    /// The instances alone, of a mesh in steps from its middle.
    fn placed(&self, middle: DVec3, step: DVec3) -> Repeated {
        let mut made = Repeated {
            features: self.feature.clone(),
            ..Repeated::default()
        };
        for place in &self.places {
            let (axes, by) = parts(place);
            let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
            let stretch = DVec3::from_array(columns.map(DVec3::length));
            let [x, y, z] = columns.map(DVec3::normalize_or_zero);
            // y up: x, z, -y of both frames.
            let turn = DMat3::from_cols(y_up(x), y_up(z), -y_up(y));
            let scale = stretch * step / STEP_M;
            let at = y_up(axes * middle + by) / STEP_M;
            let rotation = DQuat::from_mat3(&turn).normalize().to_array();
            made.translations.extend(at.to_array().map(|c| c as f32));
            made.rotations
                .extend(rotation.map(|c| (c * 32767.0).round() as i16));
            made.scales
                .extend([scale.x, scale.z, scale.y].map(|c| c as f32));
        }
        made
    }
}

fn parts(place: &[f64; 12]) -> (DMat3, DVec3) {
    let column = |k: usize| DVec3::new(place[k], place[4 + k], place[8 + k]);
    (DMat3::from_cols(column(0), column(1), column(2)), column(3))
}
