//! Roofs whose edges change how they move at a height: half-hips and gablets.

use std::collections::{BTreeMap, HashMap};

use super::edges::Gables;
use crate::skeleton::{roof_within, Eaves, FaceOrigin, SkeletonError};
use crate::solid::envelope::{Bound, Storeys};
use crate::solid::inset::Rings;
use crate::solid::level::Level;
use crate::solid::loops::close_in_plane;
use crate::solid::{Face, Mesh};
use crate::Budget;

/// How often a height is moved a little where what is left at it touches itself.
const ATTEMPTS: u32 = 8;
/// Sine of the angle up to which faces over an edge are one.
const SAME_PLANE: f64 = 1e-6;

/// Gables of which the share `clipped` of the height is a slope again. `walls` is how far the floor
/// lies below the height from which shares count.
pub fn half_hip(
    level: Level,
    eaves: &Eaves,
    slope: f64,
    clipped: f64,
    below: f64,
    budget: &dyn Budget,
) -> Result<Mesh, SkeletonError> {
    let gabled = roof_within(eaves, None, budget)?;
    let mut tops = vec![0.0; eaves.len()];
    for face in &gabled.faces {
        if let FaceOrigin::Edge(edge) = face.origin {
            let heights = face.rings.iter().flatten();
            let top = heights.map(|&node| gabled.nodes_m[node as usize][2]);
            tops[edge as usize] = top.fold(tops[edge as usize], f64::max) * slope;
        }
    }
    let all = tops.iter().copied().fold(0.0, f64::max);
    tried(|attempt| {
        let share = (1.0 - clipped) * (1.0 - 0.003 * f64::from(attempt));
        let bound = |edge: usize| {
            let stands = eaves.speeds()[edge] == 0.0;
            let wall = below + share * (tops[edge] - below).max(0.0);
            Bound {
                wall: if stands { wall } else { 0.0 },
                speed: 1.0 / slope,
            }
        };
        let bounds: Vec<Bound> = (0..eaves.len()).map(bound).collect();
        let mut work = Work::on(level, eaves, budget);
        let mut walls: Vec<f64> = bounds.iter().map(|bound| bound.wall).collect();
        walls.retain(|&wall| wall > 0.0);
        walls.sort_by(f64::total_cmp);
        walls.dedup_by(|a, b| *a - *b <= 1e-6 * all);
        let mut low = 0.0;
        for high in walls {
            work.storeys.storey(&bounds, low, high)?;
            low = high;
        }
        work.storeys.storey(&bounds, low, 2.0 * all)?;
        work.whole()
    })
}

/// A hip roof up to the share `share` of its height, and a gable roof over what is left there.
pub fn gablet(
    level: Level,
    eaves: &Eaves,
    slope: f64,
    share: f64,
    budget: &dyn Budget,
) -> Result<Mesh, SkeletonError> {
    let hip = roof_within(eaves, None, budget)?;
    let top = hip.nodes_m.iter().map(|node| node[2]).fold(0.0, f64::max) * slope;
    tried(|attempt| {
        let knee = share * top * (1.0 - 0.003 * f64::from(attempt));
        let moving = Bound {
            wall: 0.0,
            speed: 1.0 / slope,
        };
        let mut bounds = vec![moving; eaves.len()];
        let mut work = Work::on(level, eaves, budget);
        work.storeys.storey(&bounds, 0.0, knee)?;
        for section in work.storeys.sections.iter_mut() {
            let plan = &work.storeys.plan;
            let flat: Rings = section
                .rings
                .iter()
                .map(|ring| ring.iter().map(|&node| plan[node as usize]).collect())
                .collect();
            let upright = Gables::Triangles.of(&Eaves::even(&flat)?, budget)?;
            for (edge, stands) in section.along.iter_mut().zip(upright) {
                work.edges.push(*edge);
                *edge = bounds.len() as u32;
                let speed = if stands { 0.0 } else { 1.0 / slope };
                bounds.push(Bound { wall: 0.0, speed });
            }
        }
        work.storeys.storey(&bounds, knee, knee + 2.0 * top)?;
        work.whole()
    })
}

