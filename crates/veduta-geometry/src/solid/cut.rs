//! A mesh to the two sides of a plane across an axis, exactly along shared points.
//!
//! Points within the tolerance of the plane lie in it and are used as they are, so nothing is cut
//! twice and no sliver appears. A side in the plane belongs to the part of its face that it bounds;
//! a whole face in the plane counts as above it. What is cut through
//! gets its points once per edge, so both faces at that edge share them and solids stay closed.

use std::collections::HashMap;

use glam::DVec3;

use super::loops::close_in_plane;
use super::mesh::{Face, Mesh};

/// What lies below and above the plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sides {
    pub below: Piece,
    pub above: Piece,
}

/// One side of a cut, with the face of the original that each face is a part of; None for a cap.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Piece {
    pub mesh: Mesh,
    pub sources: Vec<Option<u32>>,
}

/// Cuts `mesh` where the coordinate `axis` (0, 1, 2) is `at`; `tolerance` is in its unit.
///
/// With `solid`, the mesh is closed, and so are both sides: each cut surface gets a cap.
pub fn cut(mesh: &Mesh, axis: usize, at: f64, tolerance: f64, solid: bool) -> Sides {
    let mut cutter = Cutter::new(mesh, axis, at, tolerance);
    let mut sides = [Builder::default(), Builder::default()];
    for face in mesh.faces() {
        cutter.cut_face(face, &mut sides, solid);
    }
    let [below, above] = sides;
    Sides {
        below: below.finish(&cutter, solid, 1.0),
        above: above.finish(&cutter, solid, -1.0),
    }
}

/// The faces of `mesh` cut along the planes where the coordinate `axis` is one of `levels`, as one
/// mesh over shared points; and for each face that of the original which it is a part of. The
/// points of the original keep their numbers.
///
/// A face of which `whole` says so is not cut, but gets the points where the planes cross its edges.
pub fn scored(
    mesh: &Mesh,
    axis: usize,
    levels: &[f64],
    tolerance: f64,
    whole: impl Fn(u32) -> bool,
) -> (Mesh, Vec<u32>) {
    let mut now = mesh.clone();
    let mut sources: Vec<u32> = (0..mesh.face_count() as u32).collect();
    for &at in levels {
        let mut cutter = Cutter::new(&now, axis, at, tolerance);
        let mut faces = Vec::with_capacity(now.face_count());
        for face in now.faces() {
            let source = sources[face.index()];
            if whole(source) {
                let rings = face.rings().map(|ring| cutter.with_crossings(ring));
                faces.push((rings.collect(), source));
                continue;
            }
            let mut sides = [Builder::default(), Builder::default()];
            cutter.cut_face(face, &mut sides, false);
            let parts = sides.into_iter().flat_map(|side| side.faces);
            faces.extend(parts.map(|(rings, _)| (rings, source)));
        }
        now = Mesh::with_points(cutter.points);
        sources.clear();
        for (rings, source) in &faces {
            now.push_face(rings);
            sources.push(*source);
        }
    }
    (now, sources)
}

const BELOW: usize = 0;
const ABOVE: usize = 1;

struct Cutter {
    axis: usize,
    /// How far each point lies above the plane; 0 on it.
    height: Vec<f64>,
    /// All points, those of the cuts after those of the mesh.
    points: Vec<DVec3>,
    on_edge: HashMap<(u32, u32), u32>,
}

/// The faces of one side, in point numbers of the cutter.
#[derive(Default)]
struct Builder {
    faces: Vec<(Vec<Vec<u32>>, u32)>,
}

/// An edge of a ring that does not cross the plane, or a part of one up to where it does.
struct Edge {
    from: u32,
    to: u32,
    side: usize,
}

/// A part of a ring on one side: it begins and ends on the plane.
struct Chain {
    points: Vec<u32>,
}

impl Cutter {
    fn new(mesh: &Mesh, axis: usize, at: f64, tolerance: f64) -> Self {
        let height = |p: &DVec3| {
            let above = p[axis] - at;
            if above.abs() <= tolerance {
                0.0
            } else {
                above
            }
        };
        Self {
            axis,
            height: mesh.points.iter().map(height).collect(),
            points: mesh.points.clone(),
            on_edge: HashMap::new(),
        }
    }

