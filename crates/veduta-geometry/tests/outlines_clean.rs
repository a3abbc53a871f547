//! Dirty outlines: mended to known shapes, or refused.

use proptest::prelude::*;
use veduta_geometry::skeleton::tolerance::CleanTolerance;
use veduta_geometry::skeleton::{clean, roof, Cleaned, SkeletonError};

use crate::footprints;

type Rings = Vec<Vec<[f64; 2]>>;

fn cleaned(rings: &[Vec<[f64; 2]>]) -> Result<Cleaned, SkeletonError> {
    let speeds = vec![1.0; rings.iter().map(Vec::len).sum()];
    let found = clean(rings, &speeds, &CleanTolerance::default())?;
    for eaves in &found.eaves {
        roof(eaves, None)?;
    }
    Ok(found)
}

fn rings_of(found: &Cleaned, polygon: usize) -> Rings {
    let eaves = &found.eaves[polygon];
    (0..eaves.ring_count())
        .map(|ring| eaves.ring(ring).to_vec())
        .collect()
}

fn square(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
    vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
}

#[test]
fn needless_points_go_and_winding_is_set_right() {
    let outline = vec![
        [0.0, 10.0],
        [10.0, 10.0],
        [10.0, 10.0],
        [10.0, 5.0],
        [10.00001, 3.0],
        [10.0, 0.0],
        [0.0, 0.0],
        [0.0, 0.0003],
        [0.0, 10.0],
    ];
    let found = cleaned(&[outline, square(4.0, 4.0, 2.0)]).unwrap();
    let rings = rings_of(&found, 0);
    assert_eq!((rings[0].len(), rings[1].len()), (4, 4));
    assert!((found.eaves[0].area_m2() - 96.0).abs() < 1e-2);
    // Reversed: the edge from (10, 10) down to (10, 0) was 4 pieces, the longest of which stays.
    let corner = rings[0].iter().position(|p| *p == [10.0, 0.0]).unwrap();
    assert_eq!(found.edges[0][corner], 2);
}

#[test]
fn straight_points_stay_where_speeds_differ() {
    let outline = vec![
        [0.0, 0.0],
        [5.0, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [0.0, 10.0],
    ];
    let speeds = [1.0, 2.0, 1.0, 1.0, 1.0];
    let found = clean(&[outline], &speeds, &CleanTolerance::default()).unwrap();
    assert_eq!(found.eaves[0].speeds(), speeds);
}

#[test]
fn spikes_go() {
    let mut outline = square(0.0, 0.0, 10.0);
    outline.splice(1..1, [[6.0, 0.0], [6.0, -3.0], [6.0, 0.0]]);
    outline.extend([[0.0, 4.0], [3.0, 4.0], [0.0, 4.0]]);
    let found = cleaned(&[outline]).unwrap();
    assert_eq!(rings_of(&found, 0), vec![square(0.0, 0.0, 10.0)]);
    assert!(found.area_change_m2.abs() < 1e-12);
}

#[test]
fn lobes_come_apart() {
    let mut outline = square(0.0, 0.0, 10.0);
    outline.splice(
        3..3,
        [[15.0, 10.0], [15.0, 15.0], [10.0, 15.0], [10.0, 10.0]],
    );
    let found = cleaned(&[outline]).unwrap();
    let areas: Vec<f64> = found.eaves.iter().map(|eaves| eaves.area_m2()).collect();
    assert_eq!(areas, [100.0, 25.0]);
}

#[test]
fn a_keyhole_becomes_a_hole() {
    let outline = vec![
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [0.0, 10.0],
        [0.0, 0.0],
        [4.0, 4.0],
        [4.0, 6.0],
        [6.0, 6.0],
        [6.0, 4.0],
        [4.0, 4.0],
    ];
    let found = cleaned(&[outline]).unwrap();
    assert_eq!(found.eaves.len(), 1);
    assert_eq!(found.eaves[0].ring_count(), 2);
    assert_eq!(found.eaves[0].area_m2(), 96.0);
}

#[test]
fn a_hole_that_touches_is_moved_off() {
    let hole = vec![[0.0, 5.0], [3.0, 6.0], [3.0, 4.0]];
    let found = cleaned(&[square(0.0, 0.0, 10.0), hole]).unwrap();
    assert_eq!(found.eaves[0].ring_count(), 2);
    assert!(found.area_change_m2.abs() < 0.01 && found.area_change_m2 != 0.0);
    // A corner of a courtyard that reaches the opposite wall of a bay from inside.
    let pinched = vec![
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [6.0, 10.0],
        [5.0, 0.0],
        [4.0, 10.0],
        [0.0, 10.0],
    ];
    let found = cleaned(&[pinched]).unwrap();
    assert_eq!(found.eaves.len(), 1);
}

#[test]
fn what_cannot_be_mended_is_refused() {
    let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 5.0]];
    assert!(cleaned(&[bow]).is_err());
    let line = vec![[0.0, 0.0], [4.0, 0.0], [8.0, 0.0]];
    assert_eq!(cleaned(&[line]), Err(SkeletonError::Vanished));
    assert!(matches!(
        cleaned(&[vec![]]),
        Err(SkeletonError::RingTooShort { .. })
    ));
    assert_eq!(cleaned(&[]), Err(SkeletonError::Vanished));
    // 0.9 mm of a wall of 4 mm is more than the area may change.
    let thin = vec![
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 0.004],
        [5.0, 0.0049],
        [0.0, 0.004],
    ];
    let coarse = CleanTolerance {
        off_line_m: 2e-3,
        ..CleanTolerance::default()
    };
    let refused = clean(&[thin], &[1.0; 5], &coarse);
    assert!(
        matches!(refused, Err(SkeletonError::AreaChange { .. })),
        "{refused:?}"
    );
}

#[test]
fn clean_outlines_stay_as_they_are() {
    for (name, rings) in footprints::hard_footprints().unwrap_or_default() {
        let found = cleaned(&rings).unwrap();
        assert_eq!(found.eaves.len(), 1, "{name}");
        let same = |(a, b): (&Vec<[f64; 2]>, &Vec<[f64; 2]>)| {
            let start = b.iter().position(|p| *p == a[0]).unwrap();
            a.len() == b.len()
                && a.iter()
                    .enumerate()
                    .all(|(k, p)| *p == b[(start + k) % b.len()])
        };
        assert!(rings.iter().zip(&rings_of(&found, 0)).all(same), "{name}");
        assert_eq!(found.area_change_m2, 0.0, "{name}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Points of a coarse grid, so that most rings touch, fold or cross: refused, or roofed over.
    #[test]
    fn whatever_is_not_refused_has_a_roof(
        rings in prop::collection::vec(prop::collection::vec((0..6i32, 0..6i32), 3..12), 1..3),
        noise in prop::sample::select(vec![0.0, 1e-9, 1e-6, 1e-4, 1e-3]),
    ) {
        let point = |(k, &(x, y)): (usize, &(i32, i32))| {
            let off = noise * ((k * 7919) % 13) as f64 / 13.0;
            [f64::from(x) + off, f64::from(y) - off]
        };
        let rings: Rings = rings.iter().map(|ring| ring.iter().enumerate().map(point).collect()).collect();
        let speeds = vec![1.0; rings.iter().map(Vec::len).sum()];
        if let Ok(found) = clean(&rings, &speeds, &CleanTolerance::default()) {
            for (eaves, edges) in found.eaves.iter().zip(&found.edges) {
                prop_assert_eq!(eaves.len(), edges.len());
                prop_assert!(roof(eaves, None).is_ok(), "{:?}", roof(eaves, None));
            }
        }
    }
}
