//! The hull: an octree with the three-way test of section 4.3.2, and signed evidence where it ends.
//!
//! A cube lies in a sphere, and the sphere's picture in a circle: with the distance to the outline at
//! the circle's middle, one look tells whether the cube is outside of a silhouette, inside, or on its
//! boundary. Only views that see a boundary are looked at again for a cube's children.

use rayon::prelude::*;

use crate::error::CarveError;
use crate::view::View;
use crate::volume::{Root, Volume, BLOCK, INSIDE, IN_BLOCK, OUTSIDE};

pub const LEAST_LEVELS: u32 = 4;
pub const MOST_LEVELS: u32 = 11;
/// Values further from zero than so many voxels are not told apart.
const FAR_VOXELS: f64 = 4.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Outside,
    Inside,
    Boundary,
}

/// A cube of a level of the octree.
#[derive(Debug, Clone)]
pub struct Cube {
    pub at: [u16; 3],
    /// The views that see a boundary in it.
    pub open: Vec<u16>,
}

/// Where cubes are judged and voxels are measured: all of the work that grows with the views.
pub trait Engine {
    /// What each cube of a level is, and the views of it that are still open.
    fn judge(&self, cubes: Vec<Cube>, level: u32) -> Result<Vec<(Verdict, Cube)>, CarveError>;
    /// Of each cube of the last level the evidence at its voxels (m), at most `far_m`, x slowest.
    fn measure(&self, cubes: &[Cube], far_m: f32) -> Result<Vec<f32>, CarveError>;
}

struct Cores<'a> {
    views: &'a [View<'a>],
    root: Root,
}

impl Engine for Cores<'_> {
    fn judge(&self, cubes: Vec<Cube>, level: u32) -> Result<Vec<(Verdict, Cube)>, CarveError> {
        let each = cubes.into_par_iter();
        Ok(each
            .map(|cube| judge(cube, level, self.views, &self.root))
            .collect())
    }

    fn measure(&self, cubes: &[Cube], far_m: f32) -> Result<Vec<f32>, CarveError> {
        let mut values = vec![0.0; cubes.len() * IN_BLOCK];
        values
            .par_chunks_mut(IN_BLOCK)
            .zip(cubes)
            .for_each(|(into, cube)| evaluate(cube, self.views, &self.root, far_m, into));
        Ok(values)
    }
}

