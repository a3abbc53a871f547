//! Whether a homography explains matches as well as a fundamental matrix: then they do not
//! determine the latter.
//!
//! The geometric robust information criterion (Torr, An assessment of information criteria for
//! motion model selection, CVPR 1997): the model of the lower score is taken. An error costs its
//! square by the noise's, at most so much; a model costs by its dimension and its numbers.

use nalgebra::Matrix3;

use crate::distance::{sampson, sampson_plane};
use crate::matches::Match;
use crate::robust::Robust;

/// Numbers of a match: two coordinates in each photo.
const COORDINATES: f64 = 4.0;

/// Squared distance from the plane, by the noise's variance, that one in a hundred of its own
/// matches has (chi-squared of two freedoms).
const OFF_PLANE: f64 = 9.21;
/// Matches off the plane that there must be: fewer are found by chance, as F can be turned to fit
/// false ones, and the noise is known only so well.
const FEWEST_OFF: usize = 8;
/// Their share of what F explains. Of noisy planes with a fifth of false matches, F explained at most
/// 4.5 % off the plane (400 matches), of scenes in depth at least 83 %.
const LEAST_OFF: f64 = 0.05;

/// F and H by what they say of the same matches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weighed {
    /// Scores of F and of H; the lower explains better.
    pub scores: [f64; 2],
    /// Matches off the plane that F explains.
    pub off_plane: usize,
    /// H is taken: its score is lower, or too little lies off its plane to determine an F.
    pub planar: bool,
}

/// Weighs F against H. False matches to both are left out: they would speak for F, which has more
/// room.
pub fn weigh(deep: &Robust, flat: &Robust, matches: &[Match], least_sigma_px: f64) -> Weighed {
    let sigma_px = noise(deep, matches).max(least_sigma_px);
    let each = (0..matches.len()).filter(|&at| deep.inliers[at] || flat.inliers[at]);
    let told: Vec<Match> = each.map(|at| matches[at]).collect();
    let scores = [
        of_fundamental(&deep.model, &told, sigma_px),
        of_homography(&flat.model, &told, sigma_px),
    ];
    let far = OFF_PLANE * sigma_px * sigma_px;
    let kept = deep.kept(matches);
    let off = |one: &&Match| sampson_plane(&flat.model, one) > far;
    let off_plane = kept.iter().filter(off).count();
    let enough = off_plane >= FEWEST_OFF && off_plane as f64 >= LEAST_OFF * kept.len() as f64;
    Weighed {
        scores,
        off_plane,
        planar: scores[1] <= scores[0] || !enough,
    }
}

/// Standard deviation of a coordinate (px), by the matches that F explains: it is the wider model,
/// and its errors are noise where a plane's may be depth. F has fitted seven numbers of them.
fn noise(deep: &Robust, matches: &[Match]) -> f64 {
    let kept = deep.kept(matches);
    let sum: f64 = kept.iter().map(|one| sampson(&deep.model, one)).sum();
    (sum / kept.len().saturating_sub(7).max(1) as f64).sqrt()
}

/// Score of squared errors under a model whose matches have `dimension` freedoms, and which itself
/// has `numbers`. sigma_px: standard deviation of a coordinate.
fn score(squared: impl Iterator<Item = f64>, sigma_px: f64, dimension: f64, numbers: f64) -> f64 {
    let most = 2.0 * (COORDINATES - dimension);
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for one in squared {
        sum += (one / (sigma_px * sigma_px)).min(most);
        count += 1.0;
    }
    sum + COORDINATES.ln() * dimension * count + (COORDINATES * count).ln() * numbers
}

/// Score of a fundamental matrix: a match moves along its epipolar lines.
fn of_fundamental(f: &Matrix3<f64>, matches: &[Match], sigma_px: f64) -> f64 {
    score(
        matches.iter().map(|one| sampson(f, one)),
        sigma_px,
        3.0,
        7.0,
    )
}

/// Score of a homography: one point gives the other.
fn of_homography(h: &Matrix3<f64>, matches: &[Match], sigma_px: f64) -> f64 {
    score(
        matches.iter().map(|one| sampson_plane(h, one)),
        sigma_px,
        2.0,
        8.0,
    )
}
