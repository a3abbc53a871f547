//! `split`: a shape to parts along an axis.

use veduta_geometry::solid::Mesh;
use veduta_geometry::Spent;

use super::super::code::{Body, Cell, Operation, Selector, Sizing};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::limits::Limit;
use super::super::run::Run;
use super::super::state::{Place, State};
use super::{axes, dividing_textures, word};
use crate::shape::{self, cells, Geometry, Pattern, Size};

/// `split(x) { 'size : A | ~size : B | { ... }* }`
pub fn split(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let along = word(run, op, 0, frame)?;
    if let Some(axis) = ["u", "v"].iter().position(|name| *name == along.as_ref()) {
        return dividing_textures::split(run, op, axis, frame);
    }
    let axis = axes(op, &along)?[0];
    let adjust = op.args.len() < 2 || word(run, op, 1, frame)?.as_ref() != "noAdjust";
    let mut bodies = Vec::new();
    let length = frame.state.form.scope.size[axis];
    let mut patterns = patterns(run, op, &op.cells, length, &mut bodies, frame)?;
    if op.repeat {
        patterns = vec![Pattern::Repeat(patterns)];
    }
    let whole = frame.state.clone();
    let most = run.options.limits.parts;
    let found = cells(&patterns, whole.form.scope.size[axis], most)
        .map_err(|many| Fault::over(Limit::Parts, op.span, many.to_string()))?;
    run_parts(run, op, (axis, adjust), &found, &bodies, whole, frame)
}

/// How often the corners of a shape may be looked at for its parts.
const MOST_CUTS: usize = 50_000_000;

/// A fault where cutting a shape into so many parts is too much work.
pub(super) fn check_cuts(op: &Operation, mesh: &Mesh, parts: usize) -> Result<(), Fault> {
    if mesh.corner_count().saturating_mul(parts) > MOST_CUTS {
        let message = format!("a split of {} faces into {parts} parts", mesh.face_count());
        return Err(Fault::at(op.span, message));
    }
    Ok(())
}

/// Runs the bodies on the parts along an axis.
fn run_parts(
    run: &mut Run<'_>,
    op: &Operation,
    (axis, adjust): (usize, bool),
    found: &[shape::Cell],
    bodies: &[&Body],
    whole: State,
    frame: &mut Frame,
) -> Result<(), Fault> {
    if let Geometry::Faces { mesh, .. } = &whole.form.geometry {
        check_cuts(op, mesh, found.len())?;
    }
    let parts = shape::split(&whole.form, axis, found, adjust, run.budget())
        .map_err(|Spent| run.failed(op.span, Spent))?;
    let total = parts.len();
    for (index, (cell, form)) in parts.into_iter().enumerate() {
        let mut state = whole.with_form(form);
        state.split = Place { index, total };
        run.run_cell(bodies[cell.part], state, frame)?;
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

/// `splitArea(x) { area : A | ~area : B | ... }`: a shape to parts along an axis, each with its area
/// of the faces (m2; `'` takes it of the whole). A second argument `noAdjust` leaves the scopes of
/// the parts as wide as the cells. Closed shapes are divided by the area of their surface, without
/// that of the cuts.
pub fn split_area(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let axis = axes(op, &word(run, op, 0, frame)?)?[0];
    let adjust = op.args.len() < 2 || word(run, op, 1, frame)?.as_ref() != "noAdjust";
    let whole = frame.state.clone();
    let area = whole.form.world_mesh().area();
    let mut bodies = Vec::new();
    let mut patterns = patterns(run, op, &op.cells, area, &mut bodies, frame)?;
    if op.repeat {
        patterns = vec![Pattern::Repeat(patterns)];
    }
    let most = run.options.limits.parts.min(MOST_PARTS_BY_AREA);
    let mut found =
        cells(&patterns, area, most).map_err(|many| run.too_many_parts(most, op.span, &many))?;
    let places = AreaAlong::of(&whole.form, axis);
    let mut start = 0.0;
    for cell in &mut found {
        run.check_time(op.span)?;
        run.take(SEARCHES * places.unit.corner_count(), op.span)?;
        let end = places.place(cell.start + cell.length);
        (cell.start, cell.length) = (start, end - start);
        start = end;
    }
    run_parts(run, op, (axis, adjust), &found, &bodies, whole, frame)
}

/// The most parts of a split by area: the place of each is searched for.
const MOST_PARTS_BY_AREA: usize = 10_000;

/// How often the place of a part is halved.
const SEARCHES: usize = 52;

/// How much of a shape's area lies below each place along an axis.
struct AreaAlong {
    unit: Mesh,
    scope: shape::Scope,
    axis: usize,
    whole: f64,
}

impl AreaAlong {
    fn of(form: &shape::Form, axis: usize) -> Self {
        Self {
            unit: form.geometry.mesh(),
            scope: form.scope,
            axis,
            whole: form.world_mesh().area(),
        }
    }

    /// Where so much area lies below (m along the axis).
    fn place(&self, area: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        if area >= self.whole * (1.0 - 1e-12) {
            return self.scope.size[self.axis];
        }
        for _ in 0..SEARCHES {
            let middle = 0.5 * (low + high);
            let sides = veduta_geometry::solid::cut(&self.unit, self.axis, middle, 1e-12, false);
            let below = sides.below.mesh.mapped(|unit| self.scope.world(unit));
            if below.area() < area {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high) * self.scope.size[self.axis]
    }
}

/// The sizes of the cells as they are now; the bodies in the order in which parts are numbered.
pub(super) fn patterns<'o>(
    run: &mut Run<'_>,
    op: &Operation,
    cells: &'o [Cell],
    whole: f64,
    bodies: &mut Vec<&'o Body>,
    frame: &mut Frame,
) -> Result<Vec<Pattern>, Fault> {
    let mut found = Vec::with_capacity(cells.len());
    for cell in cells {
        found.push(match cell {
            Cell::Part { selector, body, .. } => {
                bodies.push(body);
                Pattern::Part(size(run, op, selector, whole, frame)?)
            }
            Cell::Repeat(inner) => Pattern::Repeat(patterns(run, op, inner, whole, bodies, frame)?),
        });
    }
    Ok(found)
}

fn size(
    run: &mut Run<'_>,
    op: &Operation,
    selector: &Selector,
    whole: f64,
    frame: &mut Frame,
) -> Result<Size, Fault> {
    let Selector::Value(sizing, expr) = selector else {
        return Err(Fault::at(op.span, "a cell of a split begins with its size"));
    };
    let number = run.evaluate_finite(expr, frame)?;
    Ok(match sizing {
        Sizing::Absolute => Size::Absolute(number),
        Sizing::Relative => Size::Relative(number),
        Sizing::Floating => Size::Floating(number),
        Sizing::FloatingRelative => Size::Floating(number * whole),
    })
}
