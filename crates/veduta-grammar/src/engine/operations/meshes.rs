//! Faces as they are made up: holes and convex pieces.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use veduta_geometry::solid::{self, Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::positive;
use crate::shape::{Form, Geometry, TOLERANCE};

/// `deleteHoles()`: the faces without their holes. The walls of a shaft through a solid stay, so
/// that the shape is then no longer closed.
pub fn delete_holes(_: &mut Run<'_>, _: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let form = &frame.state.form;
    if let Geometry::Faces { mesh, solid } = &form.geometry {
        if mesh.faces().any(|face| face.ring_count() > 1) {
            let mut filled = Mesh::with_points(mesh.points.clone());
            for face in mesh.faces() {
                filled.push_face(&[face.outline()]);
            }
            let still = *solid && filled.is_closed();
            frame.state.form.geometry = Geometry::of(filled.compact(), still);
        }
    }
    frame.changed();
    Ok(())
}

/// `convexify()`, `convexify(length)`: faces with holes or corners that turn inwards as convex pieces,
/// by cuts that are shorter than the length (m); holes are cut in any case. Pieces share their points,
/// so that closed shapes stay closed.
pub fn convexify(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let longest = match op.args.len() {
        0 => f64::INFINITY,
        _ => positive(run, op, 0, frame)?,
    };
    let inwards = TOLERANCE;
    let form = &frame.state.form;
    let Geometry::Faces { solid, .. } = &form.geometry else {
        frame.changed();
        return Ok(());
    };
    let (solid, axes) = (*solid, form.scope.axes);
    let mesh = form.world_mesh();
    let mut pieces = Mesh::with_points(mesh.points.clone());
    for face in mesh.faces() {
        run.check_time(op.span)?;
        let normal = face.normal();
        if face.ring_count() == 1 && is_convex(&mesh.points, face.outline(), normal, inwards) {
            pieces.push_face(&[face.outline()]);
            continue;
        }
        let corners = face.edges().count();
        run.take(corners.saturating_mul(corners), op.span)?;
        let triangles = triangles(&mesh, face)
            .map_err(|error| Fault::at(op.span, format!("a face cannot be divided: {error}")))?;
        let convex = convex_pieces(&mesh.points, triangles, normal, inwards);
        for piece in without_cuts_from(longest, &mesh.points, convex) {
            pieces.push_face(&[piece]);
        }
    }
    frame.state.form = Form::around(pieces.compact(), axes, solid);
    frame.changed();
    Ok(())
}

/// The triangles of a face, as numbers of the mesh's points.
pub fn triangles(mesh: &Mesh, face: Face<'_>) -> Result<Vec<[u32; 3]>, String> {
    let extent = mesh.bounds().map_or(0.0, |(low, high)| low.distance(high));
    solid::triangles(mesh, face, 1e-6 * extent).map_err(|error| error.to_string())
}

/// Triangles joined across their sides as long as that stays convex (Hertel and Mehlhorn 1983).
fn convex_pieces(
    points: &[DVec3],
    triangles: Vec<[u32; 3]>,
    normal: DVec3,
    inwards: f64,
) -> Vec<Vec<u32>> {
    let mut pieces: Vec<Vec<u32>> = triangles.iter().map(|t| t.to_vec()).collect();
    let mut owner: HashMap<(u32, u32), usize> = HashMap::new();
    for (index, piece) in pieces.iter().enumerate() {
        for side in sides(piece) {
            owner.insert(side, index);
        }
    }
    let all: Vec<(u32, u32)> = triangles
        .iter()
        .flat_map(|t| sides(t).collect::<Vec<_>>())
        .collect();
    for (a, b) in all {
        let (Some(&one), Some(&other)) = (owner.get(&(a, b)), owner.get(&(b, a))) else {
            continue;
        };
        if one == other {
            continue;
        }
        let Some(whole) = joined(&pieces[one], &pieces[other], a, b) else {
            continue;
        };
        if is_convex(points, &whole, normal, inwards) {
            owner.remove(&(a, b));
            owner.remove(&(b, a));
            for side in sides(&whole) {
                owner.insert(side, one);
            }
            pieces[one] = whole;
            pieces[other].clear();
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// The pieces joined across cuts that are as long as this (m), the longest first, where that leaves rings.
fn without_cuts_from(length: f64, points: &[DVec3], mut pieces: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    if length == f64::INFINITY {
        return pieces;
    }
    let far = |(a, b): (u32, u32)| points[a as usize].distance(points[b as usize]);
    let all: HashSet<(u32, u32)> = pieces.iter().flat_map(|piece| sides(piece)).collect();
    let is_cut = |&(a, b): &(u32, u32)| a < b && all.contains(&(b, a)) && far((a, b)) >= length;
    let mut cuts: Vec<(u32, u32)> = all.iter().copied().filter(is_cut).collect();
    cuts.sort_by(|a, b| far(*b).total_cmp(&far(*a)).then(a.cmp(b)));
    for (a, b) in cuts {
        let owner = |side| {
            pieces
                .iter()
                .position(|piece| sides(piece).any(|own| own == side))
        };
        let (Some(one), Some(other)) = (owner((a, b)), owner((b, a))) else {
            continue;
        };
        let whole = joined(&pieces[one], &pieces[other], a, b).filter(|ring| {
            let own: HashSet<(u32, u32)> = sides(ring).collect();
            one != other && own.iter().all(|&(a, b)| !own.contains(&(b, a)))
        });
        if let Some(whole) = whole {
            pieces[one] = whole;
            pieces[other].clear();
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// Two rings as one across the side from `a` to `b` of the first.
fn joined(one: &[u32], other: &[u32], a: u32, b: u32) -> Option<Vec<u32>> {
    let after = one.iter().position(|&p| p == b)?;
    let start = other.iter().position(|&p| p == a)?;
    let mut whole: Vec<u32> = (0..one.len())
        .map(|k| one[(after + k) % one.len()])
        .collect();
    if whole.last() != Some(&a) {
        return None;
    }
    whole.extend((1..other.len() - 1).map(|k| other[(start + k) % other.len()]));
    Some(whole)
}

fn sides(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().copied().zip(next.copied())
}

/// Whether no corner of a ring turns inwards by more than an angle of this sine.
fn is_convex(points: &[DVec3], ring: &[u32], normal: DVec3, inwards: f64) -> bool {
    let count = ring.len();
    (0..count).all(|k| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| points[ring[k % count] as usize]);
        let (before, after) = (b - a, c - b);
        before.cross(after).dot(normal) >= -inwards * before.length() * after.length()
    })
}
