//! Closed roofs over level faces, from the straight skeleton.

use glam::{DMat3, DVec3};

use super::mesh::{Face, Mesh};
use crate::skeleton::{roof, Eaves, FaceOrigin, SkeletonError};

/// The kinds of roof that follow from slopes alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoofKind {
    /// Every edge of the outline carries a slope.
    Hip,
    /// Slopes that would be triangles stand upright instead.
    Gable,
}

/// The solid between each face of a sheet and the roof over it, one closed shell per face.
///
/// `slope` is the tangent of the angle between the roof and its face. Each face of the sheet is
/// the floor of its roof and has to be planar; its normal is where the roof rises.
pub fn roofed(sheet: &Mesh, kind: RoofKind, slope: f64) -> Result<Mesh, SkeletonError> {
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let axes = axes_of(face.normal());
        let rings = flattened(sheet, face, axes);
        let eaves = match kind {
            RoofKind::Hip => Eaves::even(&rings)?,
            RoofKind::Gable => gables(&Eaves::even(&rings)?)?,
        };
        let origin = axes * DVec3::new(0.0, 0.0, level_of(sheet, face, axes));
        add_shell(&mut solid, &eaves, axes, origin, slope)?;
    }
    Ok(solid)
}

/// The same eaves with an upright end wherever a hip roof has a triangle; of two such ends side by
/// side, the first.
fn gables(even: &Eaves) -> Result<Eaves, SkeletonError> {
    let hip = roof(even, None)?;
    let mut speeds = vec![1.0; even.len()];
    for face in &hip.faces {
        let FaceOrigin::Edge(edge) = face.origin else {
            continue;
        };
        let edge = edge as usize;
        let stands_beside = speeds[even.previous(edge)] == 0.0 || speeds[even.next(edge)] == 0.0;
        if face.rings[0].len() == 3 && !stands_beside {
            speeds[edge] = 0.0;
        }
    }
    even.with_speeds(&speeds)
}

fn add_shell(
    solid: &mut Mesh,
    eaves: &Eaves,
    axes: DMat3,
    origin: DVec3,
    slope: f64,
) -> Result<(), SkeletonError> {
    let found = roof(eaves, None)?;
    let first = solid.points.len() as u32;
    for &[x, y, z] in &found.nodes_m {
        solid.push_point(origin + axes * DVec3::new(x, y, z * slope));
    }
    let shifted = |ring: &Vec<u32>| ring.iter().map(|&node| node + first).collect::<Vec<_>>();
    for face in &found.faces {
        let rings: Vec<Vec<u32>> = face.rings.iter().map(shifted).collect();
        solid.push_face(&rings);
    }
    let mut floor = Vec::with_capacity(eaves.ring_count());
    let mut at = first;
    for ring in 0..eaves.ring_count() {
        let end = at + eaves.ring(ring).len() as u32;
        floor.push((at..end).rev().collect::<Vec<_>>());
        at = end;
    }
    solid.push_face(&floor);
    Ok(())
}

/// Axes with z along the normal.
fn axes_of(normal: DVec3) -> DMat3 {
    let (x, y) = normal.any_orthonormal_pair();
    DMat3::from_cols(x, y, normal)
}

fn flattened(sheet: &Mesh, face: Face<'_>, axes: DMat3) -> Vec<Vec<[f64; 2]>> {
    let local = axes.transpose();
    face.rings()
        .map(|ring| {
            let flat = |&point: &u32| {
                let own = local * sheet.points[point as usize];
                [own.x, own.y]
            };
            ring.iter().map(flat).collect()
        })
        .collect()
}

fn level_of(sheet: &Mesh, face: Face<'_>, axes: DMat3) -> f64 {
    sheet.points[face.outline()[0] as usize].dot(axes.z_axis)
}
