//! Signed distances to what depth maps show, in blocks of voxels near the surface alone.
//!
//! Curless and Levoy 1996 (A volumetric method for building complex models from range images);
//! blocks as in Niessner et al. 2013 (Real-time 3D reconstruction at scale using voxel hashing).

use std::collections::HashMap;

use rayon::prelude::*;

use crate::camera::Camera;
use crate::consistent::Depths;
use crate::error::StereoError;

/// Voxels along one side of a block.
pub const SIDE: usize = 8;
pub const VOXELS: usize = SIDE * SIDE * SIDE;

#[derive(Clone, Copy, Debug, Default)]
pub struct Voxel {
    /// Mean distance to the surface (of the truncation), positive in front of it.
    pub distance: f32,
    /// Sum of what the views weigh; 0 where none has seen it.
    pub weight: f32,
}

pub type Key = [i32; 3];

pub struct Volume {
    pub voxel_m: f64,
    pub truncation_m: f64,
    pub blocks: Vec<[Voxel; VOXELS]>,
    pub keys: Vec<Key>,
    places: HashMap<Key, usize>,
    most: usize,
}

/// Index of a voxel in its block.
pub const fn voxel_at(x: usize, y: usize, z: usize) -> usize {
    (z * SIDE + y) * SIDE + x
}

impl Volume {
    /// most: blocks that may be taken (each has 4 kB).
    pub fn new(voxel_m: f64, truncation_voxels: f64, most: usize) -> Result<Self, StereoError> {
        if !(voxel_m > 0.0 && voxel_m.is_finite() && truncation_voxels >= 1.0) {
            return Err(StereoError::Voxel(voxel_m));
        }
        Ok(Self {
            voxel_m,
            truncation_m: voxel_m * truncation_voxels,
            blocks: Vec::new(),
            keys: Vec::new(),
            places: HashMap::new(),
            most,
        })
    }

    pub fn place(&self, key: Key) -> Option<usize> {
        self.places.get(&key).copied()
    }

    fn key(&self, point: [f64; 3]) -> Key {
        point.map(|one| (one / (self.voxel_m * SIDE as f64)).floor() as i32)
    }

    /// Takes in a depth map. weights: how much each of its pixels is believed.
    pub fn add(&mut self, view: &Depths<'_>, weights: &[f32]) -> Result<(), StereoError> {
        let touched = self.touched(view)?;
        let (voxel, truncation) = (self.voxel_m, self.truncation_m);
        let keys = &self.keys;
        let mut mark = vec![false; self.blocks.len()];
        touched.iter().for_each(|&at| mark[at] = true);
        self.blocks
            .par_iter_mut()
            .enumerate()
            .filter(|(at, _)| mark[*at])
            .for_each(|(at, block)| integrate(block, keys[at], voxel, truncation, view, weights));
        Ok(())
    }

    /// The blocks within the truncation of what a view shows; new ones are made.
    fn touched(&mut self, view: &Depths<'_>) -> Result<Vec<usize>, StereoError> {
        let steps =
            (2.0 * self.truncation_m / (self.voxel_m * SIDE as f64)).ceil() as usize * 2 + 1;
        let mut found = Vec::new();
        for y in 0..view.height {
            let mut last = usize::MAX;
            for x in 0..view.width {
                let Some(depth) = view.depth(x, y) else {
                    continue;
                };
                for step in 0..steps {
                    let share = step as f64 / (steps - 1) as f64;
                    let deep = depth + (2.0 * share - 1.0) * self.truncation_m;
                    let key = self.key(view.camera.point(Depths::centre(x, y), deep.max(1e-6)));
                    let at = self.block(key)?;
                    if at != last {
                        found.push(at);
                        last = at;
                    }
                }
            }
            found.sort_unstable();
            found.dedup();
        }
        Ok(found)
    }

    fn block(&mut self, key: Key) -> Result<usize, StereoError> {
        if let Some(at) = self.place(key) {
            return Ok(at);
        }
        if self.blocks.len() >= self.most {
            return Err(StereoError::TooManyBlocks(self.most));
        }
        self.places.insert(key, self.blocks.len());
        self.keys.push(key);
        self.blocks.push([Voxel::default(); VOXELS]);
        Ok(self.blocks.len() - 1)
    }
}

fn integrate(
    block: &mut [Voxel; VOXELS],
    key: Key,
    voxel_m: f64,
    truncation_m: f64,
    view: &Depths<'_>,
    weights: &[f32],
) {
    let camera: &Camera = &view.camera;
    for z in 0..SIDE {
        for y in 0..SIDE {
            for x in 0..SIDE {
                let at = [x, y, z];
                let point = std::array::from_fn(|i| {
                    (f64::from(key[i]) * SIDE as f64 + at[i] as f64) * voxel_m
                });
                let seen = camera.seen(point);
                let Some((u, v)) = view.cell(seen) else {
                    continue;
                };
                let Some(depth) = view.depth(u, v) else {
                    continue;
                };
                let distance = depth - seen[2];
                if distance < -truncation_m {
                    continue;
                }
                let share = (distance / truncation_m).min(1.0) as f32;
                let weight = weights[v * view.width + u];
                let voxel = &mut block[voxel_at(x, y, z)];
                let whole = voxel.weight + weight;
                if whole > 0.0 {
                    voxel.distance = (voxel.distance * voxel.weight + share * weight) / whole;
                    voxel.weight = whole;
                }
            }
        }
    }
}