    fn cut_face(&mut self, face: Face<'_>, sides: &mut [Builder; 2], solid: bool) {
        let source = face.index() as u32;
        let on_plane = face
            .rings()
            .flatten()
            .all(|&p| self.height[p as usize] == 0.0);
        if on_plane && solid {
            return; // the caps are there instead
        }
        let mut whole: [Vec<Vec<u32>>; 2] = Default::default();
        let mut chains: [Vec<Chain>; 2] = Default::default();
        let normal = face.normal();
        for ring in face.rings() {
            self.cut_ring(ring, normal, &mut whole, &mut chains);
        }
        for side in [BELOW, ABOVE] {
            let parts = std::mem::take(&mut chains[side]);
            let mut rings = self.joined(parts, face, side);
            rings.append(&mut whole[side]);
            for rings in self.nested(rings, face) {
                sides[side].faces.push((rings, source));
            }
        }
    }

    /// A ring goes whole to its side, or in chains to both.
    fn cut_ring(
        &mut self,
        ring: &[u32],
        normal: DVec3,
        whole: &mut [Vec<Vec<u32>>; 2],
        chains: &mut [Vec<Chain>; 2],
    ) {
        let steps = self.steps(ring, normal);
        let count = steps.len();
        let breaks = |k: usize| {
            let (before, here) = (&steps[(k + count - 1) % count], &steps[k]);
            before.side != here.side || self.wraps_round(before, here, normal)
        };
        let Some(first) = (0..count).find(|&k| breaks(k)) else {
            whole[steps[0].side].push(ring.to_vec());
            return;
        };
        let mut points = vec![steps[first].from];
        for k in (first..first + count).map(|k| k % count) {
            let (here, next) = (&steps[k], &steps[(k + 1) % count]);
            push_new(&mut points, here.to);
            if breaks((k + 1) % count) {
                let done = std::mem::replace(&mut points, vec![here.to]);
                chains[here.side].push(Chain { points: done });
                if here.side == next.side {
                    let points = vec![here.to];
                    chains[1 - here.side].push(Chain { points });
                }
            }
        }
    }

    /// The edges of a ring, those that cross the plane in two.
    fn steps(&mut self, ring: &[u32], normal: DVec3) -> Vec<Edge> {
        let mut steps = Vec::with_capacity(ring.len() + 2);
        for (k, &from) in ring.iter().enumerate() {
            let to = ring[(k + 1) % ring.len()];
            let (a, b) = (self.height[from as usize], self.height[to as usize]);
            let side = if a == 0.0 && b == 0.0 {
                let along = self.points[to as usize] - self.points[from as usize];
                let inwards = normal.cross(along)[self.axis];
                usize::from(inwards >= 0.0)
            } else {
                usize::from(a > 0.0 || (a == 0.0 && b > 0.0))
            };
            if a * b < 0.0 {
                let at = self.crossing(from, to);
                let (first, last) = (usize::from(a > 0.0), usize::from(b > 0.0));
                steps.push(Edge {
                    from,
                    to: at,
                    side: first,
                });
                steps.push(Edge {
                    from: at,
                    to,
                    side: last,
                });
            } else {
                steps.push(Edge { from, to, side });
            }
        }
        steps
    }

    /// Whether a face goes round a point in the plane, from two edges on one side to the other side.
    fn wraps_round(&self, before: &Edge, after: &Edge, normal: DVec3) -> bool {
        let [a, b, c] = [before.from, after.from, after.to].map(|p| self.points[p as usize]);
        let is_touched = self.height[after.from as usize] == 0.0;
        let is_off = |point: u32| self.height[point as usize] != 0.0;
        is_touched
            && is_off(before.from)
            && is_off(after.to)
            && (b - a).cross(c - b).dot(normal) < 0.0
    }

    /// The point where an edge crosses the plane.
    fn crossing(&mut self, from: u32, to: u32) -> u32 {
        let key = (from.min(to), from.max(to));
        if let Some(&known) = self.on_edge.get(&key) {
            return known;
        }
        let (low, high) = (self.points[key.0 as usize], self.points[key.1 as usize]);
        let (h0, h1) = (self.height[key.0 as usize], self.height[key.1 as usize]);
        let mut point = low + (high - low) * (h0 / (h0 - h1));
        point[self.axis] = low[self.axis] - h0;
        let number = self.points.len() as u32;
        self.points.push(point);
        self.height.push(0.0);
        self.on_edge.insert(key, number);
        number
    }

