//! What expressions can ask of the current shape.

use std::f64::consts::PI;

use glam::EulerRot;

use super::state::State;
use super::tree::Node;
use super::value::Value;
use crate::shape::Scope;

/// A shape attribute of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeAttribute {
    ScopeSize(usize),
    /// The place of the scope's origin, in the world.
    ScopePlace(usize),
    /// The turn of the scope about the world's axes, in degrees.
    ScopeTurn(usize),
    SplitIndex,
    SplitTotal,
    CompIndex,
    CompTotal,
    CompSelector,
    Colour(usize),
    Opacity,
    ColourText,
    MaterialName,
    Texture,
    Seed,
    Elevation,
    /// The pivot is the world: scopes have their places in it.
    Pivot,
    StartName,
    StartPlace(usize),
    StartTurn(usize),
}

/// All shape attributes by their names.
const TABLE: [(&str, ShapeAttribute); 37] = {
    use ShapeAttribute as A;
    [
        ("scope.sx", A::ScopeSize(0)),
        ("scope.sy", A::ScopeSize(1)),
        ("scope.sz", A::ScopeSize(2)),
        ("scope.tx", A::ScopePlace(0)),
        ("scope.ty", A::ScopePlace(1)),
        ("scope.tz", A::ScopePlace(2)),
        ("scope.rx", A::ScopeTurn(0)),
        ("scope.ry", A::ScopeTurn(1)),
        ("scope.rz", A::ScopeTurn(2)),
        ("split.index", A::SplitIndex),
        ("split.total", A::SplitTotal),
        ("comp.index", A::CompIndex),
        ("comp.total", A::CompTotal),
        ("comp.sel", A::CompSelector),
        ("material.color.r", A::Colour(0)),
        ("material.color.g", A::Colour(1)),
        ("material.color.b", A::Colour(2)),
        ("material.opacity", A::Opacity),
        ("material.colormap", A::Texture),
        ("material.color.rgb", A::ColourText),
        ("material.name", A::MaterialName),
        ("seedian", A::Seed),
        ("scope.elevation", A::Elevation),
        ("pivot.px", A::Pivot),
        ("pivot.py", A::Pivot),
        ("pivot.pz", A::Pivot),
        ("pivot.ox", A::Pivot),
        ("pivot.oy", A::Pivot),
        ("pivot.oz", A::Pivot),
        ("initialShape.name", A::StartName),
        ("initialShape.startRule", A::StartName),
        ("initialShape.origin.px", A::StartPlace(0)),
        ("initialShape.origin.py", A::StartPlace(1)),
        ("initialShape.origin.pz", A::StartPlace(2)),
        ("initialShape.origin.ox", A::StartTurn(0)),
        ("initialShape.origin.oy", A::StartTurn(1)),
        ("initialShape.origin.oz", A::StartTurn(2)),
    ]
};

impl ShapeAttribute {
    pub fn named(name: &str) -> Option<Self> {
        let found = TABLE.iter().find(|(known, _)| *known == name);
        found.map(|(_, attribute)| *attribute)
    }

    /// All names of attributes that derive.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|entry| entry.0)
    }

    /// The attribute of a shape now; `first` is the start shape.
    pub fn of(self, state: &State, first: &Node) -> Value {
        let scope = &state.form.scope;
        match self {
            Self::ScopeSize(axis) => Value::Number(scope.size[axis]),
            Self::ScopePlace(axis) => Value::Number(scope.origin[axis]),
            Self::ScopeTurn(axis) => Value::Number(turn(scope, axis)),
            Self::SplitIndex => Value::Number(state.split.index as f64),
            Self::SplitTotal => Value::Number(state.split.total as f64),
            Self::CompIndex => Value::Number(state.comp.index as f64),
            Self::CompTotal => Value::Number(state.comp.total as f64),
            Self::CompSelector => Value::Text(state.selector.clone()),
            Self::Colour(channel) => Value::Number(f64::from(state.look.colour[channel])),
            Self::Opacity => Value::Number(f64::from(state.look.opacity)),
            Self::ColourText => {
                let [r, g, b] = state.look.colour.map(|c| (c * 255.0).round() as u8);
                Value::text(&format!("#{r:02x}{g:02x}{b:02x}"))
            }
            Self::MaterialName => Value::Text(state.look.class.clone()),
            Self::Texture => match &state.look.texture {
                Some(path) => Value::Text(path.clone()),
                None => Value::text(""),
            },
            Self::Seed => Value::Number(f64::from(state.seed)),
            Self::Elevation => Value::Number(scope.origin.y),
            Self::Pivot => Value::Number(0.0),
            Self::StartName => Value::Text(first.name.clone()),
            Self::StartPlace(axis) => Value::Number(first.state.form.scope.origin[axis]),
            Self::StartTurn(axis) => Value::Number(turn(&first.state.form.scope, axis)),
        }
    }
}

/// The turn of a scope about an axis of the world (degrees).
fn turn(scope: &Scope, axis: usize) -> f64 {
    let (x, y, z) = scope.axes.to_euler(EulerRot::XYZ);
    [x, y, z][axis] * 180.0 / PI
}
