//! Colour consistency with visibility: voxels of the surface on whose colour the photos disagree are
//! carved, layer by layer (4.3.2; Seitz and Dyer 1997 for the criterion, with a depth map per view and
//! sweep in the place of their order of planes).
//!
//! The rules for neighbours: a voxel that is not outside is grey where one of its six neighbours is
//! outside, and white where none is. Only grey ones are looked at; what a carved voxel uncovers turns
//! from white to grey. All of a sweep are judged by the surface as it was when the sweep began, so that
//! their order does not matter.

use rayon::prelude::*;

use crate::error::CarveError;
use crate::judging::Cores;
use crate::view::{Photo, View};
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

const STEPS: [[isize; 3]; 6] = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
];

/// Where voxels are judged: all of the work that grows with the views. A voxel is known by its order
/// in the cube, x slowest.
pub trait Judge {
    /// Of each voxel that is asked for, the spread of its colours where enough views see it. shell: the
    /// grey voxels of all that is solid, which hide one another.
    fn spreads(
        &self,
        solid: &[bool],
        shell: &[usize],
        asked: &[usize],
    ) -> Result<Vec<Option<f32>>, CarveError>;
    /// Whether each of the wanted voxels alone holds an outline up, of what would be left without them.
    fn held(&self, left: &[bool], wanted: &[usize]) -> Result<Vec<bool>, CarveError>;
}

/// Carves what is solid; photos and views in the same order. With no sweeps it only measures.
pub fn sweep(
    photos: &[Photo<'_>],
    views: &[View<'_>],
    root: &Root,
    solid: Vec<bool>,
    rule: &SweepRule,
) -> Result<Swept, CarveError> {
    check(photos, views)?;
    let cores = Cores {
        photos,
        views,
        root,
        rule,
    };
    sweep_on(&cores, root, solid, rule)
}

/// Whether photos and views can be looked at.
pub fn check(photos: &[Photo<'_>], views: &[View<'_>]) -> Result<(), CarveError> {
    for (at, (photo, view)) in photos.iter().zip(views).enumerate() {
        photo.check(at)?;
        view.check(at)?;
    }
    Ok(())
}

/// The same on another engine, which has photos and views. `check` is the caller's.
pub fn sweep_on(
    engine: &dyn Judge,
    root: &Root,
    solid: Vec<bool>,
    rule: &SweepRule,
) -> Result<Swept, CarveError> {
    let mut swept = Swept {
        solid,
        ..Swept::default()
    };
    let mut asked = grey(&swept.solid, root.voxels());
    for number in 0..rule.sweeps.max(1) {
        let shell = grey(&swept.solid, root.voxels());
        let judged = engine.spreads(&swept.solid, &shell, &asked)?;
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
        let held = engine.held(&left, &wanted)?;
        let mut gone = Vec::with_capacity(wanted.len());
        for (voxel, held) in wanted.into_iter().zip(held) {
            left[voxel] = held;
            if !held {
                gone.push(voxel);
            }
        }
        swept.solid = left;
        swept.carved.push(gone.len());
        if gone.is_empty() {
            break;
        }
        asked = around(&swept.solid, &gone, root.voxels(), 2);
    }
    Ok(swept)
}

/// Where in the cube a voxel lies.
pub(crate) fn place(voxel: usize, along: usize) -> [usize; 3] {
    [voxel / along / along, voxel / along % along, voxel % along]
}

pub(crate) fn beside(voxel: usize, step: [isize; 3], along: usize) -> Option<usize> {
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
