//! Solids that stand on the faces of a shape: `taper` and the roofs that need no skeleton.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{cut, joined, pyramids, raised, Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::roofs::Rise;
use super::{length, number};
use crate::shape::Form;

/// Heights below this share of the extent are none.
const NO_HEIGHT_SHARE: f64 = 1e-9;

/// `taper(height)`: a pyramid over the centre of gravity of each face; below zero it points down.
/// CityEngine takes the first face alone.
pub fn taper(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let height = length(run, op, 0, frame.state.form.scope.size.y, frame)?;
    let sheet = sheet_of(&frame.state.form);
    if sheet.is_empty() || height == 0.0 {
        return Ok(());
    }
    let solid = pyramids(&sheet, |face| {
        centre_of_gravity(&sheet, face) + face.normal() * height
    });
    let solid = if height < 0.0 {
        solid.reversed()
    } else {
        solid
    };
    stand(frame, solid, sheet.face(0).normal());
    Ok(())
}

/// `roofPyramid(angle)`, `roofPyramid(byAngle | byHeight, value)`: triangles from the edges of each
/// face to a point over the mean of its corners. The angle (degrees) is that of the triangle at the
/// first edge.
pub fn pyramid(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let sheet = sheet_of(&frame.state.form);
    if sheet.is_empty() {
        return Ok(());
    }
    let first = first_edge_distance(sheet.face(0));
    let slope = rise.slope(op, || Ok(first))?;
    let solid = pyramids(&sheet, |face| {
        let away = first_edge_distance(face);
        mean(face) + face.normal() * (slope * away)
    });
    stand(frame, solid, sheet.face(0).normal());
    Ok(())
}

/// `roofShed(angle)`, `roofShed(angle, edge)`, and both with `byAngle | byHeight, value`: one plane
/// over each face that rises from an edge, the first where none is given. Where a face lies beyond
/// its edge, too, the plane rises from its lowest corner instead.
pub fn shed(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let edge = match op.args.len() > rise.arguments {
        true => number(run, op, rise.arguments, frame)?,
        false => 0.0,
    };
    let sheet = sheet_of(&frame.state.form);
    if sheet.is_empty() {
        return Ok(());
    }
    let deepest = sheet
        .faces()
        .map(|face| Away::from_edge(&sheet, face, edge).depth(face))
        .fold(0.0, f64::max);
    let slope = rise.slope(op, || Ok(deepest))?;
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let away = Away::from_edge(&sheet, face, edge);
        let depth = away.depth(face);
        let alone = sheet.of_faces([face.index()]);
        let height = |point: DVec3| slope * away.of(point);
        let least = NO_HEIGHT_SHARE * depth * slope;
        solid.append(&raised(&alone, face.normal(), height, least));
    }
    stand(frame, solid, sheet.face(0).normal());
    Ok(())
}

/// `roofRidge(byAngle | byHeight, value)`: two planes over each face that meet in a ridge along x
/// of the scope, over the middle of the face.
pub fn ridge(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let sheet = sheet_of(&frame.state.form);
    if sheet.is_empty() {
        return Ok(());
    }
    let axes = |face: Face<'_>| upright(&frame.state.form, face.normal());
    let half_width = |face: Face<'_>| {
        let (low, high) = across(face, axes(face).z_axis);
        0.5 * (high - low)
    };
    let widest = sheet.faces().map(half_width).fold(0.0, f64::max);
    let slope = rise.slope(op, || Ok(widest))?;
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let across_axis = axes(face).z_axis;
        let (low, high) = across(face, across_axis);
        let middle = 0.5 * (low + high);
        let halves = halved(&sheet, face, axes(face), middle);
        let height =
            |point: DVec3| slope * (0.5 * (high - low) - (point.dot(across_axis) - middle).abs());
        let least = NO_HEIGHT_SHARE * slope * (high - low);
        solid.append(&raised(&halves, face.normal(), height, least));
    }
    stand(frame, solid, sheet.face(0).normal());
    Ok(())
}

