//! The particles: moved, weighed, drawn anew.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use crate::error::DriveError;
use crate::field::EdgeField;
use crate::random::Stream;

/// The most particles, and the most draws of a start.
pub const MOST: usize = 10_000_000;
/// Entries of the table of likelihoods, and the distance between two of them (m).
const TABLE: usize = 512;
const TABLE_STEP_M: f64 = 0.05;
/// A place so deep inside is taken for it (m).
const DEEP_M: f32 = 1.0;

/// How particles are weighed.
///
/// sigma_m: how far points of a scan lie from their edges; while the particles are spread widely,
/// `spread_share` of their spread, up to `widest_sigma_m`. outlier: the likelihood of a point that
/// belongs to no edge, against 1 on an edge. outside: that of a point of which the map knows nothing.
/// blocked: that of a point that a beam went through where the map has something that stands there.
/// worth: so many independent beams a scan counts as: neighbours see the same wall. draw_below: share of
/// effective particles below which they are drawn anew. first_draws: poses that the first scan chooses from.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    pub particles: usize,
    pub first_draws: usize,
    pub seed: u64,
    pub sigma_m: f64,
    pub widest_sigma_m: f64,
    pub spread_share: f64,
    pub outlier: f64,
    pub outside: f64,
    pub blocked: f64,
    pub worth: f64,
    pub draw_below: f64,
}

/// Where a drive begins: x, y (m), heading (rad), each up to `reach` off, all equally likely.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    pub pose: [f64; 3],
    pub reach: [f64; 3],
}

/// The weighted mean of the particles and its covariance (row by row: x, y, heading).
///
/// share: of the scan's points that are within `2 sigma_m` of an edge at the mean. known: share of
/// them of which the map knows something. through: share of the points that beams went through where
/// something stands on the map.
#[derive(Debug, Clone, Copy)]
pub struct Estimate {
    pub pose: [f64; 3],
    pub covariance: [f64; 9],
    pub share: f64,
    pub known: f64,
    pub through: f64,
}

/// Particles in a map; `step` after each motion.
#[derive(Debug, Clone)]
pub struct Filter {
    field: EdgeField,
    settings: Settings,
    poses: Vec<[f64; 3]>,
    log_weights: Vec<f64>,
    steps: u64,
    spread_m: f64,
    first: bool,
}

