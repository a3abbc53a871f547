//! Polygons with holes to triangles, through a constrained Delaunay triangulation.
//!
//! Ear clipping (the crate `earcut`) was considered first: it drops a vertex whenever it lies on
//! the line of its two neighbours, which windows in one row do all the time, and the wall then
//! meets its reveals in T-junctions. A constrained Delaunay triangulation (the crate `spade`,
//! exact predicates) keeps every vertex and says so when rings cross.

use std::collections::HashMap;

use rayon::prelude::*;
use spade::handles::{FixedFaceHandle, InnerTag, PossiblyOuterTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

use crate::{area_vector, Plane, PolygonError, PolygonSet};

/// Triangles of all polygons, in the order of the polygons.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangulation {
    /// Vertex numbers, counter-clockwise around the polygon's normal.
    pub triangles: Vec<[u32; 3]>,
    /// The polygon of each triangle.
    pub triangle_polygon: Vec<u32>,
    /// Unit normal of each polygon.
    pub normals: Vec<[f64; 3]>,
    /// Area of each polygon, holes taken off (m2).
    pub areas_m2: Vec<f64>,
}

/// Which polygons are sound, and the triangles of those that are.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SoundTriangulation {
    pub is_sound: Vec<bool>,
    /// Vertex numbers, and the polygon of each triangle.
    pub triangles: Vec<[u32; 3]>,
    pub triangle_polygon: Vec<u32>,
    /// Unit normal of each polygon; zero of those that are not sound.
    pub normals: Vec<[f64; 3]>,
}

struct Piece {
    triangles: Vec<[u32; 3]>,
    normal: [f64; 3],
    area_m2: f64,
}

/// Triangulates every polygon; `tolerance_m` is how far a vertex may lie off its polygon's plane.
///
/// A polygon of n vertices and h holes whose rings do not touch gives n + 2h - 2 triangles.
pub fn triangulate(set: &PolygonSet<'_>, tolerance_m: f64) -> Result<Triangulation, PolygonError> {
    let pieces: Vec<Piece> = (0..set.len())
        .into_par_iter()
        .map(|polygon| one_polygon(set, polygon, tolerance_m))
        .collect::<Result<_, _>>()?;
    let mut all = Triangulation::default();
    for (polygon, piece) in pieces.into_iter().enumerate() {
        all.triangle_polygon
            .extend(std::iter::repeat_n(polygon as u32, piece.triangles.len()));
        all.triangles.extend(piece.triangles);
        all.normals.push(piece.normal);
        all.areas_m2.push(piece.area_m2);
    }
    Ok(all)
}

/// Triangulates the polygons that are some, and leaves out the others: those that
/// [`triangulate`] refuses. On the calling thread alone.
pub fn triangulate_sound(set: &PolygonSet<'_>, tolerance_m: f64) -> SoundTriangulation {
    let mut all = SoundTriangulation::default();
    for polygon in 0..set.len() {
        let found = set.check_rings(polygon);
        let piece = found.and_then(|()| one_polygon(set, polygon, tolerance_m));
        all.is_sound.push(piece.is_ok());
        let Ok(piece) = piece else {
            all.normals.push([0.0; 3]);
            continue;
        };
        all.triangle_polygon
            .extend(std::iter::repeat_n(polygon as u32, piece.triangles.len()));
        all.triangles.extend(piece.triangles);
        all.normals.push(piece.normal);
    }
    all
}

fn one_polygon(
    set: &PolygonSet<'_>,
    polygon: usize,
    tolerance_m: f64,
) -> Result<Piece, PolygonError> {
    let plane = Plane::of(set, polygon, tolerance_m)?;
    let mut area_m2 = 0.0;
    for (ring, range) in set.rings(polygon).enumerate() {
        let vector = area_vector(set, range);
        let along: f64 = (0..3).map(|axis| vector[axis] * plane.normal[axis]).sum();
        area_m2 += if ring == 0 { along } else { -along.abs() };
    }
    if area_m2 <= 0.0 {
        return Err(PolygonError::NoArea { polygon, area_m2 });
    }
    let triangles = match convex_triangles(set, polygon, &plane) {
        Some(triangles) => triangles,
        None => inside_triangles(set, polygon, &plane)?,
    };
    Ok(Piece {
        triangles,
        normal: plane.normal,
        area_m2,
    })
}

/// A corner whose sides enclose less than this is not told from a straight line (m2).
const STRAIGHT_M2: f64 = 1e-9;

