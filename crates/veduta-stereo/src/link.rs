//! Correspondences linked along a sequence of views: chapter 3.3 of Moslah's thesis.
//!
//! From each pixel of a view a chain goes up the sequence and one down, a lookup in a map of
//! disparities for each step (3.3, 3.4). Each spot on the way is triangulated with the pixel, a Kalman
//! filter takes the depths together, and a chain ends at the first that does not fit what it has.

use rayon::prelude::*;

use crate::camera::{Camera, Transfer};
use crate::error::StereoError;

pub type Homography = [[f32; 3]; 3];

/// From one view of the sequence to the next.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The next view.
    pub camera: Camera,
    /// Rectified from this view's pixels, and the next view's pixels from rectified ones.
    pub rectified: Homography,
    pub back: Homography,
    pub width: usize,
    pub height: usize,
    /// x in the next view's rectified picture less x in this view's; NaN where unknown.
    pub disparities: &'a [f32],
}

/// When a chain goes on.
#[derive(Clone, Copy, Debug)]
pub struct LinkRule {
    /// Deviation of a link (px); those of a chain add up.
    pub deviation_px: f32,
    /// Deviations by which an estimate may differ from what the chain has.
    pub most_deviations: f32,
    /// How far a spot may lie from the pixel's epipolar line (px).
    pub most_across_px: f32,
    /// Depths that can be (m).
    pub near: f32,
    pub far: f32,
}

/// What the chains of a pixel have found. Depths are NaN where there is no estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Linked {
    pub depths: Vec<f32>,
    /// Of the inverse depth (1/m).
    pub deviations: Vec<f32>,
    pub estimates: Vec<u8>,
}

#[derive(Clone, Copy)]
struct Filter {
    inverse: f32,
    variance: f32,
    estimates: u8,
}

/// Whether chains can be followed.
pub fn check(chains: &[&[Step<'_>]], rule: &LinkRule) -> Result<(), StereoError> {
    if !(rule.near > 0.0 && rule.far > rule.near && rule.far.is_finite()) {
        return Err(StereoError::Range {
            near: rule.near,
            far: rule.far,
        });
    }
    for step in chains.iter().copied().flatten() {
        if step.disparities.len() != step.width * step.height {
            return Err(StereoError::Size {
                width: step.width,
                height: step.height,
                given: step.disparities.len(),
            });
        }
    }
    Ok(())
}

/// The depths of a view. chains: up the sequence and down, from the next view on.
pub fn link(
    camera: Camera,
    size: [usize; 2],
    chains: &[&[Step<'_>]],
    rule: &LinkRule,
) -> Result<Linked, StereoError> {
    check(chains, rule)?;
    let transfers: Vec<Vec<Transfer>> = chains
        .iter()
        .map(|chain| chain.iter().map(|s| Transfer::new(&camera, &s.camera)))
        .map(Iterator::collect)
        .collect();
    let [width, height] = size;
    let found: Vec<Filter> = (0..width * height)
        .into_par_iter()
        .map(|i| {
            let at = [(i % width) as f32 + 0.5, (i / width) as f32 + 0.5];
            let mut filter = Filter {
                inverse: f32::NAN,
                variance: 0.0,
                estimates: 0,
            };
            for (chain, transfers) in chains.iter().zip(&transfers) {
                follow(at, chain, transfers, rule, &mut filter);
            }
            filter
        })
        .collect();
    Ok(Linked {
        depths: found.iter().map(|one| 1.0 / one.inverse).collect(),
        deviations: found.iter().map(|one| one.variance.sqrt()).collect(),
        estimates: found.iter().map(|one| one.estimates).collect(),
    })
}

fn follow(
    at: [f32; 2],
    chain: &[Step<'_>],
    transfers: &[Transfer],
    rule: &LinkRule,
    filter: &mut Filter,
) {
    let mut spot = at;
    for (number, (step, transfer)) in chain.iter().zip(transfers).enumerate() {
        let Some(next) = linked(step, spot) else {
            return;
        };
        spot = next;
        let Some((inverse, pace)) = triangulated(transfer, at, spot, rule) else {
            return;
        };
        let deviation = rule.deviation_px / pace;
        let variance = deviation * deviation * (number + 1) as f32;
        if filter.estimates == 0 {
            *filter = Filter {
                inverse,
                variance,
                estimates: 1,
            };
            continue;
        }
        let both = filter.variance + variance;
        let off = inverse - filter.inverse;
        if off * off > rule.most_deviations * rule.most_deviations * both {
            return;
        }
        let gain = filter.variance / both;
        filter.inverse += gain * off;
        filter.variance *= 1.0 - gain;
        filter.estimates = filter.estimates.saturating_add(1);
    }
}

/// (3.3): rectify, look up, and back from the next view's rectified picture.
fn linked(step: &Step<'_>, spot: [f32; 2]) -> Option<[f32; 2]> {
    let [x, y] = mapped(&step.rectified, spot)?;
    let inside = x >= 0.0 && y >= 0.0 && x < step.width as f32 && y < step.height as f32;
    if !inside {
        return None;
    }
    let disparity = step.disparities[y as usize * step.width + x as usize];
    if disparity.is_nan() {
        return None;
    }
    mapped(&step.back, [x + disparity, y])
}

fn mapped(h: &Homography, [x, y]: [f32; 2]) -> Option<[f32; 2]> {
    let [u, v, w] = [0, 1, 2].map(|row: usize| h[row][0] * x + h[row][1] * y + h[row][2]);
    (w > 0.0).then(|| [u / w, v / w])
}

/// The inverse depth (1/m) at which a pixel is seen nearest to a spot of another view, and by how
/// many pixels the spot moves for one of it.
fn triangulated(
    transfer: &Transfer,
    at: [f32; 2],
    spot: [f32; 2],
    rule: &LinkRule,
) -> Option<(f32, f32)> {
    let far = transfer.apply(at, 0.0);
    let near = transfer.near;
    let e = [far[0] - spot[0] * far[2], far[1] - spot[1] * far[2]];
    let g = [near[0] - spot[0] * near[2], near[1] - spot[1] * near[2]];
    let inverse = -(e[0] * g[0] + e[1] * g[1]) / (g[0] * g[0] + g[1] * g[1]);
    let depth = far[2] + near[2] * inverse;
    let between = inverse >= 1.0 / rule.far && inverse <= 1.0 / rule.near;
    if !(between && depth > 0.0) {
        return None;
    }
    let seen = [0, 1].map(|c: usize| (far[c] + near[c] * inverse) / depth);
    let off = [seen[0] - spot[0], seen[1] - spot[1]];
    if off[0] * off[0] + off[1] * off[1] > rule.most_across_px * rule.most_across_px {
        return None;
    }
    let pace = [0, 1].map(|c: usize| (near[c] - seen[c] * near[2]) / depth);
    Some((inverse, (pace[0] * pace[0] + pace[1] * pace[1]).sqrt()))
}
