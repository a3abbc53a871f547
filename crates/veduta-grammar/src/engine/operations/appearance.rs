//! What a shape looks like, and what it is.

use std::sync::Arc;

use super::super::code::{Arg, Operation};
use super::super::colours::parsed;
use super::super::fault::Fault;
use super::super::frame::Frame;
use super::super::materials;
use super::super::run::Run;
use super::super::state::Look;
use super::super::value::Value;
use super::{number, value, word};

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
    let tile = materials::tile_of(&run.options.textures, &path);
    let tile = tile.map_err(|message| Fault::at(op.span, message))?;
    let look = Arc::make_mut(&mut frame.state.look);
    look.texture = (!path.is_empty()).then_some(path);
    look.tile = tile;
    frame.changed();
    Ok(())
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

/// `setMaterial(array)`: properties of the material, each a name without `material.` and its
/// value after it.
pub fn set_material(run: &mut Run<'_>, op: &Operation, frame: &mut Frame) -> Result<(), Fault> {
    let given = value(run, op, 0, frame)?;
    let Value::Array(array) = &given else {
        let message = format!(
            "an array of names and values is needed, not {}",
            given.kind()
        );
        return Err(Fault::at(op.span, message));
    };
    let pairs = array.values.chunks_exact(2);
    if let [alone] = pairs.remainder() {
        let message = format!("`{alone}` has no value after it");
        return Err(Fault::at(op.span, message));
    }
    let look = Arc::make_mut(&mut frame.state.look);
    for pair in pairs {
        let name = format!("{}{}", materials::PREFIX, pair[0]);
        materials::set(look, &name, &pair[1], &run.options.textures)
            .map_err(|message| Fault::at(op.span, message))?;
    }
    frame.changed();
    Ok(())
}
