//! Roofs over the faces of a shape that CityEngine does not have: Veduta's own operations.
//!
//! Angles are degrees, lengths metres. Overhangs come after what makes the roof: that of the eaves,
//! measured down the slope, and for roofs with gables that of the gables, level.

use veduta_geometry::solid::{Along, Gables, RoofKind};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::value::Value;
use super::roofs::{edge_number, no_more, optional, reaches, slope_of, Rise};
use super::standing::upright;
use super::{number, numbers_of_edges, positive, value};

/// The most steps of a round roof, and teeth of a sawtooth roof.
const MOST_PARTS: f64 = 100.0;
/// In how many steps a roof is round where that is not told.
const STEPS: f64 = 8.0;
/// How thick the slab of a flat roof is where that is not told (m).
const SLAB_M: f64 = 0.2;

/// `roofMansard(lower, upper, height)`, and an overhang: a hip roof that is flatter above a height.
pub fn mansard(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let (rise, upper, knee) = two_slopes(run, op, frame)?;
    let reach = optional(run, op, 3, 0.0, frame)?;
    rise.build(run, op, frame, [reach, 0.0], |_, _| {
        Ok(RoofKind::Mansard { upper, knee })
    })
}

/// `roofGambrel(lower, upper, height)`, and overhangs: a gable roof that is flatter above a height.
pub fn gambrel(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let (rise, upper, knee) = two_slopes(run, op, frame)?;
    let reach = reaches(run, op, 3, frame)?;
    rise.build(run, op, frame, reach, |_, _| {
        let gables = Gables::Triangles;
        Ok(RoofKind::Gambrel {
            gables,
            upper,
            knee,
        })
    })
}

/// The lower slope, the upper one and the height between them.
fn two_slopes(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
) -> Result<(Rise, f64, f64), Fault> {
    let rise = Rise::angle(number(run, op, 0, frame)?);
    let upper = number(run, op, 1, frame)?;
    let upper = slope_of(op, upper)?;
    Ok((rise, upper, above_zero(run, op, 2, frame)?))
}

/// `roofHalfHip(angle, share)`, also with `byAngle | byHeight, value`, and overhangs: a gable roof
/// whose gables lean back over the upper share of their height.
pub fn half_hip(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let clipped = share(run, op, rise.arguments, frame)?;
    let reach = reaches(run, op, rise.arguments + 1, frame)?;
    no_more(op, rise.arguments + 3)?;
    rise.build(run, op, frame, reach, |_, _| {
        let gables = Gables::Triangles;
        Ok(RoofKind::HalfHip { gables, clipped })
    })
}

/// `roofDutch(angle, share)`, also with `byAngle | byHeight, value`, and an overhang: a hip roof up
/// to a share of its height, and a small gable roof over what is left there.
pub fn dutch(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let share = share(run, op, rise.arguments, frame)?;
    let reach = optional(run, op, rise.arguments + 1, 0.0, frame)?;
    no_more(op, rise.arguments + 2)?;
    rise.build(run, op, frame, [reach, 0.0], |_, _| {
        Ok(RoofKind::Dutch { share })
    })
}

/// `roofSaltbox(front, back)`, overhangs, and the front edge: a gable roof with another angle on
/// the edges that look away from the front, which is the longest edge where none is given.
pub fn saltbox(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::angle(number(run, op, 0, frame)?);
    let back = number(run, op, 1, frame)?;
    let back = slope_of(op, back)?;
    let reach = reaches(run, op, 2, frame)?;
    let front = match op.args.len() > 4 {
        true => Some(value(run, op, 4, frame)?),
        false => None,
    };
    rise.build(run, op, frame, reach, |_, face| {
        let number = |edge: &Value| edge_number(op, edge, face);
        let front = front.as_ref().map(number).transpose()?;
        Ok(RoofKind::Saltbox { back, front })
    })
}

/// `roofPerEdge(angles)`, and overhangs: an angle for each edge, through all rings; one of 90
/// degrees stays upright. All eaves lie at one height, so what is flatter hangs over farther.
pub fn per_edge(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let angles = value(run, op, 0, frame)?;
    let reach = reaches(run, op, 1, frame)?;
    let count = match &angles {
        Value::Array(array) => array.values.len(),
        _ => 0,
    };
    let mut flattest = f64::INFINITY;
    let mut slopes = Vec::with_capacity(count);
    for angle in numbers_of_edges(run, op, &angles, count)? {
        let is_upright = (angle - 90.0).abs() < 1e-9;
        let slope = if is_upright {
            f64::INFINITY
        } else {
            slope_of(op, angle)?
        };
        flattest = slope.min(flattest);
        slopes.push(slope);
    }
    if !flattest.is_finite() {
        return Err(Fault::at(
            op.span,
            "a roof needs an edge that is not upright",
        ));
    }
    let rise = Rise::angle(flattest.atan().to_degrees());
    rise.build(run, op, frame, reach, |_, _| {
        Ok(RoofKind::PerEdge(slopes.clone()))
    })
}

/// `roofSkillion(angle, direction)`, also with `byAngle | byHeight, value`, and an overhang: one
/// plane that falls towards a direction of the scope: 0 is its front, 90 its right.
pub fn skillion(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let turn = match op.args.len() > rise.arguments {
        true => number(run, op, rise.arguments, frame)?.to_radians(),
        false => 0.0,
    };
    let reach = optional(run, op, rise.arguments + 1, 0.0, frame)?;
    no_more(op, rise.arguments + 2)?;
    let form = frame.state.form.clone();
    rise.build(run, op, frame, [reach, 0.0], |_, face| {
        let axes = upright(&form, face.normal());
        let towards = axes.z_axis * turn.cos() + axes.x_axis * turn.sin();
        Ok(RoofKind::Skillion { towards })
    })
}

