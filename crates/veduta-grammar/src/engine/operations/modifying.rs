//! `modify`: parts of a shape are changed, and the rest comes with them.

use std::collections::HashMap;

use glam::DVec3;
use veduta_geometry::solid::{joined, Mesh};

use super::super::code::{Cell, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::selection::{kind_named, Choosing};
use super::super::state::State;
use super::components::selectors;
use super::inlining::recomposed;
use super::word;
use crate::ast::Joining;
use crate::shape::{Component, Form, Geometry, Kind, TOLERANCE};

/// `modify(f | e | fe | v | fv) { selector : operations | ... }`: as `comp`, but what the operations leave takes
/// the place of the component, and the shape stays one.
///
/// Where a face, an edge or a vertex has only been moved, turned or sized, the corners of all faces
/// there go with it, by the sum of what moves them, and faces that this bends become triangles. Where a face has become something
/// else, that is in its place.
pub fn modify(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let named = word(run, op, 0, frame)?;
    let kind = match kind_named(&named) {
        Some(Kind::Holes | Kind::Groups | Kind::Materials) | None => {
            let message = format!("`{named}` cannot be modified: f, e, fe, v or fv");
            return Err(Fault::at(op.span, message));
        }
        Some(kind) => kind,
    };
    let whole = frame.state.clone();
    let mut parts = Parts::of(&whole.form);
    let mut choosing = Choosing::of(&whole.form, kind, run);
    let places: Vec<Vec<DVec3>> = choosing.found.iter().map(|one| ends(kind, one)).collect();
    if op.args.len() > 1 && word(run, op, 1, frame)?.as_ref() == "noAlign" {
        choosing = choosing.unaligned();
    }
    let chosen = run.chosen(selectors(op), &choosing, op.span, &mut frame.scene())?;
    for (cell, picked) in op.cells.iter().zip(chosen) {
        let Cell::Part {
            selector,
            joining: Joining::Each,
            body,
            ..
        } = cell
        else {
            return Err(Fault::at(op.span, "`modify` takes `:` after a selector"));
        };
        for at in picked {
            let mut state = choosing.state(&whole, at);
            state.selector = selector.name();
            let left = run.inlined(body, state, op.span, frame)?;
            parts.take(kind, &choosing.found[at], &places[at], &left);
        }
    }
    frame.state = whole;
    let axes = frame.state.form.scope.axes;
    let mesh = parts
        .put_together()
        .map_err(|message| Fault::at(op.span, message))?;
    frame.state.form = if mesh.is_empty() {
        Form {
            geometry: Geometry::Nothing,
            ..frame.state.form.clone()
        }
    } else {
        let solid = mesh.is_closed();
        Form::around(mesh, axes, solid)
    };
    frame.changed();
    Ok(())
}

/// The ends of an edge, and the place of a vertex.
fn ends(kind: Kind, part: &Component) -> Vec<DVec3> {
    let scope = part.form.scope;
    match kind {
        Kind::Edges | Kind::FaceEdges => vec![scope.origin, scope.world(DVec3::X)],
        Kind::Vertices | Kind::FaceVertices => vec![scope.origin],
        _ => Vec::new(),
    }
}

/// A shape with what has become of its parts.
struct Parts {
    /// The shape in the world, with corners at one place as one.
    mesh: Mesh,
    near: f64,
    /// Where points have been moved to, once for each part that has.
    moved: HashMap<u32, Vec<DVec3>>,
    /// The faces that are something else now.
    replaced: Vec<usize>,
    instead: Vec<Mesh>,
}

impl Parts {
    fn of(form: &Form) -> Self {
        let near = form.scope.size.length() * TOLERANCE;
        Self {
            mesh: joined(&[&form.world_mesh()], near),
            near,
            moved: HashMap::new(),
            replaced: Vec::new(),
            instead: Vec::new(),
        }
    }

    /// `ends` are the places of an edge or a vertex.
    fn take(&mut self, kind: Kind, part: &Component, ends: &[DVec3], left: &[State]) {
        let (before, form) = (&part.form, left.first().map(|state| &state.form));
        match (kind, form) {
            (Kind::Faces, Some(form)) if left.len() == 1 && form.geometry == before.geometry => {
                let (old, new) = (before.world_mesh(), form.world_mesh());
                for (&old, &new) in old.points.iter().zip(&new.points) {
                    self.move_point(old, new);
                }
            }
            (Kind::Faces, _) => {
                let old = before.world_mesh();
                let face = self.mesh.faces().find(|face| {
                    face.points()
                        .all(|p| old.points.iter().any(|o| o.distance(p) <= 4.0 * self.near))
                });
                self.replaced.extend(face.map(|face| face.index()));
                self.instead
                    .extend(left.iter().map(|state| state.form.world_mesh()));
            }
            (_, Some(form)) if left.len() == 1 => {
                for &end in ends {
                    self.move_point(end, form.scope.world(before.scope.unit(end)));
                }
            }
            _ => {}
        }
    }

    fn move_point(&mut self, old: DVec3, new: DVec3) {
        let points = self.mesh.points.iter();
        let found = points
            .enumerate()
            .find(|(_, point)| point.distance(old) <= 4.0 * self.near);
        if let Some((number, _)) = found {
            self.moved.entry(number as u32).or_default().push(new);
        }
    }

    /// The shape as one; Err says what cannot be.
    fn put_together(mut self) -> Result<Mesh, String> {
        for (&number, places) in &self.moved {
            let point = &mut self.mesh.points[number as usize];
            let from = *point;
            *point += places.iter().map(|to| *to - from).sum::<DVec3>();
        }
        let mut rest = Mesh::with_points(self.mesh.points.clone());
        for face in self.mesh.faces() {
            if self.replaced.contains(&face.index()) {
                continue;
            }
            let normal = face.normal();
            let height = self.mesh.points[face.outline()[0] as usize].dot(normal);
            let is_bent = face
                .points()
                .any(|p| (p.dot(normal) - height).abs() > 1e3 * self.near);
            if !is_bent {
                rest.push_face(&face.rings().collect::<Vec<_>>());
            } else if face.ring_count() > 1 {
                return Err("a face with a hole would be bent".into());
            } else {
                let ring = face.outline();
                for k in 1..ring.len() - 1 {
                    rest.push_face(&[[ring[0], ring[k], ring[k + 1]]]);
                }
            }
        }
        let rest = rest.compact();
        let mut all = vec![&rest];
        all.extend(&self.instead);
        Ok(recomposed(&all))
    }
}
