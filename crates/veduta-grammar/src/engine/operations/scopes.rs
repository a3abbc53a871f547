//! Other scopes around the same geometry, and geometry mirrored in its scope.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::shape_attributes::pivot;
use super::super::value::Value;
use super::transform::turn_in;
use super::{axes, number, value, word};
use crate::shape::{Form, Geometry, Instance, Scope};

/// `alignScopeToAxes()`: the scope upright along the world's axes; `alignScopeToAxes(y)` with that
/// axis alone as the world's, and x (for `x` it is z) as near to what it was as it can be. `object.y` and
/// `object.xyz` mean the axes of the start shape. What is in it stays where it is, and the pivot comes
/// to the scope's origin.
pub fn align_to_axes(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let name = match op.args.len() {
        0 => "xyz".into(),
        _ => word(run, op, 0, frame)?,
    };
    let (wanted, letters) = match name.split_once('.') {
        Some(("object", letters)) => (run.first().state.form.scope.axes, letters),
        Some(("world", letters)) => (DMat3::IDENTITY, letters),
        _ => (DMat3::IDENTITY, name.as_ref()),
    };
    let axes = match axes(op, letters)?[..] {
        [axis] => aligned(frame.state.form.scope.axes, axis, wanted),
        _ => wanted,
    };
    turn_with_pivot(frame, axes);
    Ok(())
}

/// The frame with one axis along that of another. The axis that is kept as well as may be lies in the
/// plane across it: z for x, x for the others; where it has no direction there, that of the other frame.
fn aligned(now: DMat3, axis: usize, wanted: DMat3) -> DMat3 {
    let up = wanted.col(axis);
    let kept = if axis == 0 { 2 } else { 0 };
    let beside = |direction: DVec3| (direction - up * direction.dot(up)).try_normalize();
    let kept_axis = beside(now.col(kept)).filter(|_| now.col(kept).dot(up).abs() < LEVEL);
    let kept_axis = kept_axis.unwrap_or(wanted.col(kept));
    match axis {
        0 => DMat3::from_cols(up, kept_axis.cross(up), kept_axis),
        1 => DMat3::from_cols(kept_axis, up, kept_axis.cross(up)),
        _ => DMat3::from_cols(kept_axis, up.cross(kept_axis), up),
    }
}

/// What is this near to an axis has no direction across it (cosine).
const LEVEL: f64 = 1.0 - 1e-12;

/// `rotateScope(x, y, z)`: degrees about the pivot's axes, x first. What is in it stays where it
/// is, and the scope is fitted to it.
pub fn rotate_scope(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let mut degrees = DVec3::ZERO;
    for axis in 0..3 {
        degrees[axis] = number(run, op, axis, frame)?;
    }
    let scope = frame.state.form.scope;
    let (_, axes) = pivot(&frame.state, run.first());
    turn_to(frame, scope.axes * turn_in(&scope, axes, degrees));
    Ok(())
}

/// `mirrorScope(x, y, z)`: true turns the axis round. What is in the scope stays. Scopes are
/// right-handed here, so that none or two axes can be turned round: where one or three are asked for, the
/// scope stays, and a message says so. CityEngine turns any.
pub fn mirror_scope(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let signs = signs(run, op, frame)?;
    if signs.element_product() < 0.0 {
        let told = Value::text("mirrorScope: one or three axes turned round; the scope stays");
        return run.write(&told, op.span);
    }
    turn_to(
        frame,
        frame.state.form.scope.axes * DMat3::from_diagonal(signs),
    );
    Ok(())
}

/// `mirror(x, y, z)`: true mirrors the geometry along the axis, in the middle of the scope. Closed
/// shapes stay closed, outside out.
pub fn mirror(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let signs = signs(run, op, frame)?;
    mirror_along(frame, signs);
    Ok(())
}

/// Mirrors the geometry along the axes that have -1.
pub fn mirror_along(frame: &mut Frame, signs: DVec3) {
    let form = &mut frame.state.form;
    let solid = form.geometry.is_solid();
    form.geometry = match &form.geometry {
        Geometry::Nothing => Geometry::Nothing,
        Geometry::Box => Geometry::Box,
        Geometry::Instance(instance) => Geometry::Instance(Instance {
            signs: instance.signs * signs,
            ..instance.clone()
        }),
        other => {
            let centre = other.mesh().mapped(|unit| (unit - 0.5) * signs + 0.5);
            let outside_in = signs.element_product() < 0.0;
            let flat = flat_as(&form.scope, centre);
            Geometry::of(if outside_in { flat.reversed() } else { flat }, solid)
        }
    };
    let scope = form.scope;
    frame
        .state
        .carry_textures(|map| map.mirrored(&scope, signs));
    frame
        .state
        .carry_marks(|point| scope.world((scope.unit(point) - 0.5) * signs + 0.5));
    frame.changed();
}