/// The faces of a shape that have an area, in the world.
pub fn sheet_of(form: &Form) -> Mesh {
    let mesh = form.world_mesh();
    let has_area = |&face: &usize| mesh.face(face).normal() != DVec3::ZERO;
    if (0..mesh.face_count()).all(|face| has_area(&face)) {
        return mesh;
    }
    mesh.of_faces((0..mesh.face_count()).filter(has_area))
}

/// The closed solid as the shape, with y of its scope along `up`.
pub fn stand(frame: &mut Frame, solid: Mesh, up: DVec3) {
    let axes = upright(&frame.state.form, up);
    frame.state.form = Form::around(solid, axes, true);
    frame.changed();
}

/// The scope's axes with y along the normal.
pub fn upright(form: &Form, normal: DVec3) -> DMat3 {
    let axes = form.scope.axes;
    let x = (axes.x_axis - normal * axes.x_axis.dot(normal)).normalize_or({
        let z = axes.z_axis - normal * axes.z_axis.dot(normal);
        z.normalize_or(DVec3::X)
    });
    DMat3::from_cols(x, normal, x.cross(normal))
}

fn mean(face: Face<'_>) -> DVec3 {
    let count = face.points().count().max(1) as f64;
    face.points().sum::<DVec3>() / count
}

fn centre_of_gravity(mesh: &Mesh, face: Face<'_>) -> DVec3 {
    let place = |point: u32| mesh.points[point as usize];
    let origin = place(face.outline()[0]);
    let normal = face.normal();
    let (mut sum, mut area) = (DVec3::ZERO, 0.0);
    for (a, b) in face.edges() {
        let (a, b) = (place(a) - origin, place(b) - origin);
        let own = 0.5 * a.cross(b).dot(normal);
        sum += own * (a + b) / 3.0;
        area += own;
    }
    if area > 0.0 {
        origin + sum / area
    } else {
        origin
    }
}

/// How far the mean of the corners is from the first edge.
fn first_edge_distance(face: Face<'_>) -> f64 {
    let mut points = face.points();
    let (Some(a), Some(b)) = (points.next(), points.next()) else {
        return 0.0;
    };
    let inward = face.normal().cross(b - a).normalize_or_zero();
    (mean(face) - a).dot(inward).abs()
}

/// The extent of a face along a direction.
fn across(face: Face<'_>, along: DVec3) -> (f64, f64) {
    let places = face.points().map(|point| point.dot(along));
    places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
        (low.min(at), high.max(at))
    })
}

/// A face cut in two along x of these axes where z is `middle`; the halves share their points.
fn halved(mesh: &Mesh, face: Face<'_>, axes: DMat3, middle: f64) -> Mesh {
    let local = axes.transpose();
    let own = mesh.of_faces([face.index()]).mapped(|point| local * point);
    let extent = own.bounds().map_or(0.0, |(low, high)| low.distance(high));
    let sides = cut(&own, 2, middle, 1e-9 * extent, false);
    let whole = joined(&[&sides.below.mesh, &sides.above.mesh], 1e-9 * extent);
    whole.mapped(|point| axes * point)
}

/// The way away from an edge of a face.
struct Away {
    inward: DVec3,
    from: f64,
}

impl Away {
    fn from_edge(mesh: &Mesh, face: Face<'_>, edge: f64) -> Self {
        let count = face.outline().len();
        let edge = edge.rem_euclid(count as f64) as usize % count.max(1);
        let ring = face.outline();
        let [a, b] = [edge, edge + 1].map(|k| mesh.points[ring[k % count] as usize]);
        let inward = face.normal().cross(b - a).normalize_or_zero();
        let (from, _) = across(face, inward);
        Self { inward, from }
    }

    fn of(&self, point: DVec3) -> f64 {
        point.dot(self.inward) - self.from
    }

    fn depth(&self, face: Face<'_>) -> f64 {
        let (low, high) = across(face, self.inward);
        high - low
    }
}
