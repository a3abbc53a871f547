//! Where textures lie on a shape and on its children.
//!
//! Texture coordinates are linear functions of the place in the world ([`TextureMap`]), one for
//! each of ten layers. Children have those of their parent, and they go with a shape that moves.
//! A layer without one covers the scope of each shape from 0 to 1.

use glam::DVec3;

use super::super::code::{Arg, Operation, Sizing};
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::separate::{Normalized, Separate};
use super::super::texture_map::{layer, map_of, TextureMap};
use super::{axes, number, word};
use crate::shape::Scope;

/// `setupProjection(layer, scope.xy, width, height)`, with `, x, y` after it, and with `, x, y,
/// depth`: the texture is to lie along two axes of the scope, or of the world (`world.xz`), each
/// tile of this size (m; `'` takes it of the shape, `~` makes whole tiles; below zero it is
/// mirrored), its corner x and y metres from the origin. `depth` is how much u also grows along
/// the third axis. [`project`] puts it on the shape or its children.
pub fn set_up(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let layer = layer_at(run, op, 0, frame)?;
    let name = word(run, op, 1, frame)?;
    let scope = frame.state.form.scope;
    let (along, origin, named) = match name.split_once('.') {
        Some(("scope", named)) => (scope.axes, scope.origin, named),
        Some(("world", named)) => (glam::DMat3::IDENTITY, DVec3::ZERO, named),
        _ => {
            return Err(Fault::at(
                op.span,
                format!("`{name}` are no axes: scope.xy, world.xz, ..."),
            ))
        }
    };
    let [u, v] = axes(op, named)?[..] else {
        return Err(Fault::at(op.span, format!("`{name}` are not two axes")));
    };
    let mut grow = [DVec3::ZERO; 2];
    let mut moved = [0.0; 2];
    for (place, axis) in [u, v].into_iter().enumerate() {
        let direction = along.col(axis);
        let extent = extent(frame, direction);
        let size = match tile(run, op, 2 + place, extent, frame)? {
            size if size == 0.0 && extent == 0.0 => 1.0, // flat along this axis
            size => size,
        };
        if size == 0.0 {
            return Err(Fault::at(op.span, "a texture of 0 m"));
        }
        grow[place] = direction / size;
        if op.args.len() > 4 + place {
            moved[place] = -number(run, op, 4 + place, frame)? / size;
        }
    }
    if op.args.len() == 7 {
        let depth = number(run, op, 6, frame)?;
        grow[0] += along.col(3 - u - v) * (grow[0].dot(along.col(u)) * depth);
    }
    let map = TextureMap::from(origin, grow).changed([1.0; 2], moved);
    frame.state.extra_mut().projections[layer] = Some(map);
    frame.changed();
    Ok(())
}

/// `projectUV(layer)`: the texture lies as `setupProjection` of the shape or a parent has said; over
/// the scope's x and y where none has.
pub fn project(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let layer = layer_at(run, op, 0, frame)?;
    let extra = frame.state.extra.as_ref();
    let known = extra.and_then(|extra| extra.projections[layer]);
    let map = known.unwrap_or_else(|| over_scope(&frame.state.form.scope));
    set(frame, layer, map);
    Ok(())
}

/// What lies where nothing was set up: one picture over the scope's x and y.
fn over_scope(scope: &Scope) -> TextureMap {
    let over = |axis: usize| match scope.size[axis] {
        size if size > 0.0 => scope.axes.col(axis) / size,
        _ => scope.axes.col(axis),
    };
    TextureMap::from(scope.origin, [over(0), over(1)])
}

/// `translateUV(layer, u, v)`: adds to the coordinates.
pub fn translate(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let by = [number(run, op, 1, frame)?, number(run, op, 2, frame)?];
    scale_and_move(run, op, frame, [1.0; 2], by)
}

/// `scaleUV(layer, u, v)`: multiplies the coordinates.
pub fn scale(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let by = [number(run, op, 1, frame)?, number(run, op, 2, frame)?];
    scale_and_move(run, op, frame, by, [0.0; 2])
}

/// `rotateUV(layer, angle)`: turns the coordinates about (0, 0) (degrees).
pub fn rotate(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let angle = number(run, op, 1, frame)?;
    change(
        run,
        op,
        frame,
        |map| map.turned(angle),
        |own| own.turned(angle),
    )
}

/// `tileUV(layer, width, height)`: tiles of this size on the surface (m; `'` takes it of the
/// surface, `~` makes whole tiles; 0 leaves the direction as it is).
pub fn tile_uv(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let map = current(run, op, frame)?;
    let mesh = frame.state.form.world_mesh();
    let mut by = [1.0; 2];
    for axis in 0..2 {
        let stretch = map.stretch(axis, &mesh);
        let (low, high) = map.range(axis, &mesh.points);
        let size = tile(run, op, 1 + axis, (high - low) * stretch, frame)?;
        if size != 0.0 && stretch > 0.0 {
            by[axis] = stretch / size;
        }
    }
    scale_and_move(run, op, frame, by, [0.0; 2])
}

