//! The functions that measure the geometry of the current shape.

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{weld, Face, Mesh};

use crate::shape::{components, is_meant, Form, Frames, Geometry, Kind, Surroundings, TOLERANCE};

use super::marks::{is_asked, Tags};
use super::state::State;
use super::texture_map::map_of;
use super::value::Value;

/// A function of the geometry. Lengths are metres, angles degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// `geometry.angle(maxSlope | azimuth | zenith)`: of the face that is farthest from level.
    Angle,
    /// `geometry.area`, `geometry.area(selector)`: of all faces, or of those that are selected.
    Area,
    /// The edges of one face alone.
    BoundaryLength,
    /// From the lowest point to the highest, in the world.
    Height,
    /// `geometry.hasTags(text)`, `isTagged(text)`: tags belong to whole shapes; `*` at an end of
    /// the text stands for anything.
    HasTags,
    Tags,
    IsClosed,
    IsConcave,
    IsInstanced,
    /// `geometry.isOriented(selector)`: whether all faces are selected.
    IsOriented,
    /// `geometry.isPlanar(tolerance)`: whether the normals of all faces are that near (degrees).
    IsPlanar,
    /// `geometry.isRectangular(tolerance)`: one face of four right angles, that near (degrees).
    IsRectangular,
    /// `geometry.groups`, `geometry.materials`: the names of an asset's parts.
    Groups,
    Materials,
    /// `geometry.hasUVs(set)`: whether texture coordinates were laid there.
    HasUvs,
    FaceCount,
    EdgeCount,
    VertexCount,
    HoleCount,
    Volume,
    /// `geometry.du(set, uvSpace | unitSpace)` and `geometry.dv`: the extent in texture space, or
    /// the same on the surface.
    UvExtent(usize),
    UvLow(usize),
    UvHigh(usize),
}

const TABLE: &[(&str, Measure)] = &[
    ("geometry.angle", Measure::Angle),
    ("geometry.area", Measure::Area),
    ("geometry.boundaryLength", Measure::BoundaryLength),
    ("geometry.du", Measure::UvExtent(0)),
    ("geometry.dv", Measure::UvExtent(1)),
    ("geometry.groups", Measure::Groups),
    ("geometry.hasTags", Measure::HasTags),
    ("geometry.hasUVs", Measure::HasUvs),
    ("geometry.height", Measure::Height),
    ("geometry.isClosedSurface", Measure::IsClosed),
    ("geometry.isConcave", Measure::IsConcave),
    ("geometry.isInstanced", Measure::IsInstanced),
    ("geometry.isOriented", Measure::IsOriented),
    ("geometry.isPlanar", Measure::IsPlanar),
    ("geometry.isRectangular", Measure::IsRectangular),
    ("geometry.materials", Measure::Materials),
    ("geometry.nEdges", Measure::EdgeCount),
    ("geometry.nFaces", Measure::FaceCount),
    ("geometry.nHoles", Measure::HoleCount),
    ("geometry.nVertices", Measure::VertexCount),
    ("geometry.tags", Measure::Tags),
    ("geometry.uMax", Measure::UvHigh(0)),
    ("geometry.uMin", Measure::UvLow(0)),
    ("geometry.vMax", Measure::UvHigh(1)),
    ("geometry.vMin", Measure::UvLow(1)),
    ("geometry.volume", Measure::Volume),
    ("isTagged", Measure::HasTags),
];

impl Measure {
    pub fn named(name: &str) -> Option<Self> {
        let found = TABLE.iter().find(|entry| entry.0 == name);
        found.map(|entry| entry.1)
    }

    /// Whether it is about tags.
    pub fn is_of_tags(self) -> bool {
        matches!(self, Self::HasTags | Self::Tags)
    }

