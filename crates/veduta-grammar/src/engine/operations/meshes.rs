//! Faces as they are made up: holes and convex pieces.

use std::collections::HashMap;

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

/// `convexify()`, `convexify(angle)`: faces with holes or corners that turn inwards as convex pieces.
/// Corners that turn inwards by no more than the angle (degrees) count as convex. Pieces share their
/// points, so that closed shapes stay closed.
pub fn convexify(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let angle = match op.args.len() {
        0 => 0.0,
        _ => positive(run, op, 0, frame)?.min(90.0),
    };
    let inwards = angle.to_radians().sin().max(TOLERANCE);
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
        for piece in convex_pieces(&mesh.points, triangles, normal, inwards) {
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
