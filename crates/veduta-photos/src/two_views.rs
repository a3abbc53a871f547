//! What two photos are to each other: a plane (or a turn), a scene in depth, or nothing sure.
//!
//! The homography against the fundamental matrix is decided first (2.5.2): matches of a plane fit a
//! whole family of F. The criterion is GRIC (`gric`). What remains must have enough true matches.

use nalgebra::Matrix3;
use rayon::prelude::*;

use crate::gric;
use crate::matches::Match;
use crate::refine::huber;
use crate::robust::{least_median, Band, FromEight, FromSeven, Model, Plane, Robust};

/// How a pair is judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Draws for the fundamental matrix.
    pub draws: usize,
    /// Draws for the homography.
    pub plane_draws: usize,
    /// Draw seven matches, not eight.
    pub seven: bool,
    /// Bounds of the distance of a true match.
    pub band: Band,
    /// The noise of a coordinate is at least this where F and H are compared (px).
    pub least_sigma_px: f64,
    /// True matches that a pair must have.
    pub min_matches: usize,
    /// Share of the matches that must be true.
    pub min_share: f64,
}

/// What a pair of photos is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A fundamental matrix explains it.
    General,
    /// A homography does.
    Planar,
    /// It has fewer true matches than are asked for.
    TooFew,
    /// Too large a share of the matches is false.
    MostlyFalse,
}

/// The geometry of a pair, and what it was judged by.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoViews {
    /// What it is.
    pub kind: Kind,
    /// The fundamental matrix, where there is one.
    pub fundamental: Option<Matrix3<f64>>,
    /// The homography, where there is one.
    pub homography: Option<Matrix3<f64>>,
    /// Whether each match is taken to be true; none is where the pair is refused.
    pub inliers: Vec<bool>,
    /// Standard deviation of the true matches' distances (px, of both photos together).
    pub sigma_px: f64,
    /// GRIC of the fundamental matrix and of the homography: the lower is taken.
    pub scores: [f64; 2],
}

impl TwoViews {
    fn refused(kind: Kind, count: usize) -> Self {
        Self {
            kind,
            fundamental: None,
            homography: None,
            inliers: vec![false; count],
            sigma_px: f64::INFINITY,
            scores: [f64::INFINITY; 2],
        }
    }
}

/// LMedS, the linear fit over what it keeps, and the M-estimator over that (2.4.3).
pub fn fundamental<M: Model>(
    matches: &[Match],
    draws: usize,
    seed: u64,
    band: Band,
) -> Option<Robust> {
    let drawn = least_median::<M>(matches, draws, seed, band)?;
    let fitted = drawn.fitted::<M>(matches, band).unwrap_or(drawn);
    let model = huber(&fitted.kept(matches), &fitted.model, fitted.sigma_px);
    Some(Robust::of::<M>(model, matches, band))
}

/// LMedS for a homography, and the linear fit over what it keeps.
pub fn plane(matches: &[Match], draws: usize, seed: u64, band: Band) -> Option<Robust> {
    let drawn = least_median::<Plane>(matches, draws, seed, band)?;
    let fitted = drawn.fitted::<Plane>(matches, band).unwrap_or(drawn);
    Some(fitted.fitted::<Plane>(matches, band).unwrap_or(fitted))
}

/// Judges one pair.
pub fn judge(matches: &[Match], seed: u64, settings: &Settings) -> TwoViews {
    let count = matches.len();
    if count < settings.min_matches.max(FromEight::SAMPLE) {
        return TwoViews::refused(Kind::TooFew, count);
    }
    let (draws, band) = (settings.draws, settings.band);
    let deep = if settings.seven {
        fundamental::<FromSeven>(matches, draws, seed, band)
    } else {
        fundamental::<FromEight>(matches, draws, seed, band)
    };
    let flat = plane(matches, settings.plane_draws, seed, band);
    let (planar, scores) = match (&deep, &flat) {
        (Some(deep), Some(flat)) => {
            let found = gric::weigh(deep, flat, matches, settings.least_sigma_px);
            (found.planar, found.scores)
        }
        _ => (deep.is_none(), [f64::INFINITY; 2]),
    };
    let (kind, taken) = if planar {
        (Kind::Planar, flat.as_ref())
    } else {
        (Kind::General, deep.as_ref())
    };
    let Some(taken) = taken else {
        return TwoViews::refused(Kind::MostlyFalse, count);
    };
    let refusal = if (taken.count() as f64) < settings.min_share * count as f64 {
        Some(Kind::MostlyFalse)
    } else if taken.count() < settings.min_matches {
        Some(Kind::TooFew)
    } else {
        None
    };
    if let Some(why) = refusal {
        return TwoViews {
            scores,
            ..TwoViews::refused(why, count)
        };
    }
    TwoViews {
        kind,
        inliers: taken.inliers.clone(),
        sigma_px: taken.sigma_px,
        fundamental: deep.map(|one| one.model),
        homography: flat.map(|one| one.model),
        scores,
    }
}

/// Judges pairs on all cores, each with its own seed.
pub fn judge_all(pairs: &[(Vec<Match>, u64)], settings: &Settings) -> Vec<TwoViews> {
    let each = pairs.par_iter();
    each.map(|(matches, seed)| judge(matches, *seed, settings))
        .collect()
}