/// `normalizeUV(layer, uv | uvUniform | u | v, separatePerFace | collectiveAllFaces)`: the coordinates of
/// the shape, or of each of its faces, from 0 to 1; `uvUniform` multiplies both by the same.
pub fn normalize(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let map = current(run, op, frame)?;
    let how = Normalized::named(&word(run, op, 1, frame)?);
    let apart = word(run, op, 2, frame)?.as_ref() == "separatePerFace";
    let layer = layer_at(run, op, 0, frame)?;
    let mesh = frame.state.form.world_mesh();
    set(frame, layer, how.of(&map, &mesh.points));
    if apart && mesh.face_count() > 1 {
        frame.state.extra_mut().separate[layer] = Some(Separate::of(map, how));
    }
    Ok(())
}

/// `deleteUV(layer)`: the texture covers the scope of each shape again.
pub fn delete(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let layer = layer_at(run, op, 0, frame)?;
    let extra = frame.state.extra_mut();
    extra.maps[layer] = None;
    extra.separate[layer] = None;
    frame.changed();
    Ok(())
}

/// `copyUV(from, to)`
pub fn copy(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let map = current(run, op, frame)?;
    let (from, to) = (layer_at(run, op, 0, frame)?, layer_at(run, op, 1, frame)?);
    let extra = frame.state.extra.as_ref();
    let own = extra.and_then(|extra| extra.separate[from]);
    set(frame, to, map);
    frame.state.extra_mut().separate[to] = own;
    Ok(())
}

/// `bakeUV(layer)`: the texture stays where it lies now on the shape and on all children, where it
/// would else cover the scope of each.
pub fn bake(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let map = current(run, op, frame)?;
    let layer = layer_at(run, op, 0, frame)?;
    set(frame, layer, map);
    Ok(())
}

fn set(frame: &mut Frame, layer: usize, map: TextureMap) {
    let extra = frame.state.extra_mut();
    extra.maps[layer] = Some(map);
    extra.separate[layer] = None;
    frame.changed();
}

/// Changes the map of the layer that the first argument names, and that of each face where they have
/// their own.
fn change(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    change: impl FnOnce(TextureMap) -> TextureMap,
    of_faces: impl FnOnce(Separate) -> Separate,
) -> Result<(), Fault> {
    let map = change(current(run, op, frame)?);
    let layer = layer_at(run, op, 0, frame)?;
    let extra = frame.state.extra.as_ref();
    let own = extra.and_then(|extra| extra.separate[layer]).map(of_faces);
    set(frame, layer, map);
    if own.is_some() {
        frame.state.extra_mut().separate[layer] = own;
    }
    Ok(())
}

/// Multiplies the coordinates, then adds to them.
fn scale_and_move(
    run: &mut Run<'_>,
    op: &Operation,
    frame: &mut Frame,
    by: [f64; 2],
    shift: [f64; 2],
) -> Result<(), Fault> {
    change(
        run,
        op,
        frame,
        |map| map.changed(by, shift),
        |own| own.changed(by, shift),
    )
}

/// The map of the layer that the first argument names.
pub fn current(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<TextureMap, Fault> {
    let layer = number(run, op, 0, frame)?;
    map_of(&frame.state, layer).map_err(|message| Fault::at(op.span, message))
}

fn layer_at(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    frame: &mut Frame,
) -> Result<usize, Fault> {
    let given = number(run, op, index, frame)?;
    layer(given).map_err(|message| Fault::at(op.span, message))
}

/// The size of a tile: metres, a share of the extent, or so that whole tiles fill it.
fn tile(
    run: &mut Run<'_>,
    op: &Operation,
    index: usize,
    extent: f64,
    frame: &mut Frame,
) -> Result<f64, Fault> {
    let Arg::Value(sizing, expr) = &op.args[index] else {
        return Err(Fault::at(op.span, "the size of a tile is needed"));
    };
    let size = run.evaluate_finite(expr, frame)?;
    let size = match sizing {
        Sizing::Absolute => size,
        Sizing::Relative => size * extent,
        Sizing::Floating | Sizing::FloatingRelative => {
            let wanted = match sizing {
                Sizing::Floating => size,
                _ => size * extent,
            };
            let tiles = (extent / wanted.abs()).round().max(1.0);
            extent / tiles * wanted.signum()
        }
    };
    if size.is_finite() {
        Ok(size)
    } else {
        Err(Fault::at(expr.span, format!("a tile of {size} m")))
    }
}

/// The extent of the shape along a direction (m).
fn extent(frame: &Frame, direction: DVec3) -> f64 {
    let points = frame.state.form.world_mesh().points;
    let places = points.iter().map(|point| point.dot(direction));
    let (low, high) = ends(places);
    high - low
}

/// The least and the greatest; 0 and 0 of nothing.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if low <= high {
        (low, high)
    } else {
        (0.0, 0.0)
    }
}
