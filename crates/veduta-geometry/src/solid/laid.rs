//! A mesh laid over faces: repeated along their texture coordinates, cut at their edges, bent.
//!
//! The mesh has x from 0 to 1 along u, z from 0 to 1 against v, and y as the height above the
//! faces (m). One tile of it covers one unit of u and v. Within each patch of a face the
//! coordinates are linear functions of the place, so that a tile is cut where the patch ends, by
//! planes in its own frame, and then carried to the patch. A closed mesh is cut with caps; those
//! that two patches or two tiles have in common are taken out again.

use std::collections::HashMap;

use glam::{DMat2, DMat3, DVec2, DVec3};

use super::cut::cut;
use super::mesh::Mesh;
use super::normals::point_normals;
use super::triangles::triangles;
use super::weld::joined;
use crate::PolygonError;

/// How far places in a tile may be apart and still be one, in tiles.
const NEAR: f64 = 1e-9;

/// Where the height of what is laid grows to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rise {
    /// Everywhere the same way (a unit vector).
    Along(DVec3),
    /// Along the normals of the points, which are blended within faces.
    Normals,
}

/// A convex part of a face in the plane of u and -v, with its way back to space.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Counter-clockwise, in tiles.
    outline: Vec<DVec2>,
    first: DVec2,
    from_first: DMat2,
    places: [DVec3; 3],
    rises: [DVec3; 3],
}

/// The patches of a surface. `uv` has to be linear in the place. Faces that have no extent in the
/// coordinates have no patches.
pub fn patches(
    surface: &Mesh,
    uv: impl Fn(DVec3) -> [f64; 2],
    rise: Rise,
) -> Result<Vec<Patch>, PolygonError> {
    let rises = match rise {
        Rise::Along(up) => vec![up; surface.points.len()],
        Rise::Normals => point_normals(surface),
    };
    let flat: Vec<DVec2> = surface
        .points
        .iter()
        .map(|&point| {
            let [u, v] = uv(point);
            DVec2::new(u, -v)
        })
        .collect();
    let extent = surface
        .bounds()
        .map_or(0.0, |(low, high)| low.distance(high));
    let mut found = Vec::new();
    let mut add = |ring: &[u32]| found.extend(Patch::of(ring, &flat, &surface.points, &rises));
    for face in surface.faces() {
        let whole = face.outline();
        let is_plain = face.ring_count() == 1 && is_convex(&surface.points, whole, face.normal());
        if is_plain && (rise != Rise::Normals || whole.len() == 3) {
            add(whole);
            continue;
        }
        for triangle in triangles(surface, face, 1e-6 * extent)? {
            add(&triangle);
        }
    }
    Ok(found)
}

impl Patch {
    fn of(ring: &[u32], flat: &[DVec2], places: &[DVec3], rises: &[DVec3]) -> Option<Self> {
        let mut outline: Vec<DVec2> = ring.iter().map(|&point| flat[point as usize]).collect();
        let first = outline[0];
        let span = outline
            .iter()
            .map(|corner| corner.distance(first))
            .fold(0.0, f64::max);
        // The way back is that of the largest triangle at the first corner.
        let spread = |k: usize| (outline[k] - first).perp_dot(outline[k + 1] - first).abs();
        let widest = (1..ring.len() - 1).max_by(|&a, &b| spread(a).total_cmp(&spread(b)))?;
        if spread(widest) <= NEAR * span * span {
            return None;
        }
        let chosen = [ring[0], ring[widest], ring[widest + 1]].map(|point| point as usize);
        let sides = DMat2::from_cols(outline[widest] - first, outline[widest + 1] - first);
        let twice: f64 = (1..ring.len() - 1)
            .map(|k| (outline[k] - first).perp_dot(outline[k + 1] - first))
            .sum();
        if twice < 0.0 {
            outline.reverse();
        }
        Some(Self {
            outline,
            first,
            from_first: sides.inverse(),
            places: chosen.map(|point| places[point]),
            rises: chosen.map(|point| rises[point]),
        })
    }

    /// The first tile along u and against v, and how many there are.
    pub fn tiles(&self) -> ([f64; 2], [f64; 2]) {
        let (low, high) = self.bounds();
        let (low, high) = ((low + NEAR).floor(), (high - NEAR).ceil());
        (low.to_array(), (high - low).max(DVec2::ONE).to_array())
    }