/// Points of a flat scope have 0 along the axis without extent.
fn flat_as(scope: &Scope, mesh: Mesh) -> Mesh {
    let flat = DVec3::from_array(
        scope
            .size
            .to_array()
            .map(|s| if s == 0.0 { 0.0 } else { 1.0 }),
    );
    mesh.mapped(|unit| unit * flat)
}

fn signs(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<DVec3, Fault> {
    let mut signs = DVec3::ONE;
    for axis in 0..3 {
        let flag = value(run, op, axis, frame)?;
        let needed = || {
            Fault::at(
                op.span,
                format!("true or false is needed, not {}", flag.kind()),
            )
        };
        if flag.truth().ok_or_else(needed)? {
            signs[axis] = -1.0;
        }
    }
    Ok(signs)
}

/// `auto` of older rule files as the word for it now.
fn automatic(value: Value, now: &str) -> Value {
    match &value {
        Value::Text(word) if word.as_ref() == "auto" => Value::text(now),
        _ => value,
    }
}

/// `alignScopeToGeometry(yUp | zUp, face, edge)`: x of the scope along an edge of a face, y or z
/// along the face's normal. The face is a number (-1 is the last), `world.lowest`, `largest`, or
/// `any`, with which the edge is looked for in all; the edge a number within the face,
/// `world.lowest` or `longest`. Edges beside a hole do not count.
pub fn align_to_geometry(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let up = word(run, op, 0, frame)?;
    let which = value(run, op, 1, frame)?;
    let edge = match op.args.len() {
        3 => value(run, op, 2, frame)?,
        _ => Value::text("auto"),
    };
    // The older form names an edge of the first face, or takes the lowest of all.
    let (which, edge) = match (op.args.len(), which.number()) {
        (2, Some(_)) => (Value::Number(0.0), which),
        _ => (automatic(which, "any"), automatic(edge, "world.lowest")),
    };
    let mesh = frame.state.form.world_mesh();
    if mesh.is_empty() {
        return Ok(());
    }
    let faces: Vec<usize> = match &which {
        Value::Text(word) if word.as_ref() == "any" => (0..mesh.face_count()).collect(),
        other => vec![face_named(op, &mesh, other)?],
    };
    let corners = |face: usize| mesh.face(face).outline().len();
    let edges = faces
        .into_iter()
        .flat_map(|face| (0..corners(face)).map(move |k| (face, k)))
        .map(|(face, k)| (face, mesh_edge(&mesh, face, k)));
    let low = |(a, b): &(DVec3, DVec3)| 0.5 * (a.y + b.y);
    let found = match &edge {
        Value::Text(word) if word.as_ref() == "world.lowest" => {
            edges.min_by(|a, b| low(&a.1).total_cmp(&low(&b.1)))
        }
        Value::Text(_) => edges.max_by(|a, b| {
            let length = |(a, b): &(DVec3, DVec3)| a.distance(*b);
            length(&a.1).total_cmp(&length(&b.1))
        }),
        other => {
            let all: Vec<_> = edges.collect();
            let index = whole_number(op, other)?.rem_euclid(all.len() as f64);
            all.into_iter().nth(index as usize)
        }
    };
    let Some((face, (a, b))) = found else {
        return Ok(());
    };
    let (x, normal) = ((b - a).normalize_or_zero(), mesh.face(face).normal());
    if x == DVec3::ZERO || normal == DVec3::ZERO {
        return Err(Fault::at(op.span, "the edge or the face has no extent"));
    }
    let axes = match up.as_ref() {
        "zUp" => DMat3::from_cols(x, normal.cross(x), normal),
        _ => DMat3::from_cols(x, normal, x.cross(normal)),
    };
    turn_with_pivot(frame, axes);
    Ok(())
}

fn mesh_edge(mesh: &Mesh, face: usize, k: usize) -> (DVec3, DVec3) {
    let ring = mesh.face(face).outline();
    let place = |k: usize| mesh.points[ring[k % ring.len()] as usize];
    (place(k), place(k + 1))
}

fn face_named(op: &Operation, mesh: &Mesh, which: &Value) -> Result<usize, Fault> {
    let low = |face: &Face<'_>| {
        let heights = face.points().map(|point| point.y);
        heights.fold(f64::INFINITY, f64::min)
    };
    let area = |face: &Face<'_>| face.area_vector().length();
    let found = match which {
        Value::Text(word) if word.as_ref() == "world.lowest" => {
            mesh.faces().min_by(|a, b| low(a).total_cmp(&low(b)))
        }
        Value::Text(word) if word.as_ref() == "largest" => {
            mesh.faces().max_by(|a, b| area(a).total_cmp(&area(b)))
        }
        other => {
            let index = whole_number(op, other)?.rem_euclid(mesh.face_count() as f64);
            return Ok((index as usize).min(mesh.face_count() - 1));
        }
    };
    Ok(found.map_or(0, Face::index))
}

