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
/// how much of each place the silhouette has. All lengths are in one unit.
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
    found
        .loss
        .par_iter_mut()
        .zip(found.by_joint.par_chunks_mut(per_frame))
        .zip(found.by_deep.par_chunks_mut(per_frame))
        .enumerate()
        .for_each(|(frame, ((loss, by_joint), by_deep))| {
            let pose = &joints[frame * per_frame..(frame + 1) * per_frame];
            let shares = &looked.shares[frame * places..(frame + 1) * places];
            *loss = one_frame(capsules, pose, looked, shares, by_joint, by_deep);
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

/// A capsule in one frame.
struct Laid {
    from: [f32; 2],
    along: [f32; 2],
    per_square: f32,
    first: f32,
    taper: f32,
    reach_square: f32,
}

/// What a capsule is at a place.
#[derive(Clone, Copy, Default)]
struct Felt {
    segment: usize,
    inside: f32,
    share: f32,
    away: [f32; 2],
    /// How its radius at the nearest point changes as that moves along it with each of its ends.
    thicker: [[f32; 2]; 2],
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
        }
    })
    .collect()
}

fn one_frame(
    capsules: &Capsules<'_>,
    pose: &[[f32; 2]],
    looked: &Looked<'_>,
    shares: &[f32],
    by_joint: &mut [[f64; 2]],
    by_deep: &mut [f64],
) -> f64 {
    let capsule = laid(capsules, pose, looked.soft);
    let area = shares.iter().sum::<f32>().max(1.0);
    let slope = -2.0 / (looked.soft * area);
    let mut near = vec![Felt::default(); capsule.len()];
    let mut loss = 0.0f64;
    for ((place, &weight), &share) in looked.places.iter().zip(looked.weights).zip(shares) {
        let (count, empty) = felt(&capsule, *place, looked.soft, &mut near);
        let error = 1.0 - empty - share;
        loss += f64::from(weight * error * error);
        let pull = slope * weight * error * empty;
        for one in &near[..count] {
            // By the distance occupancy falls by (1 - occupancy) * inside / soft.
            let all = one.inside * pull;
            let late = all * one.share;
            for (joint, part, thicker) in [
                (capsules.start[one.segment], all - late, one.thicker[0]),
                (capsules.end[one.segment], late, one.thicker[1]),
            ] {
                by_deep[joint] -= f64::from(part);
                for axis in 0..2 {
                    by_joint[joint][axis] -= f64::from(part * one.away[axis] + all * thicker[axis]);
                }
            }
        }
    }
    loss / f64::from(area)
}

/// How many capsules are felt at a place, written to `near`, and how much of it is in none of them.
fn felt(capsules: &[Laid], place: [f32; 2], soft: f32, near: &mut [Felt]) -> (usize, f32) {
    let (mut count, mut empty) = (0, 1.0f32);
    for (segment, one) in capsules.iter().enumerate() {
        let (mut x, mut y) = (place[0] - one.from[0], place[1] - one.from[1]);
        let free = (x * one.along[0] + y * one.along[1]) * one.per_square;
        let share = free.clamp(0.0, 1.0);
        let taper = if free == share {
            one.taper * one.per_square
        } else {
            0.0
        };
        let late = [0, 1].map(|axis| taper * ([x, y][axis] - 2.0 * share * one.along[axis]));
        x -= share * one.along[0];
        y -= share * one.along[1];
        let square = x * x + y * y;
        if square > one.reach_square {
            continue;
        }
        let far = square.sqrt() + 1e-6;
        let apart = (far - one.first - share * one.taper) / soft;
        let inside = 1.0 / (1.0 + apart.clamp(-20.0, 20.0).exp());
        empty *= 1.0 - inside;
        near[count] = Felt {
            segment,
            inside,
            share,
            away: [x / far, y / far],
            thicker: [
                [0, 1].map(|axis| -late[axis] - taper * one.along[axis]),
                late,
            ],
        };
        count += 1;
    }
    (count, empty)
}
