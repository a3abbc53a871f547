//! Surface nets over the blocks of a volume: a vertex in each cell that the surface passes.
//!
//! Gibson 1998 (Constrained elastic surface nets), without the relaxation. A cell with a corner that
//! no view has seen has no vertex: the surface ends there, nothing is bulged over.

use rayon::prelude::*;

use crate::volume::{voxel_at, Volume, Voxel, SIDE};

#[derive(Default)]
pub struct Surface {
    pub points: Vec<[f64; 3]>,
    /// Counter-clockwise seen from where the cameras are.
    pub triangles: Vec<[u32; 3]>,
}

const WITH_NEXT: usize = SIDE + 1;

/// A block's voxels and the first ones of the blocks after it.
struct Padded(Vec<Voxel>);

impl Padded {
    fn new(volume: &Volume, block: usize) -> Self {
        let key = volume.keys[block];
        let mut voxels = vec![Voxel::default(); WITH_NEXT.pow(3)];
        for corner in 0..8usize {
            let next = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
            let other = std::array::from_fn(|i| key[i] + next[i] as i32);
            let Some(from) = volume.place(other) else {
                continue;
            };
            let count = next.map(|one| if one == 1 { 1 } else { SIDE });
            for z in 0..count[2] {
                for y in 0..count[1] {
                    for x in 0..count[0] {
                        let to =
                            padded_at(x + next[0] * SIDE, y + next[1] * SIDE, z + next[2] * SIDE);
                        voxels[to] = volume.blocks[from][voxel_at(x, y, z)];
                    }
                }
            }
        }
        Self(voxels)
    }

    fn at(&self, x: usize, y: usize, z: usize) -> Voxel {
        self.0[padded_at(x, y, z)]
    }
}

const fn padded_at(x: usize, y: usize, z: usize) -> usize {
    (z * WITH_NEXT + y) * WITH_NEXT + x
}

/// The vertices of a block: the cells that have one, sorted, and the number of the first's.
#[derive(Clone, Default)]
struct Cells {
    first: u32,
    cells: Vec<u16>,
}

impl Cells {
    fn vertex(&self, cell: usize) -> Option<u32> {
        let found = self.cells.binary_search(&(cell as u16)).ok()?;
        Some(self.first + found as u32)
    }
}

/// Blocks that are worked on at a time: more would only take more memory.
const AT_ONCE: usize = 4096;

/// The surface at distance 0. least: the weight that a voxel must have to be believed.
pub fn surface(volume: &Volume, least: f32) -> Surface {
    let mut order: Vec<usize> = (0..volume.keys.len()).collect();
    order.sort_unstable_by_key(|&at| volume.keys[at]);
    let mut found = Surface::default();
    let mut index = vec![Cells::default(); volume.keys.len()];
    for some in order.chunks(AT_ONCE) {
        let made: Vec<Vec<(u16, [f64; 3])>> = some
            .par_iter()
            .map(|&block| vertices(volume, block, least))
            .collect();
        for (&block, own) in some.iter().zip(made) {
            index[block] = Cells {
                first: found.points.len() as u32,
                cells: own.iter().map(|one| one.0).collect(),
            };
            found.points.extend(own.into_iter().map(|one| one.1));
        }
    }
    for some in order.chunks(AT_ONCE) {
        let made: Vec<Vec<[u32; 3]>> = some
            .par_iter()
            .map(|&block| quads(volume, block, &index, least))
            .collect();
        found.triangles.extend(made.into_iter().flatten());
    }
    found
}

/// The vertices of a block's cells: cell and point (m).
fn vertices(volume: &Volume, block: usize, least: f32) -> Vec<(u16, [f64; 3])> {
    let padded = Padded::new(volume, block);
    let key = volume.keys[block];
    let mut found = Vec::new();
    for z in 0..SIDE {
        for y in 0..SIDE {
            for x in 0..SIDE {
                if let Some(inside) = crossing(&padded, [x, y, z], least) {
                    let at = [x, y, z];
                    let point = std::array::from_fn(|i| {
                        let first = f64::from(key[i]) * SIDE as f64 + at[i] as f64;
                        (first + f64::from(inside[i])) * volume.voxel_m
                    });
                    found.push((voxel_at(x, y, z) as u16, point));
                }
            }
        }
    }
    found
}

/// The mean of where the surface cuts a cell's edges, in voxels from its first corner.
fn crossing(padded: &Padded, at: [usize; 3], least: f32) -> Option<[f32; 3]> {
    let mut values = [0.0f32; 8];
    let mut behind = 0;
    for (corner, value) in values.iter_mut().enumerate() {
        let voxel = padded.at(
            at[0] + (corner & 1),
            at[1] + (corner >> 1 & 1),
            at[2] + (corner >> 2),
        );
        if voxel.weight < least {
            return None;
        }
        *value = voxel.distance;
        behind += usize::from(voxel.distance < 0.0);
    }
    if behind == 0 || behind == 8 {
        return None;
    }
    let (mut sum, mut count) = ([0.0f32; 3], 0.0f32);
    for first in 0..8usize {
        for axis in 0..3 {
            let second = first | 1 << axis;
            if second == first || (values[first] < 0.0) == (values[second] < 0.0) {
                continue;
            }
            let share = values[first] / (values[first] - values[second]);
            for i in 0..3 {
                sum[i] += (first >> i & 1) as f32 + if i == axis { share } else { 0.0 };
            }
            count += 1.0;
        }
    }
    Some(sum.map(|one| one / count))
}

/// Two triangles for each edge between voxels that the surface cuts.
fn quads(volume: &Volume, block: usize, index: &[Cells], least: f32) -> Vec<[u32; 3]> {
    let padded = Padded::new(volume, block);
    let mut found = Vec::new();
    for z in 0..SIDE {
        for y in 0..SIDE {
            for x in 0..SIDE {
                let own = padded.at(x, y, z);
                if own.weight < least {
                    continue;
                }
                for axis in 0..3 {
                    let mut next = [x, y, z];
                    next[axis] += 1;
                    let other = padded.at(next[0], next[1], next[2]);
                    if other.weight < least || (own.distance < 0.0) == (other.distance < 0.0) {
                        continue;
                    }
                    if let Some(corners) = around(volume, block, index, [x, y, z], axis) {
                        let [a, b, c, d] = corners;
                        if own.distance < 0.0 {
                            found.extend([[a, b, c], [a, c, d]]);
                        } else {
                            found.extend([[a, c, b], [a, d, c]]);
                        }
                    }
                }
            }
        }
    }
    found
}

/// The vertices of the four cells around an edge, counter-clockwise seen from its far end.
fn around(
    volume: &Volume,
    block: usize,
    index: &[Cells],
    at: [usize; 3],
    axis: usize,
) -> Option<[u32; 4]> {
    let (first, second) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut found = [0; 4];
    for (corner, (a, b)) in [(1, 1), (0, 1), (0, 0), (1, 0)].into_iter().enumerate() {
        let mut cell = at.map(|one| one as i32);
        cell[first] -= a;
        cell[second] -= b;
        let mut key = volume.keys[block];
        for i in 0..3 {
            if cell[i] < 0 {
                cell[i] += SIDE as i32;
                key[i] -= 1;
            }
        }
        let table = &index[volume.place(key)?];
        found[corner] = table.vertex(voxel_at(
            cell[0] as usize,
            cell[1] as usize,
            cell[2] as usize,
        ))?;
    }
    Some(found)
}
