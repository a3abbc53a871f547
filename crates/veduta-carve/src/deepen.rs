//! A volume from which what the colours carved is taken, too.

use rayon::prelude::*;

use crate::error::CarveError;
use crate::volume::{Volume, BLOCK, INSIDE, IN_BLOCK, OUTSIDE};

impl Volume {
    /// The volume where it has the greater of its own evidence and that of `field` (m, less than zero
    /// where nothing is carved), which fills the same cube with `2^levels` values along each edge.
    pub fn deepened(&self, field: &[f32], levels: u32) -> Result<Volume, CarveError> {
        let (given, needed) = (field.len(), 1_usize << (3 * levels));
        if given != needed {
            return Err(CarveError::Field {
                levels,
                needed,
                given,
            });
        }
        let along = self.root.voxels() / BLOCK;
        let shrink = 2.0_f64.powi(levels as i32 - self.root.levels as i32);
        let made: Vec<Option<Vec<f32>>> = self
            .blocks
            .par_iter()
            .enumerate()
            .map(|(block, state)| {
                if *state == OUTSIDE {
                    return None;
                }
                let at = [block / along / along, block / along % along, block % along];
                let mut values = match *state {
                    INSIDE => vec![-self.far_m; IN_BLOCK],
                    order => self.values[order as usize * IN_BLOCK..][..IN_BLOCK].to_vec(),
                };
                let mut changed = *state != INSIDE;
                for (number, value) in values.iter_mut().enumerate() {
                    let inner = [
                        number / BLOCK / BLOCK,
                        number / BLOCK % BLOCK,
                        number % BLOCK,
                    ];
                    let place = std::array::from_fn(|axis| {
                        ((at[axis] * BLOCK + inner[axis]) as f64 + 0.5) * shrink - 0.5
                    });
                    let carved = sample(field, 1 << levels, place).min(self.far_m);
                    changed |= carved > *value;
                    *value = value.max(carved);
                }
                changed.then_some(values)
            })
            .collect();
        let mut blocks = self.blocks.clone();
        let mut values = Vec::with_capacity(self.values.len());
        for (block, own) in made.into_iter().enumerate() {
            if let Some(own) = own {
                blocks[block] = (values.len() / IN_BLOCK) as i32;
                values.extend(own);
            }
        }
        Ok(Volume {
            root: self.root,
            blocks,
            values,
            far_m: self.far_m,
            counts: self.counts.clone(),
        })
    }

    /// Of each voxel (x slowest), whether its centre is inside.
    pub fn solid(&self) -> Vec<bool> {
        let along = self.root.voxels();
        let every = (0..along.pow(3)).into_par_iter();
        let place = |at: usize| [at / along / along, at / along % along, at % along];
        every.map(|at| self.value(place(at)) < 0.0).collect()
    }
}

/// Between the eight values around a place, which is in values.
fn sample(field: &[f32], along: usize, place: [f64; 3]) -> f32 {
    let place = place.map(|one| one.clamp(0.0, (along - 1) as f64));
    let low = place.map(|one| (one as usize).min(along - 2));
    let part: [f32; 3] = std::array::from_fn(|axis| (place[axis] - low[axis] as f64) as f32);
    let mut sum = 0.0;
    for corner in 0..8_usize {
        let bit = [corner >> 2 & 1, corner >> 1 & 1, corner & 1];
        let weight: f32 = (0..3)
            .map(|axis| {
                if bit[axis] == 1 {
                    part[axis]
                } else {
                    1.0 - part[axis]
                }
            })
            .product();
        let at = (low[0] + bit[0]) * along * along + (low[1] + bit[1]) * along + low[2] + bit[2];
        sum += weight * field[at];
    }
    sum
}
