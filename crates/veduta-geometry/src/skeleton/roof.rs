//! The roof over eaves: what the wavefront has drawn, as faces.

use super::check::check;
use super::eaves::ring_area_m2;
use super::front::{Front, Node, Side};
use super::nodes::{merged, rename, settle};
use super::planes::Lines;
use super::rings::{rings_of_faces, Rings, Untangler};
use super::simple::inside;
use super::sweep::{sweep, Rest};
use super::tolerance::{ATTEMPTS, SAME_LINE_SHARES, SAME_NODE_SHARE, SHORTEST_EDGE_SHARE};
use super::{Eaves, SkeletonError};
use crate::{Budget, Unlimited};

/// Where a face begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceOrigin {
    /// An edge of the eaves.
    Edge(u32),
    /// A standing step between two parallel edges of different speeds; the numbers are theirs.
    Step { before: u32, after: u32 },
}

/// A planar face: numbers of nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct RoofFace {
    pub origin: FaceOrigin,
    /// The outline, counter-clockwise seen from outside; then holes, clockwise. Only a face that
    /// overtakes a slower courtyard has any.
    pub rings: Vec<Vec<u32>>,
}

/// A level polygon that is left at the height to stop at: its outline, counter-clockwise from
/// above, and its holes, clockwise. A hole may touch the outline in a node.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    pub rings: Vec<Vec<u32>>,
}

/// A roof: x east, y north, z up (m), the eaves at height 0.
///
/// Every side of a face is a side of exactly one other face, or of a polygon of `rest`, in the
/// opposite direction; but for the eaves, which are sides of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Roof {
    /// The vertices of the eaves in their order, and then the inner nodes.
    pub nodes_m: Vec<[f64; 3]>,
    /// In the order of the edges, steps last. An edge whose face touches itself has several.
    pub faces: Vec<RoofFace>,
    /// The level polygons left at the height to stop at.
    pub rest: Vec<Level>,
    /// How often the wavefront was run; more than once where the first roof was not sound.
    pub attempts: u32,
}

/// The roof over eaves, up to its top or to `stop_m` above the eaves.
///
/// The result has passed [`check()`]; what cannot be built is an error, never half a roof.
pub fn roof(eaves: &Eaves, stop_m: Option<f64>) -> Result<Roof, SkeletonError> {
    roof_within(eaves, stop_m, &Unlimited)
}

/// [`roof`] within a budget.
pub fn roof_within(
    eaves: &Eaves,
    stop_m: Option<f64>,
    budget: &dyn Budget,
) -> Result<Roof, SkeletonError> {
    let least_m = SHORTEST_EDGE_SHARE * eaves.diagonal_m() / fastest(eaves);
    if let Some(height_m) = stop_m.filter(|&height| !height.is_finite() || height <= least_m) {
        return Err(SkeletonError::BadHeight { height_m, least_m });
    }
    let mut near_m = SAME_LINE_SHARES.map(|share| share * eaves.diagonal_m());
    let mut lines = Lines::of(eaves, near_m[0]);
    let mut attempt = 0;
    loop {
        let found = attempted(eaves, &lines, stop_m, attempt, budget).and_then(|mut roof| {
            check(eaves, &roof)?;
            roof.attempts = attempt as u32 + 1;
            Ok(roof)
        });
        attempt += 1;
        match found {
            Ok(roof) => return Ok(roof),
            Err(why @ (SkeletonError::Unbounded { .. } | SkeletonError::Spent(_))) => {
                return Err(why)
            }
            Err(why) if attempt == ATTEMPTS => return Err(why),
            Err(SkeletonError::NearlyParallel { .. }) => {
                near_m.rotate_left(1);
                lines = Lines::of(eaves, near_m[0]);
            }
            Err(_) => {}
        }
    }
}

fn attempted(
    eaves: &Eaves,
    lines: &Lines,
    stop_m: Option<f64>,
    attempt: u64,
    budget: &dyn Budget,
) -> Result<Roof, SkeletonError> {
    let fastest = fastest(eaves);
    let moving = eaves.speeds().iter().filter(|&&speed| speed > 0.0);
    let slowest = moving.copied().fold(fastest, f64::min);
    let diagonal_m = eaves.diagonal_m();
    // No edge that moves can have moved farther than the diagonal.
    let last = 2.0 * diagonal_m * fastest / slowest;
    let mut front = Front::on_eaves(eaves, lines.planes(eaves, fastest, attempt))?;
    let stop = stop_m.map(|height| height * fastest);
    let rests = sweep(&mut front, stop, last, diagonal_m, budget)?;
    let made = Drawing {
        eaves,
        lines,
        front,
        stop,
    }
    .roof(rests, fastest);
    match made.rest.first() {
        Some(rest) if stop_m.is_none() => {
            let node = rest.rings[0][0];
            let has_node = |face: &RoofFace| face.rings.iter().flatten().any(|&n| n == node);
            let face = made.faces.iter().position(has_node).unwrap_or(0);
            Err(SkeletonError::Unbounded { face })
        }
        _ => Ok(made),
    }
}

