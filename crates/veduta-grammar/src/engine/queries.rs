//! Questions about other shapes: what stands in the way, how far a labelled shape is, how many
//! there are.
//!
//! The first pass of a derivation answers that there is nothing, the second asks about the shapes
//! that the first made: closed leaves, closed shapes that `comp`, `offset` or a setback was applied
//! to, and those that `label` names.

use std::sync::Arc;

use glam::DVec3;
use veduta_geometry::solid::{relation, Relation};

use crate::shape::{box_distance, Scope};
use crate::Span;

use super::converting::convert;
use super::fault::Fault;
use super::materials;
use super::occluders::{Around, Neighbour, Occluder};
use super::run::Run;
use super::state::State;
use super::value::{Array, Value};

/// A question about other shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Query {
    /// `inside()`, `inside(intra | inter | all)`, `inside(target, label)`: whether the shape lies in
    /// or on one closed shape.
    Inside,
    /// Whether a part of it does, or a part of the other in it.
    Overlaps,
    /// Whether it overlaps, or faces lie on faces.
    Touches,
    /// `minimumDistance(target, label)`: from scope to scope (m).
    Distance,
    /// `contextCount(target, label)`
    Count,
    /// `getTreeKey()`: the way from the start shape to the rule's shape, as a list.
    TreeKey,
    /// `contextCompare(target, label, world.highest | area.largest | ...)`: how many come before it.
    Rank,
    /// `assetInfo(name, sx | sy | sz | tx | ty | tz)`: size and lowest place of an asset (m).
    AssetInfo,
    /// `assetNamingInfo(name, g | m)`: the names of an asset's groups or materials, as a list in a
    /// string or, `true`, as an array.
    Naming(bool),
    /// `convert(...)`: see [`convert`].
    Convert,
    /// `edgeAttr.getFloat(name)` and its like: what an attribute of edges says of the start shape's edge
    /// that the shape stands for.
    Edge(EdgeKind),
    /// `getGeoCoord(x | y | lon | lat)`: where the scope's origin lies on Earth.
    Geographic,
    /// `getMaterial(used | shape | geometry, changed | all)`: names and values, a row of each.
    Material,
}

/// What an attribute of edges is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    Number,
    Text,
    Bool,
}

const TABLE: &[(&str, Query)] = &[
    ("assetInfo", Query::AssetInfo),
    ("assetNamingInfo", Query::Naming(false)),
    ("assetNamingInfos", Query::Naming(true)),
    ("contextCompare", Query::Rank),
    ("contextCount", Query::Count),
    ("convert", Query::Convert),
    ("edgeAttr.getBool", Query::Edge(EdgeKind::Bool)),
    ("edgeAttr.getFloat", Query::Edge(EdgeKind::Number)),
    ("edgeAttr.getString", Query::Edge(EdgeKind::Text)),
    ("getGeoCoord", Query::Geographic),
    ("getMaterial", Query::Material),
    ("getTreeKey", Query::TreeKey),
    ("inside", Query::Inside),
    ("minimumDistance", Query::Distance),
    ("overlaps", Query::Overlaps),
    ("touches", Query::Touches),
];

/// Shares of a surface up to this are rounding.
const NOTHING: f64 = 1e-9;

impl Query {
    pub fn named(name: &str) -> Option<Self> {
        let found = TABLE.iter().find(|entry| entry.0 == name);
        found.map(|entry| entry.1)
    }

