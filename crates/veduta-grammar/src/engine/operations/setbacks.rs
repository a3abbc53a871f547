//! Faces to the strips along some of their edges, and what is left of them.

use veduta_geometry::solid::{inset_within, merged, Mesh, Pieces};

use super::super::code::{Arg, Operation, Selector, Sizing};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::selection::{Choosing, REMAINDER};
use super::super::value::Value;
use super::components::{run_shapes, selectors};
use super::{numbers, numbers_of_edges, positive, value};
use crate::ast::Joining;
use crate::shape::{connected, Form, Kind, TOLERANCE};

/// How often the distance of `setbackToArea` is halved.
const HALVINGS: usize = 48;

/// `setback(distance) { front : A | all = B | remainder : C }`, `setback(distances) { ... }`: the
/// edges that the cells select move inwards by the distance (m), or each by its own of an array in
/// the order of `comp(fe)`; a second argument is the texture layer for selectors such as `uv.left`. Others
/// stand, and so do those that the array has no number for. A cell has the strips along its edges, those that touch
/// as one, and `remainder` has what is left of the faces.
pub fn setback(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let edges = Edges::of(run, op, frame)?;
    let given = value(run, op, 0, frame)?;
    let distances = match given {
        Value::Array(_) => {
            let mut each = numbers(run, op, &given)?;
            each.resize(edges.count(), 0.0);
            edges.of_chosen(|edge| each[edge])
        }
        _ => {
            let distance = positive(run, op, 0, frame)?;
            edges.of_chosen(|_| distance)
        }
    };
    let pieces = edges.moved(run, op, &distances)?;
    edges.finish(run, op, &pieces, frame)
}

/// `setbackPerEdge(distance) { ... }`: as `setback`, with the distance evaluated for each edge (its
/// shape is that of `comp(fe)`; `'` takes it of the edge's length).
pub fn per_edge(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let edges = Edges::of(run, op, frame)?;
    let Arg::Value(sizing, expr) = &op.args[0] else {
        return Err(Fault::at(op.span, "a distance is needed"));
    };
    let mut distances = vec![0.0; edges.count()];
    let whole = frame.state.clone();
    for at in 0..edges.choosing.found.len() {
        let state = edges.choosing.state(&whole, at);
        let edge = &edges.choosing.found[at];
        let distance = run.finite(expr, &mut frame.scene().of(&state))?;
        let distance = match sizing {
            Sizing::Relative => distance * edge.form.scope.size.x,
            _ => distance,
        };
        if !(distance.is_finite() && distance >= 0.0) {
            let message = format!("a distance from 0 on is needed, not {distance}");
            return Err(Fault::at(expr.span, message));
        }
        distances[edge.index] = distance;
    }
    let distances = edges.of_chosen(|edge| distances[edge]);
    let pieces = edges.moved(run, op, &distances)?;
    edges.finish(run, op, &pieces, frame)
}

/// `setbackToArea(area) { ... }`, `setbackToArea(area, least)`, `setbackToArea(area, least, most)`, each
/// also with a texture layer for selectors such as `uv.left`:
/// as `setback`, with the distance at which that area (m2) of each face remains. Arrays give the
/// least distance of each edge, to which the same is added, and the most that it may become. A face
/// that is smaller loses no more than the least.
pub fn to_area(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let edges = Edges::of(run, op, frame)?;
    let area = positive(run, op, 0, frame)?;
    let mut bounds = [vec![0.0; edges.count()], vec![f64::MAX; edges.count()]];
    for index in 1..op.args.len() {
        let given = value(run, op, index, frame)?;
        if index + 1 == op.args.len() && matches!(given, Value::Number(_)) {
            break; // the texture layer of selectors
        }
        if index > bounds.len() {
            return Err(Fault::at(op.span, "a texture layer is needed last"));
        }
        bounds[index - 1] = numbers_of_edges(run, op, &given, edges.count())?;
    }
    let [least, most] = bounds;
    let mut pieces = Vec::new();
    let extent = frame.state.form.scope.size.length();
    for face in 0..edges.mesh.face_count() {
        let at = |far: f64| edges.of_chosen(|edge| (least[edge] + far).min(most[edge]));
        let left = |far: f64| -> Result<(f64, Pieces), Fault> {
            run.check_time(op.span)?;
            let found = edges.face_moved(run, op, face, &at(far))?;
            Ok((area_left(&found), found))
        };
        let (mut low, mut high) = (0.0, extent);
        let (mut rest, mut best) = left(0.0)?;
        if rest > area {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                (rest, best) = left(middle)?;
                if rest > area {
                    low = middle;
                } else {
                    high = middle;
                }
                if (rest - area).abs() <= 1e-12 * area {
                    break;
                }
            }
        }
        pieces.push(best);
    }
    edges.finish(run, op, &pieces, frame)
}

