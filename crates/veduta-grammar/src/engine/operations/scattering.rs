//! `scatter`: points on a shape or in its scope.

use glam::{DMat3, DVec3};

use super::super::code::{Arg, Cell, Operation, Sizing};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::limits::Limit;
use super::super::random::Stream;
use super::super::run::Run;
use super::super::state::Place;
use super::meshes::triangles;
use super::{number, word};
use crate::shape::{Form, Geometry, Scope};

/// How often a place is drawn anew that is too far from the middle.
const TRIES: usize = 200;
/// The spread where none is given, as a share of the scope's size.
const SPREAD: f64 = 0.16;

/// `scatter(surface | volume | scope, count, uniform) { operations }`, `scatter(domain, count, gaussian,
/// center | front | ..., spread)`: points on the faces or in the scope, each a shape without size
/// or geometry. On faces y of its scope is along the normal. `spread` is the standard deviation in
/// metres, or after `'` in shares of the scope's size along each axis ('0.16 where none is given);
/// `gaussian` draws a place again that lies outside of the scope, or on faces as the bell curve says.
///
/// `volume` is within the surface of a closed shape, and for others what `surface` is. The points depend on the seed, and on nothing beside the shape.
pub fn scatter(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let domain = word(run, op, 0, frame)?;
    let count = number(run, op, 1, frame)?.round().max(0.0);
    if count > run.options.limits.parts as f64 {
        return Err(Fault::over(
            Limit::Parts,
            op.span,
            format!("{count} points"),
        ));
    }
    let scope = frame.state.form.scope;
    let bell = match word(run, op, 2, frame)?.as_ref() {
        "uniform" => None,
        _ => Some(Bell::of(run, op, frame)?),
    };
    let closed = frame.state.form.geometry.is_solid();
    let (surface, room) = match domain.as_ref() {
        "scope" => (None, None),
        "volume" if closed => (None, Some(Room::of(op, &frame.state.form)?)),
        "surface" | "volume" => (Some(Surface::of(op, &frame.state.form)?), None),
        other => {
            let message = format!("`{other}` is no place for points: surface, volume or scope");
            return Err(Fault::at(op.span, message));
        }
    };
    run.take(STEPS_PER_POINT * count as usize, op.span)?;
    let mut scopes = Vec::with_capacity(count as usize);
    for _ in 0..count as usize {
        run.check_time(op.span)?;
        scopes.push(match (&surface, &room) {
            (None, Some(room)) => {
                match room.point(run, op, &scope, bell.as_ref(), &mut frame.stream)? {
                    Some(place) => place,
                    // So thin a shape has no room for the point.
                    None => continue,
                }
            }
            (Some(surface), _) if surface.sums.is_empty() => break,
            (Some(surface), _) => surface.point(&scope, bell.as_ref(), &mut frame.stream),
            (None, None) => in_scope(&scope, bell.as_ref(), &mut frame.stream),
        });
    }
    let whole = frame.state.clone();
    let total = scopes.len();
    for (index, scope) in scopes.into_iter().enumerate() {
        let geometry = Geometry::Nothing;
        let mut state = whole.with_form(Form { scope, geometry });
        state.split = Place { index, total };
        for cell in &op.cells {
            if let Cell::Part { body, .. } = cell {
                run.run_cell(body, state.clone(), frame)?;
            }
        }
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

/// What a point costs, in steps of work.
const STEPS_PER_POINT: usize = 256;
/// What the solid angle of a triangle costs, in steps of work.
const STEPS_PER_TRIANGLE: usize = 8;

/// A bell curve in shares of the scope's size.
struct Bell {
    middle: DVec3,
    spread: DVec3,
}

impl Bell {
    fn of(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<Self, Fault> {
        let name = match op.args.len() > 3 {
            true => word(run, op, 3, frame)?,
            false => "center".into(),
        };
        let middle = match name.as_ref() {
            "center" => DVec3::splat(0.5),
            "front" => DVec3::new(0.5, 0.5, 1.0),
            "back" => DVec3::new(0.5, 0.5, 0.0),
            "left" => DVec3::new(0.0, 0.5, 0.5),
            "right" => DVec3::new(1.0, 0.5, 0.5),
            "top" => DVec3::new(0.5, 1.0, 0.5),
            "bottom" => DVec3::new(0.5, 0.0, 0.5),
            other => {
                let message = format!("`{other}` is no place in a scope: center, front, ...");
                return Err(Fault::at(op.span, message));
            }
        };
        let size = frame.state.form.scope.size;
        let spread = if op.args.len() > 4 {
            let given = number(run, op, 4, frame)?.abs();
            match &op.args[4] {
                Arg::Value(Sizing::Relative, _) => DVec3::splat(given),
                _ => crate::shape::over(DVec3::splat(given), size),
            }
        } else {
            DVec3::splat(SPREAD)
        };
        Ok(Self { middle, spread })
    }

    /// How likely a place is, against the middle.
    fn chance(&self, unit: DVec3) -> f64 {
        let away = crate::shape::over(unit - self.middle, self.spread);
        (-0.5 * away.length_squared()).exp()
    }
}

/// What lies within a closed surface.
struct Room {
    triangles: Vec<[DVec3; 3]>,
}

impl Room {
    fn of(op: &Operation, form: &Form) -> Result<Self, Fault> {
        let mesh = form.world_mesh();
        let mut all = Vec::new();
        for face in mesh.faces() {
            let found = triangles(&mesh, face).map_err(|error| {
                Fault::at(op.span, format!("a face cannot be divided: {error}"))
            })?;
            all.extend(
                found
                    .into_iter()
                    .map(|t| t.map(|point| mesh.points[point as usize])),
            );
        }
        Ok(Self { triangles: all })
    }

    /// A place in it; None where none of those drawn is. Each costs a look at all triangles.
    fn point(
        &self,
        run: &Run<'_>,
        op: &Operation,
        scope: &Scope,
        bell: Option<&Bell>,
        stream: &mut Stream,
    ) -> Result<Option<Scope>, Fault> {
        for _ in 0..TRIES {
            run.take(STEPS_PER_TRIANGLE * self.triangles.len(), op.span)?;
            let place = in_scope(scope, bell, stream);
            if self.holds(place.origin) {
                return Ok(Some(place));
            }
        }
        Ok(None)
    }

    /// Whether the surface goes round a place: by the solid angles of its triangles (van Oosterom
    /// and Strackee 1983).
    fn holds(&self, place: DVec3) -> bool {
        let angle: f64 = self
            .triangles
            .iter()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| corner - place);
                let (la, lb, lc) = (a.length(), b.length(), c.length());
                let across = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
                2.0 * a.dot(b.cross(c)).atan2(across)
            })
            .sum();
        angle.abs() > std::f64::consts::TAU
    }
}

