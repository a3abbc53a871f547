//! Places and directions from one frame to another.

use glam::{DMat3, DVec3};

use super::shape_attributes::pivot;
use super::state::State;
use super::tree::Node;
use super::value::Value;
use crate::shape::{degrees_of, turn};

/// `convert(from, to, pos | orient, [x, y, z])`, `convert(x | y | z, from, to, pos | orient, x, y,
/// z)`: a place (m) or a turn (degrees, about x, y and z) of one frame as it is in another. The
/// frames are `scope`, `pivot`, `object` (the scope of the start shape) and `world`.
pub fn convert(args: &[Value], state: &State, first: &Node) -> Result<Value, String> {
    let (one, rest) = match args.len() {
        4 => (None, args),
        7 => (Some(args[0].to_string()), &args[1..]),
        count => return Err(format!("4 or 7 arguments are needed, not {count}")),
    };
    let numbers = match (&rest[3], one.is_some()) {
        (Value::Array(array), false) => &array.values[..],
        _ => &rest[3..],
    };
    let given: Option<Vec<f64>> = numbers.iter().map(Value::number).collect();
    let Some([x, y, z]) = given.as_deref() else {
        return Err("three numbers are needed".into());
    };
    let given = DVec3::new(*x, *y, *z);
    let frame = |index: usize| frame_named(&rest[index].to_string(), state, first);
    let ((from, from_axes), (to, to_axes)) = (frame(0)?, frame(1)?);
    let found = match rest[2].to_string().as_str() {
        "pos" => to_axes.transpose() * (from + from_axes * given - to),
        "orient" => {
            let turned = from_axes * turn(given);
            degrees_of(to_axes.transpose() * turned)
        }
        other => return Err(format!("`{other}` is neither pos nor orient")),
    };
    match one.as_deref() {
        None => Ok(Value::list(found.to_array().map(Value::Number).to_vec())),
        Some("x") => Ok(Value::Number(found.x)),
        Some("y") => Ok(Value::Number(found.y)),
        Some("z") => Ok(Value::Number(found.z)),
        Some(other) => Err(format!("`{other}` is neither x, y nor z")),
    }
}

/// Origin and axes of a frame in the world.
pub fn frame_named(name: &str, state: &State, first: &Node) -> Result<(DVec3, DMat3), String> {
    let scope = &state.form.scope;
    let object = &first.state.form.scope;
    Ok(match name {
        "scope" => (scope.origin, scope.axes),
        "pivot" => pivot(state, first),
        "object" => (object.origin, object.axes),
        "world" => (DVec3::ZERO, DMat3::IDENTITY),
        other => {
            return Err(format!(
                "`{other}` is no frame: scope, pivot, object, world"
            ))
        }
    })
}