fn tried(mut make: impl FnMut(u32) -> Result<Mesh, SkeletonError>) -> Result<Mesh, SkeletonError> {
    let mut attempt = 0;
    loop {
        match make(attempt) {
            Err(why @ SkeletonError::Spent(_)) => return Err(why),
            Err(_) if attempt + 1 < ATTEMPTS => attempt += 1,
            result => return result,
        }
    }
}

struct Work<'a> {
    storeys: Storeys<'a>,
    /// The edge of the eaves that each edge of the bounds is.
    edges: Vec<u32>,
}

impl<'a> Work<'a> {
    fn on(level: Level, eaves: &Eaves, budget: &'a dyn Budget) -> Self {
        let rings: Rings = (0..eaves.ring_count())
            .map(|ring| eaves.ring(ring).to_vec())
            .collect();
        Self {
            storeys: Storeys::on(level, &rings, budget),
            edges: (0..eaves.len() as u32).collect(),
        }
    }

    /// The solid with the pieces of each plane as one face.
    fn whole(self) -> Result<Mesh, SkeletonError> {
        if !self.storeys.sections.is_empty() {
            return Err(SkeletonError::Unbounded { face: 0 });
        }
        let origins = self.storeys.origins.clone();
        let mesh = self.storeys.closed();
        let mut planes: BTreeMap<(u32, bool), Vec<Vec<usize>>> = BTreeMap::new();
        let mut rings: Vec<Vec<Vec<u32>>> = Vec::with_capacity(mesh.face_count());
        for face in mesh.faces() {
            match origins.get(face.index()).copied().flatten() {
                Some((edge, moves)) => {
                    let key = (self.edges[edge as usize], moves);
                    let known = planes.entry(key).or_default();
                    match known
                        .iter_mut()
                        .find(|pieces| are_level(&mesh, pieces[0], face))
                    {
                        Some(pieces) => pieces.push(face.index()),
                        None => known.push(vec![face.index()]),
                    }
                }
                None => rings.push(face.rings().map(<[u32]>::to_vec).collect()),
            }
        }
        for faces in planes.values().flatten() {
            let normal = mesh.face(faces[0]).normal();
            let turned: Vec<Vec<u32>> = faces
                .iter()
                .flat_map(|&face| mesh.face(face).rings())
                .map(|ring| ring.iter().rev().copied().collect())
                .collect();
            rings.extend(close_in_plane(
                &mesh.points,
                turned.iter(),
                |_| true,
                normal,
            ));
        }
        Ok(straightened(&mesh, rings))
    }
}

/// Whether a face lies in the plane of another. Upright steps between edges, and what stands on
/// them, have the number of an edge and lie elsewhere.
fn are_level(mesh: &Mesh, one: usize, face: Face<'_>) -> bool {
    let (normal, origin) = (mesh.face(one).normal(), mesh.face(one).points().next());
    let same = normal.cross(face.normal()).length() <= SAME_PLANE;
    same && normal.dot(face.normal()) > 0.0
        && origin.is_some_and(|origin| {
            face.points().all(|point| {
                let to = point - origin;
                to.dot(normal).abs() <= SAME_PLANE * to.length()
            })
        })
}

/// The faces without points that lie on the straight side between two faces and no more.
fn straightened(mesh: &Mesh, mut faces: Vec<Vec<Vec<u32>>>) -> Mesh {
    let mut uses: HashMap<u32, usize> = HashMap::new();
    for &point in faces.iter().flatten().flatten() {
        *uses.entry(point).or_default() += 1;
    }
    let place = |point: u32| mesh.points[point as usize];
    for ring in faces.iter_mut().flatten() {
        let whole = ring.clone();
        let count = whole.len();
        let mut at = 0;
        ring.retain(|point| {
            let (before, after) = (whole[(at + count - 1) % count], whole[(at + 1) % count]);
            at += 1;
            let (a, b) = (place(*point) - place(before), place(after) - place(*point));
            let is_straight = a.cross(b).length() <= 1e-7 * a.length() * b.length();
            uses[point] != 2 || !is_straight
        });
    }
    let mut whole = Mesh::with_points(mesh.points.clone());
    for rings in &faces {
        whole.push_face(rings);
    }
    whole.compact()
}
