//! A vehicle in a drawn yard must be found, and the same seed must give the same numbers.

#![allow(clippy::unwrap_used)]

use veduta_drive::{DriveError, EdgeField, Estimate, Filter, Settings, Start};

const SIDE: usize = 120;
const CELL_M: f64 = 0.5;

/// Walls at x = 10 and x = 50, y = 5 and y = 55, and one that ends the symmetry.
fn walls() -> Vec<([f64; 2], [f64; 2])> {
    vec![
        ([10.0, 5.0], [10.0, 55.0]),
        ([50.0, 5.0], [50.0, 55.0]),
        ([10.0, 5.0], [50.0, 5.0]),
        ([10.0, 55.0], [50.0, 55.0]),
        ([10.0, 20.0], [22.0, 20.0]),
        ([22.0, 20.0], [22.0, 26.0]),
    ]
}

fn to_segment(x: f64, y: f64, (one, two): &([f64; 2], [f64; 2])) -> f64 {
    let along = [two[0] - one[0], two[1] - one[1]];
    let length = along[0] * along[0] + along[1] * along[1];
    let share = ((x - one[0]) * along[0] + (y - one[1]) * along[1]) / length;
    let share = share.clamp(0.0, 1.0);
    (x - one[0] - share * along[0]).hypot(y - one[1] - share * along[1])
}

fn field() -> EdgeField {
    let walls = walls();
    let distance = (0..SIDE * SIDE)
        .map(|cell| {
            let x = (cell % SIDE) as f64 * CELL_M + CELL_M / 2.0;
            let y = (cell / SIDE) as f64 * CELL_M + CELL_M / 2.0;
            walls
                .iter()
                .map(|wall| to_segment(x, y, wall))
                .fold(f64::MAX, f64::min) as f32
        })
        .collect();
    EdgeField::new(distance, SIDE, SIDE, [0.0, 0.0], CELL_M).unwrap()
}

/// What 90 beams all around see of the walls from a pose.
fn scan(pose: [f64; 3]) -> Vec<[f64; 2]> {
    (0..90)
        .filter_map(|beam| {
            let local = f64::from(beam) * std::f64::consts::TAU / 90.0;
            let (sine, cosine) = (local + pose[2]).sin_cos();
            let nearest = walls()
                .iter()
                .filter_map(|(one, two)| {
                    let along = [two[0] - one[0], two[1] - one[1]];
                    let cross = cosine * along[1] - sine * along[0];
                    let offset = [one[0] - pose[0], one[1] - pose[1]];
                    let range = (offset[0] * along[1] - offset[1] * along[0]) / cross;
                    let share = (offset[0] * sine - offset[1] * cosine) / cross;
                    (range > 0.0 && (0.0..=1.0).contains(&share)).then_some(range)
                })
                .fold(f64::MAX, f64::min);
            (nearest < 80.0).then(|| [nearest * local.cos(), nearest * local.sin()])
        })
        .collect()
}

fn settings(seed: u64) -> Settings {
    Settings {
        particles: 3000,
        first_draws: 30_000,
        seed,
        sigma_m: 0.5,
        widest_sigma_m: 2.0,
        spread_share: 0.2,
        outlier: 0.05,
        outside: 0.2,
        blocked: 0.3,
        worth: 12.0,
        draw_below: 0.5,
    }
}

fn run(seed: u64) -> (Vec<Estimate>, [f64; 3]) {
    let start = Start {
        pose: [38.0, 22.0, 1.3],
        reach: [15.0, 15.0, 0.5],
    };
    let mut filter = Filter::new(field(), start, settings(seed)).unwrap();
    let mut pose = [30.0, 15.0, 1.57];
    let mut told = vec![filter.step([0.0; 3], [0.0; 3], &scan(pose), &[])];
    for _ in 0..25 {
        pose[0] += pose[2].cos();
        pose[1] += pose[2].sin();
        told.push(filter.step([1.0, 0.0, 0.0], [0.05, 0.05, 0.01], &scan(pose), &[]));
    }
    (told, pose)
}

