//! The edges of a face moved inwards or outwards, each by its own distance.

use std::collections::HashMap;

use super::level::Level;
use super::loops::close_in_plane;
use super::mesh::{Face, Mesh};
use crate::skeleton::{roof_within, Eaves, FaceOrigin, Roof, SkeletonError};
use crate::{Budget, Unlimited};

/// Places nearer to each other than this, as a share of the extent, are one.
const SAME_PLACE_SHARE: f64 = 1e-9;
/// How far a corner may reach beyond its edges, in distances that these move.
const LONGEST_MITRE: f64 = 50.0;
/// Distances below this share of the largest are none.
const NO_DISTANCE_SHARE: f64 = 1e-9;

pub(super) type Rings = Vec<Vec<[f64; 2]>>;

/// A face in pieces: the strip along each edge that has moved, and what is left.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pieces {
    /// The pieces share their points.
    pub mesh: Mesh,
    /// The edge of each piece, counted through all rings of the face; None for what is left.
    pub along: Vec<Option<u32>>,
}

/// A larger face around a face.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outset {
    /// The larger face.
    pub grown: Mesh,
    /// The edge of the face that each edge of the larger one comes from, through all rings.
    pub along: Vec<u32>,
    /// The face and the strips around it.
    pub pieces: Pieces,
}

/// The face with each edge moved inwards by its distance (the unit of the mesh, through all rings).
pub fn inset(mesh: &Mesh, face: Face<'_>, distances: &[f64]) -> Result<Pieces, SkeletonError> {
    inset_within(mesh, face, distances, &Unlimited)
}

/// [`inset`] within a budget.
pub fn inset_within(
    mesh: &Mesh,
    face: Face<'_>,
    distances: &[f64],
    budget: &dyn Budget,
) -> Result<Pieces, SkeletonError> {
    let level = Level::of(mesh, face);
    let rings = level.flat(mesh, face);
    let mut flat = FlatPieces::new(&rings);
    match moved(&rings, distances, budget)? {
        None => flat.push(None, &rings),
        Some(roof) => {
            let all = distances.iter().zip(0u32..);
            let moving: Vec<_> = all
                .map(|(&far, edge)| (far > 0.0).then_some(edge))
                .collect();
            flat.strips(&roof, &moving);
            let origin = origins(&roof);
            for rest in &roof.rest {
                let mut rings = rest.rings.clone();
                let edge = |side: (u32, u32)| origin.get(&(side.1, side.0)).copied();
                first_along(&mut rings[0], edge);
                flat.push(None, &places(&roof, &rings));
            }
        }
    }
    Ok(flat.raised(&level))
}

/// The face with each edge moved outwards by its distance; holes get smaller.
pub fn outset(mesh: &Mesh, face: Face<'_>, distances: &[f64]) -> Result<Outset, SkeletonError> {
    outset_within(mesh, face, distances, &Unlimited)
}

/// [`outset`] within a budget.
pub fn outset_within(
    mesh: &Mesh,
    face: Face<'_>,
    distances: &[f64],
    budget: &dyn Budget,
) -> Result<Outset, SkeletonError> {
    let level = Level::of(mesh, face);
    let rings = level.flat(mesh, face);
    let mut flat = FlatPieces::new(&rings);
    flat.push(None, &rings);
    let grown = grown(&rings, distances, budget, |roof, edges| {
        let moves = |edge: &u32| distances[*edge as usize] > 0.0;
        let moving: Vec<_> = edges.iter().map(|edge| edge.filter(moves)).collect();
        flat.strips(roof, &moving);
    })?;
    let place = |ring: &Vec<[f64; 2]>| ring.iter().map(|&p| level.place(p, 0.0)).collect();
    let larger: Vec<Vec<_>> = grown.rings.iter().map(place).collect();
    Ok(Outset {
        grown: Mesh::polygon(&larger),
        along: grown.along,
        pieces: flat.raised(&level),
    })
}

/// Coplanar faces of a mesh that share points as few faces with outlines around them.
pub fn merged(mesh: &Mesh, faces: &[usize]) -> Mesh {
    let Some(&first) = faces.first() else {
        return Mesh::new();
    };
    let reversed: Vec<Vec<u32>> = faces
        .iter()
        .flat_map(|&face| mesh.face(face).rings())
        .map(|ring| ring.iter().rev().copied().collect())
        .collect();
    let normal = mesh.face(first).normal();
    let whole = close_in_plane(&mesh.points, reversed.iter(), |_| true, normal);
    let mut result = Mesh::with_points(mesh.points.clone());
    for rings in &whole {
        result.push_face(rings);
    }
    result.compact()
}

pub(super) struct Grown {
    pub rings: Rings,
    pub along: Vec<u32>,
}