    /// The names of all functions of geometry.
    pub fn names() -> impl Iterator<Item = &'static str> {
        TABLE.iter().map(|entry| entry.0)
    }

    /// The value for a shape; `object` are the axes of the start shape, `tags` what it has besides its
    /// own.
    pub fn of(
        self,
        state: &State,
        object: DMat3,
        tags: Tags,
        args: &[Value],
    ) -> Result<Value, String> {
        let form = &state.form;
        Ok(match self {
            Self::Area => Value::Number(area(form, object, args)?),
            Self::IsOriented => Value::Bool(is_oriented(form, object, args)?),
            Self::Height => Value::Number(height(form)),
            Self::HasTags => Value::Bool(has_tags(state, tags, args)),
            Self::Tags => tags_of(state, tags),
            Self::Groups => parts(state, Kind::Groups),
            Self::Materials => parts(state, Kind::Materials),
            Self::HasUvs => Value::Bool(has_uvs(state, args)),
            Self::IsClosed => Value::Bool(form.geometry.is_solid()),
            Self::IsInstanced => Value::Bool(matches!(form.geometry, Geometry::Instance(_))),
            Self::Volume => Value::Number(if form.geometry.is_solid() {
                volume(form)
            } else {
                0.0
            }),
            Self::FaceCount => Value::Number(match &form.geometry {
                Geometry::Nothing => 0.0,
                Geometry::Rectangle(_) => 1.0,
                Geometry::Box => 6.0,
                Geometry::Faces { mesh, .. } => mesh.face_count() as f64,
                Geometry::Instance(instance) => instance.mesh().face_count() as f64,
            }),
            Self::UvExtent(_) | Self::UvLow(_) | Self::UvHigh(_) => self.of_texture(state, args)?,
            _ => self.of_mesh(&form.world_mesh(), args)?,
        })
    }

    fn of_mesh(self, mesh: &Mesh, args: &[Value]) -> Result<Value, String> {
        let tolerance = args.first().and_then(Value::number).unwrap_or(0.0);
        Ok(match self {
            Self::Angle => Value::Number(angle(mesh, args)?),
            Self::BoundaryLength => Value::Number(boundary_length(mesh)),
            Self::IsConcave => Value::Bool(mesh.faces().any(|face| is_concave(mesh, face))),
            Self::IsPlanar => Value::Bool(is_planar(mesh, tolerance)),
            Self::IsRectangular => Value::Bool(is_rectangular(mesh, tolerance)),
            Self::EdgeCount => Value::Number(edges(mesh).len() as f64),
            Self::HoleCount => {
                let holes: usize = mesh.faces().map(|face| face.ring_count() - 1).sum();
                Value::Number(holes as f64)
            }
            _ => {
                let first = welded(mesh);
                let used = mesh.faces().flat_map(Face::rings).flatten();
                let all: std::collections::HashSet<u32> =
                    used.map(|&point| first[point as usize]).collect();
                Value::Number(all.len() as f64)
            }
        })
    }

    fn of_texture(self, state: &State, args: &[Value]) -> Result<Value, String> {
        let set = args.first().and_then(Value::number).unwrap_or(0.0);
        let map = map_of(state, set)?;
        let mesh = state.form.world_mesh();
        let (Self::UvExtent(axis) | Self::UvLow(axis) | Self::UvHigh(axis)) = self else {
            return Err("no texture coordinate".into());
        };
        let places = mesh.points.iter().map(|&point| map.at(point)[axis]);
        let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
            (low.min(c), high.max(c))
        });
        if low > high {
            return Ok(Value::Number(0.0));
        }
        let unit = args
            .get(1)
            .is_some_and(|word| word.to_string() == "unitSpace");
        Ok(Value::Number(match self {
            Self::UvLow(_) => low,
            Self::UvHigh(_) => high,
            _ if unit => (high - low) * map.stretch(axis, &mesh),
            _ => high - low,
        }))
    }
}

/// The area of the selected faces (m2).
fn area(form: &Form, object: DMat3, args: &[Value]) -> Result<f64, String> {
    let size = form.scope.size;
    match (args, &form.geometry) {
        ([], Geometry::Nothing) => Ok(0.0),
        ([], Geometry::Rectangle(axis)) => Ok(size[(axis + 1) % 3] * size[(axis + 2) % 3]),
        ([], Geometry::Box) => Ok(2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)),
        ([], _) => Ok(form.world_mesh().area()),
        ([word, ..], _) => {
            let mut sum = 0.0;
            for (is, area) in selected(form, object, &word.to_string())? {
                sum += if is { area } else { 0.0 };
            }
            Ok(sum)
        }
    }
}

fn is_oriented(form: &Form, object: DMat3, args: &[Value]) -> Result<bool, String> {
    let word = args.first().map(ToString::to_string).unwrap_or_default();
    let all = selected(form, object, &word)?;
    Ok(!all.is_empty() && all.iter().all(|(is, _)| *is))
}

/// For each face whether a word means it, and its area.
fn selected(form: &Form, object: DMat3, word: &str) -> Result<Vec<(bool, f64)>, String> {
    let word = if word == "surface" { "all" } else { word };
    let frames = Frames {
        scope: form.scope.axes,
        object,
    };
    let faces = components(form, Kind::Faces);
    let each = faces.iter().map(|face| {
        let is = is_meant(word, face, frames, Surroundings::default);
        let is = is.ok_or_else(|| format!("`{word}` selects no faces"))?;
        Ok((is, face.form.world_mesh().area()))
    });
    each.collect()
}

fn volume(form: &Form) -> f64 {
    match form.geometry {
        Geometry::Box => form.scope.size.element_product(),
        _ => form.world_mesh().volume(),
    }
}

fn height(form: &Form) -> f64 {
    let bounds = form.world_mesh().bounds();
    bounds.map_or(0.0, |(low, high)| high.y - low.y)
}