/// The highest speed, or 1 where all edges stand.
fn fastest(eaves: &Eaves) -> f64 {
    match eaves.speeds().iter().copied().fold(0.0, f64::max) {
        0.0 => 1.0,
        fastest => fastest,
    }
}

struct Drawing<'a> {
    eaves: &'a Eaves,
    lines: &'a Lines,
    front: Front,
    stop: Option<f64>,
}

impl Drawing<'_> {
    fn roof(mut self, rests: Vec<Rest>, fastest: f64) -> Roof {
        let near = SAME_NODE_SHARE * self.eaves.diagonal_m();
        let faces = self.front.planes.len();
        for rest in &rests {
            let next = rest.iter().cycle().skip(1);
            let sides = rest.iter().zip(next);
            let rest_face = faces as u32;
            self.front.sides.extend(sides.map(|(&from, &to)| Side {
                face: rest_face,
                from,
                to,
            }));
        }
        let name = merged(&self.front.nodes, &self.front.sides, near);
        let mut rings = rings_of_faces(&mut self.front.sides, faces + 1);
        let mut untangler = Untangler::new(self.front.nodes.len());
        rename(&mut rings, &name, &mut untangler);
        let rest_rings = rings.pop().unwrap_or_default();
        let level = self.stop.map(|time| (&rest_rings, time));
        let (first, most) = (self.eaves.len(), 4.0 * near);
        settle(&mut self.front, self.lines, &rings, level, first, most);
        let mut made = Roof {
            nodes_m: Vec::new(),
            faces: Vec::with_capacity(faces),
            rest: Vec::new(),
            attempts: 0,
        };
        for (face, of_face) in rings.into_iter().enumerate() {
            let origin = self.origin(face);
            let pieces = self.pieces(face, of_face);
            made.faces
                .extend(pieces.into_iter().map(|rings| RoofFace { origin, rings }));
        }
        let place = |node: u32| self.front.nodes[node as usize].place_m;
        made.rest = nested(rest_rings, place)
            .into_iter()
            .map(|rings| Level { rings })
            .collect();
        self.number(&mut made, fastest);
        made
    }

    fn origin(&self, face: usize) -> FaceOrigin {
        if face < self.eaves.len() {
            FaceOrigin::Edge(face as u32)
        } else {
            let (before, after) = self.front.step_between(face as u32);
            FaceOrigin::Step { before, after }
        }
    }

    /// The polygons of a face, in its own plane: along the edge, and up.
    fn pieces(&self, face: usize, rings: Rings) -> Vec<Rings> {
        if rings.len() == 1 {
            return vec![rings];
        }
        let plane = &self.front.planes[face];
        let (along, normal) = (plane.quick_along(), plane.quick_normal);
        let flat = |node: u32| {
            let Node { place_m, time } = self.front.nodes[node as usize];
            let up = if plane.speed > 0.0 {
                normal[0] * place_m[0] + normal[1] * place_m[1]
            } else {
                time
            };
            [along[0] * place_m[0] + along[1] * place_m[1], up]
        };
        nested(rings, flat)
    }

    /// Numbers the nodes that are in use: the vertices of the eaves first, then as they come.
    fn number(&self, roof: &mut Roof, fastest: f64) {
        let mut number: Vec<Option<u32>> = vec![None; self.front.nodes.len()];
        for (vertex, point) in self.eaves.points_m().iter().enumerate() {
            number[vertex] = Some(vertex as u32);
            roof.nodes_m.push([point[0], point[1], 0.0]);
        }
        let centre = self.eaves.centre_m();
        let of_faces = roof.faces.iter_mut().flat_map(|face| &mut face.rings);
        let of_rest = roof.rest.iter_mut().flat_map(|rest| &mut rest.rings);
        for node in of_faces.chain(of_rest).flatten() {
            let known = &mut number[*node as usize];
            *node = *known.get_or_insert_with(|| {
                let Node { place_m, time } = self.front.nodes[*node as usize];
                let [x, y] = place_m;
                roof.nodes_m
                    .push([x + centre[0], y + centre[1], time / fastest]);
                roof.nodes_m.len() as u32 - 1
            });
        }
    }
}

/// Sorts simple rings into polygons: outlines, each with the holes in it.
fn nested(rings: Rings, place: impl Fn(u32) -> [f64; 2]) -> Vec<Rings> {
    let flat = |ring: &[u32]| ring.iter().map(|&node| place(node)).collect::<Vec<_>>();
    let (outlines, holes): (Rings, Rings) = rings
        .into_iter()
        .partition(|ring| ring_area_m2(&flat(ring)) >= 0.0);
    let places: Vec<Vec<[f64; 2]>> = outlines.iter().map(|ring| flat(ring)).collect();
    let mut polygons: Vec<Rings> = outlines.into_iter().map(|ring| vec![ring]).collect();
    for hole in holes {
        let around = |outline: &Vec<[f64; 2]>| hole.iter().any(|&n| inside(place(n), outline));
        match places.iter().position(around) {
            Some(outline) => polygons[outline].push(hole),
            None => polygons.push(vec![hole]),
        }
    }
    polygons
}
