//! Models of matches of which some are false: least median of squares, and RANSAC.

use nalgebra::Matrix3;

use crate::buckets::Buckets;
use crate::chance::Chance;
use crate::distance::{epipolar, transfer};
use crate::fundamental::{eight_points, seven_points, EIGHT, SEVEN};
use crate::homography::{four_points, FOUR};
use crate::matches::Match;

/// What is drawn for, and how far a match is off it.
pub trait Model {
    /// Matches of a draw.
    const SAMPLE: usize;
    /// Numbers that the model has.
    const NUMBERS: usize;
    /// Standard deviation of a normal error by the median of its size.
    const BY_MEDIAN: f64;
    /// Matches within this many standard deviations are taken to be true.
    const REACH: f64;

    /// The models that a draw fits.
    fn of_draw(draw: &[Match], found: &mut Vec<Matrix3<f64>>);
    /// The one model that many matches fit best, linearly.
    fn of_all(matches: &[Match]) -> Option<Matrix3<f64>>;
    /// Squared distance of each match in both photos together (px²).
    fn squared(model: &Matrix3<f64>) -> impl Fn(&Match) -> f64;
}

/// A fundamental matrix, drawn for with eight matches, as the thesis does.
pub struct FromEight;
/// A fundamental matrix, drawn for with seven.
pub struct FromSeven;
/// A homography.
pub struct Plane;

impl Model for FromEight {
    const SAMPLE: usize = EIGHT;
    const NUMBERS: usize = 7;
    const BY_MEDIAN: f64 = 1.4826;
    const REACH: f64 = 2.5;

    fn of_draw(draw: &[Match], found: &mut Vec<Matrix3<f64>>) {
        found.extend(eight_points(draw, None));
    }

    fn of_all(matches: &[Match]) -> Option<Matrix3<f64>> {
        eight_points(matches, None).ok()
    }

    fn squared(model: &Matrix3<f64>) -> impl Fn(&Match) -> f64 {
        let model = *model;
        move |one| epipolar(&model, one)
    }
}

impl Model for FromSeven {
    const SAMPLE: usize = SEVEN;
    const NUMBERS: usize = FromEight::NUMBERS;
    const BY_MEDIAN: f64 = FromEight::BY_MEDIAN;
    const REACH: f64 = FromEight::REACH;

    fn of_draw(draw: &[Match], found: &mut Vec<Matrix3<f64>>) {
        seven_points(draw, found);
    }

    fn of_all(matches: &[Match]) -> Option<Matrix3<f64>> {
        FromEight::of_all(matches)
    }

    fn squared(model: &Matrix3<f64>) -> impl Fn(&Match) -> f64 {
        FromEight::squared(model)
    }
}

impl Model for Plane {
    const SAMPLE: usize = FOUR;
    const NUMBERS: usize = 8;
    // The error of a plane has two parts: the median of its size is 1.177 standard deviations of
    // one, and 98.9 % of the sizes are within three, as 98.8 % of normal ones are within 2.5.
    const BY_MEDIAN: f64 = 0.8493;
    const REACH: f64 = 3.0;

    fn of_draw(draw: &[Match], found: &mut Vec<Matrix3<f64>>) {
        found.extend(four_points(draw, None));
    }

    fn of_all(matches: &[Match]) -> Option<Matrix3<f64>> {
        four_points(matches, None).ok()
    }

    fn squared(model: &Matrix3<f64>) -> impl Fn(&Match) -> f64 {
        transfer(model)
    }
}

/// Bounds of the distance at which a match is taken to be false (px, of both photos together).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Not below this, however well the others fit: points are not found better.
    pub least_px: f64,
    /// Not above: half of any matches are within a multiple of their median, of noise as well.
    pub largest_px: f64,
}

impl Band {
    /// No bounds: sigma alone decides.
    pub const OPEN: Self = Self {
        least_px: 0.0,
        largest_px: f64::INFINITY,
    };

    fn limit<M: Model>(&self, sigma_px: f64) -> f64 {
        (M::REACH * sigma_px)
            .max(self.least_px)
            .min(self.largest_px)
    }
}

/// A model, and the matches that it explains.
#[derive(Debug, Clone, PartialEq)]
pub struct Robust {
    /// F or H.
    pub model: Matrix3<f64>,
    /// Standard deviation of the true matches' distances (px, of both photos together).
    pub sigma_px: f64,
    /// Whether each match is taken to be true.
    pub inliers: Vec<bool>,
}

impl Robust {
    /// Sigma (2.25) and the inliers of a model (algorithm 4, v and vi).
    pub fn of<M: Model>(model: Matrix3<f64>, matches: &[Match], band: Band) -> Self {
        let distance = M::squared(&model);
        let squared: Vec<f64> = matches.iter().map(&distance).collect();
        let sigma_px = sigma::<M>(median(&mut squared.clone()), matches.len());
        let limit = band.limit::<M>(sigma_px);
        Self {
            model,
            sigma_px,
            inliers: squared.iter().map(|&one| one <= limit * limit).collect(),
        }
    }

