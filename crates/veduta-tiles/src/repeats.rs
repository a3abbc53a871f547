//! Pieces that occur several times: one mesh, and where each stands.

use std::collections::BTreeMap;

use foldhash::HashMap;
use glam::DVec3;

use crate::building::Building;
use crate::mapping::Mapping;
use crate::piece::{describe, Key, Motion, STEP_M};

/// A mesh and its instances.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Repeated {
    pub material: u32,
    /// x, y, z and a zero for each vertex, in steps of [`Repeated::step_m`].
    pub positions: Vec<i16>,
    /// Two texture coordinates of each vertex, in the steps of the material; empty where it has no
    /// texture.
    pub uv: Vec<u16>,
    pub indices: Vec<u16>,
    /// Three numbers for each instance, in the same steps.
    pub translations: Vec<f32>,
    /// Quaternions x, y, z, w; 32767 is one.
    pub rotations: Vec<i16>,
    /// Three stretches for each instance, along the mesh's axes; empty where there are none.
    pub scales: Vec<f32>,
    /// The surface of each instance.
    pub features: Vec<u32>,
}

impl Repeated {
    /// Metres of a step.
    pub const fn step_m() -> f64 {
        STEP_M
    }
}

/// Triangles of a building's sound polygons, and their normals.
pub(crate) struct Cut {
    /// Vertex numbers of the building, by polygon.
    pub triangles: Vec<Vec<[u32; 3]>>,
    pub normals: Vec<[f64; 3]>,
}

/// Some polygons of one building, of one surface and one material.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    pub building: usize,
    pub polygons: Vec<usize>,
}

/// What a vertex, a triangle, an instance and another mesh cost (bytes).
pub(crate) const VERTEX: usize = 12;
pub(crate) const TRIANGLE: usize = 6;
pub(crate) const INSTANCE: usize = 22;
pub(crate) const MESH: usize = 900;

/// Takes the pieces that are worth an instance each; the others come back in their order.
pub(crate) fn take_repeats(
    buildings: &[Building<'_>],
    cuts: &[Cut],
    uv_steps: &BTreeMap<u32, f64>,
    pieces: Vec<Piece>,
) -> (Vec<Repeated>, Vec<Piece>) {
    let mut groups: Vec<Vec<(usize, Motion)>> = Vec::new();
    let mut known: HashMap<(u32, Key), usize> = HashMap::default();
    for (number, piece) in pieces.iter().enumerate() {
        let Some((motion, key)) = described(&buildings[piece.building], cuts, uv_steps, piece)
        else {
            continue;
        };
        let material = buildings[piece.building].material[piece.polygons[0]];
        let next = groups.len();
        let group = *known.entry((material, key)).or_insert(next);
        if group == next {
            groups.push(Vec::new());
        }
        groups[group].push((number, motion));
    }
    let mut is_taken = vec![false; pieces.len()];
    let mut found = Vec::new();
    for group in groups {
        let first = &pieces[group[0].0];
        let triangles: usize = first
            .polygons
            .iter()
            .map(|&p| cuts[first.building].triangles[p].len())
            .sum();
        // Of closed pieces there are about as many vertices as half the triangles.
        let alone = (triangles / 2 + 3) * VERTEX + triangles * TRIANGLE;
        if group.len() * alone < alone + group.len() * INSTANCE + MESH {
            continue;
        }
        let Some(repeated) = repeated(buildings, cuts, uv_steps, &pieces, &group) else {
            continue;
        };
        for (number, _) in &group {
            is_taken[*number] = true;
        }
        found.push(repeated);
    }
    let rest = pieces.into_iter().zip(is_taken);
    (found, rest.filter(|(_, is)| !is).map(|(p, _)| p).collect())
}

fn described(
    building: &Building<'_>,
    cuts: &[Cut],
    uv_steps: &BTreeMap<u32, f64>,
    piece: &Piece,
) -> Option<(Motion, Key)> {
    let first = *piece.polygons.first()?;
    let normal = DVec3::from_array(cuts[piece.building].normals[first]);
    let motion = Motion::of(&building.rings(first).next()?, normal)?;
    let mut key = Key::new();
    for &polygon in &piece.polygons {
        let rings: Vec<_> = building.rings(polygon).collect();
        if !describe(&mut key, &motion, &rings) {
            return None;
        }
    }
    if let Some(mapping) = Mapping::of(building, &piece.polygons, uv_steps) {
        let vertices = piece.polygons.iter().flat_map(|&p| building.vertices(p));
        key.extend(vertices.flat_map(|v| mapping.at(building.uv[v]).map(i32::from)));
    }
    Some((motion, key))
}

/// Place and texture coordinates, in steps.
type Corner = ([i32; 3], Option<[u16; 2]>);

/// The mesh is that of the first piece.
fn repeated(
    buildings: &[Building<'_>],
    cuts: &[Cut],
    uv_steps: &BTreeMap<u32, f64>,
    pieces: &[Piece],
    group: &[(usize, Motion)],
) -> Option<Repeated> {
    let (first, motion) = (&pieces[group[0].0], group[0].1);
    let building = &buildings[first.building];
    let mut made = Repeated {
        material: building.material[first.polygons[0]],
        ..Repeated::default()
    };
    let mapping = Mapping::of(building, &first.polygons, uv_steps);
    let mut known: HashMap<Corner, u16> = HashMap::default();
    let offset = DVec3::from_array(building.offset);
    for &polygon in &first.polygons {
        for triangle in &cuts[first.building].triangles[polygon] {
            let mut corners = [0; 3];
            let mut places = [[0; 3]; 3];
            for k in 0..3 {
                let vertex = triangle[k] as usize;
                let local = motion.local(DVec3::from_array(building.positions[vertex]) + offset);
                let uv = mapping.as_ref().map(|m| m.at(building.uv[vertex]));
                let next = u16::try_from(known.len()).ok()?;
                corners[k] = *known.entry((local, uv)).or_insert(next);
                places[k] = local;
                if corners[k] == next {
                    made.positions.extend(local.map(|c| c as i16));
                    made.positions.push(0);
                    made.uv.extend(uv.into_iter().flatten());
                }
            }
            if places[0] != places[1] && places[1] != places[2] && places[2] != places[0] {
                made.indices.extend(corners);
            }
        }
    }
    for (number, motion) in group {
        let (rotation, place) = motion.y_up();
        let steps = place / STEP_M;
        made.translations
            .extend(steps.to_array().map(|c| c.round() as f32));
        let turned = rotation.to_array();
        made.rotations
            .extend(turned.map(|c| (c * 32767.0).round() as i16));
        let piece = &pieces[*number];
        made.features
            .push(buildings[piece.building].feature[piece.polygons[0]]);
    }
    (!made.indices.is_empty()).then_some(made)
}
