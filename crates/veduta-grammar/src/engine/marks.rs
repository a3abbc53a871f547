//! Tags of single faces: what operations say of the faces that they make, and what booleans keep of
//! two shapes.
//!
//! Meshes have no tags. A shape keeps which operation made it, and the tagged surfaces that it was put
//! together from; a face that `comp` takes gets its tags by where it looks, and by the surfaces that it
//! lies on. Rules that never ask for tags keep neither.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{Face, Mesh};

use super::state::{Extra, State};

/// Sine of the angle up to which a face stands upright.
const ALONG: f64 = 1e-4;
/// How far from a surface a face lies on it, as a share of the surface's extent.
const NEAR: f64 = 1e-6;

/// What the tags begin with that operations give.
const AUTOMATIC: &[&str] = &["roof", "extrude", "taper", "envelope", "bool"];

pub type Tags = BTreeSet<Arc<str>>;

/// An operation whose faces have tags by where they look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Maker {
    Roof,
    Extrude,
    Taper,
    Envelope,
}

impl Maker {
    /// What all its tags begin with.
    fn stem(self) -> &'static str {
        match self {
            Self::Roof => "roof",
            Self::Extrude => "extrude",
            Self::Taper => "taper",
            Self::Envelope => "envelope",
        }
    }

    /// The tag of a face by the sine of its slope along the direction in which it was made.
    fn tag(self, up: f64) -> &'static str {
        let (rises, falls) = (up > ALONG, up < -ALONG);
        match self {
            Self::Roof if rises => "roof.top",
            Self::Roof if falls => "roof.bottom",
            Self::Roof => "roof.side",
            Self::Extrude if rises => "extrude.top",
            Self::Extrude if falls => "extrude.bottom",
            Self::Extrude => "extrude.side.outer",
            Self::Taper if falls => "taper.bottom",
            Self::Taper => "taper.side",
            Self::Envelope if up > 1.0 - ALONG => "envelope.top",
            Self::Envelope if rises => "envelope.side.slope",
            Self::Envelope if falls => "envelope.bottom",
            Self::Envelope => "envelope.side.base",
        }
    }
}

/// Which operation made a shape, and along which direction of its scope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Made {
    pub by: Maker,
    pub along: DVec3,
}

/// A surface in the world whose faces carry tags.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    pub surface: Arc<Mesh>,
    pub tags: Tags,
}

impl State {
    /// Says which operation has made the shape, along a direction of the world: the tags that it left
    /// before are gone.
    pub fn made(&mut self, by: Maker, along: DVec3) {
        let along = self.form.scope.axes.transpose() * along;
        let extra = self.extra_mut();
        extra.tags.retain(|tag| !is_within(tag, by.stem()));
        extra.made = Some(Made { by, along });
    }

    /// Says that the shape has another geometry, which nothing was said of yet: the tags that
    /// operations gave to the one before are gone, those of rules stay.
    pub fn replaced(&mut self) {
        let is_marked = |extra: &Arc<Extra>| {
            let tagged = extra.tags.iter().any(|tag| is_automatic(tag));
            tagged || extra.made.is_some() || !extra.marks.is_empty()
        };
        if !self.extra.as_ref().is_some_and(is_marked) {
            return;
        }
        let extra = self.extra_mut();
        extra.made = None;
        extra.marks.clear();
        extra.tags.retain(|tag| !is_automatic(tag));
    }

    /// Takes surfaces along that are moved with the shape.
    pub fn carry_marks(&mut self, change: impl Fn(DVec3) -> DVec3) {
        if let Some(extra) = &mut self.extra {
            if extra.marks.is_empty() {
                return;
            }
            for mark in &mut Arc::make_mut(extra).marks {
                mark.surface = Arc::new(Mesh::clone(&mark.surface).mapped(&change));
            }
        }
    }

    /// The shape's faces by their tags, with another tag for all: what remains of it in one that it is
    /// part of.
    pub fn marked(&self, with: Option<&str>) -> Vec<Mark> {
        let mesh = self.form.world_mesh();
        let mut found: Vec<(Tags, Vec<usize>)> = Vec::new();
        for face in mesh.faces() {
            let mut tags = self.face_tags(&mesh, face, self.form.scope.axes);
            tags.extend(with.map(Arc::from));
            if tags.is_empty() {
                continue;
            }
            match found.iter_mut().find(|(known, _)| *known == tags) {
                Some((_, faces)) => faces.push(face.index()),
                None => found.push((tags, vec![face.index()])),
            }
        }
        let marks = found.into_iter().map(|(tags, faces)| Mark {
            surface: Arc::new(mesh.of_faces(faces)),
            tags,
        });
        marks.collect()
    }

    /// The tags of all faces of the shape.
    pub fn all_tags(&self) -> Tags {
        let Some(extra) = &self.extra else {
            return Tags::new();
        };
        let mut tags = extra.tags.clone();
        if extra.made.is_some() || !extra.marks.is_empty() {
            let mesh = self.form.world_mesh();
            for face in mesh.faces() {
                tags.extend(extra.tags_of(&mesh, face, self.form.scope.axes));
            }
        }
        tags
    }

