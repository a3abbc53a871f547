//! Closed roofs over level faces, from the straight skeleton.

use super::inset::{grown, Rings};
use super::level::Level;
use super::mesh::Mesh;
use crate::skeleton::{roof, Eaves, FaceOrigin, SkeletonError};

/// The kinds of roof that follow from slopes alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoofKind {
    /// Every edge of the outline carries a slope.
    Hip,
    /// Slopes that would be triangles stand upright instead.
    Gable,
}

/// How far a roof reaches beyond its outline, measured level. Its planes go on: eaves that reach
/// out lie lower.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overhang {
    pub eaves: f64,
    pub gables: f64,
}

/// The solid between each face of a sheet and the roof over it, one closed shell per face.
///
/// `slope` is the tangent of the angle between the roof and its face. Each face of the sheet is
/// the floor of its roof and has to be planar; its normal is where the roof rises.
pub fn roofed(sheet: &Mesh, kind: RoofKind, slope: f64) -> Result<Mesh, SkeletonError> {
    roofed_over(sheet, kind, slope, Overhang::default())
}

/// As [`roofed`], with eaves and gables that reach out. The floor lies where the eaves do.
pub fn roofed_over(
    sheet: &Mesh,
    kind: RoofKind,
    slope: f64,
    overhang: Overhang,
) -> Result<Mesh, SkeletonError> {
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let level = Level::of(sheet, face);
        let rings = level.flat(sheet, face);
        let mut eaves = match kind {
            RoofKind::Hip => Eaves::even(&rings)?,
            RoofKind::Gable => gables(&Eaves::even(&rings)?)?,
        };
        if overhang != Overhang::default() {
            eaves = reaching(&rings, &eaves, overhang)?;
        }
        add_shell(&mut solid, &eaves, &level, -overhang.eaves * slope, slope)?;
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

fn reaching(rings: &Rings, eaves: &Eaves, overhang: Overhang) -> Result<Eaves, SkeletonError> {
    let distance = |&speed: &f64| {
        if speed == 0.0 {
            overhang.gables
        } else {
            overhang.eaves
        }
    };
    let distances: Vec<f64> = eaves.speeds().iter().map(distance).collect();
    let larger = grown(rings, &distances, |_, _| {})?;
    let speed = |&edge: &u32| eaves.speeds()[edge as usize];
    let speeds: Vec<f64> = larger.along.iter().map(speed).collect();
    Eaves::new(&larger.rings, &speeds)
}

fn add_shell(
    solid: &mut Mesh,
    eaves: &Eaves,
    level: &Level,
    base: f64,
    slope: f64,
) -> Result<(), SkeletonError> {
    let found = roof(eaves, None)?;
    let first = solid.points.len() as u32;
    for &[x, y, z] in &found.nodes_m {
        solid.push_point(level.place([x, y], base + z * slope));
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
