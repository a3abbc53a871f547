//! Roofs over the faces of a shape from slopes over its edges.

use veduta_geometry::solid::{roofed_over, Mesh, Overhang, RoofKind};

use super::super::code::{Arg, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::value::Value;
use super::standing::{sheet_of, stand, upright};
use super::{number, positive, value};
use crate::shape::Form;

/// Slopes steeper than this are walls (degrees).
const STEEPEST: f64 = 89.0;
/// Slopes flatter than this cannot be told from their floors when they are cut (degrees).
const FLATTEST: f64 = 0.01;

/// `roofHip(angle)`, `roofHip(angle, overhang)`, `roofHip(byAngle | byHeight, value)`,
/// `roofHip(byAngle | byHeight, value, overhang)`: a slope over every edge, at an angle (degrees) or
/// up to a height (m). The overhang (m) is measured down the slope.
///
/// The planes go on beyond the edges, so that eaves that hang over lie lower than the face. Other
/// than in CityEngine the roof is closed there by a level floor. `even` may only be false.
pub fn hip(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    build(run, op, frame, RoofKind::Hip)
}

/// `roofGable(angle)`, `roofGable(angle, eaves, gables)` and both with `byAngle | byHeight, value`:
/// upright ends where a hip roof has triangles. The overhangs (m) are that of the eaves, down the
/// slope, and that of the gables, level; where the second is not given it is as the first.
///
/// Of two triangles side by side the first stands. `even` may only be false, and the edge that
/// carries a gable cannot be chosen.
pub fn gable(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    build(run, op, frame, RoofKind::Gable)
}

/// The scope has y where the roof rises afterwards, and holds the closed roof.
fn build(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    kind: RoofKind,
) -> Result<(), Fault> {
    let height = Rise::of(run, op, frame)?;
    let first = height.arguments;
    let mut reach = [0.0; 2];
    let places = if kind == RoofKind::Hip { 1 } else { 2 };
    for (place, distance) in reach.iter_mut().enumerate().take(places) {
        if first + place < op.args.len() {
            *distance = positive(run, op, first + place, frame)?;
        }
    }
    if op.args.len() == first + 1 {
        reach[1] = reach[0];
    }
    if op.args.len() > first + places {
        let even = value(run, op, first + places, frame)?;
        if even != Value::Bool(false) || op.args.len() > first + places + 1 {
            let message = "even roofs and the choice of an edge do not derive";
            return Err(Fault::at(op.span, message));
        }
    }
    let sheet = sheet_of(&frame.state.form);
    if sheet.is_empty() {
        return Ok(());
    }
    let roof = |slope: f64, overhang: Overhang| -> Result<Mesh, Fault> {
        roofed_over(&sheet, kind, slope, overhang)
            .map_err(|error| Fault::at(op.span, format!("no roof here: {error}")))
    };
    let axes = upright(&frame.state.form, sheet.face(0).normal());
    let slope = height.slope(op, || {
        let unit = roof(1.0, Overhang::default())?;
        Ok(Form::around(unit, axes, true).scope.size.y)
    })?;
    let level = 1.0 / slope.hypot(1.0);
    let overhang = Overhang {
        eaves: reach[0] * level,
        gables: if kind == RoofKind::Hip { 0.0 } else { reach[1] },
    };
    let solid = roof(slope, overhang)?;
    stand(frame, solid, sheet.face(0).normal());
    Ok(())
}

/// How a roof rises: `angle`, `byAngle, angle`, or `byHeight, height`.
pub struct Rise {
    by_height: bool,
    value: f64,
    /// How many arguments say so.
    pub arguments: usize,
}

impl Rise {
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

    /// The tangent of the slope; `unit` is how high the roof is where that is 1.
    pub fn slope(
        &self,
        op: &Operation,
        unit: impl FnOnce() -> Result<f64, Fault>,
    ) -> Result<f64, Fault> {
        let slope = if self.by_height {
            self.value / unit()?.max(f64::MIN_POSITIVE)
        } else {
            self.value.to_radians().tan()
        };
        let [least, most] = [FLATTEST, STEEPEST].map(|angle| angle.to_radians().tan());
        if (least..=most).contains(&slope) {
            return Ok(slope);
        }
        let angle = slope.atan().to_degrees();
        let message =
            format!("a slope from {FLATTEST} to {STEEPEST} degrees is needed, not {angle:.3}");
        Err(Fault::at(op.span, message))
    }
}
