//! How the processor judges the voxels of a sweep: their colours in the photos that see them, and
//! whether they hold an outline up.

use rayon::prelude::*;

use crate::colours::facing;
use crate::error::CarveError;
use crate::sweep::{beside, place, Judge, SweepRule};
use crate::view::{Photo, View};
use crate::visibility::DepthMap;
use crate::volume::Root;

/// Between two looks along a ray.
pub const STEP_VOXELS: f64 = 0.7;
/// A voxel covers what a ball of this radius about its middle covers.
pub const COVER_VOXELS: f64 = 0.6;
/// A voxel is seen where nothing lies more than this before it.
pub const SLACK_VOXELS: f64 = 1.5;

pub(crate) struct Cores<'a> {
    pub(crate) photos: &'a [Photo<'a>],
    pub(crate) views: &'a [View<'a>],
    pub(crate) root: &'a Root,
    pub(crate) rule: &'a SweepRule,
}

impl Judge for Cores<'_> {
    fn spreads(
        &self,
        solid: &[bool],
        shell: &[usize],
        asked: &[usize],
    ) -> Result<Vec<Option<f32>>, CarveError> {
        let Self { photos, root, .. } = *self;
        Ok(judge_all(photos, root, solid, shell, asked, self.rule))
    }

    fn held(&self, left: &[bool], wanted: &[usize]) -> Result<Vec<bool>, CarveError> {
        let each = wanted.par_iter();
        Ok(each
            .map(|voxel| holds_up(self.views, self.root, left, *voxel, self.rule))
            .collect())
    }
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
            DepthMap::of_points(
                &photo.projection,
                size,
                &centres,
                COVER_VOXELS * root.voxel_m(),
            )
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
        if cosine < rule.least_cosine || !map.sees(pixel, depth, SLACK_VOXELS * root.voxel_m()) {
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
