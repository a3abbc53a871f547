//! A shape to parts along one axis of its scope.

use glam::DVec3;
use veduta_geometry::solid::{cut, Mesh};
use veduta_geometry::{Budget, Spent};

use super::form::{Form, Geometry, TOLERANCE};
use super::scope::{over, Scope};
use super::sizes::Cell;

/// The part of a shape in each cell along `axis`; a cell without geometry gives none.
///
/// Closed shapes give closed parts. With `adjust` the scope of each part is fitted to its
/// geometry; otherwise it is the cell, so that the scopes fill that of the whole.
///
/// # Errors
/// Where the budget does not suffice.
pub fn split(
    form: &Form,
    axis: usize,
    cells: &[Cell],
    adjust: bool,
    budget: &dyn Budget,
) -> Result<Vec<(Cell, Form)>, Spent> {
    Ok(match &form.geometry.opened() {
        Geometry::Faces { mesh, solid } => split_faces(form, mesh, *solid, (axis, cells), budget)?
            .into_iter()
            .map(|(cell, part)| (cell, if adjust { part.fitted() } else { part }))
            .collect(),
        Geometry::Rectangle(normal) if *normal == axis => Vec::new(),
        plain => cells
            .iter()
            .map(|&cell| {
                let part = Form {
                    scope: form.scope.part(axis, cell.start, cell.length),
                    geometry: plain.clone(),
                };
                (cell, part)
            })
            .collect(),
    })
}

fn split_faces(
    form: &Form,
    mesh: &Mesh,
    solid: bool,
    (axis, cells): (usize, &[Cell]),
    budget: &dyn Budget,
) -> Result<Vec<(Cell, Form)>, Spent> {
    let scope = &form.scope;
    let size = scope.size[axis];
    if size <= 0.0 {
        return Ok(Vec::new());
    }
    // A hollow is cut as the solid that fills it, so that the cuts close.
    let hollow = solid && mesh.volume() < 0.0;
    let turned = |mesh: Mesh| if hollow { mesh.reversed() } else { mesh };
    let mut rest = turned(mesh.clone());
    let mut parts = Vec::with_capacity(cells.len());
    for &cell in cells {
        let end = (cell.start + cell.length) / size;
        budget.take(STEPS_PER_CORNER * rest.corner_count())?;
        let piece = if end < 1.0 - TOLERANCE {
            let sides = cut(&rest, axis, end, TOLERANCE, solid);
            rest = sides.above.mesh;
            sides.below.mesh
        } else {
            std::mem::take(&mut rest)
        };
        if !piece.is_empty() {
            budget.hold(piece.byte_count())?;
            parts.push((cell, part_of(scope, turned(piece), solid, axis, cell)));
        }
    }
    Ok(parts)
}

/// What a corner of what is cut costs, in steps of the budget.
const STEPS_PER_CORNER: usize = 4;

/// A piece in shares of the whole's scope, in shares of its own.
fn part_of(scope: &Scope, piece: Mesh, solid: bool, axis: usize, cell: Cell) -> Form {
    let part = scope.part(axis, cell.start, cell.length);
    let mut offset = DVec3::ZERO;
    offset[axis] = cell.start;
    let own = piece.mapped(|unit| {
        let mut point = over(unit * scope.size - offset, part.size);
        point[axis] = point[axis].clamp(0.0, 1.0);
        point
    });
    Form {
        scope: part,
        geometry: Geometry::of(own, solid),
    }
}
