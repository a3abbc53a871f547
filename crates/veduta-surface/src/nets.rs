//! Surface nets: one vertex for each sheet of a cell, one quad for each edge that is crossed.

use rayon::prelude::*;

use crate::active::{layers, Active, Cases, Layer};
use crate::cell::{corners_of, EDGES, NO_SHEET};
use crate::error::SurfaceError;
use crate::quads::triangles_of;
use crate::samples::Samples;

/// Twice the longest axis still fits the numbers of rows.
const LONGEST_AXIS: usize = 1 << 20;

/// Triangles that share their vertices, counter-clockwise seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// In samples: a vertex on sample (x, y, z) has these coordinates.
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

/// The surface where the values pass `level`; less is inside.
///
/// close: what is inside at the border of the grid is closed half a cell beyond it; else the surface
/// ends there. Where a value is NaN there is no surface, and it has a rim.
pub fn surface_nets(
    samples: &impl Samples,
    level: f32,
    close: bool,
) -> Result<Surface, SurfaceError> {
    if !level.is_finite() {
        return Err(SurfaceError::Level { level });
    }
    let size = samples.size();
    if size.iter().any(|axis| *axis > LONGEST_AXIS) {
        let most = LONGEST_AXIS;
        return Err(SurfaceError::Axis { size, most });
    }
    if size.contains(&0) {
        return Ok(Surface::default());
    }
    let cases = Cases::new();
    let beyond = if close { f32::INFINITY } else { f32::NAN };
    let layers = layers(samples, level, beyond, &cases);
    let mut starts = vec![0_usize];
    for layer in &layers {
        starts.push(starts[starts.len() - 1] + layer.vertices as usize);
    }
    let count = starts[layers.len()];
    if count > u32::MAX as usize {
        return Err(SurfaceError::Vertices { count });
    }
    let each = layers.par_iter().enumerate();
    let parts: Vec<Vec<[f64; 3]>> = each
        .map(|(x, layer)| positions_of(layer, x, level, &cases))
        .collect();
    let positions = parts.concat();
    let parts: Vec<Vec<[u32; 3]>> = (0..layers.len())
        .into_par_iter()
        .map(|x| triangles_of(&layers, &starts, x, &cases, &positions))
        .collect();
    let triangles = parts.concat();
    Ok(Surface {
        positions,
        triangles,
    })
}

fn positions_of(layer: &Layer, x: usize, level: f32, cases: &Cases) -> Vec<[f64; 3]> {
    let mut found = Vec::with_capacity(layer.vertices as usize);
    for y in 0..layer.rows.len() - 1 {
        for cell in layer.row(y) {
            let base = [x, y, cell.z as usize].map(|at| at as f64 - 1.0);
            place(cell, base, level, cases, &mut found);
        }
    }
    found
}

/// The mean of the points where a sheet crosses the cell's edges.
fn place(cell: &Active, base: [f64; 3], level: f32, cases: &Cases, into: &mut Vec<[f64; 3]>) {
    let sheets = cases.of(cell);
    for sheet in 0..sheets.count {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for edge in 0..EDGES {
            if sheets.of_edge[edge] == NO_SHEET || sheets.of_edge[edge] != sheet {
                continue;
            }
            let (a, b) = corners_of(edge);
            for axis in 0..3 {
                sum[axis] += (a >> axis & 1) as f64;
            }
            sum[edge / 4] += crossing(cell.values[a], cell.values[b], level);
            count += 1.0;
        }
        into.push(std::array::from_fn(|axis| base[axis] + sum[axis] / count));
    }
}

/// How far along an edge the level is passed.
fn crossing(first: f32, second: f32, level: f32) -> f64 {
    if first.is_infinite() || second.is_infinite() {
        return 0.5;
    }
    let (first, second, level) = (f64::from(first), f64::from(second), f64::from(level));
    ((level - first) / (second - first)).clamp(0.0, 1.0)
}
