//! Soft occupancy of tapered capsules against silhouettes, with gradients in closed form.
//!
//! A capsule occupies a place by 1 / (1 + exp(d / soft)), d the distance to its surface. Several are
//! joined as what is in none of them: 1 - prod(1 - o), so each of them feels every place near to it.

use rayon::prelude::*;

use crate::error::CoverError;

/// Beyond so many widths of an edge a capsule is not felt: it occupies little more than a ten thousandth.
const FELT: f32 = 9.0;

/// The segments of a figure: numbers of the joints that each begins and ends at, and half of the
/// thickness at each joint.
pub struct Capsules<'a> {
    pub start: &'a [usize],
    pub end: &'a [usize],
    pub deep: &'a [f32],
}

/// What a figure is compared with: the places looked at, how much each counts, and, frame by frame,
/// how much of each place the silhouette has, NaN where a frame does not show it. All lengths are in
/// one unit.
pub struct Looked<'a> {
    pub places: &'a [[f32; 2]],
    pub weights: &'a [f32],
    pub shares: &'a [f32],
    pub soft: f32,
}

/// The loss of each frame: weighted squared difference for the silhouette's area, and its gradients,
/// frame by frame and joint by joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    pub loss: Vec<f64>,
    pub by_joint: Vec<[f64; 2]>,
    pub by_deep: Vec<f64>,
}

/// Compares a figure with the silhouettes of all frames. joints: frame by frame, as many for each as
/// there are thicknesses.
pub fn cover(
    capsules: &Capsules<'_>,
    joints: &[[f32; 2]],
    looked: &Looked<'_>,
) -> Result<Cover, CoverError> {
    let per_frame = capsules.deep.len();
    let frames = check(capsules, joints, looked)?;
    let places = looked.places.len();
    let mut found = Cover {
        loss: vec![0.0; frames],
        by_joint: vec![[0.0; 2]; joints.len()],
        by_deep: vec![0.0; joints.len()],
    };
    if frames == 0 || per_frame == 0 || places == 0 {
        return Ok(found);
    }
    let blocks = blocks(looked);
    found
        .loss
        .par_iter_mut()
        .zip(found.by_joint.par_chunks_mut(per_frame))
        .zip(found.by_deep.par_chunks_mut(per_frame))
        .enumerate()
        .for_each(|(frame, ((loss, by_joint), by_deep))| {
            let pose = &joints[frame * per_frame..(frame + 1) * per_frame];
            let shares = &looked.shares[frame * places..(frame + 1) * places];
            *loss = one_frame(capsules, pose, looked, &blocks, shares, by_joint, by_deep);
        });
    Ok(found)
}

fn check(
    capsules: &Capsules<'_>,
    joints: &[[f32; 2]],
    looked: &Looked<'_>,
) -> Result<usize, CoverError> {
    let per_frame = capsules.deep.len();
    let wrong = |what, given, wanted| CoverError::Size {
        what,
        given,
        wanted,
    };
    if capsules.end.len() != capsules.start.len() {
        return Err(wrong("end", capsules.end.len(), capsules.start.len()));
    }
    for &joint in capsules.start.iter().chain(capsules.end) {
        if joint >= per_frame {
            return Err(CoverError::Joint {
                joint,
                count: per_frame,
            });
        }
    }
    let frames = joints.len().checked_div(per_frame).unwrap_or(0);
    if frames * per_frame != joints.len() {
        return Err(wrong("joints", joints.len(), frames * per_frame));
    }
    if looked.weights.len() != looked.places.len() {
        return Err(wrong("weights", looked.weights.len(), looked.places.len()));
    }
    if looked.shares.len() != frames * looked.places.len() {
        let wanted = frames * looked.places.len();
        return Err(wrong("shares", looked.shares.len(), wanted));
    }
    if looked.soft <= 0.0 || !looked.soft.is_finite() {
        return Err(CoverError::Soft { soft: looked.soft });
    }
    Ok(frames)
}

/// Places are looked at so many together, which one instruction does for several of them.
const LANES: usize = 16;

