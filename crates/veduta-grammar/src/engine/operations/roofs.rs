//! Roofs over the faces of a shape: those that CityEngine has.

use glam::DVec3;
use veduta_geometry::solid::{roofed_within, Along, Face, Gables, Mesh, Overhang, RoofKind};

use super::super::code::{Arg, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::marks::Maker;
use super::super::run::Run;
use super::super::value::Value;
use super::standing::{sheet_of, stand, upright};
use super::{number, positive, value};
use crate::shape::Form;

/// Slopes steeper than this are walls (degrees).
const STEEPEST: f64 = 89.0;
/// Slopes flatter than this cannot be told from their floors when they are cut (degrees).
const FLATTEST: f64 = 0.01;

/// `roofHip(angle)`, `roofHip(angle, overhang, even)` and both with `byAngle | byHeight, value`: a
/// slope over every edge, at an angle (degrees) or up to a height (m). The overhang (m) is measured
/// down the slope. `even` puts all ridges at one height.
///
/// The planes go on beyond the edges, so that eaves that hang over lie lower than the face. Other
/// than in CityEngine the roof is closed there by a level floor.
pub fn hip(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let reach = optional(run, op, rise.arguments, 0.0, frame)?;
    let even = is_even(run, op, rise.arguments + 1, frame)?;
    no_more(op, rise.arguments + 2)?;
    rise.build(run, op, frame, [reach, 0.0], |_, _| {
        Ok(RoofKind::Hip { even })
    })
}

/// `roofGable(angle)`, `roofGable(angle, eaves, gables, even, index)` and both with
/// `byAngle | byHeight, value`: upright ends where a hip roof has triangles. The overhangs (m) are
/// that of the eaves, down the slope, and that of the gables, level; where the second is not given
/// it is as the first.
///
/// Of two triangles side by side the first stands. With an index, the gables stand on that edge and
/// on the one opposite; with an array of them, on these edges.
pub fn gable(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let first = rise.arguments;
    let reach = reaches(run, op, first, frame)?;
    let even = is_even(run, op, first + 2, frame)?;
    let chosen = match op.args.len() > first + 3 {
        true => Some(value(run, op, first + 3, frame)?),
        false => None,
    };
    no_more(op, first + 4)?;
    rise.build(run, op, frame, reach, |sheet, face| {
        let gables = match &chosen {
            None => Gables::Triangles,
            Some(Value::Array(edges)) => {
                let edges = edges.values.iter().map(|edge| edge_number(op, edge, face));
                Gables::Edges(edges.collect::<Result<_, _>>()?)
            }
            Some(edge) => {
                let edge = edge_number(op, edge, face)?;
                Gables::Edges(
                    [Some(edge), opposite(sheet, face, edge)]
                        .into_iter()
                        .flatten()
                        .collect(),
                )
            }
        };
        Ok(RoofKind::Gable { gables, even })
    })
}

/// `roofPyramid(angle)`, `roofPyramid(byAngle | byHeight, value)`, both with an overhang (m, down
/// the slope over the first edge), which CityEngine has not: triangles from the edges of each face
/// to a point over the mean of its corners, or over a place in sight of all edges where the mean is
/// not one. The angle (degrees) is that of the triangle at the first edge.
pub fn pyramid(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let reach = optional(run, op, rise.arguments, 0.0, frame)?;
    no_more(op, rise.arguments + 1)?;
    rise.build(run, op, frame, [reach, 0.0], |_, _| Ok(RoofKind::Pyramid))
}

/// `roofShed(angle)`, `roofShed(angle, edge)`, and both with `byAngle | byHeight, value`: one plane
/// over each face that rises from an edge, the first where none is given. Where a face lies beyond
/// its edge, too, the plane rises from its lowest corner instead. After the edge there may be an
/// overhang (m, down the slope), which CityEngine has not.
pub fn shed(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let edge = match op.args.len() > rise.arguments {
        true => number(run, op, rise.arguments, frame)?,
        false => 0.0,
    };
    let reach = optional(run, op, rise.arguments + 1, 0.0, frame)?;
    no_more(op, rise.arguments + 2)?;
    rise.build(run, op, frame, [reach, 0.0], |_, face| {
        let count = face.outline().len() as f64;
        let edge = edge.rem_euclid(count) as u32 % count as u32;
        Ok(RoofKind::Shed { edge })
    })
}

/// `roofRidge(byAngle | byHeight, value)`: two planes over each face that meet in a ridge along x
/// of the scope, over the middle of the face. After that there may be an overhang (m, down the
/// slope), which CityEngine has not.
pub fn ridge(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let reach = optional(run, op, rise.arguments, 0.0, frame)?;
    no_more(op, rise.arguments + 1)?;
    let form = frame.state.form.clone();
    rise.build(run, op, frame, [reach, 0.0], |_, face| {
        let along = upright(&form, face.normal()).x_axis;
        Ok(RoofKind::Ridge(Along::Direction(along)))
    })
}

/// The two overhangs from argument `first` on; the second is as the first where it is not given.
pub fn reaches(
    run: &mut Run<'_>,
    op: &Operation,
    first: usize,
    frame: &mut Frame,
) -> Result<[f64; 2], Fault> {
    let eaves = optional(run, op, first, 0.0, frame)?;
    Ok([eaves, optional(run, op, first + 1, eaves, frame)?])
}

/// The argument at `index` as a number from 0 on, where there is one.
pub fn optional(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    none: f64,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    match op.args.len() > index {
        true => positive(run, op, index, frame),
        false => Ok(none),
    }
}

fn is_even(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<bool, Fault> {
    if op.args.len() <= index {
        return Ok(false);
    }
    match value(run, op, index, frame)? {
        Value::Bool(even) => Ok(even),
        other => {
            let message = format!("`even` is true or false, not {}", other.kind());
            Err(Fault::at(op.span, message))
        }
    }
}

/// A fault where there are more arguments than this.
pub fn no_more(op: &Operation, most: usize) -> Result<(), Fault> {
    if op.args.len() <= most {
        return Ok(());
    }
    let message = format!("{} arguments; {most} are the most here", op.args.len());
    Err(Fault::at(op.span, message))
}

/// A value as the number of an edge of a face, counted through all rings.
pub fn edge_number(op: &Operation, value: &Value, face: Face<'_>) -> Result<u32, Fault> {
    let count = face.edges().count();
    let number = value.number().filter(|n| *n >= 0.0 && *n < count as f64);
    number.map(|n| n as u32).ok_or_else(|| {
        let message = format!("the number of an edge from 0 to {} is needed", count - 1);
        Fault::at(op.span, message)
    })
}

/// The edge of an outline that looks away from another most, and is not beside it.
fn opposite(sheet: &Mesh, face: Face<'_>, edge: u32) -> Option<u32> {
    let outline = face.outline();
    let count = outline.len();
    let along = |k: usize| -> DVec3 {
        let [a, b] = [k, k + 1].map(|k| sheet.points[outline[k % count] as usize]);
        (b - a).normalize_or_zero()
    };
    let edge = edge as usize;
    if edge >= count {
        return None;
    }
    (0..count)
        .filter(|&k| k != edge && (k + 1) % count != edge && (edge + 1) % count != k)
        .min_by(|&a, &b| {
            along(a)
                .dot(along(edge))
                .total_cmp(&along(b).dot(along(edge)))
        })
        .map(|k| k as u32)
}

/// How a roof rises: `angle`, `byAngle, angle`, or `byHeight, height`.
pub struct Rise {
    by_height: bool,
    value: f64,
    /// How many arguments say so.
    pub arguments: usize,
}

impl Rise {
    /// At an angle (degrees).
    pub fn angle(value: f64) -> Self {
        Self {
            by_height: false,
            value,
            arguments: 1,
        }
    }

    pub fn of(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<Self, Fault> {
        let told = match &op.args[0] {
            Arg::Word(word) => Some(word.clone()),
            Arg::Value(_, expr) if op.args.len() > 1 => match run.evaluate(expr, frame)? {
                Value::Text(word) => Some(word),
                _ => None,
            },
            Arg::Value(..) => None,
        };
        let by_height = match told.as_deref() {
            None | Some("byAngle") => false,
            Some("byHeight") => true,
            Some(other) => {
                let message = format!("`{other}` is neither byAngle nor byHeight");
                return Err(Fault::at(op.span, message));
            }
        };
        let arguments = if told.is_some() { 2 } else { 1 };
        if op.args.len() < arguments {
            return Err(Fault::at(op.span, "an angle or a height is needed"));
        }
        Ok(Self {
            by_height,
            value: number(run, op, arguments - 1, frame)?,
            arguments,
        })
    }

    /// Puts the roof over each face of the shape. `kind` gives what it is over a face; `reach` are
    /// the overhangs of the eaves, down the slope, and of the gables, level.
    pub fn build(
        &self,
        run: &Run<'_>,
        op: &Operation,
        frame: &mut Frame,
        reach: [f64; 2],
        kind: impl Fn(&Mesh, Face<'_>) -> Result<RoofKind, Fault>,
    ) -> Result<(), Fault> {
        let sheet = sheet_of(&frame.state.form);
        if sheet.is_empty() {
            return Ok(());
        }
        let up = sheet.face(0).normal();
        let axes = upright(&frame.state.form, up);
        let slope = if self.by_height {
            let unit = over_each(run, op, &sheet, 1.0, Overhang::default(), &kind)?;
            let height = Form::around(unit, axes, true).scope.size.y;
            checked_slope(op, self.value / height.max(f64::MIN_POSITIVE))?
        } else {
            slope_of(op, self.value)?
        };
        let overhang = Overhang {
            eaves: reach[0] / slope.hypot(1.0),
            gables: reach[1],
        };
        let solid = over_each(run, op, &sheet, slope, overhang, &kind)?;
        stand(frame, solid, up);
        if run.code.tags {
            frame.state.made(Maker::Roof, up);
        }
        Ok(())
    }
}

fn over_each(
    run: &Run<'_>,
    op: &Operation,
    sheet: &Mesh,
    slope: f64,
    overhang: Overhang,
    kind: &impl Fn(&Mesh, Face<'_>) -> Result<RoofKind, Fault>,
) -> Result<Mesh, Fault> {
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        run.check_time(op.span)?;
        let kind = kind(sheet, face)?;
        let alone = sheet.of_faces([face.index()]);
        let roof = roofed_within(&alone, &kind, slope, overhang, run.budget());
        let told = |why| run.failed(op.span, format!("no roof here: {why}"));
        solid.append(&roof.map_err(told)?);
    }
    Ok(solid)
}

/// The tangent of an angle (degrees).
pub fn slope_of(op: &Operation, angle: f64) -> Result<f64, Fault> {
    checked_slope(op, angle.to_radians().tan())
}

fn checked_slope(op: &Operation, slope: f64) -> Result<f64, Fault> {
    let [least, most] = [FLATTEST, STEEPEST].map(|angle| angle.to_radians().tan());
    if (least..=most).contains(&slope) {
        return Ok(slope);
    }
    let angle = slope.atan().to_degrees();
    let message =
        format!("a slope from {FLATTEST} to {STEEPEST} degrees is needed, not {angle:.3}");
    Err(Fault::at(op.span, message))
}