/// The larger polygon; `seen` gets each run of the skeleton with the edges of the polygon by those
/// of the run.
pub(super) fn grown(
    rings: &[Vec<[f64; 2]>],
    distances: &[f64],
    budget: &dyn Budget,
    mut seen: impl FnMut(&Roof, &[Option<u32>]),
) -> Result<Grown, SkeletonError> {
    let mut result = Grown {
        rings: Vec::new(),
        along: Vec::new(),
    };
    Eaves::new(rings, distances)?;
    let mut first = 0;
    for (index, ring) in rings.iter().enumerate() {
        let own = &distances[first..first + ring.len()];
        let around = turned(ring, first, own, index == 0);
        match moved(&around.rings, &around.distances, budget)? {
            None => {
                result.rings.push(ring.clone());
                result
                    .along
                    .extend((first..first + ring.len()).map(|edge| edge as u32));
            }
            Some(roof) => {
                seen(&roof, &around.edges);
                take_rest(&roof, &around.edges, index == 0, &mut result)?;
            }
        }
        first += ring.len();
    }
    Ok(result)
}

/// The outside of a ring as a polygon: that of the outline has a frame around it.
struct Around {
    rings: Rings,
    distances: Vec<f64>,
    edges: Vec<Option<u32>>,
}

fn turned(ring: &[[f64; 2]], first: usize, distances: &[f64], is_outline: bool) -> Around {
    let count = ring.len();
    let back = |k: usize| (2 * count - 2 - k) % count;
    let mut around = Around {
        rings: Vec::new(),
        distances: Vec::new(),
        edges: Vec::new(),
    };
    if is_outline {
        around.rings.push(frame(ring, distances));
        around.distances.extend([0.0; 4]);
        around.edges.extend([None; 4]);
    }
    around.rings.push(ring.iter().rev().copied().collect());
    around
        .distances
        .extend((0..count).map(|k| distances[back(k)]));
    around
        .edges
        .extend((0..count).map(|k| Some((first + back(k)) as u32)));
    around
}