type Lanes = [f32; LANES];

/// Places that lie together: the box around them, their weights; what is missing weighs nothing.
struct Block {
    x: Lanes,
    y: Lanes,
    weights: Lanes,
    low: [f32; 2],
    high: [f32; 2],
}

fn blocks(looked: &Looked<'_>) -> Vec<Block> {
    let parts = looked
        .places
        .chunks(LANES)
        .zip(looked.weights.chunks(LANES));
    parts
        .map(|(places, own)| {
            let at = |axis: usize, lane: usize| places[lane.min(places.len() - 1)][axis];
            let least = |axis| places.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
            let most = |axis| {
                places
                    .iter()
                    .map(|p| p[axis])
                    .fold(f32::NEG_INFINITY, f32::max)
            };
            let mut weights = [0.0; LANES];
            weights[..own.len()].copy_from_slice(own);
            Block {
                x: std::array::from_fn(|lane| at(0, lane)),
                y: std::array::from_fn(|lane| at(1, lane)),
                weights,
                low: [0, 1].map(least),
                high: [0, 1].map(most),
            }
        })
        .collect()
}

/// A capsule in one frame, and the box in which it is felt.
struct Laid {
    from: [f32; 2],
    along: [f32; 2],
    per_square: f32,
    first: f32,
    taper: f32,
    reach_square: f32,
    low: [f32; 2],
    high: [f32; 2],
}

/// What a capsule is at the places of a block.
#[derive(Clone, Default)]
struct Felt {
    segment: usize,
    inside: Lanes,
    share: Lanes,
    away: [Lanes; 2],
    /// By how much its radius at the nearest point grows as that moves along it with its second end,
    /// and, for its length, with its first end the other way.
    thicker: [Lanes; 2],
    taper: Lanes,
}

