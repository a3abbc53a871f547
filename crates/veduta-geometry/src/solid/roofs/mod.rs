//! Closed roofs over level faces.

mod apex;
mod edges;
mod even;
mod field;
mod flat;
mod planes;
mod profile;
mod shell;
mod storeys;

use glam::DVec3;

pub use edges::Gables;

use super::level::Level;
use super::mesh::{Face, Mesh};
use crate::skeleton::{roof_within, Eaves, SkeletonError};
use crate::{Budget, Unlimited};
use edges::reaching;
use planes::Across;
use profile::Profile;
use shell::Shell;

/// Which way a roof runs over a face.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Along {
    /// Along the longer side of the least rectangle around the outline that has a side in common
    /// with it.
    #[default]
    Longest,
    /// Along an edge, counted through all rings.
    Edge(u32),
    /// Along a direction in space.
    Direction(DVec3),
}

/// The types of roof. Lengths are in the unit of the sheet; slopes are tangents. Where no slope is
/// told, it is the one that the roof is made with.
#[derive(Debug, Clone, PartialEq)]
pub enum RoofKind {
    /// Every edge carries a slope. `even` puts all ridges at the height of the highest.
    Hip { even: bool },
    /// Some edges stay upright to the top.
    Gable { gables: Gables, even: bool },
    /// Each edge has a slope of its own, through all rings; an infinite one stays upright.
    PerEdge(Vec<f64>),
    /// Triangles to one point over the middle of the corners, or where it sees all edges. The
    /// slope is that over the first edge.
    Pyramid,
    /// One plane that rises from an edge.
    Shed { edge: u32 },
    /// One plane that falls towards a direction.
    Skillion { towards: DVec3 },
    /// Two planes that meet over the middle of the face.
    Ridge(Along),
    /// A hip roof that is flatter above a height.
    Mansard { upper: f64, knee: f64 },
    /// A gable roof that is flatter above a height.
    Gambrel {
        gables: Gables,
        upper: f64,
        knee: f64,
    },
    /// A gable roof whose gables end in a slope: this share of their height.
    HalfHip { gables: Gables, clipped: f64 },
    /// A hip roof up to this share of its height, and a gable roof over what is left there.
    Dutch { share: f64 },
    /// A gable roof with another slope on the edges that look away from `front`, by default the
    /// longest.
    Saltbox { back: f64, front: Option<u32> },
    /// Two planes that fall to the middle of the face.
    Butterfly(Along),
    /// As many planes side by side that rise and end upright.
    Sawtooth { teeth: u32, along: Along },
    /// Two ridges of one height at right angles.
    CrossGable(Along),
    /// Round from the eaves up, in so many steps; where the outline is narrower it ends lower.
    Dome { height: f64, steps: u32 },
    /// A bulb with a tip; the foot is narrower than the bulb, which fills the outline.
    Onion { height: f64, steps: u32 },
    /// Round between gables.
    Vault {
        gables: Gables,
        height: f64,
        steps: u32,
    },
    /// A slab with a parapet around it.
    Flat { slab: f64, parapet: f64, width: f64 },
}

impl RoofKind {
    pub const HIP: Self = Self::Hip { even: false };
    /// Upright where a hip roof has triangles.
    pub const GABLE: Self = Self::Gable {
        gables: Gables::Triangles,
        even: false,
    };
}

/// How far a roof reaches beyond its outline, measured level. Its planes go on: eaves that reach
/// out lie lower.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overhang {
    pub eaves: f64,
    /// For the edges that stay upright.
    pub gables: f64,
}

/// The solid between each face of a sheet and the roof over it, one closed shell per face.
///
/// `slope` is the tangent of the angle between the roof and its face. Each face of the sheet is
/// the floor of its roof and has to be planar; its normal is where the roof rises.
pub fn roofed(sheet: &Mesh, kind: &RoofKind, slope: f64) -> Result<Mesh, SkeletonError> {
    roofed_over(sheet, kind, slope, Overhang::default())
}

/// As [`roofed`], with eaves and gables that reach out. The floor lies where the lowest eaves do.
pub fn roofed_over(
    sheet: &Mesh,
    kind: &RoofKind,
    slope: f64,
    overhang: Overhang,
) -> Result<Mesh, SkeletonError> {
    roofed_within(sheet, kind, slope, overhang, &Unlimited)
}

