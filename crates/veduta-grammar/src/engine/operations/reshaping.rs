//! The whole geometry of a shape anew: as it was at first, seen from above, cleaned, squared.

use glam::{DVec2, DVec3};
use veduta_geometry::solid::{boolean_within, cleaned, Boolean, Cleaning, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::{number, word};
use crate::shape::{Form, Geometry, TOLERANCE};

/// `resetGeometry()`: scope, geometry and pivot of the start shape, and no planes for `trim`. Looks, attributes and what
/// `setupProjection` has prepared stay.
pub fn reset(run: &mut Run<'_>, _: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    frame.state.form = run.first().state.form.clone();
    if frame.state.extra.is_some() {
        let extra = frame.state.extra_mut();
        extra.pivot = None;
        extra.trims.clear();
    }
    frame.state.replaced();
    frame.changed();
    Ok(())
}

/// The most faces that a footprint is made of.
const MOST_SEEN: usize = 2_000;

/// `footprint()`: what of the plane y = 0 of the scope lies under the geometry, as faces that look
/// up.
pub fn footprint(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let scope = frame.state.form.scope;
    let solid = frame.state.form.geometry.is_solid();
    let mesh = frame.state.form.world_mesh();
    let up = scope.axes.y_axis;
    let is_seen = |normal: DVec3| {
        let rise = normal.dot(up);
        rise > TOLERANCE || (!solid && rise < -TOLERANCE)
    };
    let seen: Vec<usize> = (0..mesh.face_count())
        .filter(|&face| is_seen(mesh.face(face).normal()))
        .collect();
    if seen.len() > MOST_SEEN {
        let message = format!(
            "a footprint of {} faces; {MOST_SEEN} are the most",
            seen.len()
        );
        return Err(Fault::at(op.span, message));
    }
    let low = scope.origin.dot(up);
    let mut whole = Mesh::new();
    for face in seen {
        run.check_time(op.span)?;
        let turned = mesh.face(face).normal().dot(up) < 0.0;
        let flat = mesh
            .of_faces([face])
            .mapped(|point| point + up * (low - point.dot(up)));
        let flat = if turned { flat.reversed() } else { flat };
        whole = if whole.is_empty() {
            flat
        } else {
            let both = boolean_within(&whole, &flat, Boolean::Union, run.budget());
            both.map_err(|error| run.failed(op.span, error))?.mesh
        };
    }
    let extent = whole.bounds().map_or(0.0, |(low, high)| low.distance(high));
    run.take(STEPS_PER_CORNER * whole.corner_count(), op.span)?;
    let whole = cleaned(
        &whole,
        &Cleaning {
            points: true,
            edges: true,
            faces: false,
            near: extent * TOLERANCE,
            angle: 1e-6,
            area: 0.0,
        },
    );
    frame.state.form = if whole.is_empty() {
        Form {
            scope,
            geometry: Geometry::Nothing,
        }
    } else {
        Form::around(whole, scope.axes, false)
    };
    frame.changed();
    Ok(())
}

/// What a corner of what is cleaned costs, in steps of the budget.
const STEPS_PER_CORNER: usize = 16;

/// How far points may be apart (m), edges from straight and faces from level (degrees), and how
/// large faces may be (m2), for `cleanupGeometry` with tolerance 1.
const WIDEST: (f64, f64, f64) = (1.0, 10.0, 1.0);

/// `cleanupGeometry(all | vertices | edges | faces, tolerance)`: points at one place become one, and
/// points on straight edges, edges between level faces, and small or double faces go. With tolerance
/// 0 nothing is seen of it; with 1, points may be 1 m apart, edges and faces 10 degrees from straight,
/// and faces of 1 m2 go.
pub fn clean(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let what = word(run, op, 0, frame)?;
    let tolerance = number(run, op, 1, frame)?;
    if !(0.0..=1.0).contains(&tolerance) {
        let message = format!("a tolerance from 0 to 1 is needed, not {tolerance}");
        return Err(Fault::at(op.span, message));
    }
    let takes = |one: &str| what.as_ref() == one || what.as_ref() == "all";
    let form = &frame.state.form;
    let Geometry::Faces { solid, .. } = form.geometry else {
        frame.changed();
        return Ok(());
    };
    let extent = form.scope.size.length();
    let mesh = form.world_mesh();
    run.take(STEPS_PER_CORNER * mesh.corner_count(), op.span)?;
    let clean = cleaned(
        &mesh,
        &Cleaning {
            points: takes("vertices"),
            edges: takes("edges"),
            faces: takes("faces"),
            near: (tolerance * WIDEST.0).max(extent * TOLERANCE),
            angle: (tolerance * WIDEST.1).max(1e-6).to_radians(),
            area: (tolerance * WIDEST.2).max(extent * extent * 1e-15),
        },
    );
    let scope = form.scope;
    frame.state.form = if clean.is_empty() {
        Form {
            scope,
            geometry: Geometry::Nothing,
        }
    } else {
        let solid = solid && clean.is_closed();
        Form::around(clean, scope.axes, solid)
    };
    frame.changed();
    Ok(())
}

/// `rectify(angle)`: edges that are no farther than this (degrees, up to 45) from an axis of the
/// scope run along it, in that plane of the scope which each face is nearest to. Each turns about
/// its middle; those in a row along one axis come onto one line.
pub fn rectify(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let angle = number(run, op, 0, frame)?;
    if !(0.0..=45.0).contains(&angle) {
        let message = format!("an angle from 0 to 45 degrees is needed, not {angle}");
        return Err(Fault::at(op.span, message));
    }
    let form = &frame.state.form;
    if form.geometry.is_solid() {
        return Err(Fault::at(
            op.span,
            "solids are not made square: take their faces",
        ));
    }
    let axes = form.scope.axes;
    let mesh = form.world_mesh().mapped(|point| axes.transpose() * point);
    let mut square = Mesh::new();
    for face in mesh.faces() {
        let normal = face.normal();
        if normal == DVec3::ZERO {
            continue;
        }
        let size = normal.abs();
        let across = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
        let (u, v) = ((across + 1) % 3, (across + 2) % 3);
        let height = mesh.points[face.outline()[0] as usize].dot(normal);
        let rings: Vec<Vec<DVec3>> = face
            .rings()
            .map(|ring| {
                let flat = |&p: &u32| {
                    let point = mesh.points[p as usize];
                    DVec2::new(point[u], point[v])
                };
                let corners = squared(&ring.iter().map(flat).collect::<Vec<_>>(), angle);
                let raised = |flat: DVec2| {
                    let mut point = DVec3::ZERO;
                    (point[u], point[v]) = (flat.x, flat.y);
                    point[across] = (height - point.dot(normal)) / normal[across];
                    point
                };
                corners.into_iter().map(raised).collect()
            })
            .collect();
        square.append(&Mesh::polygon(&rings));
    }
    if !square.is_empty() {
        frame.state.form = Form::around(square.mapped(|point| axes * point), axes, false);
    }
    frame.changed();
    Ok(())
}

/// A ring with its edges along x and y where they are near to that.
fn squared(ring: &[DVec2], degrees: f64) -> Vec<DVec2> {
    let count = ring.len();
    let limit = degrees.to_radians().sin() + 1e-12;
    // For each edge the axis (0, 1) that it is to run along.
    let axis: Vec<Option<usize>> = (0..count)
        .map(|k| {
            let along = (ring[(k + 1) % count] - ring[k]).normalize_or_zero();
            (0..2).find(|&axis| along[1 - axis].abs() <= limit)
        })
        .collect();
    let line = |k: usize| -> (DVec2, DVec2) {
        let edge = |k: usize| (ring[k], ring[(k + 1) % count]);
        let (from, to) = edge(k);
        let Some(own) = axis[k] else {
            return (from, to - from);
        };
        // All edges of the row that this one is in.
        let mut first = k;
        while axis[(first + count - 1) % count] == Some(own) && (first + count - 1) % count != k {
            first = (first + count - 1) % count;
        }
        let (mut sum, mut lengths, mut at) = (DVec2::ZERO, 0.0, first);
        loop {
            let (from, to) = edge(at);
            sum += 0.5 * (from + to) * from.distance(to);
            lengths += from.distance(to);
            at = (at + 1) % count;
            if axis[at] != Some(own) || at == first {
                break;
            }
        }
        let mut along = DVec2::ZERO;
        along[own] = 1.0;
        (if lengths > 0.0 { sum / lengths } else { from }, along)
    };
    (0..count)
        .map(|k| {
            let ((a, along), (b, other)) = (line((k + count - 1) % count), line(k));
            let across = along.perp_dot(other);
            if across.abs() <= 1e-9 * along.length() * other.length() {
                let along = other.normalize_or_zero();
                return b + along * (ring[k] - b).dot(along);
            }
            a + along * ((b - a).perp_dot(other) / across)
        })
        .collect()
}