    /// All tags of a face of the shape; `axes` are those of the scope that it was made in.
    fn face_tags(&self, mesh: &Mesh, face: Face<'_>, axes: DMat3) -> Tags {
        self.extra.as_ref().map_or_else(Tags::new, |extra| {
            let mut tags = extra.tags.clone();
            tags.extend(extra.tags_of(mesh, face, axes));
            tags
        })
    }
}

impl Extra {
    /// Gives a component that is one face its own tags.
    pub fn settle(&mut self, component: &Mesh, axes: DMat3) {
        if (self.made.is_none() && self.marks.is_empty()) || component.face_count() != 1 {
            return;
        }
        let own = self.tags_of(component, component.face(0), axes);
        self.tags.extend(own);
        self.made = None;
        self.marks.clear();
    }

    fn tags_of(&self, mesh: &Mesh, face: Face<'_>, axes: DMat3) -> Tags {
        let normal = face.normal();
        let mut tags = Tags::new();
        if let Some(made) = self.made {
            let up = normal.dot(axes * made.along);
            tags.insert(made.by.tag(up).into());
        }
        if !self.marks.is_empty() {
            if let Some(point) = within(mesh, face, normal) {
                let marks = self.marks.iter();
                let there = marks.filter(|mark| lies_on(&mark.surface, point, normal));
                tags.extend(there.flat_map(|mark| mark.tags.iter().cloned()));
            }
        }
        tags
    }
}

/// Whether a point with a normal lies on a face of a surface, seen from either side.
fn lies_on(surface: &Mesh, point: DVec3, normal: DVec3) -> bool {
    let extent = surface
        .bounds()
        .map_or(0.0, |(low, high)| low.distance(high));
    surface.faces().any(|face| {
        let own = face.normal();
        let Some(first) = face.points().next() else {
            return false;
        };
        own.dot(normal).abs() > 1.0 - NEAR
            && (point - first).dot(own).abs() <= NEAR * extent.max(1.0)
            && holds(surface, face, own, point)
    })
}

/// A point inside of a face: the middle of the first of its corners' triangles that has it inside.
fn within(mesh: &Mesh, face: Face<'_>, normal: DVec3) -> Option<DVec3> {
    let ring: Vec<DVec3> = face
        .outline()
        .iter()
        .map(|&p| mesh.points[p as usize])
        .collect();
    let count = ring.len();
    let all = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let middles = all.map(|(a, b)| (ring[a] + ring[b] + ring[(b + 1) % count]) / 3.0);
    let mut middles = middles.take(count * 8);
    middles.find(|&point| holds(mesh, face, normal, point))
}

/// Whether a point of a face's plane lies within its outline and in none of its holes: by how many
/// edges there are on one side of it.
fn holds(mesh: &Mesh, face: Face<'_>, normal: DVec3, point: DVec3) -> bool {
    let flat = normal.abs();
    let (u, v) = if flat.x >= flat.y && flat.x >= flat.z {
        (1, 2)
    } else if flat.y >= flat.z {
        (2, 0)
    } else {
        (0, 1)
    };
    let mut inside = false;
    for (from, to) in face.edges() {
        let (a, b) = (mesh.points[from as usize], mesh.points[to as usize]);
        if (a[v] > point[v]) != (b[v] > point[v]) {
            let across = a[u] + (point[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u]);
            inside ^= point[u] < across;
        }
    }
    inside
}

/// Whether a tag is one that a query asks for: the same, or one below it. `?` stands for one part
/// between dots, `*` for one or more.
pub fn is_asked(tag: &str, query: &str) -> bool {
    let tag: Vec<&str> = tag.split('.').collect();
    // Which numbers of the tag's parts those of the query so far can stand for.
    let mut reached = vec![false; tag.len() + 1];
    reached[0] = true;
    for part in query.split('.') {
        let mut next = vec![false; tag.len() + 1];
        for (end, own) in tag.iter().enumerate() {
            next[end + 1] = match part {
                "*" => reached[..=end].contains(&true),
                "?" => reached[end],
                part => reached[end] && fits_part(own, part),
            };
        }
        reached = next;
    }
    reached.contains(&true)
}

/// A part of a tag; `*` at an end of the query's part stands for anything there.
fn fits_part(own: &str, part: &str) -> bool {
    match (part.strip_prefix('*'), part.strip_suffix('*')) {
        (Some(end), Some(_)) => own.contains(end.trim_end_matches('*')),
        (Some(end), None) => own.ends_with(end),
        (None, Some(start)) => own.starts_with(start),
        (None, None) => own == part,
    }
}

/// Whether a tag is one that operations give.
fn is_automatic(tag: &str) -> bool {
    AUTOMATIC.iter().any(|stem| is_within(tag, stem))
}

/// Whether a tag is a name or below it.
fn is_within(tag: &str, stem: &str) -> bool {
    tag.strip_prefix(stem)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}
