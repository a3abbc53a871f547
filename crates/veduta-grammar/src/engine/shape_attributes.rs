//! What expressions can ask of the current shape.

use std::f64::consts::PI;

use glam::EulerRot;

use super::state::State;
use super::value::Value;

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
    Texture,
    Seed,
}

/// All shape attributes by their names.
const TABLE: [(&str, ShapeAttribute); 21] = {
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
        ("material.color.a", A::Opacity),
        ("material.opacity", A::Opacity),
        ("material.colormap", A::Texture),
        ("seedian", A::Seed),
    ]
};

impl ShapeAttribute {
    pub fn named(name: &str) -> Option<Self> {
        let found = TABLE.iter().find(|(known, _)| *known == name);
        found.map(|(_, attribute)| *attribute)
    }

    /// The attribute of a shape now.
    pub fn of(self, state: &State) -> Value {
        let scope = &state.form.scope;
        match self {
            Self::ScopeSize(axis) => Value::Number(scope.size[axis]),
            Self::ScopePlace(axis) => Value::Number(scope.origin[axis]),
            Self::ScopeTurn(axis) => {
                let (x, y, z) = scope.axes.to_euler(EulerRot::XYZ);
                Value::Number([x, y, z][axis] * 180.0 / PI)
            }
            Self::SplitIndex => Value::Number(state.split.index as f64),
            Self::SplitTotal => Value::Number(state.split.total as f64),
            Self::CompIndex => Value::Number(state.comp.index as f64),
            Self::CompTotal => Value::Number(state.comp.total as f64),
            Self::CompSelector => Value::Text(state.selector.clone()),
            Self::Colour(channel) => Value::Number(f64::from(state.look.colour[channel])),
            Self::Opacity => Value::Number(f64::from(state.look.opacity)),
            Self::Texture => match &state.look.texture {
                Some(path) => Value::Text(path.clone()),
                None => Value::text(""),
            },
            Self::Seed => Value::Number(state.seed as f64),
        }
    }
}
