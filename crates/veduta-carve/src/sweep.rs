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
    /// What is so near to an outline (in voxels) stays where nothing farther than that along the view's
    /// ray would hold the silhouette up.
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

/// Between two looks along a ray.
const STEP_VOXELS: f64 = 0.7;
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
    let mut asked = grey(&swept.solid, root.voxels());
    for number in 0..rule.sweeps.max(1) {
        let shell = grey(&swept.solid, root.voxels());
        let judged = judge_all(photos, root, &swept.solid, &shell, &asked, rule);
        if number == 0 {
            swept.hull_spreads = judged.iter().copied().flatten().collect();
        }
        if rule.sweeps == 0 {
            break;
        }
        let wanted = asked.iter().zip(&judged);
        let wanted: Vec<usize> = wanted
            .filter(|(_, spread)| spread.is_some_and(|one| one > rule.spread))
            .map(|(voxel, _)| *voxel)
            .collect();
        let mut left = swept.solid.clone();
        wanted.iter().for_each(|voxel| left[*voxel] = false);
        let (held, gone): (Vec<usize>, Vec<usize>) = wanted
            .par_iter()
            .partition(|voxel| holds_up(views, root, &left, **voxel, rule));
        held.iter().for_each(|voxel| left[*voxel] = true);
        swept.solid = left;
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

/// Whether a silhouette's outline would shrink without a voxel: of all that is left, nothing else lies
/// on the view's ray through it.
fn holds_up(
    views: &[View<'_>],
    root: &Root,
    left: &[bool],
    voxel: usize,
    rule: &SweepRule,
) -> bool {
    let at = root.centre(place(voxel, root.voxels()));
    views.iter().any(|view| {
        let (pixel, depth) = view.projection.project(at);
        let voxel_px = view.projection.focal_px * root.voxel_m() / depth;
        let near = f64::from(view.distance_px(pixel)).abs() < rule.rim_voxels * voxel_px;
        depth > 0.0 && near && !backed(view, root, left, at, rule.rim_voxels)
    })
}

/// Whether something is left on the ray of a view through a place, farther off than so many voxels.
fn backed(view: &View<'_>, root: &Root, left: &[bool], at: [f64; 3], voxels: f64) -> bool {
    let along = root.voxels();
    let way: [f64; 3] = std::array::from_fn(|axis| at[axis] - view.projection.centre_m[axis]);
    let length = way.iter().map(|one| one * one).sum::<f64>().sqrt();
    let solid = |away: f64| -> Option<bool> {
        let mut voxel = 0;
        for axis in 0..3 {
            let place = at[axis] + way[axis] / length * away * root.voxel_m();
            let cell = ((place - root.low_m[axis]) / root.voxel_m()).floor();
            if !(cell >= 0.0 && cell < along as f64) {
                return None;
            }
            voxel = voxel * along + cell as usize;
        }
        Some(left[voxel])
    };
    [1.0, -1.0].iter().any(|sign| {
        let steps = (1..).map(|step| sign * (voxels + STEP_VOXELS * f64::from(step)));
        steps.map_while(solid).any(|one| one)
    })
}

/// Of each voxel that is asked for, the spread of its colours where enough views see it.
fn judge_all(
    photos: &[Photo<'_>],
    root: &Root,
    solid: &[bool],
    shell: &[usize],
    asked: &[usize],
    rule: &SweepRule,
) -> Vec<Option<f32>> {
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
            judge(photos, &maps, root, at, out, rule)
        })
        .collect()
}

fn judge(
    photos: &[Photo<'_>],
    maps: &[DepthMap],
    root: &Root,
    at: [f64; 3],
    out: [f64; 3],
    rule: &SweepRule,
) -> Option<f32> {
    let mut seen: Vec<(f64, [f32; 3])> = Vec::with_capacity(rule.most_views + 1);
    for (photo, map) in photos.iter().zip(maps) {
        let (pixel, depth) = photo.projection.project(at);
        if depth <= 0.0 {
            continue;
        }
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
    (seen.len() >= rule.least_views).then(|| spread_of(&seen))
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