/// Whether a face has a tag that is asked for, or any.
fn has_tags(state: &State, tags: Tags, args: &[Value]) -> bool {
    let query = args.first().map(ToString::to_string);
    let own = state.all_tags();
    own.iter()
        .chain(&tags)
        .any(|tag| query.as_ref().is_none_or(|query| is_asked(tag, query)))
}

/// The names of what `comp(g)` or `comp(m)` would take the shape apart into.
fn parts(state: &State, kind: Kind) -> Value {
    let names = match &state.form.geometry {
        Geometry::Instance(instance) => instance.asset.part_names(kind),
        _ if kind == Kind::Materials => vec![state.look.class.clone()],
        _ => vec!["".into()],
    };
    Value::texts(names.into_iter().map(Value::Text).collect())
}

fn has_uvs(state: &State, args: &[Value]) -> bool {
    let set = args.first().and_then(Value::number).unwrap_or(0.0);
    let maps = state.extra.as_ref().map(|extra| &extra.maps);
    maps.and_then(|maps| maps.get(set as usize))
        .is_some_and(Option::is_some)
}

fn tags_of(state: &State, mut tags: Tags) -> Value {
    tags.extend(state.all_tags());
    Value::texts(tags.into_iter().map(Value::Text).collect())
}

fn angle(mesh: &Mesh, args: &[Value]) -> Result<f64, String> {
    let flattest = |face: &Face<'_>| face.normal().y.abs();
    let steepest = mesh
        .faces()
        .min_by(|a, b| flattest(a).total_cmp(&flattest(b)));
    let Some(normal) = steepest.map(Face::normal) else {
        return Ok(0.0);
    };
    let slope = normal.y.abs().clamp(0.0, 1.0).acos().to_degrees();
    match args.first().map(ToString::to_string).as_deref() {
        Some("maxSlope") => Ok(slope),
        Some("zenith") => Ok(90.0 - slope),
        // From north over east; z points south.
        Some("azimuth") => Ok(normal.x.atan2(-normal.z).to_degrees().rem_euclid(360.0)),
        other => {
            let other = other.unwrap_or_default();
            Err(format!(
                "`{other}` is no angle: maxSlope, azimuth or zenith"
            ))
        }
    }
}

fn welded(mesh: &Mesh) -> Vec<u32> {
    let extent = mesh.bounds().map_or(0.0, |(low, high)| low.distance(high));
    weld(&mesh.points, extent * TOLERANCE)
}

/// Each edge with the number of faces at it.
fn edges(mesh: &Mesh) -> std::collections::HashMap<(u32, u32), (usize, f64)> {
    let first = welded(mesh);
    let mut found = std::collections::HashMap::new();
    for (from, to) in mesh.faces().flat_map(Face::edges) {
        let (a, b) = (first[from as usize], first[to as usize]);
        let length = mesh.points[from as usize].distance(mesh.points[to as usize]);
        found.entry((a.min(b), a.max(b))).or_insert((0, length)).0 += 1;
    }
    found
}

fn boundary_length(mesh: &Mesh) -> f64 {
    let mut alone: Vec<f64> = edges(mesh)
        .into_values()
        .filter(|(faces, _)| *faces == 1)
        .map(|(_, length)| length)
        .collect();
    // The order of a hash map must not be seen in the sum.
    alone.sort_by(f64::total_cmp);
    alone.iter().sum()
}

/// Whether a face has a corner that turns inwards, or a hole.
fn is_concave(mesh: &Mesh, face: Face<'_>) -> bool {
    let normal = face.normal();
    let ring = face.outline();
    let count = ring.len();
    let inwards = |k: usize| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| mesh.points[ring[k % count] as usize]);
        let (before, after) = (b - a, c - b);
        before.cross(after).dot(normal) < -TOLERANCE * before.length() * after.length()
    };
    face.ring_count() > 1 || (0..count).any(inwards)
}

fn is_planar(mesh: &Mesh, tolerance: f64) -> bool {
    let mut normals = mesh.faces().map(Face::normal);
    let Some(first) = normals.next() else {
        return false;
    };
    normals.all(|normal| near_angle(first, normal, 0.0, tolerance))
}

fn is_rectangular(mesh: &Mesh, tolerance: f64) -> bool {
    if mesh.face_count() != 1 || mesh.corner_count() != 4 {
        return false;
    }
    let corners: Vec<DVec3> = mesh.face(0).points().collect();
    (0..4).all(|k| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| corners[k % 4]);
        near_angle(b - a, c - b, 90.0, tolerance)
    })
}

/// Whether the angle between two directions is `wanted` (degrees).
fn near_angle(a: DVec3, b: DVec3, wanted: f64, tolerance: f64) -> bool {
    const ROUNDING: f64 = 1e-4;
    let angle = a.angle_between(b).to_degrees();
    (angle - wanted).abs() <= tolerance.max(ROUNDING)
}