    /// How many are taken to be true.
    pub fn count(&self) -> usize {
        self.inliers.iter().filter(|&&one| one).count()
    }

    /// The matches that are taken to be true.
    pub fn kept(&self, matches: &[Match]) -> Vec<Match> {
        let each = matches.iter().zip(&self.inliers);
        each.filter(|(_, &own)| own).map(|(&one, _)| one).collect()
    }

    /// The linear fit over the matches that are taken to be true, and what it explains.
    pub fn fitted<M: Model>(&self, matches: &[Match], band: Band) -> Option<Self> {
        let model = M::of_all(&self.kept(matches))?;
        Some(Self::of::<M>(model, matches, band))
    }
}

/// (2.25), from the median of the squares.
fn sigma<M: Model>(median: f64, count: usize) -> f64 {
    let more = count.saturating_sub(M::NUMBERS).max(1) as f64;
    M::BY_MEDIAN * (1.0 + 5.0 / more) * median.sqrt()
}

/// The median; the upper one of an even number.
pub fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// How many draws find one without a false match, with a probability of `sure` (end of 2.4.3.2).
pub fn draws_needed(false_share: f64, sample: usize, sure: f64) -> usize {
    let clean = (1.0 - false_share).powi(sample as i32);
    if clean >= 1.0 {
        return 1;
    }
    ((1.0 - sure).ln() / (1.0 - clean).ln()).ceil() as usize
}

/// Calls `tell` with the models of so many draws.
fn of_draws<M: Model>(
    matches: &[Match],
    draws: usize,
    seed: u64,
    mut tell: impl FnMut(&Matrix3<f64>),
) {
    let buckets = Buckets::of(matches);
    let mut chance = Chance::new(seed);
    let mut drawn = vec![0; M::SAMPLE];
    let mut found = Vec::new();
    for _ in 0..draws {
        buckets.draw(&mut chance, &mut drawn);
        let draw: Vec<Match> = drawn.iter().map(|&one| matches[one]).collect();
        found.clear();
        M::of_draw(&draw, &mut found);
        found.iter().for_each(&mut tell);
    }
}

/// Least median of squares (algorithm 4, to step vi): the model of a draw. None where no draw
/// determines one.
pub fn least_median<M: Model>(
    matches: &[Match],
    draws: usize,
    seed: u64,
    band: Band,
) -> Option<Robust> {
    if matches.len() < M::SAMPLE {
        return None;
    }
    let mut best: Option<(f64, Matrix3<f64>)> = None;
    let mut squared = Vec::with_capacity(matches.len());
    of_draws::<M>(matches, draws, seed, |model| {
        let least = best.map_or(f64::INFINITY, |known| known.0);
        if within_half::<M>(model, matches, least, &mut squared) {
            let found = median(&mut squared);
            if found < least {
                best = Some((found, *model));
            }
        }
    });
    best.map(|(_, model)| Robust::of::<M>(model, matches, band))
}

/// The squared distances; false, and not all of them, where their median is not below `least`.
fn within_half<M: Model>(
    model: &Matrix3<f64>,
    matches: &[Match],
    least: f64,
    squared: &mut Vec<f64>,
) -> bool {
    squared.clear();
    let distance = M::squared(model);
    let mut far = 0;
    for one in matches {
        let value = distance(one);
        if value >= least {
            far += 1;
            if far >= matches.len() - matches.len() / 2 {
                return false;
            }
        }
        squared.push(value);
    }
    true
}

/// RANSAC (algorithm 3): the linear fit over the matches of the draw that most are within a limit
/// of.
///
/// limit_px: the limit, of both photos together. Without one each draw has its own, 1.96 of its
/// sigma, as the thesis writes it: that rewards a draw which is far off for its large sigma, and
/// fails from a few false matches on.
pub fn largest_support<M: Model>(
    matches: &[Match],
    draws: usize,
    seed: u64,
    limit_px: Option<f64>,
) -> Option<Robust> {
    if matches.len() < M::SAMPLE {
        return None;
    }
    let mut best: Option<(usize, f64, Matrix3<f64>)> = None;
    of_draws::<M>(matches, draws, seed, |model| {
        let squared: Vec<f64> = matches.iter().map(M::squared(model)).collect();
        let limit = limit_px
            .unwrap_or_else(|| 1.96 * sigma::<M>(median(&mut squared.clone()), matches.len()));
        let support = squared.iter().filter(|&&one| one <= limit * limit).count();
        if best.is_none_or(|known| support > known.0) {
            best = Some((support, limit, *model));
        }
    });
    let (_, limit, model) = best?;
    let within = |model: Matrix3<f64>| {
        let distance = M::squared(&model);
        let inliers = matches.iter().map(|one| distance(one) <= limit * limit);
        Robust {
            inliers: inliers.collect(),
            sigma_px: limit / 1.96,
            model,
        }
    };
    let drawn = within(model);
    match M::of_all(&drawn.kept(matches)) {
        Some(fitted) => Some(within(fitted)),
        None => Some(drawn),
    }
}
