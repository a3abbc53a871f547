//! Colour consistency with visibility: voxels of the surface on whose colour the photos disagree are
//! carved, layer by layer (4.3.2; Seitz and Dyer 1997 for the criterion, with a depth map per view and
//! sweep in the place of their order of planes).
//!
//! The rules for neighbours: a voxel that is not outside is grey where one of its six neighbours is
//! outside, and white where none is. Only grey ones are looked at; what a carved voxel uncovers turns
//! from white to grey. All of a sweep are judged by the surface as it was when the sweep began, so that
//! their order does not matter.

use rayon::prelude::*;

use crate::colours::facing;
use crate::error::CarveError;
use crate::view::{Photo, View};
use crate::visibility::DepthMap;
use crate::volume::Root;

/// When a voxel is carved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepRule {
    /// Disagreement of colours (grey levels, root mean square about the mean) that is too much.
    pub spread: f32,
    /// Fewer views that see a voxel say nothing of it; more than so many are not asked.
    pub least_views: usize,
    pub most_views: usize,
    /// Views that see it more slantingly do not count.
    pub least_cosine: f64,
    /// Voxels so near to an outline (in voxels) hold a silhouette up: they stay.
    pub rim_voxels: f64,
    /// Sweeps at most.
    pub sweeps: usize,
}

/// What the sweeps came to.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Swept {
    /// Of each voxel (x slowest), whether it is left.
    pub solid: Vec<bool>,
    /// Voxels carved by each sweep.
    pub carved: Vec<usize>,
    /// The spreads of the hull's voxels that views agree or disagree on, in their order.
    pub hull_spreads: Vec<f32>,
}

const STEPS: [[isize; 3]; 6] = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
];

