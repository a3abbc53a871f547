//! PatchMatch over planes: good ones spread over a chequerboard, and are varied.
//!
//! Bleyer et al. 2011 (PatchMatch Stereo) for slanted windows, Galliani et al. 2015 (Massively
//! parallel multiview stereopsis) for the chequerboard, Xu and Tao 2019 (Multi-scale geometric
//! consistency guided multi-view stereo) for where candidates come from, and for the consistency
//! with the neighbours' depths as a part of the cost.

use rayon::prelude::*;

use crate::camera::{Camera, Transfer};
use crate::chance::Chance;
use crate::error::StereoError;
use crate::grey::Grey;
use crate::patch::{Patch, Window, SIDE, WORST};
use crate::planes::{Plane, Planes};

/// A view that the reference is compared with.
pub struct Neighbour<'a> {
    pub image: &'a Grey,
    pub camera: Camera,
    /// Its depths (m, NaN where unknown) at its picture's size, once there are some.
    pub depths: Option<&'a [f32]>,
}

/// How planes are looked for.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    pub window: Window,
    /// Rounds over both colours of the chequerboard.
    pub sweeps: usize,
    /// Depths that are looked at (m).
    pub near: f32,
    pub far: f32,
    /// Views whose costs are averaged: the best so many, the others may be hidden.
    pub views: usize,
    /// Cost of a pixel by which a neighbour's depth leads back elsewhere, and the most that counts.
    pub consistency: f32,
    pub most_px: f32,
    /// First variation: share of the depth, and of a unit normal; each sweep halves them.
    pub vary_depth: f32,
    pub vary_normal: f32,
    pub seed: u64,
}

impl Search {
    /// By how much inverse depths (1/m) and slopes (1/m/px) differ where planes are told apart.
    pub fn same(&self, there: impl Iterator<Item = Transfer>) -> [f32; 2] {
        // So far a view's pixel moves at most with the inverse depth (px m).
        let reach = there.map(|one| one.near[0].hypot(one.near[1]));
        let inverse = SAME_PX / reach.fold(1e-6, f32::max);
        [inverse, inverse / (self.window.step_px * (SIDE / 2) as f32)]
    }
}

/// Pixels from which candidates come, in eight groups; each group gives its best.
pub const GROUPS: [&[(i32, i32)]; 8] = [
    &[(-1, 0), (-2, -1), (-2, 1)],
    &[(1, 0), (2, -1), (2, 1)],
    &[(0, -1), (-1, -2), (1, -2)],
    &[(0, 1), (-1, 2), (1, 2)],
    &[(-3, 0), (-5, 0), (-9, 0), (-15, 0)],
    &[(3, 0), (5, 0), (9, 0), (15, 0)],
    &[(0, -3), (0, -5), (0, -9), (0, -15)],
    &[(0, 3), (0, 5), (0, 9), (0, 15)],
];
/// Candidates that move no sample of a window by more are the plane at hand: they are not looked at.
const SAME_PX: f32 = 0.1;
/// Neighbours at most; others are left out.
pub const MOST_VIEWS: usize = 16;

struct Scene<'a> {
    image: &'a Grey,
    camera: Camera,
    neighbours: &'a [Neighbour<'a>],
    /// To each neighbour, and back.
    there: Vec<Transfer>,
    back: Vec<Transfer>,
    search: Search,
    /// Planes are one that differ by less.
    same: [f32; 2],
}