fn area_left(pieces: &Pieces) -> f64 {
    let faces = pieces.along.iter().enumerate();
    let left = faces.filter(|(_, along)| along.is_none());
    left.map(|(face, _)| pieces.mesh.face(face).area_vector().length())
        .sum()
}

/// The texture layer that the last argument names after the first; 0 where it is none.
fn layer(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<f64, Fault> {
    let last = op.args.len() - 1;
    match (last, op.args.last()) {
        (1.., Some(Arg::Value(..))) => match value(run, op, last, frame)? {
            Value::Number(layer) => Ok(layer),
            _ => Ok(0.0),
        },
        _ => Ok(0.0),
    }
}

/// The edges of a shape's faces, and the cells that select them.
pub struct Edges {
    pub choosing: Choosing,
    pub mesh: Mesh,
    /// For each edge of each face the cell that it belongs to.
    cell: Vec<Option<usize>>,
    /// The number of the first edge of each face.
    first: Vec<usize>,
}

impl Edges {
    pub fn of(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<Self, Fault> {
        run.check_time(op.span)?;
        run.record(None, &frame.state, op.span)?;
        let form = frame.state.form.clone();
        let layer = layer(run, op, frame)?;
        let choosing = Choosing::of(&form, Kind::FaceEdges, run).textured(&frame.state, layer);
        let choosing = choosing.map_err(|message| Fault::at(op.span, message))?;
        let chosen = run.chosen(selectors(op), &choosing, op.span, &mut frame.scene())?;
        let mut edges = Self::without_cells(choosing, form.world_mesh());
        for (cell, picked) in chosen.into_iter().enumerate() {
            for at in picked {
                edges.cell[edges.choosing.found[at].index] = Some(cell);
            }
        }
        Ok(edges)
    }

    fn without_cells(choosing: Choosing, mesh: Mesh) -> Self {
        let mut first = vec![0];
        for face in mesh.faces() {
            let edges: usize = face.rings().map(<[u32]>::len).sum();
            first.push(first[first.len() - 1] + edges);
        }
        Self {
            choosing,
            cell: vec![None; first[first.len() - 1]],
            mesh,
            first,
        }
    }

    /// All edges in one cell: for `shapeL` and its like.
    pub fn in_one(run: &mut Run<'_>, cell: Option<usize>, frame: &Frame) -> Self {
        let form = &frame.state.form;
        let choosing = Choosing::of(form, Kind::FaceEdges, run);
        let mut edges = Self::without_cells(choosing, form.world_mesh());
        edges.cell.fill(cell);
        edges
    }

    pub fn count(&self) -> usize {
        self.cell.len()
    }

    /// The distances of the edges that are in a cell; of others 0.
    fn of_chosen(&self, distance: impl Fn(usize) -> f64) -> Vec<f64> {
        let each = self.cell.iter().enumerate();
        each.map(|(edge, cell)| cell.map_or(0.0, |_| distance(edge)))
            .collect()
    }

    fn face_moved(
        &self,
        run: &Run<'_>,
        op: &Operation,
        face: usize,
        distances: &[f64],
    ) -> Result<Pieces, Fault> {
        let own = &distances[self.first[face]..self.first[face + 1]];
        if self.mesh.face(face).normal() == glam::DVec3::ZERO {
            // A face without area is left as it is.
            return Ok(Pieces {
                mesh: self.mesh.of_faces([face]),
                along: vec![None],
            });
        }
        inset_within(&self.mesh, self.mesh.face(face), own, run.budget())
            .map_err(|error| run.failed(op.span, format!("no setback here: {error}")))
    }

    /// The pieces of each face.
    pub fn moved(
        &self,
        run: &Run<'_>,
        op: &Operation,
        distances: &[f64],
    ) -> Result<Vec<Pieces>, Fault> {
        let mut all = Vec::with_capacity(self.mesh.face_count());
        for face in 0..self.mesh.face_count() {
            run.check_time(op.span)?;
            all.push(self.face_moved(run, op, face, distances)?);
        }
        Ok(all)
    }

    /// The faces of a cell: strips along its edges, or what is left.
    fn faces_of(&self, pieces: &[Pieces], cell: Option<usize>) -> Mesh {
        let mut found = Mesh::new();
        for (face, one) in pieces.iter().enumerate() {
            let is_own = |along: &Option<u32>| match along {
                Some(edge) => {
                    cell.is_some() && self.cell[self.first[face] + *edge as usize] == cell
                }
                None => cell.is_none(),
            };
            let all = one.along.iter().enumerate();
            let own: Vec<usize> = all
                .filter(|(_, along)| is_own(along))
                .map(|(index, _)| index)
                .collect();
            match cell {
                Some(_) => found.append(&merged(&one.mesh, &own)),
                None => found.append(&one.mesh.of_faces(own)),
            }
        }
        found
    }

    /// Runs the cells on their pieces.
    pub fn finish(
        &self,
        run: &mut Run<'_>,
        op: &Operation,
        pieces: &[Pieces],
        frame: &mut Frame,
    ) -> Result<(), Fault> {
        run_pieces(run, op, frame, |cell| self.faces_of(pieces, cell))
    }
}

/// Runs each cell on its faces: `faces_of` gets the cell's number, None for `remainder`.
pub fn run_pieces(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    faces_of: impl Fn(Option<usize>) -> Mesh,
) -> Result<(), Fault> {
    let whole = frame.state.clone();
    let axes = whole.form.scope.axes;
    for (index, cell) in op.cells.iter().enumerate() {
        let Some((selector, joining, body)) = cell.part() else {
            return Err(Fault::at(op.span, "these cells do not repeat"));
        };
        let is_rest = matches!(selector, Selector::Word(word) if word.as_ref() == REMAINDER);
        let shapes = as_shapes(faces_of((!is_rest).then_some(index)), axes, joining);
        run_shapes(run, body, shapes, &whole, &selector.name(), frame)?;
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

/// Faces as a shape each, as one, or as one of those that hang together.
pub fn as_shapes(faces: Mesh, axes: glam::DMat3, joining: Joining) -> Vec<Form> {
    if faces.is_empty() {
        return Vec::new();
    }
    if joining == Joining::All {
        return vec![Form::around(faces, axes, false)];
    }
    let each = 0..faces.face_count();
    let alone: Vec<Form> = each
        .map(|face| Form::around(faces.of_faces([face]), axes, false))
        .collect();
    if joining == Joining::Each {
        return alone;
    }
    let reach = faces.bounds().map_or(0.0, |(low, high)| low.distance(high));
    connected(&alone.iter().collect::<Vec<_>>(), TOLERANCE * reach)
        .into_iter()
        .map(|group| Form::around(faces.of_faces(group), axes, false))
        .collect()
}