fn in_scope(scope: &Scope, bell: Option<&Bell>, stream: &mut Stream) -> Scope {
    let mut draw = || DVec3::new(stream.draw(), stream.draw(), stream.draw());
    let unit = match bell {
        None => draw(),
        Some(bell) => {
            let inside =
                |unit: &DVec3| unit.cmpge(DVec3::ZERO).all() && unit.cmple(DVec3::ONE).all();
            let mut tries = (0..TRIES).map(|_| bell.middle + bell.spread * normal(draw(), draw()));
            tries.find(inside).unwrap_or(bell.middle)
        }
    };
    point_at(scope.world(unit), scope.axes)
}

/// Three numbers of the normal distribution from six even ones (Box and Muller 1958).
fn normal(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|axis| {
        let radius = (-2.0 * (1.0 - a[axis]).ln()).sqrt();
        radius * (std::f64::consts::TAU * b[axis]).cos()
    }))
}

fn point_at(origin: DVec3, axes: DMat3) -> Scope {
    Scope {
        origin,
        axes,
        size: DVec3::ZERO,
    }
}

/// The triangles of a shape, to draw places from.
struct Surface {
    corners: Vec<[DVec3; 3]>,
    normals: Vec<DVec3>,
    /// The area of each triangle with that of those before it.
    sums: Vec<f64>,
}

impl Surface {
    fn of(op: &Operation, form: &Form) -> Result<Self, Fault> {
        let mesh = form.world_mesh();
        let mut surface = Self {
            corners: Vec::new(),
            normals: Vec::new(),
            sums: Vec::new(),
        };
        let mut sum = 0.0;
        for face in mesh.faces() {
            let found = triangles(&mesh, face)
                .map_err(|error| Fault::at(op.span, format!("no points on a face: {error}")))?;
            for triangle in found {
                let [a, b, c] = triangle.map(|point| mesh.points[point as usize]);
                sum += 0.5 * (b - a).cross(c - a).length();
                surface.corners.push([a, b, c]);
                surface.normals.push(face.normal());
                surface.sums.push(sum);
            }
        }
        Ok(surface)
    }

    fn point(&self, scope: &Scope, bell: Option<&Bell>, stream: &mut Stream) -> Scope {
        let mut found = self.drawn(stream);
        if let Some(bell) = bell {
            for _ in 0..TRIES {
                let unit = flat_middle(scope, scope.unit(found.0), bell);
                if stream.draw() < bell.chance(unit) {
                    break;
                }
                found = self.drawn(stream);
            }
        }
        let (place, normal) = found;
        let x = (scope.axes.x_axis - normal * scope.axes.x_axis.dot(normal))
            .normalize_or(normal.any_orthonormal_vector());
        point_at(place, DMat3::from_cols(x, normal, x.cross(normal)))
    }

    fn drawn(&self, stream: &mut Stream) -> (DVec3, DVec3) {
        let whole = self.sums[self.sums.len() - 1];
        let at = stream.draw() * whole;
        let index = self.sums.partition_point(|&sum| sum <= at);
        let index = index.min(self.sums.len() - 1);
        let [a, b, c] = self.corners[index];
        let (mut u, mut v) = (stream.draw(), stream.draw());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        (a + (b - a) * u + (c - a) * v, self.normals[index])
    }
}

/// Along an axis without extent, a place is as good as any.
fn flat_middle(scope: &Scope, mut unit: DVec3, bell: &Bell) -> DVec3 {
    for axis in 0..3 {
        if scope.size[axis] == 0.0 {
            unit[axis] = bell.middle[axis];
        }
    }
    unit
}