/// [`roofed_over`] within a budget.
pub fn roofed_within(
    sheet: &Mesh,
    kind: &RoofKind,
    slope: f64,
    overhang: Overhang,
    budget: &dyn Budget,
) -> Result<Mesh, SkeletonError> {
    let mut solid = Mesh::new();
    for face in sheet.faces() {
        let work = Work {
            sheet,
            face,
            slope,
            overhang,
            budget,
        };
        solid.append(&work.roof(kind)?);
    }
    Ok(solid)
}

struct Work<'a> {
    sheet: &'a Mesh,
    face: Face<'a>,
    slope: f64,
    overhang: Overhang,
    budget: &'a dyn Budget,
}

impl Work<'_> {
    fn roof(&self, kind: &RoofKind) -> Result<Mesh, SkeletonError> {
        let (slope, none) = (self.slope, &Gables::None);
        match kind {
            RoofKind::Hip { even } => self.sloped(none, *even),
            RoofKind::Gable { gables, even } => self.sloped(gables, *even),
            RoofKind::PerEdge(slopes) => self.per_edge(slopes, |_| true),
            RoofKind::Saltbox { back, front } => self.saltbox(*back, *front),
            RoofKind::Mansard { upper, knee } => {
                self.profiled(none, |_| Profile::knee(slope, *upper, *knee))
            }
            RoofKind::Gambrel {
                gables,
                upper,
                knee,
            } => self.profiled(gables, |_| Profile::knee(slope, *upper, *knee)),
            RoofKind::Dome { height, steps } => self.profiled(none, |width| {
                Profile::round(width, *height, *steps as usize)
            }),
            RoofKind::Vault {
                gables,
                height,
                steps,
            } => self.profiled(gables, |width| {
                Profile::round(width, *height, *steps as usize)
            }),
            RoofKind::Onion { height, steps } => self.onion(*height, *steps as usize),
            RoofKind::HalfHip { gables, clipped } => {
                let (level, eaves) = self.eaves(gables)?;
                let below = self.overhang.eaves * slope;
                storeys::half_hip(
                    level.raised(-below),
                    &eaves,
                    slope,
                    *clipped,
                    below,
                    self.budget,
                )
            }
            RoofKind::Dutch { share } => {
                let (level, eaves) = self.eaves(none)?;
                let below = self.overhang.eaves * slope;
                storeys::gablet(level.raised(-below), &eaves, slope, *share, self.budget)
            }
            RoofKind::Flat {
                slab,
                parapet,
                width,
            } => {
                let (level, eaves) = self.eaves(none)?;
                let solid = flat::flat(&eaves, *slab, *parapet, *width, self.budget)?;
                Ok(placed(solid, &level))
            }
            RoofKind::Pyramid => self.pyramid(),
            RoofKind::Shed { edge } => {
                let inward = self.face.normal().cross(self.edge(*edge)?);
                self.across(inward, |plan| plan.shed(slope))
            }
            RoofKind::Skillion { towards } => self.across(-*towards, |plan| plan.shed(slope)),
            RoofKind::Ridge(along) => self.across(self.beside(*along)?, |plan| plan.ridge(slope)),
            RoofKind::Butterfly(along) => {
                self.across(self.beside(*along)?, |plan| plan.butterfly(slope))
            }
            RoofKind::Sawtooth { teeth, along } => {
                self.across(self.beside(*along)?, |plan| plan.sawtooth(slope, *teeth))
            }
            RoofKind::CrossGable(along) => self.across(self.beside(*along)?, |plan| {
                plan.crossed(0.5 * slope * plan.width())
            }),
        }
    }

    fn level(&self) -> Level {
        Level::of(self.sheet, self.face)
    }

    /// The eaves of an even roof: beyond the walls where it hangs over.
    fn eaves(&self, gables: &Gables) -> Result<(Level, Eaves), SkeletonError> {
        let level = self.level();
        let rings = level.flat(self.sheet, self.face);
        let upright = gables.of(&Eaves::even(&rings)?, self.budget)?;
        let (rings, along) = reaching(&rings, &upright, self.overhang, self.budget)?;
        let speed = |&edge: &u32| f64::from(!upright[edge as usize]);
        let speeds: Vec<f64> = along.iter().map(speed).collect();
        Ok((level, Eaves::new(&rings, &speeds)?))
    }

    fn sloped(&self, gables: &Gables, even: bool) -> Result<Mesh, SkeletonError> {
        let (level, eaves) = self.eaves(gables)?;
        let found = roof_within(&eaves, None, self.budget)?;
        let mut solid = Shell::of(&eaves, &found).closed(|p| p.z * self.slope);
        if even {
            solid = even::levelled(&solid).ok_or(SkeletonError::FoldedGable)?;
        }
        Ok(placed(
            solid,
            &level.raised(-self.overhang.eaves * self.slope),
        ))
    }

    fn profiled(
        &self,
        gables: &Gables,
        profile: impl Fn(f64) -> Profile,
    ) -> Result<Mesh, SkeletonError> {
        let (level, eaves) = self.eaves(gables)?;
        let found = roof_within(&eaves, None, self.budget)?;
        let shell = Shell::of(&eaves, &found);
        let reach = self.overhang.eaves;
        let profile = profile(shell.deepest() - reach).reaching(reach);
        let floor = profile.height(0.0);
        let solid = shell.profiled(&profile).mapped(|p| p - DVec3::Z * floor);
        Ok(placed(solid, &level.raised(floor)))
    }

    fn onion(&self, height: f64, steps: usize) -> Result<Mesh, SkeletonError> {
        const BELLY: f64 = 0.2;
        const NECK: f64 = 0.15;
        let (level, eaves) = self.eaves(&Gables::None)?;
        let found = roof_within(&eaves, None, self.budget)?;
        let shell = Shell::of(&eaves, &found);
        let (deepest, belly) = (shell.deepest(), BELLY * height);
        let profile = Profile::bulb(deepest, height - belly, steps);
        let solid = shell.bulging(&profile, NECK * deepest + self.overhang.eaves, belly);
        Ok(placed(solid, &level))
    }

    /// A slope for each edge; those that `reaches` says so of hang over.
    fn per_edge(
        &self,
        slopes: &[f64],
        reaches: impl Fn(usize) -> bool,
    ) -> Result<Mesh, SkeletonError> {
        let level = self.level();
        let rings = level.flat(self.sheet, self.face);
        let edges = rings.iter().map(Vec::len).sum();
        if slopes.len() != edges {
            let speeds = slopes.len();
            return Err(SkeletonError::SpeedCount { speeds, edges });
        }
        // All eaves lie at one height: what is flatter reaches farther out.
        let upright = |edge: usize| slopes[edge].is_infinite();
        let sloping = slopes.iter().copied().filter(|slope| slope.is_finite());
        let flattest = sloping.fold(f64::INFINITY, f64::min);
        let mut below = 0.0;
        let (mut larger, mut along) = (rings, (0..edges as u32).collect::<Vec<_>>());
        if self.overhang != Overhang::default() && flattest.is_finite() {
            below = self.overhang.eaves * flattest;
            let distance = |edge: usize| match (upright(edge), reaches(edge)) {
                (true, _) => self.overhang.gables,
                (false, true) => below / slopes[edge],
                (false, false) => 0.0,
            };
            let distances: Vec<f64> = (0..edges).map(distance).collect();
            let grown = super::inset::grown(&larger, &distances, self.budget, |_, _| {})?;
            (larger, along) = (grown.rings, grown.along);
        }
        let speed = |&edge: &u32| 1.0 / slopes[edge as usize];
        let speeds: Vec<f64> = along.iter().map(speed).collect();
        let eaves = Eaves::new(&larger, &speeds)?;
        let found = roof_within(&eaves, None, self.budget)?;
        let solid = Shell::of(&eaves, &found).closed(|p| p.z);
        Ok(placed(solid, &level.raised(-below)))
    }

    fn saltbox(&self, back: f64, front: Option<u32>) -> Result<Mesh, SkeletonError> {
        let rings = self.level().flat(self.sheet, self.face);
        let even = Eaves::even(&rings)?;
        let upright = Gables::Triangles.of(&even, self.budget)?;
        let along = |edge: usize| {
            let (a, b) = (even.points_m()[edge], even.points_m()[even.next(edge)]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let length = |edge: &usize| along(*edge)[0].hypot(along(*edge)[1]);
        let longest = (0..even.len())
            .filter(|&edge| !upright[edge])
            .max_by(|a, b| length(a).total_cmp(&length(b)).then(b.cmp(a)));
        let front = front.map(|edge| edge as usize).or(longest).unwrap_or(0);
        if front >= even.len() {
            let (edge, edges) = (front, even.len());
            return Err(SkeletonError::NoSuchEdge { edge, edges });
        }
        let ahead = along(front);
        let slope = |edge: usize| {
            let own = along(edge);
            let looks_back = own[0] * ahead[0] + own[1] * ahead[1] < 0.0;
            match (upright[edge], looks_back) {
                (true, _) => f64::INFINITY,
                (false, true) => back,
                (false, false) => self.slope,
            }
        };
        let slopes: Vec<f64> = (0..even.len()).map(slope).collect();
        self.per_edge(&slopes, |_| true)
    }

    fn pyramid(&self) -> Result<Mesh, SkeletonError> {
        let level = self.level();
        let rings = level.flat(self.sheet, self.face);
        Eaves::even(&rings)?;
        let count = rings.iter().map(Vec::len).sum::<usize>() as f64;
        let mean = |axis: usize| rings.iter().flatten().map(|p| p[axis]).sum::<f64>() / count;
        let top = apex::apex(&rings, [mean(0), mean(1)]).ok_or(SkeletonError::NoApex)?;
        let off = |k: usize| {
            let (a, b) = (rings[0][k], rings[0][(k + 1) % rings[0].len()]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            (dx * (top[1] - a[1]) - dy * (top[0] - a[0])) / dx.hypot(dy)
        };
        let height = self.slope * off(0);
        let nearest = (0..rings[0].len()).map(off).fold(f64::INFINITY, f64::min);
        let growth = self.overhang.eaves / nearest;
        let below = level.raised(-growth * height);
        let place = |&[x, y]: &[f64; 2]| {
            let out = [x + growth * (x - top[0]), y + growth * (y - top[1])];
            below.place(out, 0.0)
        };
        let larger: Vec<Vec<DVec3>> = rings
            .iter()
            .map(|r| r.iter().map(place).collect())
            .collect();
        let tip = level.place(top, height);
        Ok(super::pyramids(&Mesh::polygon(&larger), |_| tip))
    }

    /// A roof of planes, `x` being the direction across it.
    fn across(&self, x: DVec3, make: impl FnOnce(&Across) -> Mesh) -> Result<Mesh, SkeletonError> {
        let level = self.level().along(x);
        let rings = level.flat(self.sheet, self.face);
        let upright = vec![false; Eaves::even(&rings)?.len()];
        let walls = Across::of(&rings);
        let (larger, _) = reaching(&rings, &upright, self.overhang, self.budget)?;
        let solid = make(&walls.grown(larger));
        Ok(placed(solid, &level))
    }

    /// The direction of an edge, counted through all rings.
    fn edge(&self, edge: u32) -> Result<DVec3, SkeletonError> {
        let place = |point: u32| self.sheet.points[point as usize];
        let mut edges = self.face.edges();
        let found = edges.nth(edge as usize);
        let (a, b) = found.ok_or(SkeletonError::NoSuchEdge {
            edge: edge as usize,
            edges: self.face.edges().count(),
        })?;
        Ok(place(b) - place(a))
    }

    /// The direction across a roof that runs this way.
    fn beside(&self, along: Along) -> Result<DVec3, SkeletonError> {
        let way = match along {
            Along::Direction(way) => way,
            Along::Edge(edge) => self.edge(edge)?,
            Along::Longest => self.longest(),
        };
        Ok(way.cross(self.face.normal()))
    }

    fn longest(&self) -> DVec3 {
        let normal = self.face.normal();
        let points: Vec<DVec3> = self.face.points().collect();
        let (mut best, mut least) = (DVec3::X, f64::INFINITY);
        for edge in 0..self.face.outline().len() {
            let Ok(way) = self.edge(edge as u32) else {
                continue;
            };
            let way = way.normalize_or_zero();
            let beside = normal.cross(way);
            let extent = |axis: DVec3| {
                let places = points.iter().map(|p| p.dot(axis));
                let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), at| {
                    (l.min(at), h.max(at))
                });
                high - low
            };
            let (long, wide) = (extent(way), extent(beside));
            if long * wide < least * (1.0 - 1e-9) {
                least = long * wide;
                best = if long >= wide { way } else { beside };
            }
        }
        best
    }
}

/// A solid over a level, with z as the height over it.
fn placed(solid: Mesh, level: &Level) -> Mesh {
    solid.mapped(|p| level.place([p.x, p.y], p.z))
}
