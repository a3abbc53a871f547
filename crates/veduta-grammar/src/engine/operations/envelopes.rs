//! `envelope`: the space over a face that walls and slopes leave.

use glam::DVec3;
use veduta_geometry::solid::{envelope_within as space, Bound, Face, Mesh};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::marks::Maker;
use super::super::run::Run;
use super::super::value::Value;
use super::standing::stand;
use super::{numbers, positive, value, word};
use crate::shape::{components, direction, Direction, Kind};

/// The least angle of a slope (degrees): what is flatter is level.
const FLATTEST: f64 = 0.01;

/// `envelope(normal | world.up, height, frontWall, frontAngle)` and more pairs for the back, then
/// for both sides, or for the right and the left; or arrays of walls and angles for the edges of
/// each face in the order of `comp(fe)`. Over each edge stands a wall (m), above it a slope
/// (degrees); at `height` (m) the solid is cut off level. Sides that are not given are walls all the
/// way.
///
/// The sides are those of the start shape's scope, as in CityEngine where no widths of streets are
/// known. With `world.up` the faces must be level.
pub fn envelope(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let up = word(run, op, 0, frame)?;
    let most = positive(run, op, 1, frame)?;
    let sheet = frame.state.form.world_mesh();
    if sheet.is_empty() || most == 0.0 {
        return Ok(());
    }
    let is_level = |normal: DVec3| normal.y > 1.0 - 1e-9;
    if up.as_ref() == "world.up" && !sheet.faces().all(|face| is_level(face.normal())) {
        return Err(Fault::at(
            op.span,
            "a face is not level, and cannot rise along world.up",
        ));
    }
    let bounds = bounds(run, op, &sheet, frame)?;
    let mut solid = Mesh::new();
    let mut first = 0;
    for face in sheet.faces() {
        run.check_time(op.span)?;
        let edges: usize = face.rings().map(<[u32]>::len).sum();
        let own = &bounds[first..first + edges];
        first += edges;
        if face.normal() == DVec3::ZERO {
            continue;
        }
        let found = space(&sheet, face, own, most, run.budget());
        let told = |error| run.failed(op.span, format!("no envelope here: {error}"));
        solid.append(&found.map_err(told)?);
    }
    if let Some(normal) = sheet.faces().map(Face::normal).find(|n| *n != DVec3::ZERO) {
        stand(frame, solid, normal);
        if run.code.tags {
            frame.state.made(Maker::Envelope, normal);
        }
    }
    Ok(())
}

fn bounds(
    run: &mut Run<'_>,
    op: &Operation,
    sheet: &Mesh,
    frame: &mut Frame,
) -> Result<Vec<Bound>, Fault> {
    let edges = sheet.corner_count();
    let given = value(run, op, 2, frame)?;
    if let (Value::Array(_), 4) = (&given, op.args.len()) {
        let mut walls = numbers(run, op, &given)?;
        let given = value(run, op, 3, frame)?;
        let mut angles = numbers(run, op, &given)?;
        for count in [walls.len(), angles.len()] {
            if count > edges {
                let message = format!("{count} numbers for {edges} edges");
                return Err(Fault::at(op.span, message));
            }
        }
        // Edges without numbers of their own have walls up to the top.
        walls.resize(edges, 0.0);
        angles.resize(edges, 90.0);
        let each = walls.into_iter().zip(angles);
        return each.map(|(wall, angle)| bound(op, wall, angle)).collect();
    }
    let mut pairs = Vec::new();
    for index in (2..op.args.len()).step_by(2) {
        let wall = positive(run, op, index, frame)?;
        let angle = positive(run, op, index + 1, frame)?;
        pairs.push(bound(op, wall, angle)?);
    }
    let object = run.first().state.form.scope.axes;
    let wall = Bound {
        wall: f64::MAX,
        speed: 0.0,
    };
    let mut found = vec![wall; edges];
    for edge in components(&frame.state.form, Kind::FaceEdges) {
        let pair = match (direction(object, edge.normal), pairs.len()) {
            (Direction::Front, _) => pairs.first(),
            (Direction::Back, _) => pairs.get(1),
            (Direction::Left, 4) => pairs.get(3),
            (Direction::Left | Direction::Right, _) => pairs.get(2),
            _ => None,
        };
        found[edge.index] = pair.copied().unwrap_or(wall);
    }
    Ok(found)
}

fn bound(op: &Operation, wall: f64, angle: f64) -> Result<Bound, Fault> {
    if !(FLATTEST..=90.0).contains(&angle) {
        let message = format!("a slope from {FLATTEST} to 90 degrees is needed, not {angle}");
        return Err(Fault::at(op.span, message));
    }
    let speed = if angle == 90.0 {
        0.0
    } else {
        1.0 / angle.to_radians().tan()
    };
    Ok(Bound { wall, speed })
}