/// `roofButterfly(angle)`, also with `byAngle | byHeight, value`, an overhang, and the edge that it
/// runs along: two planes that fall to the middle.
pub fn butterfly(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let first = rise.arguments;
    planes(run, op, frame, &rise, first, RoofKind::Butterfly)
}

/// `roofCrossGable(angle)`, also with `byAngle | byHeight, value`, an overhang, and the edge that it
/// runs along: two ridges of one height at right angles. The angle is that over the longer sides.
pub fn cross_gable(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let first = rise.arguments;
    planes(run, op, frame, &rise, first, RoofKind::CrossGable)
}

/// `roofSawtooth(angle, teeth)`, also with `byAngle | byHeight, value`, an overhang, and the edge
/// that the teeth run along: planes side by side that rise and end upright.
pub fn sawtooth(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let rise = Rise::of(run, op, frame)?;
    let first = rise.arguments;
    let teeth = parts(run, op, first, f64::NAN, frame)?;
    planes(run, op, frame, &rise, first + 1, |along| {
        RoofKind::Sawtooth { teeth, along }
    })
}

/// An overhang from argument `first` on, and the edge that a roof runs along.
fn planes(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    rise: &Rise,
    first: usize,
    kind: impl Fn(Along) -> RoofKind,
) -> Result<(), Fault> {
    let reach = optional(run, op, first, 0.0, frame)?;
    let edge = match op.args.len() > first + 1 {
        true => Some(value(run, op, first + 1, frame)?),
        false => None,
    };
    no_more(op, first + 2)?;
    rise.build(run, op, frame, [reach, 0.0], |_, face| {
        Ok(kind(match &edge {
            Some(edge) => Along::Edge(edge_number(op, edge, face)?),
            None => Along::Longest,
        }))
    })
}

/// `roofDome(height)`, an overhang, and the number of steps: round from the eaves up.
pub fn dome(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let height = above_zero(run, op, 0, frame)?;
    let reach = optional(run, op, 1, 0.0, frame)?;
    let steps = parts(run, op, 2, STEPS, frame)?;
    Rise::angle(45.0).build(run, op, frame, [reach, 0.0], |_, _| {
        Ok(RoofKind::Dome { height, steps })
    })
}

/// `roofOnion(height)`, an overhang, and the number of steps: a bulb with a tip.
pub fn onion(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let height = above_zero(run, op, 0, frame)?;
    let reach = optional(run, op, 1, 0.0, frame)?;
    let steps = parts(run, op, 2, STEPS, frame)?;
    Rise::angle(45.0).build(run, op, frame, [reach, 0.0], |_, _| {
        Ok(RoofKind::Onion { height, steps })
    })
}

/// `roofVault(height)`, overhangs, and the number of steps: round between gables.
pub fn vault(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let height = above_zero(run, op, 0, frame)?;
    let reach = reaches(run, op, 1, frame)?;
    let steps = parts(run, op, 3, STEPS, frame)?;
    Rise::angle(45.0).build(run, op, frame, reach, |_, _| {
        let gables = Gables::Triangles;
        Ok(RoofKind::Vault {
            gables,
            height,
            steps,
        })
    })
}

/// `roofFlat(parapet, width)`, the thickness of the slab, and an overhang: level, with a parapet of
/// this height over the slab and this width around it.
pub fn flat(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let above = above_zero(run, op, 0, frame)?;
    let width = above_zero(run, op, 1, frame)?;
    let slab = match op.args.len() > 2 {
        true => above_zero(run, op, 2, frame)?,
        false => SLAB_M,
    };
    let reach = optional(run, op, 3, 0.0, frame)?;
    let parapet = slab + above;
    // Its eaves are level, so that the overhang is, too.
    let reach = reach * 2f64.sqrt();
    Rise::angle(45.0).build(run, op, frame, [reach, 0.0], |_, _| {
        Ok(RoofKind::Flat {
            slab,
            parapet,
            width,
        })
    })
}

fn above_zero(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    let found = positive(run, op, index, frame)?;
    if found > 0.0 {
        return Ok(found);
    }
    Err(Fault::at(op.span, "a number above 0 is needed, not 0"))
}

/// The argument at `index` as a share between 0 and 1.
fn share(run: &mut Run<'_>, op: &Operation, index: usize, frame: &mut Frame) -> Result<f64, Fault> {
    if op.args.len() <= index {
        return Err(Fault::at(op.span, "a share of the height is needed, too"));
    }
    let found = number(run, op, index, frame)?;
    if found > 0.0 && found < 1.0 {
        return Ok(found);
    }
    let message = format!("a share between 0 and 1 is needed, not {found}");
    Err(Fault::at(op.span, message))
}

/// The argument at `index` as a count, `none` where it is not given.
fn parts(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    none: f64,
    frame: &mut Frame,
) -> Result<u32, Fault> {
    let found = match op.args.len() > index {
        true => number(run, op, index, frame)?,
        false => none,
    };
    if (1.0..=MOST_PARTS).contains(&found) {
        return Ok(found as u32);
    }
    let message = format!("a count from 1 to {MOST_PARTS} is needed, not {found}");
    Err(Fault::at(op.span, message))
}