/// Most polygons of buildings are triangles and convex quadrilaterals: no search is needed. A
/// quadrilateral is cut along its shorter diagonal (of two equals, the one at its first corner).
fn convex_triangles(set: &PolygonSet<'_>, polygon: usize, plane: &Plane) -> Option<Vec<[u32; 3]>> {
    let mut rings = set.rings(polygon);
    let ring = rings.next()?;
    if rings.next().is_some() || ring.len() > 4 {
        return None;
    }
    let count = ring.len();
    let points: Vec<[f64; 2]> = ring
        .clone()
        .map(|vertex| plane.flatten(set.position_m(vertex)))
        .collect();
    let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
    for k in 0..count {
        let into = minus(points[k], points[(k + count - 1) % count]);
        let out = minus(points[(k + 1) % count], points[k]);
        if into[0] * out[1] - into[1] * out[0] <= STRAIGHT_M2 {
            return None;
        }
    }
    let vertex = |k: usize| (ring.start + k) as u32;
    if count == 3 {
        return Some(vec![[vertex(0), vertex(1), vertex(2)]]);
    }
    let square = |a: [f64; 2]| a[0] * a[0] + a[1] * a[1];
    let first = square(minus(points[2], points[0]));
    let second = square(minus(points[3], points[1]));
    // Equal but for rounding is equal: congruent polygons are cut alike.
    Some(if first <= second * (1.0 + 1e-9) {
        vec![
            [vertex(0), vertex(1), vertex(2)],
            [vertex(0), vertex(2), vertex(3)],
        ]
    } else {
        vec![
            [vertex(0), vertex(1), vertex(3)],
            [vertex(1), vertex(2), vertex(3)],
        ]
    })
}

type Mesh = ConstrainedDelaunayTriangulation<Point2<f64>>;

fn inside_triangles(
    set: &PolygonSet<'_>,
    polygon: usize,
    plane: &Plane,
) -> Result<Vec<[u32; 3]>, PolygonError> {
    let mut mesh = Mesh::new();
    let mut vertex_of_handle = HashMap::new();
    for range in set.rings(polygon) {
        let mut handles = Vec::with_capacity(range.len());
        for vertex in range.clone() {
            let [u, v] = plane.flatten(set.position_m(vertex)).map(without_dust);
            let handle = mesh
                .insert(Point2::new(u, v))
                .map_err(|_| PolygonError::NotFinite { vertex })?;
            vertex_of_handle
                .entry(handle.index())
                .or_insert(vertex as u32);
            handles.push(handle);
        }
        for (k, &from) in handles.iter().enumerate() {
            let to = handles[(k + 1) % handles.len()];
            if from == to || mesh.try_add_constraint(from, to).is_empty() {
                let next = range.start + (k + 1) % range.len();
                return Err(PolygonError::SelfCrossing {
                    polygon,
                    from: range.start + k,
                    to: next,
                });
            }
        }
    }
    let inside = faces_inside(&mesh);
    let mut triangles: Vec<[u32; 3]> = mesh
        .inner_faces()
        .filter(|face| inside[face.fix().index()])
        .map(|face| face.vertices().map(|v| vertex_of_handle[&v.fix().index()]))
        .collect();
    triangles.sort_unstable();
    Ok(triangles)
}

/// Whether each face (by its index; 0 is the unbounded one) lies within the polygon: the number
/// of ring edges between it and the outside is odd.
fn faces_inside(mesh: &Mesh) -> Vec<bool> {
    let mut inside: Vec<Option<bool>> = vec![None; mesh.num_all_faces()];
    let outer: FixedFaceHandle<PossiblyOuterTag> = mesh.outer_face().fix();
    inside[outer.index()] = Some(false);
    let mut open: Vec<FixedFaceHandle<InnerTag>> = Vec::new();
    for edge in mesh.convex_hull() {
        let hull = if edge.is_outer_edge() {
            edge.rev()
        } else {
            edge
        };
        let Some(face) = hull.face().as_inner() else {
            continue;
        };
        if inside[face.fix().index()].is_none() {
            inside[face.fix().index()] = Some(hull.is_constraint_edge());
            open.push(face.fix());
        }
    }
    while let Some(handle) = open.pop() {
        let here = inside[handle.index()].unwrap_or(false);
        for edge in mesh.face(handle).adjacent_edges() {
            let Some(next) = edge.rev().face().as_inner() else {
                continue;
            };
            let slot = &mut inside[next.fix().index()];
            if slot.is_none() {
                *slot = Some(here != edge.is_constraint_edge());
                open.push(next.fix());
            }
        }
    }
    inside
        .into_iter()
        .map(|known| known.unwrap_or(false))
        .collect()
}

/// The triangulation refuses coordinates below 2^-142, which are zero by any measure of ours.
fn without_dust(coordinate_m: f64) -> f64 {
    if coordinate_m.abs() < 1e-30 {
        0.0
    } else {
        coordinate_m
    }
}
