//! Attributes of the edges of the start shape, and which edge another shape stands for.
//!
//! The caller gives an array for each name, `/edgeattr/NAME`, with an element for each edge of the
//! start shape: face by face, ring by ring, in the order of their corners.

use glam::{DVec2, DVec3};
use veduta_geometry::solid::Mesh;

use crate::shape::Form;

use super::marks::Tags;
use super::queries::EdgeKind;
use super::run::Run;
use super::state::State;
use super::value::Value;

/// What the names of attributes of edges begin with.
pub const PREFIX: &str = "/edgeattr/";
/// The attribute of edges that says how wide the street before each is; 0 where there is none.
const STREET: &str = "/edgeattr/streetWidth";
/// Shares of the start shape's extent up to this are rounding.
const NOTHING: f64 = 1e-6;

/// An edge of the outline, in the plane of the start shape.
struct Edge {
    from: DVec2,
    to: DVec2,
    outward: DVec2,
}

/// The plane of the start shape, and its edges in it.
struct Outline {
    axes: (DVec3, DVec3),
    edges: Vec<Edge>,
    extent: f64,
}

impl Outline {
    fn of(start: &Mesh) -> Option<Self> {
        let up: DVec3 = start.faces().map(|face| face.area_vector()).sum();
        let up = up.try_normalize()?;
        let u = up.any_orthonormal_vector();
        let axes = (u, up.cross(u));
        let flat = |point: u32| flat(axes, start.points[point as usize]);
        let mut edges = Vec::new();
        for face in start.faces() {
            for ring in face.rings() {
                for (at, &from) in ring.iter().enumerate() {
                    let (from, to) = (flat(from), flat(ring[(at + 1) % ring.len()]));
                    edges.push(Edge {
                        from,
                        to,
                        outward: -(to - from).perp().normalize_or_zero(),
                    });
                }
            }
        }
        let (low, high) = start.bounds()?;
        Some(Self {
            axes,
            edges,
            extent: low.distance(high),
        })
    }

    /// The edge that the projection of a shape along where it looks covers most; of several the
    /// nearest. A shape that looks along the plane's normal stands for the edge nearest to it.
    fn edge_of(&self, form: &Form) -> Option<usize> {
        let mesh = form.world_mesh();
        // Edges have no mesh: they lie along their scope.
        let scope = &form.scope;
        let ends = [0.0, scope.size.x].map(|x| scope.origin + scope.axes.x_axis * x);
        let points = match mesh.points[..] {
            [] => &ends[..],
            _ => &mesh.points,
        };
        let points: Vec<DVec2> = points.iter().map(|&p| flat(self.axes, p)).collect();
        let middle = points.iter().sum::<DVec2>() / points.len().max(1) as f64;
        let looks: DVec3 = mesh.faces().map(|face| face.area_vector()).sum();
        let looks = looks.try_normalize().unwrap_or(form.scope.axes.z_axis);
        let along = flat(self.axes, looks);
        if along.length() < 0.1 {
            return self.least(|edge| distance(edge, middle));
        }
        let along = along.normalize();
        let across = along.perp();
        let ends = points.iter().map(|point| point.dot(across));
        let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
            (low.min(at), high.max(at))
        });
        let near = NOTHING * self.extent;
        let covered = |edge: &Edge| {
            let (a, b) = (edge.from.dot(across), edge.to.dot(across));
            let overlap = high.min(a.max(b)) - low.max(a.min(b));
            match high - low <= near {
                true if overlap >= -near => 1.0,
                true => 0.0,
                false => overlap.max(0.0),
            }
        };
        let facing = |edge: &Edge| edge.outward.dot(along);
        let faces = self.edges.iter().filter(|edge| facing(edge) > NOTHING);
        let most = faces.map(covered).fold(0.0, f64::max);
        if most <= 0.0 {
            return self.least(|edge| distance(edge, middle) - facing(edge) * self.extent);
        }
        self.least(|edge| match facing(edge) > NOTHING {
            true if covered(edge) >= most * (1.0 - 1e-3) => distance(edge, middle),
            _ => f64::INFINITY,
        })
    }

    fn least(&self, of: impl Fn(&Edge) -> f64) -> Option<usize> {
        let each = self.edges.iter().enumerate();
        let best = each.min_by(|(_, a), (_, b)| of(a).total_cmp(&of(b)));
        best.map(|(number, _)| number)
    }
}

fn flat((u, v): (DVec3, DVec3), point: DVec3) -> DVec2 {
    DVec2::new(point.dot(u), point.dot(v))
}

/// From a point to the nearest place of an edge.
fn distance(edge: &Edge, point: DVec2) -> f64 {
    let along = edge.to - edge.from;
    let share = (point - edge.from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    (edge.from + along * share.clamp(0.0, 1.0)).distance(point)
}

impl Run<'_> {
    /// The element of an attribute of edges for a shape; None where there is none.
    pub(super) fn edge_value(&self, name: &str, form: &Form) -> Option<Value> {
        let Value::Array(array) = self.options.attributes.get(name)? else {
            return None;
        };
        let outline = Outline::of(&self.first().state.form.world_mesh())?;
        if array.values.len() != outline.edges.len() {
            return None;
        }
        array.values.get(outline.edge_of(form)?).cloned()
    }

    /// `edgeAttr.getFloat(name)` and its like; what such a value is at first where there is none.
    pub(super) fn of_edge(&self, kind: EdgeKind, args: &[Value], state: &State) -> Value {
        let name = format!("{PREFIX}{}", args[0]);
        match (kind, self.edge_value(&name, &state.form)) {
            (EdgeKind::Number, Some(Value::Number(number))) => Value::Number(number),
            (EdgeKind::Text, Some(Value::Text(text))) => Value::Text(text),
            (EdgeKind::Bool, Some(Value::Bool(is))) => Value::Bool(is),
            (EdgeKind::Number, _) => Value::Number(0.0),
            (EdgeKind::Text, _) => Value::text(""),
            (EdgeKind::Bool, _) => Value::Bool(false),
        }
    }

    /// The tags that a shape has by texts of edges, after `setTagsFromEdgeAttrs`.
    pub(super) fn edge_tags(&self, state: &State) -> Tags {
        let has = state.extra.as_ref().is_some_and(|extra| extra.edge_tags);
        if !has {
            return Tags::new();
        }
        let names = self.options.attributes.keys();
        let texts = names.filter_map(|name| Some((name, name.strip_prefix(PREFIX)?)));
        let tags = texts.filter_map(|(name, own)| match self.edge_value(name, &state.form)? {
            Value::Text(text) => Some(format!("edgeattr.{own}.{text}").into()),
            _ => None,
        });
        tags.collect()
    }

    /// Whether it is known which edges of the start shape have a street before them.
    pub(super) fn has_streets(&self) -> bool {
        match self.options.attributes.get(STREET) {
            Some(Value::Array(array)) => array.values.iter().any(is_street),
            _ => false,
        }
    }

    /// Whether a component stands at an edge with a street before it.
    pub(super) fn at_street(&self, form: &Form) -> bool {
        self.edge_value(STREET, form)
            .as_ref()
            .is_some_and(is_street)
    }
}

fn is_street(width: &Value) -> bool {
    width.number().is_some_and(|width| width > 0.0)
}
