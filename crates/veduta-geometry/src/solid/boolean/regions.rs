//! A face to the regions between its segments.

use std::collections::{HashMap, HashSet};

use glam::{DVec2, DVec3};

use super::cuts::{Cuts, Segment};
use super::flat::{area, inner_place, is_in, Polygon};
use super::sides::side;
use super::Region;
use crate::{Budget, Spent};

/// What a corner of the other mesh costs that a region is looked at from, in steps of the budget.
const STEPS_PER_SEEN_CORNER: usize = 4;

/// The regions of all faces of a mesh.
pub fn of(cuts: &Cuts, which: usize, budget: &dyn Budget) -> Result<Vec<Region>, Spent> {
    let mut found = Vec::new();
    let others = &cuts.polygons[1 - which];
    let seen: usize = others.iter().map(Polygon::corner_count).sum();
    for (face, polygon) in cuts.polygons[which].iter().enumerate() {
        for rings in rings_of(cuts, which, face, budget)? {
            budget.take(STEPS_PER_SEEN_CORNER * seen)?;
            let flat: Vec<Vec<DVec2>> =
                rings.iter().map(|ring| flat(cuts, polygon, ring)).collect();
            let Some(place) = inner_place(&flat) else {
                continue;
            };
            let place = polygon.place(place);
            if polygon.holds(place, 0.0) {
                found.push(Region {
                    area: flat.iter().map(|ring| area(ring)).sum(),
                    side: side(cuts, which, face, place),
                    rings,
                    face,
                });
            }
        }
    }
    Ok(found)
}

fn flat(cuts: &Cuts, polygon: &Polygon, ring: &[u32]) -> Vec<DVec2> {
    let place = |&p: &u32| -> DVec3 { cuts.points[p as usize] };
    ring.iter().map(|p| polygon.flat(place(p))).collect()
}

/// The rings of each region: the outline, then the holes.
fn rings_of(
    cuts: &Cuts,
    which: usize,
    face: usize,
    budget: &dyn Budget,
) -> Result<Vec<Vec<Vec<u32>>>, Spent> {
    let polygon = &cuts.polygons[which][face];
    let segments = &cuts.segments[which][face];
    let is_whole = segments.len() == polygon.edges().count()
        && segments
            .iter()
            .all(|s| !cuts.between.contains_key(s) || cuts.between[s].is_empty());
    if is_whole {
        return Ok(vec![polygon.rings.clone()]);
    }
    let graph = Graph::new(divided(cuts, segments), |p| {
        polygon.flat(cuts.points[p as usize])
    });
    let parts = graph.parts();
    let (mut outlines, mut holes) = (Vec::new(), Vec::new());
    for ring in graph.loops() {
        let shape = flat(cuts, polygon, &ring);
        let area = area(&shape);
        if area > 0.0 {
            outlines.push((area, shape, parts[&ring[0]], vec![ring]));
        } else if area < 0.0 {
            holes.push((shape, ring));
        }
    }
    let corners: usize = outlines.iter().map(|(_, shape, ..)| shape.len()).sum();
    for (shape, ring) in holes {
        budget.take(corners)?;
        let part = parts[&ring[0]];
        let around = outlines
            .iter_mut()
            .filter(|(_, outline, other, _)| *other != part && is_in(&[outline], shape[0]))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((.., rings)) = around {
            rings.push(ring);
        }
    }
    Ok(outlines.into_iter().map(|(.., rings)| rings).collect())
}

/// The segments between neighbouring points, each once.
fn divided(cuts: &Cuts, segments: &[Segment]) -> Vec<Segment> {
    let mut all = HashSet::new();
    for &(from, to) in segments {
        let none = Vec::new();
        let between = cuts.between.get(&(from, to)).unwrap_or(&none);
        let mut last = from;
        for &next in between.iter().chain([&to]) {
            if next != last {
                all.insert((last.min(next), last.max(next)));
            }
            last = next;
        }
    }
    let mut all: Vec<Segment> = all.into_iter().collect();
    all.sort_unstable();
    all
}

/// Points with their neighbours in the order of their directions, counter-clockwise.
struct Graph {
    around: HashMap<u32, Vec<u32>>,
    starts: Vec<u32>,
}

impl Graph {
    /// What ends freely divides nothing, and is left out.
    fn new(segments: Vec<Segment>, flat: impl Fn(u32) -> DVec2) -> Self {
        let mut around: HashMap<u32, Vec<u32>> = HashMap::new();
        for (a, b) in segments {
            around.entry(a).or_default().push(b);
            around.entry(b).or_default().push(a);
        }
        let mut free: Vec<u32> = around
            .iter()
            .filter(|(_, n)| n.len() < 2)
            .map(|(&p, _)| p)
            .collect();
        while let Some(point) = free.pop() {
            for other in around.remove(&point).unwrap_or_default() {
                if let Some(neighbours) = around.get_mut(&other) {
                    neighbours.retain(|&p| p != point);
                    if neighbours.len() < 2 {
                        free.push(other);
                    }
                }
            }
        }
        for (&point, neighbours) in &mut around {
            let here = flat(point);
            let angle = |&other: &u32| (flat(other) - here).to_angle();
            neighbours.sort_by(|a, b| angle(a).total_cmp(&angle(b)).then(a.cmp(b)));
        }
        let mut starts: Vec<u32> = around.keys().copied().collect();
        starts.sort_unstable();
        Self { around, starts }
    }

    /// For each point the number of the connected part that it is in.
    fn parts(&self) -> HashMap<u32, usize> {
        let mut parts = HashMap::new();
        for &start in &self.starts {
            let part = parts.len();
            let mut open = vec![start];
            while let Some(point) = open.pop() {
                let is_new = parts.insert(point, part).is_none();
                if is_new {
                    open.extend(&self.around[&point]);
                }
            }
        }
        parts
    }

    /// The rings with what they enclose on their left, each directed edge in one of them.
    fn loops(&self) -> Vec<Vec<u32>> {
        let mut used: HashSet<Segment> = HashSet::new();
        let mut rings = Vec::new();
        for &start in &self.starts {
            for &second in &self.around[&start] {
                let mut ring = Vec::new();
                let (mut from, mut to) = (start, second);
                while used.insert((from, to)) {
                    ring.push(from);
                    let around = &self.around[&to];
                    let back = around.iter().position(|&p| p == from).unwrap_or(0);
                    let next = around[(back + around.len() - 1) % around.len()];
                    (from, to) = (to, next);
                }
                if ring.len() >= 3 {
                    rings.push(ring);
                }
            }
        }
        rings
    }
}
