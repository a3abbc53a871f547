//! `innerRectangle`: the largest rectangle within each face.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{cut, inner_rectangle as largest, Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::setbacks::run_pieces;
use super::word;
use crate::shape::Form;

/// `innerRectangle(scope) { shape : A | remainder : B }` finds in each face the largest rectangle
/// with sides along the scope's axes, `innerRectangle(edge)` the largest with a side along an edge
/// of at least a quarter of the longest edge's length.
///
/// The rectangle is the largest of those whose sides run through corners of the face or on one of
/// 48 lines between. What remains comes in strips beside, below and above it. Other than in
/// CityEngine the rectangle is one in the plane of the face, not as seen along an axis of the scope.
pub fn inner_rectangle(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let by_edge = word(run, op, 0, frame)?.as_ref() == "edge";
    let (inner, rest) = parted(run, op, frame, by_edge)?;
    run_pieces(run, op, frame, |cell| match cell {
        Some(_) => inner.clone(),
        None => rest.clone(),
    })
}

/// `innerRect()`, the older form: the shape becomes the largest rectangles in its faces, with sides
/// along the scope's axes.
pub fn inner_rect(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let (inner, _) = parted(run, op, frame, false)?;
    if !inner.is_empty() {
        let axes = frame.state.form.scope.axes;
        frame.state.form = Form::around(inner, axes, false);
        frame.changed();
    }
    Ok(())
}

/// The largest rectangle of each face, and what remains of them.
fn parted(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &Frame,
    by_edge: bool,
) -> Result<(Mesh, Mesh), Fault> {
    let mesh = frame.state.form.world_mesh();
    let axes = frame.state.form.scope.axes;
    let (mut inner, mut rest) = (Mesh::new(), Mesh::new());
    for face in mesh.faces() {
        let normal = face.normal();
        let ways = if by_edge {
            long_edges(&mesh, face)
        } else {
            vec![along_scope(axes, normal)]
        };
        let lines = LINES_BETWEEN + face.rings().map(<[u32]>::len).sum::<usize>();
        run.take(ways.len() * lines * lines, op.span)?;
        let placed = ways
            .into_iter()
            .filter_map(|along| Placed::within(&mesh, face, along));
        match placed.max_by(|a, b| a.area().total_cmp(&b.area())) {
            Some(found) => found.take(&mut inner, &mut rest),
            None => rest.append(&mesh.of_faces([face.index()])),
        }
    }
    Ok((inner, rest))
}

/// Lines across a face that are tried beside those through its corners: each with each.
const LINES_BETWEEN: usize = 48;

/// The scope's axis that lies most nearly in a face.
fn along_scope(axes: DMat3, normal: DVec3) -> DVec3 {
    if normal.dot(axes.x_axis).abs() < 0.9 {
        axes.x_axis
    } else {
        axes.z_axis
    }
}

/// The directions of the edges of a face that are not much shorter than the longest; at most 64.
fn long_edges(mesh: &Mesh, face: Face<'_>) -> Vec<DVec3> {
    let along = |(a, b): (u32, u32)| mesh.points[b as usize] - mesh.points[a as usize];
    let mut edges: Vec<DVec3> = face.edges().map(along).collect();
    edges.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let longest = edges.first().map_or(0.0, |edge| edge.length());
    edges.retain(|edge| edge.length() >= 0.25 * longest);
    edges.truncate(64);
    edges
}

/// A rectangle in a face, in a frame with x and y along its sides.
struct Placed {
    frame: DMat3,
    face: Mesh,
    low: [f64; 2],
    high: [f64; 2],
}

impl Placed {
    fn within(mesh: &Mesh, face: Face<'_>, along: DVec3) -> Option<Self> {
        let normal = face.normal();
        let x = (along - normal * along.dot(normal)).try_normalize()?;
        let frame = DMat3::from_cols(x, normal.cross(x), normal);
        let local = frame.transpose();
        let alone = mesh.of_faces([face.index()]).mapped(|point| local * point);
        let flat = |&point: &u32| {
            let place = alone.points[point as usize];
            [place.x, place.y]
        };
        let rings: Vec<Vec<[f64; 2]>> = alone
            .face(0)
            .rings()
            .map(|ring| ring.iter().map(flat).collect())
            .collect();
        let (low, high) = largest(&rings)?;
        Some(Self {
            frame,
            face: alone,
            low,
            high,
        })
    }

    fn area(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    /// Cuts the face at the sides of the rectangle.
    fn take(self, inner: &mut Mesh, rest: &mut Mesh) {
        let extent = self.face.bounds().map_or(0.0, |(a, b)| a.distance(b));
        let tolerance = 1e-9 * extent;
        let frame = self.frame;
        let level = self.face.points[0].z;
        let mut middle = self.face;
        for axis in 0..2 {
            let sides = cut(&middle, axis, self.low[axis], tolerance, false);
            rest.append(&sides.below.mesh.mapped(|point| frame * point));
            let sides = cut(&sides.above.mesh, axis, self.high[axis], tolerance, false);
            rest.append(&sides.above.mesh.mapped(|point| frame * point));
            middle = sides.below.mesh;
        }
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        let corners = corners.map(|(x, y)| frame * DVec3::new(x, y, level));
        inner.append(&Mesh::polygon(&[corners]));
    }
}
