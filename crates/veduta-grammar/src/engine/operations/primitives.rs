//! Round shapes: disk, cylinder, cone and sphere.

use glam::DVec3;
use veduta_geometry::solid::{cone, cylinder, disk, sphere, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::{length, number};
use crate::shape::{Form, Geometry};

/// Sides around a circle where none are given.
const SIDES: f64 = 16.0;
/// The most sides around a circle.
const MOST_SIDES: f64 = 2_000.0;

/// `primitiveDisk()`, `primitiveDisk(sides)`, `primitiveDisk(sides, radius)`: level, seen from
/// above, or upright in an upright flat scope. Without a radius the shape fills the scope, where a size of 0 is first made the mean of
/// the others; with one (m) it stands in the middle of the scope's floor.
pub fn make_disk(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let sides = count(run, op, 0, SIDES, 3.0, frame)?;
    let now = frame.state.form.scope.size;
    let across = lies_across(now);
    let has = [0, 1, 2].map(|axis| axis != across);
    let size = match op.args.len() {
        2 => {
            let radius = length(run, op, 1, now.x, frame)?;
            Some(DVec3::from_array(has.map(|has| {
                if has {
                    2.0 * radius
                } else {
                    0.0
                }
            })))
        }
        _ => None,
    };
    // A disk that stands is the level one with its axes told on: x and z as y and x, or as x and y.
    let turned = disk(sides).mapped(|point| match across {
        0 => DVec3::new(point.y, point.z, point.x),
        1 => point,
        _ => DVec3::new(point.z, point.x, point.y),
    });
    insert(op, frame, turned, size, has, false)
}

/// `primitiveCylinder()`, `primitiveCylinder(sides)`, `primitiveCylinder(sides, radius, height)`;
/// see [`make_disk`].
pub fn make_cylinder(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let sides = count(run, op, 0, SIDES, 3.0, frame)?;
    let size = upright(run, op, frame)?;
    insert(op, frame, cylinder(sides), size, [true; 3], true)
}

/// `primitiveCone()`, `primitiveCone(sides)`, `primitiveCone(sides, radius, height)`; see
/// [`make_disk`].
pub fn make_cone(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let sides = count(run, op, 0, SIDES, 3.0, frame)?;
    let size = upright(run, op, frame)?;
    insert(op, frame, cone(sides), size, [true; 3], true)
}

/// `primitiveSphere()`, `primitiveSphere(sides, rows)`, `primitiveSphere(sides, rows, radius)`:
/// `rows` are counted from pole to pole; see [`make_disk`].
pub fn make_sphere(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let sides = count(run, op, 0, SIDES, 3.0, frame)?;
    let rows = count(run, op, 1, SIDES, 2.0, frame)?;
    super::check_faces(run, op, sides * rows)?;
    let size = match op.args.len() {
        3 => {
            let radius = length(run, op, 2, frame.state.form.scope.size.x, frame)?;
            Some(DVec3::splat(2.0 * radius))
        }
        _ => None,
    };
    insert(op, frame, sphere(sides, rows), size, [true; 3], true)
}

fn count(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    given: f64,
    least: f64,
    frame: &mut Frame,
) -> Result<usize, Fault> {
    let count = match index < op.args.len() {
        true => number(run, op, index, frame)?.round(),
        false => given,
    };
    if (least..=MOST_SIDES).contains(&count) {
        return Ok(count as usize);
    }
    let message = format!("{least} to {MOST_SIDES} sides are needed, not {count}");
    Err(Fault::at(op.span, message))
}

fn upright(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<Option<DVec3>, Fault> {
    if op.args.len() < 3 {
        return Ok(None);
    }
    let size = frame.state.form.scope.size;
    let radius = length(run, op, 1, size.x, frame)?;
    let height = length(run, op, 2, size.y, frame)?;
    Ok(Some(DVec3::new(2.0 * radius, height, 2.0 * radius)))
}

/// Puts a shape of the unit cube into the scope; `has` says along which axes it has an extent.
fn insert(
    op: &Operation,
    frame: &mut Frame,
    unit: Mesh,
    size: Option<DVec3>,
    has: [bool; 3],
    solid: bool,
) -> Result<(), Fault> {
    let scope = &mut frame.state.form.scope;
    match size {
        Some(size) => {
            if size.cmplt(DVec3::ZERO).any() {
                return Err(Fault::at(op.span, "a radius or height below 0"));
            }
            let mut middle = DVec3::new(0.5, 0.0, 0.5) * (scope.size - size);
            if !has[0] || !has[2] {
                middle = 0.5 * (scope.size - size);
            }
            let placed = unit.mapped(|point| point * size + middle);
            let world = placed.mapped(|point| scope.origin + scope.axes * point);
            frame.state.form = Form::around(world, scope.axes, solid);
        }
        None => {
            scope.size = filled(scope.size, has);
            let (low, high) = unit.bounds().unwrap_or_default();
            // Corners of a polygon with few sides do not reach all sides of its square.
            let whole = unit.mapped(|point| crate::shape::over(point - low, high - low));
            frame.state.form.geometry = Geometry::of(whole, solid);
        }
    }
    frame.state.replaced();
    frame.changed();
    Ok(())
}

/// The axis across which what is flat lies in a scope: the only one without extent, or y.
pub fn lies_across(size: DVec3) -> usize {
    let flat: Vec<usize> = (0..3).filter(|&axis| size[axis] == 0.0).collect();
    match flat[..] {
        [only] => only,
        _ => 1,
    }
}

/// Sizes of 0 as the mean of the others, or 1; none along an axis without extent.
pub fn filled(size: DVec3, has: [bool; 3]) -> DVec3 {
    let given: Vec<f64> = size.to_array().into_iter().filter(|s| *s > 0.0).collect();
    let mean = match given.len() {
        0 => 1.0,
        count => given.iter().sum::<f64>() / count as f64,
    };
    DVec3::from_array(std::array::from_fn(|axis| match (has[axis], size[axis]) {
        (false, _) => 0.0,
        (true, s) if s > 0.0 => s,
        (true, _) => mean,
    }))
}
