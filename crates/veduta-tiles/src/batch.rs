//! Buildings in, the meshes of a tile out.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;
use veduta_geometry::{triangulate_sound, PolygonError, PolygonSet};

use crate::building::Building;
use crate::mapping::steps;
use crate::merge::{merge, Grid, Merged};
use crate::repeats::{take_repeats, Cut, Piece, Repeated};
use crate::standing::Standing;
use crate::whole::Whole;

/// A vertex may lie this far off its polygon's plane (m).
const PLANE_TOLERANCE_M: f64 = 1e-3;

/// The meshes of a tile.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Batch {
    pub merged: Vec<Merged>,
    pub repeated: Vec<Repeated>,
    /// Where the merged positions count from, and their steps (m, y-up).
    pub grid_low: [f64; 3],
    pub grid_step: [f64; 3],
    /// What a step of texture coordinates is, by material: shares of a texture.
    pub uv_steps: BTreeMap<u32, f64>,
    /// The box around all, z up (m); `low` is above `high` where there is nothing.
    pub low: [f64; 3],
    pub high: [f64; 3],
    /// Triangles that are drawn.
    pub triangles: usize,
    /// The features of polygons that are none: too thin, or their lines cross.
    pub dropped: Vec<u32>,
}

/// Merges buildings and the meshes that stand in them; the same give the same bytes.
pub fn batch(buildings: &[Building<'_>], standing: &[Standing]) -> Result<Batch, PolygonError> {
    batched(buildings, standing, true)
}

/// As [`batch`], with the cells of a surface as the faces that they were cut from, and none of them
/// repeated: what meets before places are rounded meets after it, too.
pub fn batch_whole(
    buildings: &[Building<'_>],
    standing: &[Standing],
) -> Result<Batch, PolygonError> {
    let whole: Vec<Option<Whole>> = buildings.par_iter().map(Whole::of).collect();
    let faces: Vec<Building<'_>> = buildings
        .iter()
        .zip(&whole)
        .map(|(own, whole)| whole.as_ref().map_or(*own, |whole| whole.building(own)))
        .collect();
    batched(&faces, standing, false)
}

fn batched(
    buildings: &[Building<'_>],
    standing: &[Standing],
    repeats: bool,
) -> Result<Batch, PolygonError> {
    let cuts: Vec<Cut> = buildings
        .par_iter()
        .map(cut)
        .collect::<Result<_, PolygonError>>()?;
    let mut made = Batch::default();
    let (low, high) = bounds(buildings, &cuts, standing);
    (made.low, made.high) = (low.to_array(), high.to_array());
    let grid = Grid::over(low, high);
    (made.grid_low, made.grid_step) = (grid.low.to_array(), grid.step.to_array());
    for (building, cut) in buildings.iter().zip(&cuts) {
        let cut = building.feature.iter().zip(&cut.triangles);
        let none = cut.filter(|(_, triangles)| triangles.is_empty());
        made.dropped.extend(none.map(|(feature, _)| *feature));
    }
    let pieces = pieces(buildings, &cuts, |building| building.piece);
    let uv_steps = steps(buildings, &pieces, standing);
    let rest = if repeats {
        let (repeated, rest) = take_repeats(buildings, &cuts, &uv_steps, pieces);
        let rest = split(buildings, rest);
        let (more, rest) = take_repeats(buildings, &cuts, &uv_steps, rest);
        made.repeated = repeated;
        made.repeated.extend(more);
        rest
    } else {
        pieces
    };
    let mut alone = Vec::new();
    for one in standing {
        match one
            .is_worth_sharing()
            .then(|| one.repeated(&uv_steps))
            .flatten()
        {
            Some(shared) => made.repeated.extend(shared),
            None => alone.push(one),
        }
    }
    made.merged = merge(buildings, &cuts, &uv_steps, &rest, &alone, &grid);
    made.uv_steps = uv_steps;
    made.triangles = made.merged.iter().map(|m| m.indices.len() / 3).sum();
    for mesh in &made.repeated {
        made.triangles += mesh.indices.len() / 3 * mesh.features.len();
    }
    Ok(made)
}

fn cut(building: &Building<'_>) -> Result<Cut, PolygonError> {
    let set = PolygonSet::of_any_rings(
        building.positions,
        building.ring_offsets,
        building.polygon_offsets,
    )?;
    let found = triangulate_sound(&set, PLANE_TOLERANCE_M);
    let mut triangles = vec![Vec::new(); set.len()];
    for (triangle, polygon) in found.triangles.iter().zip(&found.triangle_polygon) {
        triangles[*polygon as usize].push(*triangle);
    }
    Ok(Cut {
        triangles,
        normals: found.normals,
    })
}

fn bounds(buildings: &[Building<'_>], cuts: &[Cut], standing: &[Standing]) -> (DVec3, DVec3) {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (building, cut) in buildings.iter().zip(cuts) {
        let offset = DVec3::from_array(building.offset);
        for &vertex in cut.triangles.iter().flatten().flatten() {
            let point = DVec3::from_array(building.positions[vertex as usize]) + offset;
            (low, high) = (low.min(point), high.max(point));
        }
    }
    for one in standing {
        for (place, &point) in one
            .places
            .iter()
            .flat_map(|p| one.points.iter().map(move |q| (p, q)))
        {
            let point = one.at(place, point);
            (low, high) = (low.min(point), high.max(point));
        }
    }
    (low, high)
}

/// The sound polygons by a column, in the order of their first.
fn pieces<'a>(
    buildings: &'a [Building<'a>],
    cuts: &[Cut],
    column: impl Fn(&'a Building<'a>) -> &'a [u32],
) -> Vec<Piece> {
    let mut found = Vec::new();
    for (number, building) in buildings.iter().enumerate() {
        let polygons = 0..building.feature.len();
        let sound = polygons.filter(|&p| !cuts[number].triangles[p].is_empty());
        group(number, sound, column(building), &mut found);
    }
    found
}

/// The same polygons by the finer column.
fn split(buildings: &[Building<'_>], pieces: Vec<Piece>) -> Vec<Piece> {
    let mut found = Vec::new();
    for piece in pieces {
        let parts = buildings[piece.building].part;
        group(
            piece.building,
            piece.polygons.into_iter(),
            parts,
            &mut found,
        );
    }
    found
}

fn group(
    building: usize,
    polygons: impl Iterator<Item = usize>,
    column: &[u32],
    found: &mut Vec<Piece>,
) {
    let mut place = std::collections::HashMap::new();
    for polygon in polygons {
        let at = *place.entry(column[polygon]).or_insert_with(|| {
            found.push(Piece {
                building,
                polygons: Vec::new(),
            });
            found.len() - 1
        });
        found[at].polygons.push(polygon);
    }
}
