//! `insertAlongUV`: an asset laid over faces along their texture coordinates.

use glam::DVec3;
use veduta_geometry::solid::{laid_together, patches, Mesh, Rise};

use super::super::code::Operation;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::limits::Limit;
use super::super::run::Run;
use super::assets::asset;
use super::textures::current;
use super::{number, word};
use crate::shape::{Form, Instance};

/// Where an asset without extent along x or z lies in its tile.
const MIDDLE: f64 = 0.5;
/// Cosine below which the height lies in a face.
const ALONG: f64 = 1e-9;

/// Each corner is bent, cut at the patch's edges and joined with those beside it.
const STEPS_PER_CORNER: usize = 16;

/// `insertAlongUV(layer, name, height)`, `insertAlongUV(layer, name, height, scope.y |
/// vertex.normal, alignPosition | keepPosition)`: the asset over the faces, once for each unit of
/// u and v, its x along u and its z against v. Its y comes to `height` (m), along the scope's y or
/// the normals of the points; its lowest place is on the faces, or, with `keepPosition`, its
/// origin. It is cut where the faces end.
pub fn insert(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let map = current(run, op, frame)?;
    let instance = Instance::new(asset(run, op, 1, frame)?, false);
    let height = number(run, op, 2, frame)?;
    let by_normals = op.args.len() > 3 && word(run, op, 3, frame)?.as_ref() == "vertex.normal";
    let keeps = op.args.len() > 4 && word(run, op, 4, frame)?.as_ref() == "keepPosition";
    let form = &frame.state.form;
    let (surface, axes) = (form.world_mesh(), form.scope.axes);
    let rise = match by_normals {
        true => Rise::Normals,
        false => Rise::Along(axes.y_axis),
    };
    let tile = tile(&instance, height, keeps);
    let solid = instance.is_solid();
    let found = patches(&surface, |place| map.at(place), rise)
        .map_err(|error| Fault::at(op.span, format!("nothing can be laid here: {error}")))?;
    check_room(run, op, &surface, rise, found.is_empty())?;
    let tiles: f64 = found
        .iter()
        .map(|patch| patch.tiles().1)
        .map(|[u, v]| u * v)
        .sum();
    let most = run.options.limits.faces as f64;
    let faces = tiles * tile.face_count() as f64;
    if faces.is_nan() || faces > most {
        let message = format!(
            "an asset of {} faces laid {tiles} times comes to more than {most} faces",
            tile.face_count()
        );
        return Err(Fault::over(Limit::Faces, op.span, message));
    }
    let mut parts = Vec::new();
    for patch in &found {
        let (first, count) = patch.tiles();
        for across in 0..count[1] as usize {
            run.check_time(op.span)?;
            for along in 0..count[0] as usize {
                let at = [first[0] + along as f64, first[1] + across as f64];
                run.take(STEPS_PER_CORNER * tile.corner_count(), op.span)?;
                let laid = patch.lay(&tile, solid, at);
                run.hold(laid.byte_count(), op.span)?;
                parts.push(laid);
            }
        }
    }
    let laid = laid_together(&parts, solid)
        .map_err(|error| Fault::at(op.span, format!("the asset cannot be bent so: {error}")))?;
    let solid = solid && laid.is_closed();
    frame.state.form = Form::around(laid, axes, solid);
    frame.changed();
    Ok(())
}

/// The asset as one tile: x and z from 0 to 1, y in metres above the faces.
fn tile(instance: &Instance, height: f64, keeps: bool) -> Mesh {
    let (low, size) = instance.bounds();
    let (stretch, below) = match (size.y > 0.0, keeps) {
        (true, true) => (height, low.y * height / size.y),
        (true, false) => (height, 0.0),
        (false, true) => (0.0, low.y),
        (false, false) => (0.0, 0.0),
    };
    let place = |unit: DVec3| {
        DVec3::new(
            if size.x > 0.0 { unit.x } else { MIDDLE },
            below + unit.y * stretch,
            if size.z > 0.0 { unit.z } else { MIDDLE },
        )
    };
    let laid = Mesh::clone(&instance.mesh()).mapped(place);
    if stretch < 0.0 {
        laid.reversed()
    } else {
        laid
    }
}

/// A fault where the texture has no extent on any face, or the height lies in all of them.
fn check_room(
    run: &Run<'_>,
    op: &Operation,
    surface: &Mesh,
    rise: Rise,
    is_empty: bool,
) -> Result<(), Fault> {
    run.check_time(op.span)?;
    let fault = |message: &str| Err(Fault::at(op.span, message));
    if is_empty {
        return fault("the texture coordinates of this layer have no extent on the shape");
    }
    if let Rise::Along(up) = rise {
        if surface
            .faces()
            .all(|face| face.normal().dot(up).abs() <= ALONG)
        {
            return fault(
                "scope.y lies in the face: turn the scope, or write `vertex.normal, alignPosition`",
            );
        }
    }
    Ok(())
}