    /// The names of all questions.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|entry| entry.0)
    }

    /// Whether the answer has to do with other shapes.
    pub fn is_about_others(self) -> bool {
        matches!(
            self,
            Self::Inside
                | Self::Overlaps
                | Self::Touches
                | Self::Distance
                | Self::Count
                | Self::Rank
        )
    }

    /// The answer where there is nothing.
    fn nothing(self) -> Value {
        match self {
            Self::Inside | Self::Overlaps | Self::Touches => Value::Bool(false),
            Self::Distance => Value::Number(f64::INFINITY),
            Self::Count | Self::Rank => Value::Number(0.0),
            Self::TreeKey => Value::text("0;"),
            _ => Value::list(Vec::new()),
        }
    }

    fn holds(self, found: &Relation, closed: bool) -> bool {
        let [within, beyond, same, opposite] = found.first;
        let overlaps = within > NOTHING || closed && (found.second[0] > NOTHING || same > NOTHING);
        match self {
            Self::Inside => beyond <= NOTHING,
            Self::Overlaps => overlaps,
            _ => overlaps || same > NOTHING || opposite > NOTHING,
        }
    }
}

/// Which shapes a question is about.
struct Wanted {
    target: String,
    label: String,
}

impl Wanted {
    /// Whether it has the label that is asked for, if any.
    fn has(&self, one: &Around<'_>) -> bool {
        self.label.is_empty() || one.shape.label.as_deref() == Some(&self.label)
    }
}

impl Run<'_> {
    /// The answer to a question about the current shape, or about the shapes around it.
    pub(super) fn answer(
        &self,
        query: Query,
        args: &[Value],
        state: &State,
        span: Span,
    ) -> Result<Value, Fault> {
        match query {
            Query::TreeKey => Ok(self.tree_key()),
            Query::AssetInfo => self.asset_info(args, span),
            Query::Edge(kind) => Ok(self.of_edge(kind, args, state)),
            Query::Geographic => Ok(self.geographic(args, state)),
            Query::Naming(as_array) => self.asset_names(args, as_array, span),
            Query::Convert => {
                convert(args, state, self.first()).map_err(|message| Fault::at(span, message))
            }
            Query::Material => Ok(material(args, state)),
            _ if self.recorded.is_some() => Ok(query.nothing()),
            Query::Inside | Query::Overlaps | Query::Touches => {
                let wanted = self.wanted(args, span)?;
                self.occluded(query, &wanted, state, span)
            }
            Query::Distance | Query::Count | Query::Rank => {
                let wanted = self.wanted(args, span)?;
                if wanted.label.is_empty() {
                    return Ok(query.nothing());
                }
                let all = self.among(&wanted, |_| true, |_| true);
                Ok(Value::Number(match query {
                    Query::Distance => nearest(all, &state.form.scope),
                    Query::Rank => before(all, &argument(args, 2, span)?, state, span)? as f64,
                    _ => all.count() as f64,
                }))
            }
        }
    }

    /// Which shapes are asked for, and the work of looking at each.
    fn wanted(&self, args: &[Value], span: Span) -> Result<Wanted, Fault> {
        let (target, label) = (argument(args, 0, span)?, argument(args, 1, span)?);
        let others = self.options.neighbours.iter().map(Neighbour::count);
        self.take(self.around.len() + others.sum::<usize>(), span)?;
        Ok(Wanted { target, label })
    }

    /// The shapes that are asked for: of the derivation's own, and of its neighbours.
    fn among<'o>(
        &'o self,
        wanted: &'o Wanted,
        own: impl Fn(&Occluder) -> bool + 'o,
        beside: impl Fn(&Neighbour) -> bool + 'o,
    ) -> impl Iterator<Item = Around<'o>> {
        let (has_own, has_others) = (wanted.target != "inter", wanted.target != "intra");
        let shapes = self.around.iter();
        let shapes = shapes.filter(move |one| has_own && own(one));
        let others = self.options.neighbours.iter();
        let others = others.filter(move |one| has_others && beside(one));
        let all = shapes.map(Around::from);
        all.chain(others.flat_map(Neighbour::around))
            .filter(|one| wanted.has(one))
    }

    fn tree_key(&self) -> Value {
        let path = self.tree.path(self.at);
        let all = path.iter().map(|place| format!("{place};"));
        Value::text(&format!("0;{}", all.collect::<String>()))
    }

    /// The shapes that `label` gave this name in the first pass of this derivation, and in those of its
    /// neighbours, but those that the current shape came from.
    pub(super) fn labelled<'o>(&'o self, label: &'o str) -> impl Iterator<Item = Around<'o>> {
        let own = self.around.iter().filter(|one| !self.came_from(one));
        let others = self.options.neighbours.iter().flat_map(Neighbour::around);
        own.map(Around::from)
            .chain(others)
            .filter(move |one| one.shape.label.as_deref() == Some(label))
    }

    /// Whether one of the closed shapes that are asked for lies as the question says.
    fn occluded(
        &self,
        query: Query,
        wanted: &Wanted,
        state: &State,
        span: Span,
    ) -> Result<Value, Fault> {
        let mesh = state.form.world_mesh();
        let Some((low, high)) = mesh.bounds().filter(|_| !mesh.is_empty()) else {
            return Ok(query.nothing());
        };
        let near = NOTHING * low.distance(high);
        let closed = state.form.geometry.is_solid();
        let occluders = self.among(
            wanted,
            |one| !self.is_kin(one),
            |one| one.reaches(low, high, near),
        );
        for one in occluders.filter(|one| one.shape.closed) {
            if low.cmpgt(one.high() + near).any() || one.low().cmpgt(high + near).any() {
                continue;
            }
            self.check_time(span)?;
            let found = if one.offset == DVec3::ZERO {
                relation(&mesh, &one.shape.mesh, self.budget())
            } else {
                let moved = mesh.clone().mapped(|point| point - one.offset);
                relation(&moved, &one.shape.mesh, self.budget())
            };
            let found = found.map_err(|error| self.failed(span, error))?;
            if query.holds(&found, closed) {
                return Ok(Value::Bool(true));
            }
        }
        Ok(Value::Bool(false))
    }
}

