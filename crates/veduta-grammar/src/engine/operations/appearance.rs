//! What a shape looks like, and what it is.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::code::{Arg, Operation};
use super::super::colours::parsed;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::run::Run;
use super::super::state::Look;
use super::super::value::Value;
use super::{number, word};
use crate::suggest::{closest, did_you_mean};

/// What names of built-in textures begin with.
const BUILT_IN: &str = "builtin/textures/";

/// `NIL`: the shape is gone.
pub fn nothing(_: &mut Run<'_>, _: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    frame.consumed();
    Ok(())
}

/// `color("#rrggbb")`, `color(grey)`, `color(r, g, b)`, `color(r, g, b, opacity)`: 0 to 1.
pub fn colour(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    if op.args.len() == 1 {
        if let Arg::Value(_, expr) = &op.args[0] {
            if let Value::Text(text) = run.evaluate(expr, frame)? {
                let Some((colour, opacity)) = parsed(&text) else {
                    let message = format!("`{text}` is no colour: #rrggbb or #rrggbbaa");
                    return Err(Fault::at(expr.span, message));
                };
                let look = Arc::make_mut(&mut frame.state.look);
                look.colour = colour;
                look.opacity = opacity.unwrap_or(look.opacity);
                frame.changed();
                return Ok(());
            }
        }
    }
    let mut channels = [0.0f32; 4];
    for index in 0..op.args.len() {
        channels[index] = number(run, op, index, frame)?.clamp(0.0, 1.0) as f32;
    }
    let look = Arc::make_mut(&mut frame.state.look);
    match op.args.len() {
        1 => look.colour = [channels[0]; 3],
        2 => return Err(Fault::at(op.span, "a colour has 1, 3 or 4 numbers")),
        _ => look.colour = [channels[0], channels[1], channels[2]],
    }
    if op.args.len() == 4 {
        look.opacity = channels[3];
    }
    frame.changed();
    Ok(())
}

/// `texture(path)`; the empty string takes it away.
pub fn texture(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let path = word(run, op, 0, frame)?;
    let tile = tile_of(run, op, &path)?;
    let look = Arc::make_mut(&mut frame.state.look);
    look.texture = (!path.is_empty()).then_some(path);
    look.tile = tile;
    frame.changed();
    Ok(())
}

/// The size of a texture, where it is known; a fault where a built-in one is named that is not
/// there.
fn tile_of(run: &Run<'_>, op: &Operation, path: &str) -> Result<Option<[f64; 2]>, Fault> {
    let known = &run.options.textures;
    let found = known.get(path).copied();
    if found.is_some() || known.is_empty() || !path.starts_with(BUILT_IN) {
        return Ok(found);
    }
    let near = closest(path, known.keys().map(AsRef::as_ref));
    let hint = did_you_mean(near).map_or_else(String::new, |hint| format!(": {hint}"));
    let message = format!("`{path}` is no texture that is built in{hint}");
    Err(Fault::at(op.span, message))
}

/// `resetMaterial()`, `resetMaterial(shape | geometry | all)`: white and opaque without a texture,
/// as at first; what the surface is in the model stays.
pub fn reset_material(_: &mut Run<'_>, _: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let look = Arc::make_mut(&mut frame.state.look);
    let class = look.class.clone();
    *look = Look {
        class,
        ..Look::default()
    };
    frame.changed();
    Ok(())
}

/// `set(name, value)`: a material's property, an attribute of the rule file for this shape and its
/// children; `material.name` says what the surface is in the model.
pub fn set(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let Arg::Word(name) = &op.args[0] else {
        return Err(Fault::at(op.span, "the name of an attribute is needed"));
    };
    let Arg::Value(_, expr) = &op.args[1] else {
        return Err(Fault::at(op.span, "a value is needed"));
    };
    let value = run.evaluate(expr, frame)?;
    let attribute = run
        .code
        .globals
        .iter()
        .position(|global| global.name == *name);
    if matches!(value, Value::Number(number) if number.is_nan()) && attribute.is_none() {
        return Err(Fault::at(expr.span, "a number is needed, not NaN"));
    }
    let look = Arc::make_mut(&mut frame.state.look);
    let channel = value.number().unwrap_or_default().clamp(0.0, 1.0) as f32;
    match (name.as_ref(), attribute) {
        (_, Some(index)) => {
            let mut set = frame.state.set.take().map(Arc::unwrap_or_clone);
            set.get_or_insert_with(BTreeMap::new).insert(index, value);
            frame.state.set = set.map(Arc::new);
        }
        ("material.color.r", _) => look.colour[0] = channel,
        ("material.color.g", _) => look.colour[1] = channel,
        ("material.color.b", _) => look.colour[2] = channel,
        ("material.color.rgb", _) => {
            let text = value.to_string();
            let Some((colour, _)) = parsed(&text) else {
                return Err(Fault::at(
                    expr.span,
                    format!("`{text}` is no colour: #rrggbb"),
                ));
            };
            look.colour = colour;
        }
        ("material.color.a" | "material.opacity", _) => look.opacity = channel,
        ("material.colormap", _) => {
            let path = value.to_string();
            look.tile = tile_of(run, op, &path)?;
            look.texture = (!path.is_empty()).then(|| path.into());
        }
        ("trim.horizontal", _) => {
            frame.state.extra_mut().trims_level = value.truth().unwrap_or(false);
        }
        ("trim.vertical", _) => {
            frame.state.extra_mut().keeps_steep = !value.truth().unwrap_or(true);
        }
        ("material.name", _) => look.class = value.to_string().into(),
        (other, _) => {
            let message = format!("`{other}` is neither an attribute nor a property of materials");
            return Err(Fault::at(op.span, message));
        }
    }
    frame.changed();
    Ok(())
}