#[test]
fn vehicle_is_found_from_a_start_that_is_off() {
    let (told, pose) = run(3);
    let last = told[told.len() - 1];
    assert!((last.pose[0] - pose[0]).abs() < 0.3, "{last:?} {pose:?}");
    assert!((last.pose[1] - pose[1]).abs() < 0.3, "{last:?} {pose:?}");
    assert!((last.pose[2] - pose[2]).abs() < 0.05);
    assert!(last.share > 0.9 && last.known > 0.99);
    assert!(last.covariance[0].sqrt() < 0.5);
}

#[test]
fn same_seed_gives_the_same_on_any_number_of_threads() {
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap()
        .install(|| run(7).0);
    let (two, other) = (run(7).0, run(8).0);
    for (a, b) in one.iter().zip(&two) {
        assert_eq!(a.pose, b.pose);
        assert_eq!(a.covariance, b.covariance);
    }
    assert_ne!(one[0].pose, other[0].pose);
}

#[test]
fn scan_without_points_only_moves_and_spreads() {
    let start = Start {
        pose: [30.0, 30.0, 0.0],
        reach: [0.0; 3],
    };
    let mut filter = Filter::new(field(), start, settings(1)).unwrap();
    let told = filter.step([2.0, 0.0, 0.0], [0.1, 0.2, 0.0], &[], &[]);
    assert!((told.pose[0] - 32.0).abs() < 0.02 && (told.pose[1] - 30.0).abs() < 0.02);
    assert!((told.covariance[0].sqrt() - 0.1).abs() < 0.01);
    assert!((told.covariance[4].sqrt() - 0.2).abs() < 0.02);
}

#[test]
fn beams_do_not_go_through_what_stands_there() {
    // Inside on the right half; nothing else tells where the vehicle is.
    let cells = (0..100)
        .map(|cell| if cell % 10 < 5 { 3.0 } else { -3.0 })
        .collect();
    let field = EdgeField::new(cells, 10, 10, [0.0; 2], 1.0).unwrap();
    let start = Start {
        pose: [5.0, 5.0, 0.0],
        reach: [4.0, 4.0, 0.0],
    };
    let mut filter = Filter::new(field, start, settings(2)).unwrap();
    let mut told = filter.step([0.0; 3], [0.0; 3], &[[0.0, 0.0]], &[[0.0, 0.0]]);
    let before = told.pose[0];
    for _ in 0..8 {
        told = filter.step([0.0; 3], [0.0; 3], &[[0.0, 0.0]], &[[0.0, 0.0]]);
    }
    assert!(before < 5.0 && told.pose[0] < 3.2, "{before} {told:?}");
    assert_eq!(told.through, 0.0);
}

#[test]
fn outside_of_the_map_nothing_is_known() {
    let field = EdgeField::new(vec![1.0, f32::NAN], 2, 1, [5.0, 5.0], 1.0).unwrap();
    assert_eq!(field.at(5.5, 5.5), Some(1.0));
    for (x, y) in [
        (6.5, 5.5),
        (4.9, 5.5),
        (5.5, 6.1),
        (f64::NAN, 5.5),
        (1e300, 5.5),
    ] {
        assert_eq!(field.at(x, y), None);
    }
}

#[test]
fn wrong_shapes_and_settings_are_refused() {
    let wrong = EdgeField::new(vec![0.0; 5], 2, 3, [0.0; 2], 1.0);
    assert!(matches!(wrong, Err(DriveError::Size { given: 5, .. })));
    let wrong = EdgeField::new(vec![0.0; 6], 2, 3, [0.0; 2], 0.0);
    assert!(matches!(wrong, Err(DriveError::Cell { .. })));
    let start = Start {
        pose: [0.0; 3],
        reach: [0.0; 3],
    };
    let mut none = settings(1);
    none.particles = 0;
    none.first_draws = 0;
    assert!(Filter::new(field(), start, none).is_err());
    let mut flat = settings(1);
    flat.sigma_m = 0.0;
    assert!(Filter::new(field(), start, flat).is_err());
}