/// An argument as text; empty where it is not given.
fn argument(args: &[Value], index: usize, span: Span) -> Result<String, Fault> {
    let text = args.get(index).map_or(Ok(String::new()), Value::written);
    text.map_err(|why| Fault::at(span, why))
}

fn material(args: &[Value], state: &State) -> Value {
    let wanted = args.get(1).map(ToString::to_string);
    let pairs = materials::pairs(&state.look, wanted.as_deref() == Some("all"));
    let values = pairs.iter().flatten().map(|text| Value::text(text));
    Value::Array(Arc::new(Array::new(2, values.collect())))
}

/// How far the nearest scope is (m); infinite where there is none.
fn nearest<'o>(all: impl Iterator<Item = Around<'o>>, scope: &Scope) -> f64 {
    let far = all.map(|one| {
        let mut scope = *scope;
        scope.origin -= one.offset;
        box_distance(&scope, &one.shape.scope)
    });
    far.fold(f64::INFINITY, f64::min)
}

/// How many come before the current shape in this order.
fn before<'o>(
    all: impl Iterator<Item = Around<'o>>,
    order: &str,
    state: &State,
    span: Span,
) -> Result<usize, Fault> {
    let mesh = state.form.world_mesh();
    let (low, high) = mesh.bounds().unwrap_or_default();
    let here = ordered(order, low, high, || mesh.area());
    let here = here.ok_or_else(|| {
        let told = format!("`{order}` is no order: world.highest, area.largest, ...");
        Fault::at(span, told)
    })?;
    let first = all.filter(|one| {
        let area = || one.shape.mesh.area();
        let there = ordered(order, one.low(), one.high(), area);
        there.is_some_and(|there| there > here + NOTHING * here.abs())
    });
    Ok(first.count())
}

/// What shapes are ordered by, the first having the most of it; None of an unknown word.
fn ordered(order: &str, low: DVec3, high: DVec3, area: impl FnOnce() -> f64) -> Option<f64> {
    Some(match order {
        "world.northernmost" => -low.z,
        "world.southernmost" => high.z,
        "world.easternmost" => high.x,
        "world.westernmost" => -low.x,
        "world.highest" => high.y,
        "world.lowest" => -low.y,
        "area.largest" => area(),
        "area.smallest" => -area(),
        _ => return None,
    })
}
