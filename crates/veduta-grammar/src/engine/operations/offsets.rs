//! `offset`: faces with all their edges moved.

use veduta_geometry::solid::{inset_within, outset_within, Face, Mesh, Pieces};
use veduta_geometry::Budget;

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::standing::sheet_of;
use super::{number, word};
use crate::shape::{Form, Geometry};

/// `offset(distance)`, `offset(distance, all | inside | border)`: below zero the edges of each face
/// move inwards (m), above zero outwards. `inside` is the face that the moved edges bound,
/// `border` the strips between, one for each edge; `all` are both.
///
/// Other than in CityEngine, faces never lie on each other: of a face that grows, `all` is the
/// face as it was and the strips around it, and the strips look where the face does. Corners are
/// always mitred.
pub fn offset(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    run.record(None, &frame.state, op.span)?;
    let distance = number(run, op, 0, frame)?;
    let kept = match op.args.len() {
        1 => "all".into(),
        _ => word(run, op, 1, frame)?,
    };
    let mesh = sheet_of(&frame.state.form);
    if distance == 0.0 || mesh.is_empty() {
        return Ok(());
    }
    let mut moved = Mesh::new();
    for face in mesh.faces() {
        run.check_time(op.span)?;
        let told = |error| run.failed(op.span, format!("no offset here: {error}"));
        let found = face_moved(&mesh, face, distance, &kept, run.budget());
        moved.append(&found.map_err(told)?);
    }
    let scope = frame.state.form.scope;
    frame.state.form = if moved.is_empty() {
        Form {
            scope,
            geometry: Geometry::Nothing,
        }
    } else {
        Form::around(moved, scope.axes, false)
    };
    frame.changed();
    Ok(())
}

fn face_moved(
    mesh: &Mesh,
    face: Face<'_>,
    distance: f64,
    kept: &str,
    budget: &dyn Budget,
) -> Result<Mesh, veduta_geometry::skeleton::SkeletonError> {
    let edges: usize = face.rings().map(<[u32]>::len).sum();
    if distance < 0.0 {
        let found = inset_within(mesh, face, &vec![-distance; edges], budget)?;
        return Ok(pieces(found, kept));
    }
    let found = outset_within(mesh, face, &vec![distance; edges], budget)?;
    Ok(match kept {
        "inside" => found.grown,
        _ => pieces(found.pieces, kept),
    })
}

fn pieces(found: Pieces, kept: &str) -> Mesh {
    let wanted = |along: &Option<u32>| match kept {
        "inside" => along.is_none(),
        "border" => along.is_some(),
        _ => true,
    };
    let faces = found.along.iter().enumerate();
    let faces = faces
        .filter(|(_, along)| wanted(along))
        .map(|(face, _)| face);
    found.mesh.of_faces(faces)
}
