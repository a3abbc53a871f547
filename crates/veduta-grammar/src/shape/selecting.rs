//! Which components a word of a selector means.

use glam::DMat3;

use super::components::{direction, is_selected, Component};
use super::surroundings::{RoofEdge, Surroundings};

/// Slopes up to this are level, and from it to a right angle less of it are aslant (degrees).
const LEVEL: f64 = 11.25;

/// The frames that selectors are about.
#[derive(Debug, Clone, Copy)]
pub struct Frames {
    /// The axes of the shape that is taken apart.
    pub scope: DMat3,
    /// The axes of the start shape.
    pub object: DMat3,
}

/// Whether a word means a component; None where there is no such word. `around` gives what is
/// around the component; it is asked only where the word is about that.
pub fn is_meant(
    word: &str,
    component: &Component,
    frames: Frames,
    around: impl FnOnce() -> Surroundings,
) -> Option<bool> {
    let looks = component.direction.is_some();
    let in_frame = |name: &str, axes: DMat3| {
        is_selected(name, looks.then(|| direction(axes, component.normal)))
    };
    if let Some(name) = word
        .strip_prefix("object.")
        .or(word.strip_prefix("street."))
    {
        return in_frame(name, frames.object);
    }
    if let Some(name) = word.strip_prefix("world.") {
        let name = match name {
            "south" => "front",
            "north" => "back",
            "west" => "left",
            "east" => "right",
            "up" => "top",
            "down" => "bottom",
            "side" => "side",
            _ => return None,
        };
        return in_frame(name, DMat3::IDENTITY);
    }
    let up = component.normal.dot(frames.scope.y_axis);
    let slope = up.clamp(-1.0, 1.0).asin().to_degrees();
    Some(match word {
        "horizontal" => looks && slope.abs() > 90.0 - LEVEL,
        "side" => looks && slope.abs() <= 90.0 - LEVEL,
        "vertical" => looks && slope.abs() <= LEVEL,
        "aslant" => looks && slope > LEVEL && slope <= 90.0 - LEVEL,
        "nutant" => looks && (LEVEL - 90.0..-LEVEL).contains(&slope),
        "border" => around().border,
        "inside" => !around().border,
        "eave" => around().roof == Some(RoofEdge::Eave),
        "hip" => around().roof == Some(RoofEdge::Hip),
        "valley" => around().roof == Some(RoofEdge::Valley),
        "ridge" => around().roof == Some(RoofEdge::Ridge),
        other => return is_selected(other, component.direction),
    })
}

/// Whether a slope counts as that of a roof: neither level nor upright (`up` is the sine).
pub fn is_aslant(up: f64) -> bool {
    let slope = up.clamp(-1.0, 1.0).asin().to_degrees();
    slope > LEVEL && slope <= 90.0 - LEVEL
}
