//! Labels against all labellings of small grids, pictures against a ray through each pixel.

#![allow(clippy::unwrap_used, clippy::panic)]

use veduta_walk::costs::{label_costs, Label, Levels, Node, Patches, OUTSIDE};
use veduta_walk::grid::Grid;
use veduta_walk::image::Grey;
use veduta_walk::potts::{energy, icm, trws};
use veduta_walk::raster::{rasterise, Scene};

/// Numbers from 0 to 1 that are the same in every run.
fn numbers(seed: u64) -> impl FnMut() -> f32 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1_u64 << 24) as f32
    }
}

fn whole_grid(rows: usize, columns: usize, mut weight: impl FnMut() -> f32) -> Grid {
    let node: Vec<i32> = (0..(rows * columns) as i32).collect();
    let right: Vec<f32> = node.iter().map(|_| weight()).collect();
    let down: Vec<f32> = node.iter().map(|_| weight()).collect();
    Grid::new((rows, columns), &node, &right, &down).unwrap()
}

fn least_of_all(grid: &Grid, costs: &[f32], labels: usize) -> f64 {
    let mut least = f64::INFINITY;
    for code in 0..labels.pow(grid.len() as u32) {
        let mut left = code;
        let chosen: Vec<u32> = (0..grid.len())
            .map(|_| {
                let own = left % labels;
                left /= labels;
                own as u32
            })
            .collect();
        least = least.min(energy(grid, costs, labels, &chosen).unwrap());
    }
    least
}

#[test]
fn message_passing_finds_the_least_energy_of_chains_and_never_claims_too_much() {
    for seed in 0..40 {
        let mut next = numbers(seed + 1);
        let (rows, columns) = if seed % 2 == 0 { (1, 6) } else { (3, 3) };
        let grid = whole_grid(rows, columns, &mut next);
        let costs: Vec<f32> = (0..grid.len() * 3).map(|_| 2.0 * next()).collect();
        let least = least_of_all(&grid, &costs, 3);
        let found = trws(&grid, &costs, 3, 50).unwrap();
        let modes = icm(&grid, &costs, 3, 50).unwrap();
        assert!(found.bound <= least + 1e-4, "{} > {least}", found.bound);
        assert!(found.energy >= least - 1e-4 && modes.energy >= least - 1e-4);
        if rows == 1 {
            assert!((found.energy - least).abs() < 1e-4, "seed {seed}");
            assert!((found.bound - least).abs() < 1e-3, "seed {seed}");
        } else {
            assert!(found.energy <= modes.energy + 1e-4, "seed {seed}");
        }
    }
}

#[test]
fn nodes_that_are_left_out_hold_nobody() {
    let grid = Grid::new((1, 3), &[0, -1, 1], &[9.0; 3], &[9.0; 3]).unwrap();
    let found = trws(&grid, &[0.0, 1.0, 1.0, 0.0], 2, 3).unwrap();
    assert_eq!(found.labels, vec![0, 1]);
    assert!(Grid::new((1, 3), &[0, 2, 1], &[9.0; 3], &[9.0; 3]).is_err());
}

fn smooth(width: usize, height: usize, zoom: f32) -> Grey {
    let value = |x: f32, y: f32| {
        100.0 + 60.0 * (x * 0.31).sin() * (y * 0.23).cos() + 30.0 * (x * 0.11 + y * 0.17).sin()
    };
    let values = (0..width * height)
        .map(|at| {
            value(
                zoom * ((at % width) as f32 + 0.5),
                zoom * ((at / width) as f32 + 0.5),
            )
        })
        .collect();
    Grey::new(width, height, values).unwrap()
}

#[test]
fn the_cheapest_label_is_the_true_offset_at_the_true_scale() {
    // B shows A twice as large, about the origin: shrunk by two it is A again.
    let scales = vec![1.0, 1.4, 2.0];
    let shrunk = |image: f32| scales.iter().map(|s| smooth(96, 96, image * s)).collect();
    let levels = Levels {
        first: shrunk(1.0),
        second: shrunk(0.5),
        scales: scales.clone(),
    };
    let node = Node {
        own: [20.0, 24.0],
        there: [38.0, 49.0],
        scale: 1,
        line: [0.0; 3],
    };
    let mut labels = Vec::new();
    for step in -1..=1 {
        for y in -3..=3 {
            for x in -3..=3 {
                labels.push(Label {
                    offset: [x as f32, y as f32],
                    step,
                });
            }
        }
    }
    let patches = Patches {
        radius: 3,
        band_px: 1.0,
        noise: 0.5,
    };
    let costs = label_costs(&levels, &[node], &labels, patches).unwrap();
    let best = (0..labels.len())
        .min_by(|&a, &b| costs[a].total_cmp(&costs[b]))
        .unwrap();
    assert_eq!((labels[best].offset, labels[best].step), ([2.0, -1.0], 1));
    assert!(costs[best] < 0.02);
    let banded = Node {
        line: [0.0, 1.0, -50.0],
        ..node
    };
    let costs = label_costs(&levels, &[banded], &labels, patches).unwrap();
    for (label, cost) in labels.iter().zip(costs) {
        assert_eq!(cost == OUTSIDE, (label.offset[1] - 1.0).abs() > 1.0);
    }
}

#[test]
fn pixels_carry_what_the_nearest_triangle_carries_there() {
    let mut next = numbers(7);
    let screen: Vec<[f32; 3]> = (0..30)
        .map(|_| {
            [
                60.0 * next() - 10.0,
                50.0 * next() - 8.0,
                1.0 + 4.0 * next(),
            ]
        })
        .collect();
    let carried: Vec<f32> = (0..60).map(|_| next()).collect();
    let triangles: Vec<[u32; 3]> = (0..10).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let scene = Scene {
        screen: &screen,
        carried: &carried,
        width: 2,
        triangles: &triangles,
    };
    let drawn = rasterise(&scene, (40, 36), 0.1).unwrap();
    for at in 0..40 * 36 {
        let (x, y) = ((at % 40) as f64 + 0.5, (at / 40) as f64 + 0.5);
        let mut nearest = (f64::INFINITY, -1_i32, [0.0; 2]);
        for (number, corners) in triangles.iter().enumerate() {
            // The ray (x, y, 1) d meets the plane of the points (X, Y, 1) Z: solved by Cramer's rule.
            let p = corners.map(|v| screen[v as usize].map(f64::from));
            let area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1])
                - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
            let a = ((p[1][0] - x) * (p[2][1] - y) - (p[1][1] - y) * (p[2][0] - x)) / area;
            let b = ((p[2][0] - x) * (p[0][1] - y) - (p[2][1] - y) * (p[0][0] - x)) / area;
            let shares = [a, b, 1.0 - a - b];
            let depth = 1.0 / (0..3).map(|k| shares[k] / p[k][2]).sum::<f64>();
            if shares.iter().all(|s| *s >= 0.0) && depth < nearest.0 {
                let value = |c: usize| {
                    (0..3)
                        .map(|k| {
                            shares[k] / p[k][2]
                                * depth
                                * f64::from(carried[corners[k] as usize * 2 + c])
                        })
                        .sum()
                };
                nearest = (depth, number as i32, [value(0), value(1)]);
            }
        }
        assert_eq!(drawn.triangle[at], nearest.1, "pixel {at}");
        if nearest.1 >= 0 {
            assert!((f64::from(drawn.depth[at]) - nearest.0).abs() < 1e-3);
            for c in 0..2 {
                assert!((f64::from(drawn.carried[2 * at + c]) - nearest.2[c]).abs() < 1e-3);
            }
        }
    }
}