fn laid(capsules: &Capsules<'_>, pose: &[[f32; 2]], soft: f32) -> Vec<Laid> {
    let ends = capsules.start.iter().zip(capsules.end);
    ends.map(|(&start, &end)| {
        let (a, b) = (pose[start], pose[end]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = (along[0] * along[0] + along[1] * along[1]).max(1e-9);
        let (first, last) = (capsules.deep[start], capsules.deep[end]);
        let reach = (first.max(last) + FELT * soft).max(0.0);
        Laid {
            from: a,
            along,
            per_square: 1.0 / square,
            first,
            taper: last - first,
            reach_square: reach * reach,
            low: [0, 1].map(|axis| a[axis].min(b[axis]) - reach),
            high: [0, 1].map(|axis| a[axis].max(b[axis]) + reach),
        }
    })
    .collect()
}

fn one_frame(
    capsules: &Capsules<'_>,
    pose: &[[f32; 2]],
    looked: &Looked<'_>,
    blocks: &[Block],
    shares: &[f32],
    by_joint: &mut [[f64; 2]],
    by_deep: &mut [f64],
) -> f64 {
    let capsule = laid(capsules, pose, looked.soft);
    let known = shares.iter().filter(|share| !share.is_nan());
    let area = known.sum::<f32>().max(1.0);
    let slope = -2.0 / (looked.soft * area);
    let mut near = vec![Felt::default(); capsule.len()];
    let mut loss = 0.0f64;
    for (block, own) in blocks.iter().zip(shares.chunks(LANES)) {
        let mut share = [0.0; LANES];
        share[..own.len()].copy_from_slice(own);
        let mut empty = [1.0; LANES];
        let mut count = 0;
        for (segment, one) in capsule.iter().enumerate() {
            let apart = (0..2).any(|k| block.high[k] < one.low[k] || block.low[k] > one.high[k]);
            if !apart {
                near[count].segment = segment;
                felt(one, block, looked.soft, &mut near[count], &mut empty);
                count += 1;
            }
        }
        let mut pull = [0.0; LANES];
        let mut lost = 0.0f32;
        for lane in 0..LANES {
            let shown = !share[lane].is_nan();
            let error = if shown {
                1.0 - empty[lane] - share[lane]
            } else {
                0.0
            };
            lost += block.weights[lane] * error * error;
            pull[lane] = slope * block.weights[lane] * error * empty[lane];
        }
        loss += f64::from(lost);
        for one in &near[..count] {
            pulled(
                capsules,
                &capsule[one.segment],
                one,
                &pull,
                by_joint,
                by_deep,
            );
        }
    }
    loss / f64::from(area)
}

/// Adds what a capsule's places say of its joints: by the distance occupancy falls by
/// (1 - occupancy) * inside / soft.
fn pulled(
    capsules: &Capsules<'_>,
    laid: &Laid,
    one: &Felt,
    pull: &Lanes,
    by_joint: &mut [[f64; 2]],
    by_deep: &mut [f64],
) {
    let (mut early, mut late) = ([0.0f32; 3], [0.0f32; 3]);
    let (mut grown, mut tapered) = ([0.0f32; 2], 0.0f32);
    for lane in 0..LANES {
        let all = one.inside[lane] * pull[lane];
        let second = all * one.share[lane];
        let first = all - second;
        let away = [one.away[0][lane], one.away[1][lane], 1.0];
        for k in 0..3 {
            early[k] += first * away[k];
            late[k] += second * away[k];
        }
        grown[0] += all * one.thicker[0][lane];
        grown[1] += all * one.thicker[1][lane];
        tapered += all * one.taper[lane];
    }
    let (start, end) = (capsules.start[one.segment], capsules.end[one.segment]);
    by_deep[start] -= f64::from(early[2]);
    by_deep[end] -= f64::from(late[2]);
    for axis in 0..2 {
        by_joint[start][axis] -= f64::from(early[axis] - grown[axis] - tapered * laid.along[axis]);
        by_joint[end][axis] -= f64::from(late[axis] + grown[axis]);
    }
}

/// What a capsule is at the places of a block; `empty`, what is in none, loses what is in it.
fn felt(one: &Laid, block: &Block, soft: f32, found: &mut Felt, empty: &mut Lanes) {
    for lane in 0..LANES {
        let (x, y) = (block.x[lane] - one.from[0], block.y[lane] - one.from[1]);
        let free = (x * one.along[0] + y * one.along[1]) * one.per_square;
        let share = free.clamp(0.0, 1.0);
        let taper = if free == share {
            one.taper * one.per_square
        } else {
            0.0
        };
        let (right, up) = (x - share * one.along[0], y - share * one.along[1]);
        let square = right * right + up * up;
        let far = square.sqrt() + 1e-6;
        let apart = (far - one.first - share * one.taper) / soft;
        let there = 1.0 / (1.0 + exponential(apart.clamp(-20.0, 20.0)));
        let inside = if square > one.reach_square {
            0.0
        } else {
            there
        };
        empty[lane] *= 1.0 - inside;
        found.inside[lane] = inside;
        found.share[lane] = share;
        found.away[0][lane] = right / far;
        found.away[1][lane] = up / far;
        found.thicker[0][lane] = taper * (x - 2.0 * share * one.along[0]);
        found.thicker[1][lane] = taper * (y - 2.0 * share * one.along[1]);
        found.taper[lane] = taper;
    }
}

/// e^x to a few millionths for x within 80 of 0, in steps that go for many lanes at once: 2^k by the
/// bits of a number, and a polynomial for the rest (Taylor's, |x ln 2| <= 0.35).
fn exponential(x: f32) -> f32 {
    const ROUND: f32 = 12_582_912.0; // 1.5 * 2^23: what is added to it is rounded to whole numbers
    let turns = x * std::f32::consts::LOG2_E;
    let rounded = turns + ROUND;
    let rest = (turns - (rounded - ROUND)) * std::f32::consts::LN_2;
    let low = 1.0 + rest * (1.0 + rest * (0.5 + rest * (1.0 / 6.0)));
    let high = rest * rest * rest * rest * (1.0 / 24.0 + rest * (1.0 / 120.0));
    let power = f32::from_bits((rounded.to_bits() << 23).wrapping_add(127 << 23));
    (low + high) * power
}