/// What the silhouettes leave of the root; a point behind a camera is outside.
pub fn carve(views: &[View<'_>], root: Root) -> Result<Volume, CarveError> {
    check(views, root)?;
    carve_on(&Cores { views, root }, views.len(), root)
}

/// The same on another engine, which has the views. `check` is the caller's.
pub fn carve_on(engine: &dyn Engine, views: usize, root: Root) -> Result<Volume, CarveError> {
    let depth = root.levels - BLOCK.trailing_zeros();
    let along = 1_usize << depth;
    let mut blocks = vec![OUTSIDE; along.pow(3)];
    let every: Vec<u16> = (0..views as u16).collect();
    let mut cubes = vec![Cube {
        at: [0; 3],
        open: every,
    }];
    let mut counts = Vec::new();
    for level in 0..=depth {
        let judged = engine.judge(cubes, level)?;
        let count = |of: Verdict| judged.iter().filter(|one| one.0 == of).count();
        counts.push([Verdict::Outside, Verdict::Inside, Verdict::Boundary].map(count));
        for (_, cube) in judged.iter().filter(|one| one.0 == Verdict::Inside) {
            fill(&mut blocks, along, cube.at, depth - level);
        }
        let open = judged.into_iter().filter(|one| one.0 == Verdict::Boundary);
        let open: Vec<Cube> = open.map(|one| one.1).collect();
        cubes = if level < depth {
            open.iter().flat_map(children).collect()
        } else {
            open
        };
    }
    for (order, cube) in cubes.iter().enumerate() {
        blocks[index(cube.at, along)] = order as i32;
    }
    let far_m = (FAR_VOXELS * root.voxel_m()) as f32;
    let values = engine.measure(&cubes, far_m)?;
    Ok(Volume {
        root,
        blocks,
        values,
        far_m,
        counts,
    })
}

/// Whether the views and the root can be carved.
pub fn check(views: &[View<'_>], root: Root) -> Result<(), CarveError> {
    if views.is_empty() {
        return Err(CarveError::NoViews);
    }
    let (levels, least, most) = (root.levels, LEAST_LEVELS, MOST_LEVELS);
    if !(least..=most).contains(&levels) {
        return Err(CarveError::Levels {
            levels,
            least,
            most,
        });
    }
    if !(root.side_m > 0.0 && root.side_m.is_finite()) {
        return Err(CarveError::Side { side: root.side_m });
    }
    let mut each = views.iter().enumerate();
    each.try_for_each(|(at, view)| view.check(at))
}

fn index(at: [u16; 3], along: usize) -> usize {
    let [x, y, z] = at.map(usize::from);
    (x * along + y) * along + z
}

/// Marks the blocks of a cube that is inside, `deeper` levels above them.
fn fill(blocks: &mut [i32], along: usize, at: [u16; 3], deeper: u32) {
    let [x, y, z] = at.map(|one| usize::from(one) << deeper);
    let side = 1 << deeper;
    for x in x..x + side {
        for y in y..y + side {
            blocks[(x * along + y) * along + z..][..side].fill(INSIDE);
        }
    }
}

fn children(cube: &Cube) -> impl Iterator<Item = Cube> + '_ {
    (0..8).map(|child| Cube {
        at: std::array::from_fn(|axis| cube.at[axis] * 2 + (child >> (2 - axis) & 1)),
        open: cube.open.clone(),
    })
}

/// The three-way test. The sphere reaches a voxel beyond the cube, so that a surface between two
/// voxels never has one of them in a block that is outside or inside as a whole.
fn judge(mut cube: Cube, level: u32, views: &[View<'_>], root: &Root) -> (Verdict, Cube) {
    let side = root.side_m / f64::from(1_u32 << level);
    let middle =
        std::array::from_fn(|axis| root.low_m[axis] + (f64::from(cube.at[axis]) + 0.5) * side);
    let radius = (side / 2.0 + root.voxel_m()) * 3.0_f64.sqrt();
    let mut outside = false;
    cube.open.retain(|view| {
        let seen = if outside {
            Verdict::Outside
        } else {
            judge_in(&views[usize::from(*view)], middle, radius)
        };
        outside |= seen == Verdict::Outside;
        seen == Verdict::Boundary
    });
    let verdict = match (outside, cube.open.is_empty()) {
        (true, _) => Verdict::Outside,
        (false, true) => Verdict::Inside,
        (false, false) => Verdict::Boundary,
    };
    (verdict, cube)
}

fn judge_in(view: &View<'_>, middle: [f64; 3], radius: f64) -> Verdict {
    let ([x, y], depth) = view.projection.project(middle);
    if depth <= -radius {
        return Verdict::Outside;
    }
    if depth <= 1.01 * radius {
        return Verdict::Boundary;
    }
    // A ray through the middle leaves the axis by so much: shifts across it look longer by that.
    let ray =
        std::array::from_fn::<f64, 3, _>(|axis| middle[axis] - view.projection.centre_m[axis]);
    let slant = ray.iter().map(|one| one * one).sum::<f64>().sqrt() / depth;
    // Half a pixel for the distances, which are kept at the middles of pixels.
    let reach = view.projection.focal_px * slant * radius / (depth - radius) + 0.5;
    let distance = f64::from(view.distance_px([x, y]));
    if distance > reach {
        Verdict::Outside
    } else if distance < -reach {
        Verdict::Inside
    } else {
        Verdict::Boundary
    }
}

/// The evidence at the voxels of a block: the largest distance to the cones of the silhouettes.
fn evaluate(cube: &Cube, views: &[View<'_>], root: &Root, far_m: f32, into: &mut [f32]) {
    into.fill(-far_m);
    let first: [usize; 3] = cube.at.map(|one| usize::from(one) * BLOCK);
    for view in cube.open.iter().map(|view| &views[usize::from(*view)]) {
        let rows = view.projection.rows;
        let step = rows.map(|row| row[2] * root.voxel_m());
        for row in 0..BLOCK * BLOCK {
            let start = root.centre([first[0] + row / BLOCK, first[1] + row % BLOCK, first[2]]);
            let base = rows.map(|r| r[0] * start[0] + r[1] * start[1] + r[2] * start[2] + r[3]);
            for (z, value) in into[row * BLOCK..][..BLOCK].iter_mut().enumerate() {
                if *value >= far_m {
                    continue;
                }
                let [x, y, depth]: [f64; 3] = std::array::from_fn(|n| base[n] + step[n] * z as f64);
                if depth <= 0.0 {
                    *value = far_m;
                    continue;
                }
                let pixels = view.distance_px([x / depth, y / depth]);
                let metres = pixels * (depth / view.projection.focal_px) as f32;
                *value = value.max(metres.min(far_m));
            }
        }
    }
}
