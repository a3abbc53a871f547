//! `split` along texture coordinates.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{cut, Mesh};

use super::super::code::{Body, Operation};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::limits::Limit;
use super::super::run::Run;
use super::super::state::Place;
use super::super::texture_map::{map_of, TextureMap};
use super::{dividing, number, word};
use crate::shape::{cells, Form, Pattern};

/// `split(u | v) { ... }`, `split(u, uvSpace | unitSpace) { ... }`, `split(u, unitSpace, layer) { ... }`:
/// parts along a texture coordinate from the least of the shape on. Sizes are in the coordinate, or,
/// with `unitSpace`, metres on the surface. Where the coordinate is the same all over the shape, there
/// are no parts, as of a flat shape across.
pub fn split(
    run: &mut Run<'_>,
    op: &Operation,
    axis: usize,
    frame: &mut Frame,
) -> Result<(), Fault> {
    let metres = op.args.len() > 1 && word(run, op, 1, frame)?.as_ref() == "unitSpace";
    let layer = match op.args.len() {
        3 => number(run, op, 2, frame)?,
        _ => 0.0,
    };
    let whole = frame.state.clone();
    let map = map_of(&whole, layer).map_err(|message| Fault::at(op.span, message))?;
    let mesh = whole.form.world_mesh();
    if map.grow[axis] == DVec3::ZERO {
        frame.consumed();
        return Ok(());
    }
    let level = Level::of(&map, axis);
    let flat = mesh.mapped(|point| level.flat(point));
    let (low, high) = flat.bounds().unwrap_or_default();
    let stretch = match metres {
        true => map.stretch(axis, &whole.form.world_mesh()),
        false => 1.0,
    };
    let length = (high.x - low.x) * stretch;
    let mut bodies: Vec<&Body> = Vec::new();
    let mut patterns = dividing::patterns(run, op, &op.cells, length, &mut bodies, frame)?;
    if op.repeat {
        patterns = vec![Pattern::Repeat(patterns)];
    }
    let found = cells(&patterns, length, run.options.limits.parts)
        .map_err(|many| Fault::over(Limit::Parts, op.span, many.to_string()))?;
    dividing::check_cuts(op, &flat, found.len())?;
    let solid = whole.form.geometry.is_solid();
    let near = 1e-9 * (high - low).max_element();
    // A hollow is cut as the solid that fills it, so that the cuts close.
    let hollow = solid && flat.volume() < 0.0;
    let turned = |mesh: Mesh| if hollow { mesh.reversed() } else { mesh };
    let mut rest = turned(flat);
    let mut parts = Vec::with_capacity(found.len());
    for cell in found {
        run.take(rest.corner_count(), op.span)?;
        let end = low.x + (cell.start + cell.length) / stretch;
        let piece = if end < high.x - near {
            let sides = cut(&rest, 0, end, near, solid);
            rest = sides.above.mesh;
            sides.below.mesh
        } else {
            std::mem::take(&mut rest)
        };
        if !piece.is_empty() {
            run.hold(piece.byte_count(), op.span)?;
            let piece = turned(piece).mapped(|flat| level.world(flat));
            parts.push((cell.part, piece));
        }
    }
    let total = parts.len();
    for (index, (part, piece)) in parts.into_iter().enumerate() {
        let mut state = whole.with_form(Form::around(piece, whole.form.scope.axes, solid));
        state.split = Place { index, total };
        // The parts keep the texture that they were cut along.
        state.extra_mut().maps[layer as usize] = Some(map);
        run.run_cell(bodies[part], state, frame)?;
    }
    frame.state = whole;
    frame.consumed();
    Ok(())
}

/// A frame with the texture coordinate as x, and metres along y and z.
struct Level {
    axes: DMat3,
    grow: f64,
    offset: f64,
}

impl Level {
    fn of(map: &TextureMap, axis: usize) -> Self {
        let grow = map.grow[axis].length();
        let along = map.grow[axis] / grow;
        let (y, z) = along.any_orthonormal_pair();
        Self {
            axes: DMat3::from_cols(along, y, z),
            grow,
            offset: map.offset[axis],
        }
    }

    fn flat(&self, point: DVec3) -> DVec3 {
        let own = self.axes.transpose() * point;
        DVec3::new(own.x * self.grow + self.offset, own.y, own.z)
    }

    fn world(&self, flat: DVec3) -> DVec3 {
        self.axes * DVec3::new((flat.x - self.offset) / self.grow, flat.y, flat.z)
    }
}
