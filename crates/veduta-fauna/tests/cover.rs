//! Gradients against differences of the loss, and what cannot be compared.

use proptest::prelude::*;
use veduta_fauna::{cover, Capsules, Cover, CoverError, Looked};

const START: [usize; 3] = [0, 1, 1];
const END: [usize; 3] = [1, 2, 3];

fn places() -> Vec<[f32; 2]> {
    let side = 0..24u8;
    side.clone()
        .flat_map(|row| side.clone().map(move |column| (row, column)))
        .map(|(row, column)| [f32::from(column) / 12.0 - 0.5, f32::from(row) / 12.0 - 0.5])
        .collect()
}

/// 1 in a box, 0 beside it.
fn shares(places: &[[f32; 2]]) -> Vec<f32> {
    let inside = |p: &[f32; 2]| p.iter().all(|v| (0.1..0.9).contains(v));
    places
        .iter()
        .map(|p| f32::from(u8::from(inside(p))))
        .collect()
}

fn loss(joints: &[[f32; 2]], deep: &[f32]) -> Result<Cover, CoverError> {
    let places = places();
    let (weights, shares) = (vec![1.0; places.len()], shares(&places));
    let capsules = Capsules {
        start: &START,
        end: &END,
        deep,
    };
    let looked = Looked {
        places: &places,
        weights: &weights,
        shares: &shares,
        soft: 0.08,
    };
    cover(&capsules, joints, &looked)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn gradients_are_those_of_the_loss(
        flat in prop::collection::vec(-0.2f32..1.2, 8),
        deep in prop::collection::vec(0.05f32..0.3, 4),
    ) {
        let joints: Vec<[f32; 2]> = flat.chunks(2).map(|p| [p[0], p[1]]).collect();
        let long = |a: usize, b: usize| (joints[a][0] - joints[b][0]).hypot(joints[a][1] - joints[b][1]);
        // Where the ends of a capsule meet its direction is anything.
        prop_assume!((0..3).all(|segment| long(START[segment], END[segment]) > 0.2));
        let Cover { by_joint, by_deep, .. } = loss(&joints, &deep)?;
        // Of all together: where a place lies on the middle of a capsule, one difference is of a kink.
        let (step, mut off, mut size) = (2e-3f32, 0.0f64, 0.0f64);
        let mut hold = |less: f64, more: f64, told: f64| {
            let slope = (more - less) / f64::from(2.0 * step);
            off += (slope - told).powi(2);
            size += slope.powi(2);
        };
        for joint in 0..4 {
            for axis in 0..2 {
                let (mut more, mut less) = (joints.clone(), joints.clone());
                more[joint][axis] += step;
                less[joint][axis] -= step;
                hold(loss(&less, &deep)?.loss[0], loss(&more, &deep)?.loss[0], by_joint[joint][axis]);
            }
            let (mut more, mut less) = (deep.clone(), deep.clone());
            more[joint] += step;
            less[joint] -= step;
            hold(loss(&joints, &less)?.loss[0], loss(&joints, &more)?.loss[0], by_deep[joint]);
        }
        prop_assert!(off.sqrt() < 0.01 + 0.03 * size.sqrt(), "{} of {}", off.sqrt(), size.sqrt());
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let deep = [0.1; 3];
    let capsules = Capsules {
        start: &[0],
        end: &[3],
        deep: &deep,
    };
    let looked = Looked {
        places: &[[0.0, 0.0]],
        weights: &[1.0],
        shares: &[1.0],
        soft: 0.1,
    };
    let joints = [[0.0; 2]; 3];
    let missing = CoverError::Joint { joint: 3, count: 3 };
    assert_eq!(cover(&capsules, &joints, &looked), Err(missing));
    let capsules = Capsules {
        end: &[1],
        ..capsules
    };
    let wrong = CoverError::Size {
        what: "joints",
        given: 2,
        wanted: 0,
    };
    assert_eq!(cover(&capsules, &joints[..2], &looked), Err(wrong));
    let sharp = Looked {
        soft: 0.0,
        ..looked
    };
    assert_eq!(
        cover(&capsules, &joints, &sharp),
        Err(CoverError::Soft { soft: 0.0 })
    );
}

#[test]
fn what_a_frame_does_not_show_pulls_nothing() -> Result<(), CoverError> {
    let (joints, deep) = ([[0.2, 0.2], [0.5, 0.5], [0.9, 0.9], [0.1, 0.9]], [0.1; 4]);
    let places = places();
    let weights = vec![1.0; places.len()];
    let capsules = Capsules {
        start: &START,
        end: &END,
        deep: &deep,
    };
    let hidden = |p: &[f32; 2]| p[0] > 0.6;
    let known: Vec<usize> = (0..places.len()).filter(|&k| !hidden(&places[k])).collect();
    let mut shares = shares(&places);
    for (share, place) in shares.iter_mut().zip(&places) {
        if hidden(place) {
            *share = f32::NAN;
        }
    }
    let found = cover(
        &capsules,
        &joints,
        &Looked {
            places: &places,
            weights: &weights,
            shares: &shares,
            soft: 0.08,
        },
    )?;
    let fewer: Vec<[f32; 2]> = known.iter().map(|&k| places[k]).collect();
    let seen: Vec<f32> = known.iter().map(|&k| shares[k]).collect();
    let alone = cover(
        &capsules,
        &joints,
        &Looked {
            places: &fewer,
            weights: &weights[..known.len()],
            shares: &seen,
            soft: 0.08,
        },
    )?;
    assert!((found.loss[0] - alone.loss[0]).abs() < 1e-4 * alone.loss[0]);
    for (one, other) in found.by_joint.iter().zip(&alone.by_joint) {
        assert!((0..2).all(|axis| (one[axis] - other[axis]).abs() < 1e-3));
    }
    Ok(())
}
