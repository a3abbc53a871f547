//! `splitAndSetbackPerimeter`: strips of different depths around a face.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{boolean_within, cut, inset_within, joined, merged, Boolean, Mesh};

use super::super::code::{Body, Cell, Expr, Operation, Selector};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::selection::REMAINDER;
use super::super::state::{Place, State};
use super::super::value::Value;
use super::components::run_shapes;
use super::dividing::patterns;
use super::{length, number, value};
use crate::shape::{cells, Form, Pattern, TOLERANCE};

/// The most sections of one outline: each is compared with those that it may overlap.
const MOST_SECTIONS: usize = 1_000;

/// `splitAndSetbackPerimeter(offset) { length : depth : A | ... } { remainder : B }`, also with `*`
/// after the first block, or as `splitAndSetbackPerimeter(offset, first edge, mask)`: the outline of
/// each face is divided by the lengths (`'` takes them of the whole outline), from `offset` on,
/// counter-clockwise from its first edge, and each section moves inwards by its depth. A mask of
/// true and false says which edges take part, face by face. Where strips overlap, the deeper one has
/// it; a section that ends within an edge ends at a right angle there.
pub fn split_and_set_back(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
) -> Result<(), Fault> {
    run.record(None, &frame.state, op.span)?;
    let whole = frame.state.clone();
    let mesh = whole.form.world_mesh();
    let (first, mask) = chosen(run, op, frame)?;
    let mut edges_before = 0;
    let mut sections = Vec::new();
    let mut rest = Mesh::new();
    for face in 0..mesh.face_count() {
        let outline = Outline::of(&mesh, face, first, mask.as_deref(), edges_before);
        edges_before += mesh.face(face).edges().count();
        let mut found = sections_of(run, op, &outline, &whole, frame)?;
        rest.append(&divided(run, op, &mesh, &outline, &mut found)?);
        sections.extend(found);
    }
    let total = sections.len();
    for (index, section) in sections.into_iter().enumerate() {
        if section.strip.is_empty() {
            continue;
        }
        let form = Form::around(section.strip, whole.form.scope.axes, false);
        let mut state = whole.with_form(form);
        state.split = Place { index, total };
        run.run_cell(section.body, state, frame)?;
    }
    for cell in &op.cells {
        let Some((selector, joining, body)) = cell.part() else {
            continue;
        };
        if is_rest(selector) {
            let shapes = super::setbacks::as_shapes(rest.clone(), whole.form.scope.axes, joining);
            run_shapes(run, body, shapes, &whole, &selector.name(), frame)?;
        }
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

fn is_rest(selector: &Selector) -> bool {
    matches!(selector, Selector::Word(word) if word.as_ref() == REMAINDER)
}

/// The number of the first edge, and which edges take part; None where all do.
fn chosen(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
) -> Result<(f64, Option<Vec<bool>>), Fault> {
    if op.args.len() < 3 {
        return Ok((0.0, None));
    }
    let first = number(run, op, 1, frame)?;
    let given = value(run, op, 2, frame)?;
    let Value::Array(array) = &given else {
        let message = format!("an array of true and false is needed, not {}", given.kind());
        return Err(Fault::at(op.span, message));
    };
    let taken = array.values.iter().map(|value| value.truth() == Some(true));
    Ok((first, Some(taken.collect())))
}

/// The edges of a face's outline that take part, in their order.
struct Outline {
    face: usize,
    /// Number in the face, start, direction, length (m).
    edges: Vec<(usize, DVec3, DVec3, f64)>,
    length: f64,
}

impl Outline {
    fn of(mesh: &Mesh, face: usize, first: f64, mask: Option<&[bool]>, before: usize) -> Self {
        let ring = mesh.face(face).outline();
        let count = ring.len();
        let start = first.rem_euclid(count as f64) as usize;
        let takes_part = |edge: &usize| {
            mask.is_none_or(|mask| mask.get(before + edge).copied().unwrap_or(false))
        };
        let numbers = (0..count).map(|k| (start + k) % count).filter(takes_part);
        let edges: Vec<_> = numbers
            .map(|edge| {
                let [a, b] = [edge, (edge + 1) % count].map(|at| mesh.points[ring[at] as usize]);
                (edge, a, (b - a).normalize_or_zero(), a.distance(b))
            })
            .collect();
        let length = edges.iter().map(|edge| edge.3).sum();
        Self {
            face,
            edges,
            length,
        }
    }

    /// The parts of edges between two places along the outline: the place of each in `edges`, and from
    /// where to where on it (m).
    fn between(&self, from: f64, to: f64) -> Vec<(usize, f64, f64)> {
        let near = TOLERANCE * self.length;
        let mut found = Vec::new();
        // A section may go past the end, on to the first edge.
        for round in [0.0, self.length] {
            let mut at = round;
            for (place, edge) in self.edges.iter().enumerate() {
                let (low, high) = ((from - at).max(0.0), (to - at).min(edge.3));
                if high - low > near {
                    found.push((place, low, high));
                }
                at += edge.3;
            }
        }
        found
    }
}

/// A section of an outline with the strip along it.
struct Section<'o> {
    body: &'o Body,
    from: f64,
    to: f64,
    depth: f64,
    strip: Mesh,
}

/// The sections of an outline as they are written; their strips are still empty.
fn sections_of<'o>(
    run: &mut Run<'_>,
    op: &'o Operation,
    outline: &Outline,
    whole: &State,
    frame: &mut Frame,
) -> Result<Vec<Section<'o>>, Fault> {
    if outline.length <= 0.0 {
        return Ok(Vec::new());
    }
    let offset = length(run, op, 0, outline.length, frame)?.rem_euclid(outline.length);
    let sized: Vec<Cell> = op
        .cells
        .iter()
        .filter(|cell| !of_rest(cell))
        .cloned()
        .collect();
    let mut bodies = Vec::new();
    let mut pattern = patterns(run, op, &sized, outline.length, &mut bodies, frame)?;
    if op.repeat {
        pattern = vec![Pattern::Repeat(pattern)];
    }
    let most = run.options.limits.parts.min(MOST_SECTIONS);
    let found = cells(&pattern, outline.length, most)
        .map_err(|many| run.too_many_parts(most, op.span, &many))?;
    let mut written = Vec::new();
    in_order(&op.cells, &mut written);
    let total = found.len();
    let mut sections = Vec::with_capacity(total);
    for (index, cell) in found.into_iter().enumerate() {
        let (depth, body) = written[cell.part];
        let mut state = whole.clone();
        state.split = Place { index, total };
        let far = run.finite(depth, &mut frame.scene().of(&state))?;
        if !(far.is_finite() && far >= 0.0) {
            let message = format!("a depth from 0 on is needed, not {far}");
            return Err(Fault::at(depth.span, message));
        }
        let from = cell.start + offset;
        sections.push(Section {
            body,
            from,
            to: from + cell.length,
            depth: far,
            strip: Mesh::new(),
        });
    }
    Ok(sections)
}