impl Filter {
    /// Particles all over the start's reach.
    pub fn new(field: EdgeField, start: Start, settings: Settings) -> Result<Self, DriveError> {
        let most = settings.particles.max(settings.first_draws);
        if settings.particles == 0 || most > MOST {
            return Err(DriveError::Particles {
                particles: most,
                most: MOST,
            });
        }
        for (what, value) in [
            ("sigma_m", settings.sigma_m),
            ("widest_sigma_m", settings.widest_sigma_m),
            ("outlier", settings.outlier),
            ("outside", settings.outside),
            ("blocked", settings.blocked),
            ("worth", settings.worth),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(DriveError::Setting { what, value });
            }
        }
        let draws = settings.first_draws.max(settings.particles);
        let poses: Vec<[f64; 3]> = (0..draws)
            .map(|row| {
                let mut stream = Stream::new(settings.seed, 0, row as u64);
                std::array::from_fn(|axis| {
                    start.pose[axis] + start.reach[axis] * (2.0 * stream.uniform() - 1.0)
                })
            })
            .collect();
        Ok(Self {
            field,
            settings,
            log_weights: vec![0.0; draws],
            poses,
            steps: 0,
            spread_m: start.reach[0].hypot(start.reach[1]) / 3.0_f64.sqrt(),
            first: true,
        })
    }

    /// Move by (forward, left, turn) with noise of these deviations, weigh by a scan's points
    /// (vehicle frame, m) and by those that its beams went through (`free`), draw anew where few
    /// particles count; NaN points must not be given.
    pub fn step(
        &mut self,
        motion: [f64; 3],
        noise: [f64; 3],
        points: &[[f64; 2]],
        free: &[[f64; 2]],
    ) -> Estimate {
        self.steps += 1;
        let (seed, step) = (self.settings.seed, self.steps);
        self.poses
            .par_iter_mut()
            .enumerate()
            .for_each(|(row, pose)| {
                let mut stream = Stream::new(seed, 2 * step, row as u64);
                let moved: [f64; 3] =
                    std::array::from_fn(|axis| motion[axis] + noise[axis] * stream.normal());
                let (sine, cosine) = pose[2].sin_cos();
                pose[0] += cosine * moved[0] - sine * moved[1];
                pose[1] += sine * moved[0] + cosine * moved[1];
                pose[2] += moved[2];
            });
        if !points.is_empty() {
            self.weigh(points, free);
        }
        let estimate = self.estimate(points, free);
        self.draw();
        estimate
    }

    fn weigh(&mut self, points: &[[f64; 2]], free: &[[f64; 2]]) {
        let table = self.table();
        let outside = self.settings.outside.ln();
        let blocked = self.settings.blocked.ln();
        let worth = self.settings.worth.min(points.len() as f64) / points.len() as f64;
        let worth_free = self.settings.worth.min(free.len() as f64) / free.len().max(1) as f64;
        let field = &self.field;
        self.log_weights
            .par_iter_mut()
            .zip(&self.poses)
            .for_each(|(weight, pose)| {
                let (sine, cosine) = pose[2].sin_cos();
                let at = |&[x, y]: &[f64; 2]| {
                    field.at(
                        pose[0] + cosine * x - sine * y,
                        pose[1] + sine * x + cosine * y,
                    )
                };
                let sum: f64 = points
                    .iter()
                    .map(|point| {
                        at(point).map_or(outside, |distance| {
                            let row = (f64::from(distance.abs()) / TABLE_STEP_M) as usize;
                            table[row.min(TABLE - 1)]
                        })
                    })
                    .sum();
                let through = free.iter().filter(|point| stands(at(point))).count();
                *weight += worth * sum + worth_free * blocked * through as f64;
            });
    }

    /// The logarithm of the likelihood at distances `TABLE_STEP_M` apart.
    fn table(&self) -> Vec<f64> {
        let one = &self.settings;
        let sigma = (one.spread_share * self.spread_m).clamp(one.sigma_m, one.widest_sigma_m);
        (0..TABLE)
            .map(|row| {
                let apart = (row as f64 + 0.5) * TABLE_STEP_M / sigma;
                (one.outlier + (1.0 - one.outlier) * (-0.5 * apart * apart).exp()).ln()
            })
            .collect()
    }

    fn weights(&self) -> Vec<f64> {
        let most = self.log_weights.iter().copied().fold(f64::MIN, f64::max);
        let raw: Vec<f64> = self.log_weights.iter().map(|w| (w - most).exp()).collect();
        let sum: f64 = raw.iter().sum();
        raw.into_iter().map(|weight| weight / sum).collect()
    }

    fn estimate(&mut self, points: &[[f64; 2]], free: &[[f64; 2]]) -> Estimate {
        let weights = self.weights();
        let mut mean = [0.0; 4];
        for (pose, weight) in self.poses.iter().zip(&weights) {
            mean[0] += weight * pose[0];
            mean[1] += weight * pose[1];
            mean[2] += weight * pose[2].cos();
            mean[3] += weight * pose[2].sin();
        }
        let pose = [mean[0], mean[1], mean[3].atan2(mean[2])];
        let mut covariance = [0.0; 9];
        for (one, weight) in self.poses.iter().zip(&weights) {
            let off = [
                one[0] - pose[0],
                one[1] - pose[1],
                (one[2] - pose[2] + PI).rem_euclid(TAU) - PI,
            ];
            for row in 0..3 {
                for column in 0..3 {
                    covariance[3 * row + column] += weight * off[row] * off[column];
                }
            }
        }
        self.spread_m = (covariance[0] + covariance[4]).sqrt();
        let (sine, cosine) = pose[2].sin_cos();
        let near = 2.0 * self.settings.sigma_m;
        let at = |&[x, y]: &[f64; 2]| {
            self.field.at(
                pose[0] + cosine * x - sine * y,
                pose[1] + sine * x + cosine * y,
            )
        };
        let (mut close, mut known) = (0usize, 0usize);
        for distance in points.iter().filter_map(at) {
            known += 1;
            close += usize::from(f64::from(distance.abs()) <= near);
        }
        let through = free.iter().filter(|point| stands(at(point))).count();
        Estimate {
            pose,
            covariance,
            share: close as f64 / known.max(1) as f64,
            known: known as f64 / points.len().max(1) as f64,
            through: through as f64 / free.len().max(1) as f64,
        }
    }

    /// Systematic drawing: particles in proportion to their weights (Kitagawa 1996).
    fn draw(&mut self) {
        let weights = self.weights();
        let effective = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        let enough = effective > self.settings.draw_below * weights.len() as f64;
        if enough && !self.first {
            return;
        }
        self.first = false;
        let count = self.settings.particles;
        let offset = Stream::new(self.settings.seed, 2 * self.steps + 1, 0).uniform();
        let mut drawn = Vec::with_capacity(count);
        let (mut row, mut sum) = (0, weights[0]);
        for number in 0..count {
            let wanted = (number as f64 + offset) / count as f64;
            while sum < wanted && row + 1 < weights.len() {
                row += 1;
                sum += weights[row];
            }
            drawn.push(self.poses[row]);
        }
        self.poses = drawn;
        self.log_weights = vec![0.0; count];
    }
}

/// Whether a place is well inside of what stands there: an eave or a cell that is off does not count.
fn stands(distance: Option<f32>) -> bool {
    distance.is_some_and(|apart| apart < -DEEP_M)
}
