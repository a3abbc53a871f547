//! What expressions can ask of the current shape.

use glam::{DMat3, DVec3};

use super::materials;
use super::state::State;
use super::tree::Node;
use super::value::Value;
use crate::shape::degrees_of;

/// A shape attribute of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeAttribute {
    ScopeSize(usize),
    /// The place of the scope's origin from the pivot, in whose axes it is told.
    ScopePlace(usize),
    /// The turn of the scope about the pivot's axes, in degrees.
    ScopeTurn(usize),
    SplitIndex,
    SplitTotal,
    CompIndex,
    CompTotal,
    CompSelector,
    Material(&'static str),
    Seed,
    /// A number of the shape's own, which hangs on its way from the start shape alone.
    Own,
    Elevation,
    PivotPlace(usize),
    PivotTurn(usize),
    TrimLevel,
    TrimSteep,
    StartName,
    StartPlace(usize),
    StartTurn(usize),
}

/// All shape attributes by their names.
const TABLE: [(&str, ShapeAttribute); 33] = {
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
        ("seedian", A::Seed),
        ("uid", A::Own),
        ("scope.elevation", A::Elevation),
        ("pivot.px", A::PivotPlace(0)),
        ("pivot.py", A::PivotPlace(1)),
        ("pivot.pz", A::PivotPlace(2)),
        ("pivot.ox", A::PivotTurn(0)),
        ("pivot.oy", A::PivotTurn(1)),
        ("pivot.oz", A::PivotTurn(2)),
        ("trim.horizontal", A::TrimLevel),
        ("trim.vertical", A::TrimSteep),
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
        let found = found.map(|(_, attribute)| *attribute);
        found.or_else(|| {
            materials::names()
                .find(|known| *known == name)
                .map(Self::Material)
        })
    }

    /// All names of attributes that derive.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|entry| entry.0).chain(materials::names())
    }

    /// Whether it hangs on the pivot.
    pub fn tells_pivot(self) -> bool {
        matches!(
            self,
            Self::ScopePlace(_) | Self::ScopeTurn(_) | Self::PivotPlace(_) | Self::PivotTurn(_)
        )
    }

    /// The attribute of a shape now; `first` is the start shape, and `path` gives the way from it.
    pub fn of(self, state: &State, first: &Node, path: impl FnOnce() -> Vec<u32>) -> Value {
        let scope = &state.form.scope;
        let (origin, axes) = pivot(state, first);
        let object = &first.state.form.scope;
        match self {
            Self::ScopeSize(axis) => Value::Number(scope.size[axis]),
            Self::ScopePlace(axis) => {
                Value::Number((axes.transpose() * (scope.origin - origin))[axis])
            }
            Self::ScopeTurn(axis) => Value::Number(degrees_of(axes.transpose() * scope.axes)[axis]),
            Self::SplitIndex => Value::Number(state.split.index as f64),
            Self::SplitTotal => Value::Number(state.split.total as f64),
            Self::CompIndex => Value::Number(state.comp.index as f64),
            Self::CompTotal => Value::Number(state.comp.total as f64),
            Self::CompSelector => Value::Text(state.selector.clone()),
            Self::Material(name) => {
                materials::get(&state.look, name).unwrap_or_else(|| Value::text(""))
            }
            Self::Seed => Value::Number(state.seed),
            Self::Elevation => Value::Number(scope.origin.y),
            Self::Own => Value::Number(number_of(&path()) as f64),
            Self::PivotPlace(axis) => {
                Value::Number((object.axes.transpose() * (origin - object.origin))[axis])
            }
            Self::PivotTurn(axis) => {
                Value::Number(degrees_of(object.axes.transpose() * axes)[axis])
            }
            Self::TrimLevel => Value::Bool(state.extra.as_ref().is_some_and(|e| e.trims_level)),
            Self::TrimSteep => Value::Bool(!state.extra.as_ref().is_some_and(|e| e.keeps_steep)),
            Self::StartName => Value::Text(first.name.clone()),
            Self::StartPlace(axis) => Value::Number(object.origin[axis]),
            Self::StartTurn(axis) => Value::Number(degrees_of(object.axes)[axis]),
        }
    }
}

/// Origin and axes of a shape's pivot: of the start shape's scope, until the shape is taken apart or
/// `setPivot` moves it.
pub fn pivot(state: &State, first: &Node) -> (DVec3, DMat3) {
    let own = state.extra.as_ref().and_then(|extra| extra.pivot);
    let object = &first.state.form.scope;
    own.unwrap_or((object.origin, object.axes))
}

/// FNV-1a (Fowler, Noll, Vo) of a way through the tree: its upper 53 bits, which numbers can hold.
fn number_of(path: &[u32]) -> u64 {
    let bytes = path.iter().flat_map(|place| place.to_le_bytes());
    let whole = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    whole >> 11
}