fn whole_number(op: &Operation, value: &Value) -> Result<f64, Fault> {
    let number = value.number().filter(|number| number.is_finite());
    let needed = || Fault::at(op.span, format!("a number is needed, not {value}"));
    Ok(number.ok_or_else(needed)?.floor())
}

/// `alignScopeToGeometryBBox(xz)`, and `xy`, `yz` and their reverses: the two axes along the
/// sides of the smallest rectangle around the geometry as it is seen along the third, which stays;
/// the first named is the longer side.
pub fn align_to_box(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let word = word(run, op, 0, frame)?;
    let named = axes(op, &word)?;
    let [long, short] = named[..] else {
        return Err(Fault::at(
            op.span,
            format!("two axes are needed, not `{word}`"),
        ));
    };
    let now = frame.state.form.scope.axes;
    let fixed = 3 - long - short;
    let mesh = frame.state.form.world_mesh();
    let (u, v) = ((fixed + 1) % 3, (fixed + 2) % 3);
    let own: Vec<DVec3> = mesh.points.iter().map(|&p| now.transpose() * p).collect();
    let hull = hull(own.iter().map(|p| [p[u], p[v]]).collect());
    let Some((mut angle, size)) = smallest_box(&hull) else {
        return Ok(());
    };
    // The longer side along the axis that is to have it.
    if (size[0] < size[1]) == (long == u) {
        angle += std::f64::consts::FRAC_PI_2;
    }
    let turn = DMat3::from_axis_angle(DMat3::IDENTITY.col(fixed), angle);
    turn_with_pivot(frame, now * turn);
    Ok(())
}

/// The convex hull, counter-clockwise (Andrew's monotone chain).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let side = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let mut hull: Vec<[f64; 2]> = Vec::new();
    let there = points.iter().copied();
    let back = points.iter().rev().copied().skip(1);
    let (mut floor, turn) = (1, points.len());
    for (index, point) in there.chain(back).enumerate() {
        if index == turn {
            floor = hull.len();
        }
        while hull.len() > floor && side(hull[hull.len() - 2], hull[hull.len() - 1], point) <= 0.0 {
            hull.pop();
        }
        hull.push(point);
    }
    hull.pop();
    hull
}

/// The turn of the smallest rectangle around a hull (radians), and its size along the turned axes.
fn smallest_box(hull: &[[f64; 2]]) -> Option<(f64, [f64; 2])> {
    let mut best: Option<(f64, f64, [f64; 2])> = None;
    for (k, a) in hull.iter().enumerate() {
        let b = hull[(k + 1) % hull.len()];
        let angle = (b[1] - a[1]).atan2(b[0] - a[0]);
        let (sine, cosine) = angle.sin_cos();
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in hull {
            let own = [p[0] * cosine + p[1] * sine, p[1] * cosine - p[0] * sine];
            for axis in 0..2 {
                low[axis] = low[axis].min(own[axis]);
                high[axis] = high[axis].max(own[axis]);
            }
        }
        let size = [high[0] - low[0], high[1] - low[1]];
        let area = size[0] * size[1];
        if best.is_none_or(|(least, ..)| area < least * (1.0 - 1e-9)) {
            best = Some((area, angle, size));
        }
    }
    best.map(|(_, angle, size)| (angle, size))
}

/// Another frame around the same geometry, and the pivot at its origin, along its axes.
fn turn_with_pivot(frame: &mut Frame, axes: DMat3) {
    turn_to(frame, axes);
    let scope = frame.state.form.scope;
    frame.state.extra_mut().pivot = Some((scope.origin, scope.axes));
}

/// Another frame around the same geometry.
fn turn_to(frame: &mut Frame, axes: DMat3) {
    let form = &frame.state.form;
    frame.state.form = match form.geometry {
        Geometry::Nothing => Form {
            scope: Scope { axes, ..form.scope },
            geometry: Geometry::Nothing,
        },
        _ => Form::around(form.world_mesh(), axes, form.geometry.is_solid()),
    };
    frame.changed();
}