    /// A ring with the points where the plane crosses it.
    fn with_crossings(&mut self, ring: &[u32]) -> Vec<u32> {
        let mut points = Vec::with_capacity(ring.len() + 2);
        for (k, &here) in ring.iter().enumerate() {
            let next = ring[(k + 1) % ring.len()];
            points.push(here);
            if self.height[here as usize] * self.height[next as usize] < 0.0 {
                points.push(self.crossing(here, next));
            }
        }
        points
    }

    /// Chains to rings: on the plane, an end is followed by the next beginning along the line.
    ///
    /// With the inside of the face on the left, ends and beginnings alternate along the line in
    /// which the plane cuts the face; those at one place are taken in the order that alternates.
    fn joined(&self, chains: Vec<Chain>, face: Face<'_>, side: usize) -> Vec<Vec<u32>> {
        if chains.is_empty() {
            return Vec::new();
        }
        let mut up = DVec3::ZERO;
        up[self.axis] = if side == BELOW { 1.0 } else { -1.0 };
        let along = up.cross(face.normal());
        let place = |point: u32| self.points[point as usize].dot(along);
        let mut stops: Vec<(f64, bool, usize)> = Vec::with_capacity(2 * chains.len());
        for (index, chain) in chains.iter().enumerate() {
            stops.push((place(chain.points[0]), true, index));
            stops.push((place(chain.points[chain.points.len() - 1]), false, index));
        }
        stops.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let followers = alternating(stops, chains.len());
        rings_of(chains, &followers)
    }

    /// Rings to faces: each hole into the outline around it.
    fn nested(&self, rings: Vec<Vec<u32>>, face: Face<'_>) -> Vec<Vec<Vec<u32>>> {
        if rings.len() <= 1 {
            return rings.into_iter().map(|ring| vec![ring]).collect();
        }
        super::loops::nested(&self.points, rings, face.normal())
    }
}

/// The chain that follows each chain, from the stops (place, whether a beginning, chain) in order.
fn alternating(mut stops: Vec<(f64, bool, usize)>, count: usize) -> Vec<usize> {
    let mut followers: Vec<usize> = (0..count).collect();
    let mut k = 0;
    while k + 1 < stops.len() {
        for (offset, wanted) in [(0, false), (1, true)] {
            let here = k + offset;
            if stops[here].1 != wanted {
                let swap = (here + 1..stops.len()).find(|&other| stops[other].1 == wanted);
                if let Some(other) = swap {
                    stops.swap(here, other);
                }
            }
        }
        followers[stops[k].2] = stops[k + 1].2;
        k += 2;
    }
    followers
}

fn rings_of(chains: Vec<Chain>, followers: &[usize]) -> Vec<Vec<u32>> {
    let mut used = vec![false; chains.len()];
    let mut rings = Vec::new();
    for start in 0..chains.len() {
        let mut ring: Vec<u32> = Vec::new();
        let mut at = start;
        while !used[at] {
            used[at] = true;
            for &point in &chains[at].points {
                push_new(&mut ring, point);
            }
            at = followers[at];
        }
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        if ring.len() >= 3 {
            rings.push(ring);
        }
    }
    rings
}

fn push_new(points: &mut Vec<u32>, point: u32) {
    if points.last() != Some(&point) {
        points.push(point);
    }
}

impl Builder {
    /// The faces with their points numbered anew; `outward` is the sign of a cap's normal.
    fn finish(mut self, cutter: &Cutter, solid: bool, outward: f64) -> Piece {
        let caps = if solid {
            let edges = self.faces.iter().flat_map(|(rings, _)| rings);
            let flat = |p: u32| cutter.height[p as usize] == 0.0;
            let mut normal = DVec3::ZERO;
            normal[cutter.axis] = outward;
            close_in_plane(&cutter.points, edges, flat, normal)
        } else {
            Vec::new()
        };
        let parts = self.faces.len();
        self.faces.extend(caps.into_iter().map(|rings| (rings, 0)));
        let mut numbers: HashMap<u32, u32> = HashMap::new();
        let mut piece = Piece::default();
        for (index, (rings, source)) in self.faces.iter().enumerate() {
            let renumbered: Vec<Vec<u32>> = rings
                .iter()
                .map(|ring| {
                    let number = |&p: &u32| {
                        *numbers
                            .entry(p)
                            .or_insert_with(|| piece.mesh.push_point(cutter.points[p as usize]))
                    };
                    ring.iter().map(number).collect()
                })
                .collect();
            piece.mesh.push_face(&renumbered);
            piece.sources.push((index < parts).then_some(*source));
        }
        piece
    }
}