/// Planes for every pixel of the reference. start: those to go on from, else random ones.
pub fn search(
    image: &Grey,
    camera: Camera,
    neighbours: &[Neighbour<'_>],
    start: Option<Planes>,
    search: Search,
) -> Result<Planes, StereoError> {
    let scene = Scene::new(image, camera, neighbours, search)?;
    let (width, height) = (image.width, image.height);
    let mut found = scene.begun(start);
    found.costs = (0..width * height)
        .into_par_iter()
        .map(|i| {
            let (x, y) = (i % width, i / width);
            let patch = Patch::new(image, x, y, &search.window);
            scene.cost(&patch, x, y, found.planes[i], f32::INFINITY)
        })
        .collect();
    for sweep in 0..search.sweeps {
        for colour in 0..2 {
            scene.sweep(&mut found, sweep, colour);
        }
    }
    Ok(found)
}

/// What a search begins with, costs not yet counted: for other engines than this one.
pub fn begun(
    image: &Grey,
    camera: Camera,
    neighbours: &[Neighbour<'_>],
    start: Option<Planes>,
    search: Search,
) -> Result<Planes, StereoError> {
    Ok(Scene::new(image, camera, neighbours, search)?.begun(start))
}

impl<'a> Scene<'a> {
    fn new(
        image: &'a Grey,
        camera: Camera,
        neighbours: &'a [Neighbour<'a>],
        search: Search,
    ) -> Result<Self, StereoError> {
        let range = search.near > 0.0 && search.far > search.near && search.far.is_finite();
        if !range {
            return Err(StereoError::Range {
                near: search.near,
                far: search.far,
            });
        }
        if neighbours.is_empty() {
            return Err(StereoError::NoNeighbour);
        }
        for one in neighbours {
            let wanted = one.image.width * one.image.height;
            if let Some(depths) = one.depths.filter(|depths| depths.len() != wanted) {
                return Err(StereoError::Size {
                    width: one.image.width,
                    height: one.image.height,
                    given: depths.len(),
                });
            }
        }
        let neighbours = &neighbours[..neighbours.len().min(MOST_VIEWS)];
        let there = neighbours.iter();
        let there: Vec<Transfer> = there
            .map(|one| Transfer::new(&camera, &one.camera))
            .collect();
        Ok(Self {
            image,
            camera,
            neighbours,
            same: search.same(there.iter().copied()),
            there,
            back: neighbours
                .iter()
                .map(|one| Transfer::new(&one.camera, &camera))
                .collect(),
            search,
        })
    }

    fn begun(&self, start: Option<Planes>) -> Planes {
        match start {
            Some(start) => start.resized(self.image.width, self.image.height),
            None => self.random(),
        }
    }

    fn ray(&self, x: usize, y: usize) -> [f32; 3] {
        let ray = self.camera.ray([x as f64 + 0.5, y as f64 + 0.5]);
        let length = crate::camera::dot(ray, ray).sqrt();
        ray.map(|one| (one / length) as f32)
    }

    fn drawn(&self, chance: &mut Chance, x: usize, y: usize) -> Plane {
        let inverse = chance.between(1.0 / self.search.far, 1.0 / self.search.near);
        let ray = self.ray(x, y);
        self.plane(ray, inverse, chance.facing(ray))
    }

    /// ray: of unit length; planes count the depth along z.
    fn plane(&self, ray: [f32; 3], inverse: f32, normal: [f32; 3]) -> Plane {
        let mut made = Plane::through(&self.camera, ray, inverse, normal);
        made.slope = made.slope.map(|one| one * ray[2]);
        made
    }

    fn random(&self) -> Planes {
        let (width, height) = (self.image.width, self.image.height);
        let planes = (0..width * height)
            .into_par_iter()
            .map(|i| {
                let mut chance = Chance::new(self.search.seed, i as u32, u32::MAX);
                self.drawn(&mut chance, i % width, i / width)
            })
            .collect();
        Planes {
            width,
            height,
            planes,
            costs: vec![f32::INFINITY; width * height],
        }
    }

    /// What the best views say against a plane at a pixel; at least `limit` where it is not less, with
    /// no more looked at than shows that.
    fn cost(&self, patch: &Patch, x: usize, y: usize, plane: Plane, limit: f32) -> f32 {
        let (low, high) = (1.0 / self.search.far, 1.0 / self.search.near);
        if !(plane.inverse >= low && plane.inverse <= high) {
            return WORST * 2.0;
        }
        let at = [x as f32 + 0.5, y as f32 + 0.5];
        let count = self.neighbours.len();
        let best = self.search.views.clamp(1, count);
        // A window costs nothing at the least, so that what is known so far bounds the rest.
        let mut costs = [0.0; MOST_VIEWS];
        let costs = &mut costs[..count];
        for (i, one) in self.neighbours.iter().enumerate() {
            if let Some(depths) = one.depths {
                costs[i] = self.inconsistency(i, depths, at, plane.inverse);
            }
        }
        for (i, one) in self.neighbours.iter().enumerate() {
            if least(costs, best) >= limit {
                return limit;
            }
            let window = &self.search.window;
            let there = &self.there[i];
            costs[i] += patch.cost(one.image, there, at, plane.inverse, plane.slope, window);
        }
        least(costs, best)
    }

    /// How far the depth that a neighbour has there leads back beside the pixel, as a cost.
    fn inconsistency(&self, view: usize, depths: &[f32], at: [f32; 2], inverse: f32) -> f32 {
        let most = self.search.consistency * self.search.most_px;
        let other = self.neighbours[view].image;
        let seen = self.there[view].apply(at, inverse);
        let (u, v) = (seen[0] / seen[2], seen[1] / seen[2]);
        let inside = seen[2] > 0.0
            && u >= 0.0
            && v >= 0.0
            && u < other.width as f32
            && v < other.height as f32;
        if !inside {
            return most;
        }
        let depth = depths[v as usize * other.width + u as usize];
        if depth.is_nan() || depth <= 0.0 {
            return most;
        }
        let back = self.back[view].apply([u, v], 1.0 / depth);
        let (dx, dy) = (back[0] / back[2] - at[0], back[1] / back[2] - at[1]);
        let away = (dx * dx + dy * dy).sqrt();
        if back[2] <= 0.0 || away.is_nan() {
            return most;
        }
        self.search.consistency * away.min(self.search.most_px)
    }

    fn sweep(&self, found: &mut Planes, sweep: usize, colour: usize) {
        let (width, height) = (found.width, found.height);
        let state: &Planes = found;
        let better: Vec<Vec<(Plane, f32)>> = (0..height)
            .into_par_iter()
            .map(|y| {
                ((y + colour) % 2..width)
                    .step_by(2)
                    .map(|x| self.improved(state, sweep, x, y))
                    .collect()
            })
            .collect();
        for (y, row) in better.into_iter().enumerate() {
            let first = (y + colour) % 2;
            for (n, (plane, cost)) in row.into_iter().enumerate() {
                let i = y * width + first + 2 * n;
                found.planes[i] = plane;
                found.costs[i] = cost;
            }
        }
    }

    /// The best of a pixel's plane, those around it, and variations of the best.
    fn improved(&self, state: &Planes, sweep: usize, x: usize, y: usize) -> (Plane, f32) {
        let patch = Patch::new(self.image, x, y, &self.search.window);
        let i = y * state.width + x;
        let mut best = (state.planes[i], state.costs[i]);
        for group in GROUPS {
            let candidate = self.candidate(state, group, x, y);
            if let Some(candidate) = candidate.filter(|one| !self.is_same(one, &best.0)) {
                let cost = self.cost(&patch, x, y, candidate, best.1);
                if cost < best.1 {
                    best = (candidate, cost);
                }
            }
        }
        let mut chance = Chance::new(self.search.seed, i as u32, sweep as u32);
        let scale = 0.5f32.powi(sweep as i32);
        let ray = self.ray(x, y);
        for kind in 0..4 {
            let tried = self.varied(best.0, kind, scale, ray, [x, y], &mut chance);
            let cost = self.cost(&patch, x, y, tried, best.1);
            if cost < best.1 {
                best = (tried, cost);
            }
        }
        best
    }

    /// Whether two planes show a pixel's window at the same places, as far as can be told.
    fn is_same(&self, one: &Plane, other: &Plane) -> bool {
        let [inverse, slope] = self.same;
        let apart = |axis: usize| (one.slope[axis] - other.slope[axis]).abs();
        (one.inverse - other.inverse).abs() < inverse && apart(0).max(apart(1)) < slope
    }

    fn candidate(&self, state: &Planes, group: &[(i32, i32)], x: usize, y: usize) -> Option<Plane> {
        let mut best: Option<(f32, Plane)> = None;
        for &(dx, dy) in group {
            let (u, v) = (x as i32 + dx, y as i32 + dy);
            if u < 0 || v < 0 || u >= state.width as i32 || v >= state.height as i32 {
                continue;
            }
            let at = v as usize * state.width + u as usize;
            let cost = state.costs[at];
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, state.planes[at].gone_on(-dx as f32, -dy as f32)));
            }
        }
        best.map(|(_, plane)| plane)
    }

    /// A plane near the best one (kinds 0 to 2: depth, normal, both), or any (3).
    fn varied(
        &self,
        best: Plane,
        kind: usize,
        scale: f32,
        ray: [f32; 3],
        at: [usize; 2],
        chance: &mut Chance,
    ) -> Plane {
        if kind == 3 {
            return self.drawn(chance, at[0], at[1]);
        }
        let mut inverse = best.inverse;
        if kind != 1 {
            let share = self.search.vary_depth * scale;
            inverse *= 1.0 + chance.between(-share, share);
        }
        let px = [at[0] as f32 + 0.5, at[1] as f32 + 0.5];
        let mut normal = best.normal(&self.camera, px);
        if kind != 0 {
            let drawn = chance.facing(ray);
            let share = self.search.vary_normal * scale;
            for axis in 0..3 {
                normal[axis] += share * drawn[axis];
            }
            let length = normal.iter().map(|one| one * one).sum::<f32>().sqrt();
            normal = normal.map(|one| one / length.max(1e-6));
        }
        self.plane(ray, inverse, normal)
    }
}

/// The mean of the least so many.
fn least(costs: &[f32], best: usize) -> f32 {
    let mut sorted = [0.0; MOST_VIEWS];
    for (count, cost) in costs.iter().enumerate() {
        let mut place = count;
        while place > 0 && sorted[place - 1] > *cost {
            sorted[place] = sorted[place - 1];
            place -= 1;
        }
        sorted[place] = *cost;
    }
    sorted[..best].iter().sum::<f32>() / best as f32
}