fn frame(ring: &[[f64; 2]], distances: &[f64]) -> Vec<[f64; 2]> {
    let farthest = distances.iter().copied().fold(0.0, f64::max);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in ring {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let room = LONGEST_MITRE * farthest + (high[0] - low[0]).max(high[1] - low[1]);
    let (low, high) = (low.map(|c| c - room), high.map(|c| c + room));
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// The edge that each side of a roof's faces belongs to.
fn origins(roof: &Roof) -> HashMap<(u32, u32), u32> {
    let mut origin = HashMap::new();
    for face in &roof.faces {
        let (FaceOrigin::Edge(edge) | FaceOrigin::Step { before: edge, .. }) = face.origin;
        for (from, to) in face.rings.iter().flat_map(|ring| sides(ring)) {
            origin.insert((from, to), edge);
        }
    }
    origin
}

/// Turns a ring so that it begins with the side of the least edge.
fn first_along(ring: &mut [u32], edge: impl Fn((u32, u32)) -> Option<u32>) {
    let of_side = |side: (u32, u32)| edge(side).unwrap_or(u32::MAX);
    let least = sides(ring)
        .enumerate()
        .min_by_key(|(_, side)| of_side(*side));
    if let Some((place, _)) = least {
        ring.rotate_left(place);
    }
}

/// What is left around a ring, as rings of the larger polygon.
fn take_rest(
    roof: &Roof,
    edges: &[Option<u32>],
    is_outline: bool,
    result: &mut Grown,
) -> Result<(), SkeletonError> {
    let origin = origins(roof);
    let mut pockets = Vec::new();
    let mut outline = None;
    for level in &roof.rest {
        // The frame's polygon has the larger outline as its hole; others are pockets in it.
        let on_frame = |&(a, b): &(u32, u32)| {
            let edge = origin.get(&(b, a)).map(|&edge| edges[edge as usize]);
            edge == Some(None)
        };
        if is_outline && sides(&level.rings[0]).any(|side| on_frame(&side)) {
            if level.rings[0].len() != 4 || level.rings.len() != 2 || outline.is_some() {
                return Err(SkeletonError::TooPointed);
            }
            outline = Some(&level.rings[1]);
        } else {
            pockets.push(&level.rings[0]);
        }
    }
    if is_outline && outline.is_none() {
        return Err(SkeletonError::TooPointed);
    }
    for ring in outline.into_iter().chain(pockets) {
        let mut reversed: Vec<u32> = ring.iter().rev().copied().collect();
        let edge = |side| origin.get(&side).and_then(|&edge| edges[edge as usize]);
        first_along(&mut reversed, edge);
        for side in sides(&reversed) {
            let edge = origin.get(&side).and_then(|&edge| edges[edge as usize]);
            result.along.push(edge.ok_or(SkeletonError::TooPointed)?);
        }
        let plan = |&node: &u32| plan(roof, node);
        result.rings.push(reversed.iter().map(plan).collect());
    }
    Ok(())
}

fn sides(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().copied().zip(next.copied())
}

fn plan(roof: &Roof, node: u32) -> [f64; 2] {
    let [x, y, _] = roof.nodes_m[node as usize];
    [x, y]
}

fn places(roof: &Roof, rings: &[Vec<u32>]) -> Rings {
    let ring = |ring: &Vec<u32>| ring.iter().map(|&node| plan(roof, node)).collect();
    rings.iter().map(ring).collect()
}

/// The way of the edges as a roof: time is the share of the largest distance. None where no edge
/// moves.
fn moved(
    rings: &[Vec<[f64; 2]>],
    distances: &[f64],
    budget: &dyn Budget,
) -> Result<Option<Roof>, SkeletonError> {
    let farthest = distances.iter().copied().fold(0.0, f64::max);
    let share = |&distance: &f64| {
        let share = distance / farthest;
        if share.abs() < NO_DISTANCE_SHARE {
            0.0
        } else {
            share
        }
    };
    if farthest == 0.0 {
        return Eaves::new(rings, distances).map(|_| None);
    }
    let speeds: Vec<f64> = distances.iter().map(share).collect();
    roof_within(&Eaves::new(rings, &speeds)?, Some(farthest), budget).map(Some)
}

/// Pieces in the plane; places that are one are so once.
struct FlatPieces {
    near: f64,
    /// What has less area is nothing.
    least_area: f64,
    cells: HashMap<[i64; 2], Vec<u32>>,
    points: Vec<[f64; 2]>,
    faces: Vec<Vec<Vec<u32>>>,
    along: Vec<Option<u32>>,
}

impl FlatPieces {
    fn new(rings: &[Vec<[f64; 2]>]) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in rings.iter().flatten() {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let extent = (high[0] - low[0]).hypot(high[1] - low[1]);
        let near = SAME_PLACE_SHARE * extent;
        Self {
            near: if near > 0.0 { near } else { 1.0 },
            least_area: near * extent,
            cells: HashMap::new(),
            points: Vec::new(),
            faces: Vec::new(),
            along: Vec::new(),
        }
    }

    /// The faces of a roof seen from above; those that stand are nothing there.
    fn strips(&mut self, roof: &Roof, edges: &[Option<u32>]) {
        for face in &roof.faces {
            if let FaceOrigin::Edge(own) = face.origin {
                let Some(edge) = edges[own as usize] else {
                    continue;
                };
                // The vertices of the eaves come first, by the number of their edges.
                let mut rings = face.rings.clone();
                first_along(&mut rings[0], |(from, to)| {
                    (from == own && (to as usize) < edges.len()).then_some(0)
                });
                self.push(Some(edge), &places(roof, &rings));
            }
        }
    }

    fn push(&mut self, along: Option<u32>, rings: &[Vec<[f64; 2]>]) {
        let mut numbers = Vec::with_capacity(rings.len());
        for ring in rings {
            let mut own: Vec<u32> = ring.iter().map(|&point| self.number(point)).collect();
            own.dedup();
            while own.len() > 1 && own.first() == own.last() {
                own.pop();
            }
            if own.len() >= 3 && self.area(&own).abs() > self.least_area {
                numbers.push(own);
            } else if numbers.is_empty() {
                return;
            }
        }
        self.faces.push(numbers);
        self.along.push(along);
    }

    fn area(&self, ring: &[u32]) -> f64 {
        let place = |node: u32| self.points[node as usize];
        let [x0, y0] = place(ring[0]);
        let twice: f64 = sides(ring)
            .map(|(from, to)| {
                let ([ax, ay], [bx, by]) = (place(from), place(to));
                (ax - x0) * (by - y0) - (ay - y0) * (bx - x0)
            })
            .sum();
        0.5 * twice
    }

    fn number(&mut self, point: [f64; 2]) -> u32 {
        let size = 4.0 * self.near;
        let [column, row] = point.map(|c| (c / size).floor() as i64);
        for dx in -1..=1 {
            for dy in -1..=1 {
                let cell = [column.saturating_add(dx), row.saturating_add(dy)];
                for &known in self.cells.get(&cell).into_iter().flatten() {
                    let [x, y] = self.points[known as usize];
                    if (x - point[0]).hypot(y - point[1]) <= self.near {
                        return known;
                    }
                }
            }
        }
        let number = self.points.len() as u32;
        self.points.push(point);
        self.cells.entry([column, row]).or_default().push(number);
        number
    }

    fn raised(self, level: &Level) -> Pieces {
        let places = self.points.iter().map(|&p| level.place(p, 0.0));
        let mut mesh = Mesh::with_points(places.collect());
        for rings in &self.faces {
            mesh.push_face(rings);
        }
        Pieces {
            mesh: mesh.compact(),
            along: self.along,
        }
    }
}
