//! `trim`: what reaches over the edges that a face had, is cut off.

use std::collections::HashMap;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{cut, weld, Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use crate::shape::{Component, Form, Geometry, TOLERANCE};

/// Edges that are less steep than this are level (degrees).
const LEVEL: f64 = 40.0;

/// A plane that bounds what may stand on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrimPlane {
    /// Towards what stays.
    normal: DVec3,
    height: f64,
    /// Whether it came from an edge that is level rather than steep.
    level: bool,
}

/// `trim()`: what lies beyond the planes goes that part the face from its neighbours, since the last
/// `comp(f)`: each goes through an edge between them, and has the same angle to both. Of steep edges
/// where `trim.vertical` is true, as at first, of others where `trim.horizontal` is. Closed shapes stay
/// closed. Other than in CityEngine primitives are not trimmed by themselves.
pub fn trim(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let Some(extra) = frame.state.extra.clone() else {
        return Ok(());
    };
    let solid = frame.state.form.geometry.is_solid();
    let axes = frame.state.form.scope.axes;
    let mut mesh = frame.state.form.world_mesh();
    for plane in &extra.trims {
        let is_on = match plane.level {
            true => extra.trims_level,
            false => !extra.keeps_steep,
        };
        if is_on && !mesh.is_empty() {
            run.take(STEPS_PER_CORNER * mesh.corner_count(), op.span)?;
            mesh = kept(mesh, plane, solid);
        }
    }
    if mesh.is_empty() {
        frame.state.form.geometry = Geometry::Nothing;
    } else {
        frame.state.form = Form::around(mesh, axes, solid);
    }
    frame.changed();
    Ok(())
}

/// What a corner of what is cut costs, in steps of the budget.
const STEPS_PER_CORNER: usize = 4;

fn kept(mesh: Mesh, plane: &TrimPlane, solid: bool) -> Mesh {
    let (y, z) = plane.normal.any_orthonormal_pair();
    let axes = DMat3::from_cols(plane.normal, y, z);
    let own = mesh.mapped(|point| axes.transpose() * point);
    let (low, high) = own.bounds().unwrap_or_default();
    let near = TOLERANCE * low.distance(high);
    if low.x >= plane.height - near {
        return own.mapped(|point| axes * point);
    }
    let sides = cut(&own, 0, plane.height, near, solid);
    sides.above.mesh.mapped(|point| axes * point)
}

/// For each face the planes between it and the faces beside it.
pub fn planes(faces: &[Component]) -> Vec<Vec<TrimPlane>> {
    let mut all = Mesh::new();
    faces
        .iter()
        .for_each(|face| all.append(&face.form.world_mesh()));
    let extent = all.bounds().map_or(0.0, |(low, high)| low.distance(high));
    let first = weld(&all.points, extent * TOLERANCE);
    let edge = |(a, b): (u32, u32)| (first[a as usize], first[b as usize]);
    let mut normals: HashMap<(u32, u32), DVec3> = HashMap::new();
    for face in all.faces() {
        for ends in face.edges() {
            normals.insert(edge(ends), face.normal());
        }
    }
    let between = |face: Face<'_>, ends: (u32, u32)| {
        let (from, to) = edge(ends);
        let other = *normals.get(&(to, from))?;
        let start = all.points[from as usize];
        let along = (all.points[to as usize] - start).try_normalize()?;
        let own = face.normal();
        // Through the edge and the mean of the normals; a face folded back has its own.
        let up = (own + other).try_normalize().unwrap_or(own);
        let normal = up.cross(along).try_normalize()?;
        Some(TrimPlane {
            normal,
            height: normal.dot(start),
            level: along.y.abs() < LEVEL.to_radians().sin(),
        })
    };
    all.faces()
        .map(|face| {
            face.edges()
                .filter_map(|ends| between(face, ends))
                .collect()
        })
        .collect()
}