/// Carves what is solid; photos and views in the same order. With no sweeps it only measures.
pub fn sweep(
    photos: &[Photo<'_>],
    views: &[View<'_>],
    root: &Root,
    solid: Vec<bool>,
    rule: &SweepRule,
) -> Result<Swept, CarveError> {
    for (at, (photo, view)) in photos.iter().zip(views).enumerate() {
        photo.check(at)?;
        view.check(at)?;
    }
    let mut swept = Swept {
        solid,
        ..Swept::default()
    };
    let mut held = vec![false; swept.solid.len()];
    let mut asked = grey(&swept.solid, root.voxels());
    for number in 0..rule.sweeps.max(1) {
        let shell = grey(&swept.solid, root.voxels());
        let judged = judge_all(photos, views, root, &swept.solid, &shell, &asked, rule);
        if number == 0 {
            swept.hull_spreads = judged.iter().filter_map(|one| one.0).collect();
        }
        if rule.sweeps == 0 {
            break;
        }
        let mut gone = Vec::new();
        for (voxel, (spread, rim)) in asked.iter().zip(&judged) {
            held[*voxel] |= *rim;
            if !held[*voxel] && spread.is_some_and(|one| one > rule.spread) {
                gone.push(*voxel);
            }
        }
        for voxel in &gone {
            swept.solid[*voxel] = false;
        }
        swept.carved.push(gone.len());
        if gone.is_empty() {
            break;
        }
        asked = around(&swept.solid, &gone, root.voxels(), 2);
    }
    Ok(swept)
}

fn place(voxel: usize, along: usize) -> [usize; 3] {
    [voxel / along / along, voxel / along % along, voxel % along]
}

fn beside(voxel: usize, step: [isize; 3], along: usize) -> Option<usize> {
    let at = place(voxel, along);
    let mut next = 0;
    for axis in 0..3 {
        let one = at[axis]
            .checked_add_signed(step[axis])
            .filter(|one| *one < along)?;
        next = next * along + one;
    }
    Some(next)
}

fn is_grey(solid: &[bool], voxel: usize, along: usize) -> bool {
    let free = |step: &[isize; 3]| beside(voxel, *step, along).is_none_or(|next| !solid[next]);
    solid[voxel] && STEPS.iter().any(free)
}

fn grey(solid: &[bool], along: usize) -> Vec<usize> {
    let every = (0..solid.len()).into_par_iter();
    every
        .filter(|voxel| is_grey(solid, *voxel, along))
        .collect()
}

/// The grey voxels within so many steps of those that are gone.
fn around(solid: &[bool], gone: &[usize], along: usize, reach: isize) -> Vec<usize> {
    let mut near: Vec<usize> = gone
        .par_iter()
        .flat_map_iter(|voxel| {
            let range = -reach..=reach;
            range.clone().flat_map(move |x| {
                let range = range.clone();
                range.clone().flat_map(move |y| {
                    range
                        .clone()
                        .filter_map(move |z| beside(*voxel, [x, y, z], along))
                })
            })
        })
        .filter(|voxel| is_grey(solid, *voxel, along))
        .collect();
    near.par_sort_unstable();
    near.dedup();
    near
}

/// The way out of the solid, from how full the neighbourhood is.
fn normal(solid: &[bool], voxel: usize, along: usize) -> [f64; 3] {
    let mut out = [0.0; 3];
    for x in -2..=2 {
        for y in -2..=2 {
            for z in -2..=2 {
                let step = [x, y, z];
                if !beside(voxel, step, along).is_some_and(|next| solid[next]) {
                    (0..3).for_each(|axis| out[axis] += step[axis] as f64);
                }
            }
        }
    }
    let length = out.iter().map(|one| one * one).sum::<f64>().sqrt();
    if length > 0.0 {
        out.map(|one| one / length)
    } else {
        [0.0; 3]
    }
}

/// Of each voxel that is asked for, the spread of its colours where enough views see it, and whether
/// it holds an outline up.
fn judge_all(
    photos: &[Photo<'_>],
    views: &[View<'_>],
    root: &Root,
    solid: &[bool],
    shell: &[usize],
    asked: &[usize],
    rule: &SweepRule,
) -> Vec<(Option<f32>, bool)> {
    let along = root.voxels();
    let centres: Vec<[f64; 3]> = shell
        .par_iter()
        .map(|voxel| root.centre(place(*voxel, along)))
        .collect();
    let maps: Vec<DepthMap> = photos
        .par_iter()
        .map(|photo| {
            let size = [photo.width, photo.height];
            DepthMap::of_points(&photo.projection, size, &centres, 0.6 * root.voxel_m())
        })
        .collect();
    asked
        .par_iter()
        .map(|voxel| {
            let at = root.centre(place(*voxel, along));
            let out = normal(solid, *voxel, along);
            judge(photos, views, &maps, root, at, out, rule)
        })
        .collect()
}

fn judge(
    photos: &[Photo<'_>],
    views: &[View<'_>],
    maps: &[DepthMap],
    root: &Root,
    at: [f64; 3],
    out: [f64; 3],
    rule: &SweepRule,
) -> (Option<f32>, bool) {
    let mut seen: Vec<(f64, [f32; 3])> = Vec::with_capacity(rule.most_views + 1);
    let mut rim = false;
    for ((photo, view), map) in photos.iter().zip(views).zip(maps) {
        let (pixel, depth) = photo.projection.project(at);
        if depth <= 0.0 {
            continue;
        }
        let voxel_px = photo.projection.focal_px * root.voxel_m() / depth;
        rim |= f64::from(view.distance_px(pixel)).abs() < rule.rim_voxels * voxel_px;
        let Some(cosine) = facing(photo.projection.centre_m, at, out) else {
            continue;
        };
        if cosine < rule.least_cosine || !map.sees(pixel, depth, 1.5 * root.voxel_m()) {
            continue;
        }
        if let Some(colour) = photo.colour(pixel) {
            let place = seen.partition_point(|one| one.0 >= cosine);
            seen.insert(place, (cosine, colour));
            seen.truncate(rule.most_views);
        }
    }
    let spread = (seen.len() >= rule.least_views).then(|| spread_of(&seen));
    (spread, rim)
}

/// Root mean square distance of the colours from their mean, per channel.
fn spread_of(seen: &[(f64, [f32; 3])]) -> f32 {
    let count = seen.len() as f32;
    let mut squares = 0.0;
    for channel in 0..3 {
        let mean = seen.iter().map(|one| one.1[channel]).sum::<f32>() / count;
        squares += seen
            .iter()
            .map(|one| (one.1[channel] - mean).powi(2))
            .sum::<f32>();
    }
    (squares / (3.0 * count)).sqrt()
}
