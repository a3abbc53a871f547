//! The space over a face that upright walls and slopes above them leave.

use std::collections::HashMap;

use super::inset::Rings;
use super::level::Level;
use super::mesh::{Face, Mesh};
use crate::skeleton::{roof_within, Eaves, FaceOrigin, SkeletonError};
use crate::{Budget, Unlimited};

/// What an edge of a storey costs, in steps of the budget.
const STEPS_PER_EDGE: usize = 16;

/// How an edge of a face bounds the space over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// How high the wall over the edge is.
    pub wall: f64,
    /// How far the edge moves inwards with each unit of height above its wall.
    pub speed: f64,
}

/// The closed solid over a face within the bounds of its edges (counted through all rings), cut
/// off level at the height `most`. Lengths are in the unit of the mesh.
///
/// It is built in storeys: from one top of a wall to the next, some edges stand and some move.
pub fn envelope(
    mesh: &Mesh,
    face: Face<'_>,
    bounds: &[Bound],
    most: f64,
) -> Result<Mesh, SkeletonError> {
    envelope_within(mesh, face, bounds, most, &Unlimited)
}

/// [`envelope`] within a budget.
pub fn envelope_within(
    mesh: &Mesh,
    face: Face<'_>,
    bounds: &[Bound],
    most: f64,
    budget: &dyn Budget,
) -> Result<Mesh, SkeletonError> {
    let level = Level::of(mesh, face);
    let flat = level.flat(mesh, face);
    let mut heights: Vec<f64> = bounds.iter().map(|bound| bound.wall).collect();
    heights.retain(|&wall| wall > 0.0 && wall < most);
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    heights.push(most);
    let mut work = Storeys::on(level, &flat, budget);
    let mut low = 0.0;
    for high in heights {
        work.storey(bounds, low, high)?;
        low = high;
    }
    Ok(work.closed())
}

/// A level polygon on its way up: node numbers of its rings, and the edge of the face that each of
/// its edges comes from.
pub(super) struct Section {
    pub rings: Vec<Vec<u32>>,
    pub along: Vec<u32>,
}

pub(super) struct Storeys<'a> {
    budget: &'a dyn Budget,
    level: Level,
    solid: Mesh,
    /// Each point of the solid in the plane of the face.
    pub plan: Vec<[f64; 2]>,
    pub sections: Vec<Section>,
    /// For each face the edge that it stands over, and whether it moves; None for the floor.
    pub origins: Vec<Option<(u32, bool)>>,
}

impl<'a> Storeys<'a> {
    pub fn on(level: Level, flat: &Rings, budget: &'a dyn Budget) -> Self {
        let mut work = Self {
            budget,
            level,
            solid: Mesh::new(),
            plan: Vec::new(),
            sections: Vec::new(),
            origins: vec![None],
        };
        let mut rings = Vec::with_capacity(flat.len());
        for ring in flat {
            rings.push(ring.iter().map(|&p| work.point(p, 0.0)).collect::<Vec<_>>());
        }
        let floor: Vec<Vec<u32>> = rings
            .iter()
            .map(|ring| ring.iter().rev().copied().collect())
            .collect();
        work.solid.push_face(&floor);
        let along = (0..work.plan.len() as u32).collect();
        work.sections.push(Section { rings, along });
        work
    }

    fn point(&mut self, plan: [f64; 2], height: f64) -> u32 {
        self.plan.push(plan);
        self.solid.push_point(self.level.place(plan, height))
    }

    /// Goes on from the height `low` to `high`: an edge whose wall is not higher than `low` moves.
    pub fn storey(&mut self, bounds: &[Bound], low: f64, high: f64) -> Result<(), SkeletonError> {
        for section in std::mem::take(&mut self.sections) {
            self.budget.take(STEPS_PER_EDGE * section.along.len())?;
            let speed = |&edge: &u32| {
                let bound = &bounds[edge as usize];
                if bound.wall <= low {
                    bound.speed
                } else {
                    0.0
                }
            };
            let speeds: Vec<f64> = section.along.iter().map(speed).collect();
            if speeds.iter().all(|&speed| speed == 0.0) {
                self.walls(section, high);
            } else {
                self.slopes(section, &speeds, low, high)?;
            }
        }
        Ok(())
    }

    /// All edges stand.
    fn walls(&mut self, section: Section, high: f64) {
        let mut rings = Vec::with_capacity(section.rings.len());
        let mut edge = 0;
        for ring in &section.rings {
            let upper: Vec<u32> = ring
                .iter()
                .map(|&node| self.point(self.plan[node as usize], high))
                .collect();
            for k in 0..ring.len() {
                let next = (k + 1) % ring.len();
                self.solid
                    .push_face(&[[ring[k], ring[next], upper[next], upper[k]]]);
                self.origins.push(Some((section.along[edge], false)));
                edge += 1;
            }
            rings.push(upper);
        }
        self.sections.push(Section { rings, ..section });
    }

    fn slopes(
        &mut self,
        section: Section,
        speeds: &[f64],
        low: f64,
        high: f64,
    ) -> Result<(), SkeletonError> {
        let place = |&node: &u32| self.plan[node as usize];
        let flat: Rings = section
            .rings
            .iter()
            .map(|ring| ring.iter().map(place).collect())
            .collect();
        let eaves = Eaves::new(&flat, speeds)?;
        let found = roof_within(&eaves, Some(high - low), self.budget)?;
        let mut numbers: Vec<u32> = section.rings.concat();
        for &[x, y, z] in &found.nodes_m[numbers.len()..] {
            numbers.push(self.point([x, y], low + z));
        }
        let named = |ring: &Vec<u32>| ring.iter().map(|&n| numbers[n as usize]).collect();
        let mut origin: HashMap<(u32, u32), u32> = HashMap::new();
        for face in &found.faces {
            let (FaceOrigin::Edge(edge) | FaceOrigin::Step { before: edge, .. }) = face.origin;
            let rings: Vec<Vec<u32>> = face.rings.iter().map(named).collect();
            for (from, to) in rings.iter().flat_map(|ring| sides(ring)) {
                origin.insert((to, from), section.along[edge as usize]);
            }
            self.solid.push_face(&rings);
            let along = section.along[edge as usize];
            let is_step = matches!(face.origin, FaceOrigin::Step { .. });
            let moves = !is_step && speeds[edge as usize] > 0.0;
            self.origins.push(Some((along, moves)));
        }
        for rest in &found.rest {
            let rings: Vec<Vec<u32>> = rest.rings.iter().map(named).collect();
            let edge = |side: (u32, u32)| origin.get(&side).copied().unwrap_or(0);
            let along = rings
                .iter()
                .flat_map(|ring| sides(ring))
                .map(edge)
                .collect();
            self.sections.push(Section { rings, along });
        }
        Ok(())
    }

    /// What is left on top is closed level.
    pub fn closed(mut self) -> Mesh {
        for section in &self.sections {
            self.solid.push_face(&section.rings);
        }
        self.solid.compact()
    }
}

fn sides(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().copied().zip(next.copied())
}
