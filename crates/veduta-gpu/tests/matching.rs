//! A noisy pair and a chain: the shaders count as the loops do.

use veduta_gpu::link::Linker;
use veduta_gpu::pair::Matcher;
use veduta_stereo::link::{link, LinkRule, Step};
use veduta_stereo::pair::{disparities, PairRule, Rectified};
use veduta_stereo::path::Path;
use veduta_stereo::Camera;

use crate::card;

const WIDTH: usize = 90;
const HEIGHT: usize = 50;

/// The same noise for the same number.
fn noise(n: usize) -> u8 {
    let mixed = (n as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    ((mixed ^ mixed >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 56) as u8
}

/// Squares of noise, moved by a few pixels.
fn picture(moved: usize) -> Vec<u8> {
    let value = |n: usize| {
        let (x, y, c) = (n / 3 % WIDTH + moved, n / 3 / WIDTH, n % 3);
        noise((x / 3) * 1000 + y / 4 + 77 * c) / 2 + noise(n + moved) / 8
    };
    (0..3 * WIDTH * HEIGHT).map(value).collect()
}

fn rule(path: Option<Path>, count: usize) -> PairRule {
    PairRule {
        low: -20,
        count,
        rows: 11,
        gamma_colour: 12.0,
        gamma_px: 7.0,
        most: 40,
        path,
    }
}

#[test]
fn the_shaders_match_as_the_loops_do() {
    let Some(card) = card() else { return };
    let matcher = Matcher::new(&card);
    let (a, b) = (picture(0), picture(7));
    let shown: Vec<bool> = (0..WIDTH * HEIGHT).map(|n| n % 31 != 0).collect();
    let side = |pixels| Rectified {
        width: WIDTH,
        height: HEIGHT,
        pixels,
        shown: &shown,
    };
    let path = Some(Path {
        step: 300,
        jump: 1600,
    });
    for (path, count) in [(None, 40), (path, 40), (path, 33), (path, 16), (path, 1)] {
        let rule = rule(path, count);
        let wanted = disparities(side(&a), side(&b), &rule).unwrap();
        let found = matcher
            .disparities(&card, side(&a), side(&b), &rule)
            .unwrap();
        for (one, other) in found.iter().zip(&wanted) {
            let same = one.is_nan() && other.is_nan() || (one - other).abs() < 1e-4;
            assert!(same, "{one} and {other} of {count} with {path:?}");
        }
    }
}

fn camera(x: f64) -> Camera {
    let turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let centre = [WIDTH as f64 / 2.0, HEIGHT as f64 / 2.0];
    Camera::new([90.0; 2], centre, turn, [-x, 0.0, 0.0]).unwrap()
}

#[test]
fn the_shader_links_as_the_loop_does() {
    let Some(card) = card() else { return };
    let even = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let maps: Vec<Vec<f32>> = (0..4)
        .map(|map| {
            let of = |n: usize| {
                let wrong = f32::from(noise(n + map * 9999)) / 60.0;
                let sign = if map == 3 { 1.0 } else { -1.0 };
                let gone = n % 13 == map;
                if gone {
                    f32::NAN
                } else {
                    sign * (7.0 + wrong)
                }
            };
            (0..WIDTH * HEIGHT).map(of).collect()
        })
        .collect();
    let step = |to: f64, map: usize| Step {
        camera: camera(to),
        rectified: even,
        back: even,
        width: WIDTH,
        height: HEIGHT,
        disparities: &maps[map],
    };
    let rule = LinkRule {
        deviation_px: 0.5,
        most_deviations: 2.0,
        most_across_px: 1.0,
        near: 1.0,
        far: 50.0,
    };
    let up = [step(0.4, 0), step(0.8, 1), step(1.2, 2)];
    let down = [step(-0.4, 3)];
    let chains: [&[Step<'_>]; 2] = [&up, &down];
    let wanted = link(camera(0.0), [WIDTH, HEIGHT], &chains, &rule).unwrap();
    let linker = Linker::new(&card);
    let found = linker
        .link(&card, camera(0.0), [WIDTH, HEIGHT], chains, &rule)
        .unwrap();
    let mut many = 0;
    let mut other = 0;
    for i in 0..WIDTH * HEIGHT {
        if found.estimates[i] != wanted.estimates[i] {
            other += 1;
            continue;
        }
        many += usize::from(found.estimates[i] > 2);
        let (one, two) = (found.depths[i], wanted.depths[i]);
        let close = one.is_nan() && two.is_nan() || (one - two).abs() < 1e-3 * two;
        assert!(close, "{one} and {two}");
    }
    assert!(many > 500, "{many}");
    // A chain may end one link earlier where an estimate lies on the limit.
    assert!(other < 5, "{other}");
    let nothing: [&[Step<'_>]; 2] = [&[], &[]];
    let alone = linker.link(&card, camera(0.0), [WIDTH, HEIGHT], nothing, &rule);
    assert!(alone.unwrap().depths.iter().all(|one| one.is_nan()));
}
