//! What each label costs at each node: how unlike the patches are that it lays upon one another.

use rayon::prelude::*;

use crate::error::{want, WalkError};
use crate::image::Grey;

/// The cost of a label that leaves the image or the epipolar band: worse than any other.
pub const OUTSIDE: f32 = 4.0;

/// Of a node: where it lies in image A (px), where geometry says that it lies in image B (px), the
/// scale by which it looms there (an index into the scales; negative: it is the larger in A), and the
/// epipolar line in B (a x + b y + c = 0, with a and b of unit length; all 0: none).
#[derive(Debug, Clone, Copy)]
pub struct Node {
    pub own: [f32; 2],
    pub there: [f32; 2],
    pub scale: i32,
    pub line: [f32; 3],
}

/// A label: an offset in B (px) from where geometry says, and steps along the scales.
#[derive(Debug, Clone, Copy)]
pub struct Label {
    pub offset: [f32; 2],
    pub step: i32,
}

/// Both images at each of the scales 1 = s0 < s1 < ...: level j is the image shrunk by s_j.
pub struct Levels {
    pub first: Vec<Grey>,
    pub second: Vec<Grey>,
    pub scales: Vec<f32>,
}

/// radius: of the patches (samples). band_px: how far from its epipolar line a label may lie.
/// noise: a contrast (standard deviation) at which a patch is no longer more than noise.
#[derive(Debug, Clone, Copy)]
pub struct Patches {
    pub radius: i32,
    pub band_px: f32,
    pub noise: f32,
}

/// Row by row of the nodes, the cost of each label: 1 - correlation (0..2), or `OUTSIDE`.
pub fn label_costs(
    levels: &Levels,
    nodes: &[Node],
    labels: &[Label],
    patches: Patches,
) -> Result<Vec<f32>, WalkError> {
    let count = levels.scales.len();
    want("the levels of the first image", levels.first.len(), count)?;
    want("the levels of the second image", levels.second.len(), count)?;
    if count == 0 || labels.is_empty() {
        return Err(WalkError::Nothing);
    }
    let mut costs = vec![OUTSIDE; nodes.len() * labels.len()];
    costs
        .par_chunks_mut(labels.len())
        .zip(nodes)
        .for_each(|(row, node)| node_costs(levels, node, labels, patches, row));
    Ok(costs)
}

fn node_costs(levels: &Levels, node: &Node, labels: &[Label], patches: Patches, row: &mut [f32]) {
    let samples = ((2 * patches.radius + 1) * (2 * patches.radius + 1)) as usize;
    let (mut own, mut there) = (vec![0.0; samples], vec![0.0; samples]);
    let most = levels.scales.len() as i32 - 1;
    let mut known: Option<(usize, Option<Spread>)> = None;
    for (label, cost) in labels.iter().zip(row.iter_mut()) {
        let (x, y) = (
            node.there[0] + label.offset[0],
            node.there[1] + label.offset[1],
        );
        if (node.line[0] * x + node.line[1] * y + node.line[2]).abs() > patches.band_px {
            continue;
        }
        let scale = node.scale + label.step;
        if scale.abs() > most {
            continue;
        }
        let (level, other) = ((-scale).max(0) as usize, scale.max(0) as usize);
        if known.is_none_or(|(known_level, _)| known_level != level) {
            let shrunk = levels.scales[level];
            let (px, py) = (node.own[0] / shrunk, node.own[1] / shrunk);
            let taken = levels.first[level].patch(px, py, patches.radius, &mut own);
            known = Some((level, taken.map(|()| centred(&mut own, patches.noise))));
        }
        let Some((_, Some(spread))) = known else {
            continue;
        };
        let shrunk = levels.scales[other];
        let image = &levels.second[other];
        if image
            .patch(x / shrunk, y / shrunk, patches.radius, &mut there)
            .is_some()
        {
            let other_spread = centred(&mut there, patches.noise);
            let along: f32 = own.iter().zip(&there).map(|(a, b)| a * b).sum();
            *cost = 1.0 - along / (spread.0 * other_spread.0);
        }
    }
}

#[derive(Clone, Copy)]
struct Spread(f32);

/// Takes the mean away; the length of what is left, never less than that of noise.
fn centred(values: &mut [f32], noise: f32) -> Spread {
    let count = values.len() as f32;
    let mean = values.iter().sum::<f32>() / count;
    for value in values.iter_mut() {
        *value -= mean;
    }
    let square: f32 = values.iter().map(|value| value * value).sum();
    Spread((square + count * noise * noise).sqrt())
}