    fn bounds(&self) -> (DVec2, DVec2) {
        let around =
            |(low, high): (DVec2, DVec2), corner: &DVec2| (low.min(*corner), high.max(*corner));
        self.outline
            .iter()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), around)
    }

    /// What of one tile of the mesh lies on the patch; `solid` where the mesh is closed.
    pub fn lay(&self, mesh: &Mesh, solid: bool, tile: [f64; 2]) -> Mesh {
        let tile = DVec2::from_array(tile);
        let mut rest = mesh.clone();
        for k in 0..self.outline.len() {
            let (from, to) = (
                self.outline[k] - tile,
                self.outline[(k + 1) % self.outline.len()] - tile,
            );
            let along = (to - from).normalize_or_zero();
            let inwards = DVec3::new(-along.y, 0.0, along.x);
            let edge = inwards.x * from.x + inwards.z * from.y;
            let is_within = |point: &DVec3| point.dot(inwards) >= edge - NEAR;
            if rest.is_empty() || along == DVec2::ZERO || rest.points.iter().all(is_within) {
                continue;
            }
            let axes = DMat3::from_cols(inwards, DVec3::Y, inwards.cross(DVec3::Y));
            let turned = rest.mapped(|point| axes.transpose() * point);
            let inside = cut(&turned, 0, edge, NEAR, solid).above.mesh;
            rest = inside.mapped(|point| axes * point);
        }
        let laid = rest.mapped(|point| self.place(tile + DVec2::new(point.x, point.z), point.y));
        if self.turns_over() {
            laid.reversed()
        } else {
            laid
        }
    }

    fn place(&self, flat: DVec2, height: f64) -> DVec3 {
        let shares = self.from_first * (flat - self.first);
        let blend =
            |all: &[DVec3; 3]| all[0] + (all[1] - all[0]) * shares.x + (all[2] - all[0]) * shares.y;
        blend(&self.places) + blend(&self.rises) * height
    }

    /// Whether the way to space mirrors what is laid.
    fn turns_over(&self) -> bool {
        let [p, q, r] = self.places;
        let [a, b, c] = self.rises;
        // u runs along x and against v along z, so that x, height and z are right-handed.
        let along = DMat3::from_cols(q - p, r - p, DVec3::ZERO);
        let [x, z] = [self.from_first.x_axis, self.from_first.y_axis]
            .map(|shares| along * DVec3::new(shares.x, shares.y, 0.0));
        DMat3::from_cols(x, a + b + c, z).determinant() < 0.0
    }
}

/// What has been laid as one mesh: points at one place are one, faces that lie on each other are
/// taken out (both, where the mesh is closed and they look at each other), and faces that were
/// bent are triangles.
pub fn laid_together(parts: &[Mesh], solid: bool) -> Result<Mesh, PolygonError> {
    let parts: Vec<&Mesh> = parts.iter().collect();
    let bounds = parts.iter().filter_map(|part| part.bounds());
    let around = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let extent = around.map_or(0.0, |(low, high)| low.distance(high));
    let whole = joined(&parts, NEAR * extent);
    let kept = without_pairs(&whole, solid);
    let mut flat = Mesh::with_points(whole.points.clone());
    for face in kept.into_iter().map(|face| whole.face(face)) {
        let normal = face.normal();
        let start = whole.points[face.outline()[0] as usize];
        if normal == DVec3::ZERO
            || face
                .points()
                .all(|point| (point - start).dot(normal).abs() <= NEAR * extent)
        {
            flat.push_face(&face.rings().collect::<Vec<_>>());
            continue;
        }
        for triangle in triangles(&whole, face, extent)? {
            flat.push_face(&[triangle]);
        }
    }
    Ok(flat.compact())
}

/// The faces that no other face lies on; of those that look the same way, the first.
fn without_pairs(mesh: &Mesh, solid: bool) -> Vec<usize> {
    let mut alike: HashMap<Vec<u32>, Vec<usize>> = HashMap::new();
    for face in mesh.faces() {
        let mut points: Vec<u32> = face.rings().flatten().copied().collect();
        points.sort_unstable();
        alike.entry(points).or_default().push(face.index());
    }
    let mut kept: Vec<usize> = Vec::with_capacity(mesh.face_count());
    for faces in alike.into_values() {
        let normal = mesh.face(faces[0]).normal();
        let (same, against): (Vec<usize>, Vec<usize>) = faces
            .into_iter()
            .partition(|&face| mesh.face(face).normal().dot(normal) >= 0.0);
        let left = match solid {
            true if same.len() > against.len() => same[against.len()..].to_vec(),
            true => against[same.len()..].to_vec(),
            false => same
                .first()
                .into_iter()
                .chain(against.first())
                .copied()
                .collect(),
        };
        kept.extend(left);
    }
    kept.sort_unstable();
    kept
}

/// Whether no corner of a ring turns inwards.
fn is_convex(points: &[DVec3], ring: &[u32], normal: DVec3) -> bool {
    let count = ring.len();
    (0..count).all(|k| {
        let [a, b, c] = [k, k + 1, k + 2].map(|k| points[ring[k % count] as usize]);
        let (before, after) = (b - a, c - b);
        before.cross(after).dot(normal) >= -NEAR * before.length() * after.length()
    })
}
