use rayon::prelude::*;
use veduta_surface::Samples;

/// Voxels along an edge of a block.
pub const BLOCK: usize = 8;
/// Voxels of a block.
pub const IN_BLOCK: usize = BLOCK * BLOCK * BLOCK;
pub(crate) const OUTSIDE: i32 = -1;
pub(crate) const INSIDE: i32 = -2;

/// The cube that is carved: 2^levels voxels along each edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    pub low_m: [f64; 3],
    pub side_m: f64,
    pub levels: u32,
}

impl Root {
    pub fn voxels(&self) -> usize {
        1 << self.levels
    }

    pub fn voxel_m(&self) -> f64 {
        self.side_m / self.voxels() as f64
    }

    /// The centre of a voxel.
    pub fn centre(&self, voxel: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| self.low_m[axis] + (voxel[axis] as f64 + 0.5) * self.voxel_m())
    }
}

/// Signed evidence at the centres of voxels (m, less than zero inside), kept in blocks where the
/// surface may pass; elsewhere a block is outside or inside as a whole.
#[derive(Debug, Clone)]
pub struct Volume {
    pub root: Root,
    /// Of each block, x slowest: where its values begin, in blocks, or OUTSIDE or INSIDE.
    pub(crate) blocks: Vec<i32>,
    pub(crate) values: Vec<f32>,
    /// What stands for the blocks without values.
    pub(crate) far_m: f32,
    /// Of each level of the octree, from the root: cubes outside, inside, and on a boundary.
    pub counts: Vec<[usize; 3]>,
}

impl Volume {
    fn along(&self) -> usize {
        self.root.voxels() / BLOCK
    }

    /// The value of a voxel.
    pub fn value(&self, voxel: [usize; 3]) -> f32 {
        let [x, y, z] = voxel.map(|at| at / BLOCK);
        match self.blocks[(x * self.along() + y) * self.along() + z] {
            OUTSIDE => self.far_m,
            INSIDE => -self.far_m,
            at => {
                let [x, y, z] = voxel.map(|at| at % BLOCK);
                self.values[at as usize * IN_BLOCK + (x * BLOCK + y) * BLOCK + z]
            }
        }
    }

    /// Voxels whose centres are inside.
    pub fn inside(&self) -> usize {
        let whole = self.blocks.iter().filter(|at| **at == INSIDE).count();
        let single = self.values.par_iter().filter(|value| **value < 0.0).count();
        whole * IN_BLOCK + single
    }

    /// Bytes that the blocks take.
    pub fn bytes(&self) -> usize {
        4 * (self.blocks.len() + self.values.len())
    }
}

impl Samples for Volume {
    fn size(&self) -> [usize; 3] {
        [self.root.voxels(); 3]
    }

    fn layer(&self, x: usize, into: &mut [f32]) {
        let (along, voxels) = (self.along(), self.root.voxels());
        for by in 0..along {
            for bz in 0..along {
                let at = self.blocks[(x / BLOCK * along + by) * along + bz];
                let place = |y: usize| (by * BLOCK + y) * voxels + bz * BLOCK;
                if at < 0 {
                    let value = if at == OUTSIDE {
                        self.far_m
                    } else {
                        -self.far_m
                    };
                    for y in 0..BLOCK {
                        into[place(y)..][..BLOCK].fill(value);
                    }
                    continue;
                }
                let slab = at as usize * IN_BLOCK + x % BLOCK * BLOCK * BLOCK;
                for y in 0..BLOCK {
                    let row = &self.values[slab + y * BLOCK..][..BLOCK];
                    into[place(y)..][..BLOCK].copy_from_slice(row);
                }
            }
        }
    }
}