fn of_rest(cell: &Cell) -> bool {
    matches!(cell, Cell::Part { selector, .. } if is_rest(selector))
}

/// Depths and bodies in the order in which the parts of a pattern are numbered.
fn in_order<'o>(cells: &'o [Cell], found: &mut Vec<(&'o Expr, &'o Body)>) {
    for cell in cells {
        match cell {
            Cell::Part {
                depth: Some(depth),
                body,
                ..
            } => found.push((depth, body)),
            Cell::Part { .. } => {}
            Cell::Repeat(inner) => in_order(inner, found),
        }
    }
}

/// Gives the sections of a face their strips, the deepest first, and what is left of it.
fn divided(
    run: &Run<'_>,
    op: &Operation,
    mesh: &Mesh,
    outline: &Outline,
    sections: &mut [Section<'_>],
) -> Result<Mesh, Fault> {
    let mut order: Vec<usize> = (0..sections.len()).collect();
    order.sort_by(|&a, &b| sections[b].depth.total_cmp(&sections[a].depth));
    let mut rest = mesh.of_faces([outline.face]);
    for at in order {
        run.check_time(op.span)?;
        let section = &sections[at];
        if section.depth == 0.0 || rest.is_empty() {
            continue;
        }
        let strip = strip(run, op, mesh, outline, section)?;
        if strip.is_empty() {
            continue;
        }
        // What is left has no part in deeper strips.
        let of = |operation| {
            let found = boolean_within(&rest, &strip, operation, run.budget());
            found.map_err(|error| run.failed(op.span, error))
        };
        let (own, left) = (of(Boolean::Intersect)?.mesh, of(Boolean::Subtract)?.mesh);
        sections[at].strip = own;
        rest = left;
    }
    Ok(rest)
}

/// The strip along a section, whatever else lies there.
fn strip(
    run: &Run<'_>,
    op: &Operation,
    mesh: &Mesh,
    outline: &Outline,
    section: &Section<'_>,
) -> Result<Mesh, Fault> {
    let parts = outline.between(section.from, section.to);
    let face = mesh.face(outline.face);
    let mut distances = vec![0.0; face.edges().count()];
    for &(place, ..) in &parts {
        distances[outline.edges[place].0] = section.depth;
    }
    let pieces = inset_within(mesh, face, &distances, run.budget())
        .map_err(|error| run.failed(op.span, format!("no setback here: {error}")))?;
    let near = TOLERANCE * outline.length;
    let mut found: Vec<Mesh> = Vec::new();
    for (place, from, to) in parts {
        let (edge, start, along, size) = outline.edges[place];
        let all = pieces.along.iter().enumerate();
        let own = all
            .filter(|(_, of)| **of == Some(edge as u32))
            .map(|(at, _)| at);
        let mut piece = pieces.mesh.of_faces(own);
        run.take(pieces.mesh.corner_count(), op.span)?;
        let (y, z) = along.any_orthonormal_pair();
        let axes = DMat3::from_cols(along, y, z);
        let local = |point: DVec3| axes.transpose() * (point - start);
        if from > near {
            piece = cut(&piece.mapped(local), 0, from, near, false).above.mesh;
            piece = piece.mapped(|point| start + axes * point);
        }
        if to < size - near {
            piece = cut(&piece.mapped(local), 0, to, near, false).below.mesh;
            piece = piece.mapped(|point| start + axes * point);
        }
        found.push(piece);
    }
    let together = joined(&found.iter().collect::<Vec<_>>(), near);
    let all: Vec<usize> = (0..together.face_count()).collect();
    Ok(merged(&together, &all))
}
