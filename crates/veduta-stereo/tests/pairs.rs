//! A pair and a chain, held against a plain count over all disparities and against a wall.

use proptest::prelude::*;
use veduta_stereo::link::{link, LinkRule, Step};
use veduta_stereo::pair::{confirmed, disparities, PairRule, Rectified};
use veduta_stereo::path::{best_path, Path};

use crate::scene::{camera, picture, wall_depth, HEIGHT, WIDTH};

fn rule(low: i32, count: usize, path: Option<Path>) -> PairRule {
    PairRule {
        low,
        count,
        rows: 9,
        gamma_colour: 12.0,
        gamma_px: 8.0,
        most: 60,
        path,
    }
}

/// The definition, without rings, bands or 16 bits.
fn plain(here: &[u8], there: &[u8], width: usize, height: usize, rule: &PairRule) -> Vec<f32> {
    let table = rule.weights();
    let half = (rule.rows / 2) as i64;
    let at = |of: &[u8], x: i64, y: i64| {
        (x >= 0 && x < width as i64).then(|| of[(y as usize * width + x as usize) * 3])
    };
    let mut found = Vec::new();
    for y in 0..height as i64 {
        for x in 0..width as i64 {
            let own = at(here, x, y).unwrap();
            let mut raw: Vec<(i64, u32)> = Vec::new();
            for v in -half..=half {
                if y + v >= 0 && y + v < height as i64 {
                    let other = at(here, x, y + v).unwrap();
                    let sum = 3 * u32::from(own.abs_diff(other));
                    let weight = table[(v + half) as usize * 256 + ((sum * 85) >> 8) as usize];
                    raw.push((v, weight));
                }
            }
            let total: u32 = raw.iter().map(|one| one.1).sum();
            let mut shares: Vec<(i64, u32)> =
                raw.iter().map(|(v, w)| (*v, w * 256 / total)).collect();
            let left = 256 - shares.iter().map(|one| one.1).sum::<u32>();
            shares
                .iter_mut()
                .filter(|one| one.0 == 0)
                .for_each(|one| one.1 += left);
            let costs: Vec<u32> = (0..rule.count as i64)
                .map(|d| {
                    let each = shares.iter().map(|(v, weight)| {
                        let to = x + i64::from(rule.low) + d;
                        let cost = match (at(here, x, y + v), at(there, to, y + v)) {
                            (Some(a), Some(b)) => {
                                ((3 * u32::from(a.abs_diff(b)) * 85) >> 8).min(u32::from(rule.most))
                            }
                            _ => u32::from(rule.most),
                        };
                        weight * cost
                    });
                    each.sum()
                })
                .collect();
            let best = *costs.iter().min().unwrap();
            let place = costs.iter().position(|one| *one == best).unwrap();
            let known = best < 256 * u32::from(rule.most);
            found.push(if known {
                (i64::from(rule.low) + place as i64) as f32
            } else {
                f32::NAN
            });
        }
    }
    found
}

fn colours(grey: &veduta_stereo::Grey) -> Vec<u8> {
    let pixels = (0..WIDTH * HEIGHT).map(|i| grey.at(i % WIDTH, i / WIDTH) as u8);
    pixels.flat_map(|one| [one; 3]).collect()
}

fn shown(pixels: &[u8]) -> Rectified<'_> {
    static ALL: [bool; WIDTH * HEIGHT] = [true; WIDTH * HEIGHT];
    Rectified {
        width: WIDTH,
        height: HEIGHT,
        pixels,
        shown: &ALL,
    }
}

#[test]
fn the_least_cost_is_that_of_the_definition() {
    let [a, b] = [0.0, 0.4].map(|x| colours(&picture(&camera([x, 0.0, 0.0], 0.0), 0.2)));
    let rule = rule(-14, 18, None);
    let found = disparities(shown(&a), shown(&b), &rule).unwrap();
    let wanted = plain(&a, &b, WIDTH, HEIGHT, &rule);
    for (one, other) in found.iter().zip(&wanted) {
        assert!(one.is_nan() && other.is_nan() || (one - other).abs() <= 0.5);
    }
}

#[test]
fn rules_that_overflow_are_refused() {
    let pixels = vec![0; 3 * WIDTH * HEIGHT];
    for (step, jump) in [(u16::MAX, 100), (101, 100), (0, 1 << 14)] {
        let rule = rule(-4, 8, Some(Path { step, jump }));
        assert!(disparities(shown(&pixels), shown(&pixels), &rule).is_err());
    }
}

fn worth(costs: &[u16], count: usize, path: Path, way: &[usize]) -> u64 {
    let own: u64 = way
        .iter()
        .enumerate()
        .map(|(x, d)| u64::from(costs[x * count + d]))
        .sum();
    let steps = way.windows(2).map(|two| match two[0].abs_diff(two[1]) {
        0 => 0,
        1 => u64::from(path.step.min(path.jump)),
        _ => u64::from(path.jump),
    });
    own + steps.sum::<u64>()
}

proptest! {
    #[test]
    fn no_other_path_is_better(costs in prop::collection::vec(0_u16..900, 5 * 4)) {
        let path = Path { step: 60, jump: 200 };
        let found = worth(&costs, 4, path, &best_path(&costs, 4, path));
        for code in 0..4_usize.pow(5) {
            let way: Vec<usize> = (0..5).map(|x| code / 4_usize.pow(x) % 4).collect();
            prop_assert!(found <= worth(&costs, 4, path, &way));
        }
    }
}

const EVEN: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn links() -> LinkRule {
    LinkRule {
        deviation_px: 0.5,
        most_deviations: 3.0,
        most_across_px: 1.0,
        near: 1.0,
        far: 20.0,
    }
}

#[test]
fn chains_find_the_wall() {
    let places = [0.0, 0.4, 0.8].map(|x| camera([x, 0.0, 0.0], 0.0));
    let pictures = places.map(|one| colours(&picture(&one, 0.2)));
    let path = Some(Path {
        step: 300,
        jump: 1500,
    });
    let (there, back) = (rule(-14, 14, path), rule(1, 14, path));
    let pair = |a: usize, b: usize, rule: &PairRule| {
        disparities(shown(&pictures[a]), shown(&pictures[b]), rule).unwrap()
    };
    let mut up = pair(1, 2, &there);
    confirmed(&mut up, &pair(2, 1, &back), [WIDTH; 2], 1.0);
    let down = pair(1, 0, &back);
    let step = |to: usize, disparities| Step {
        camera: places[to],
        rectified: EVEN,
        back: EVEN,
        width: WIDTH,
        height: HEIGHT,
        disparities,
    };
    let chains: [&[Step<'_>]; 2] = [&[step(2, &up)], &[step(0, &down)]];
    let found = link(places[1], [WIDTH, HEIGHT], &chains, &links()).unwrap();
    let (mut right, mut twice) = (0, 0);
    for i in (0..WIDTH * HEIGHT).filter(|i| found.estimates[*i] == 2) {
        let px = [(i % WIDTH) as f64 + 0.5, (i / WIDTH) as f64 + 0.5];
        let truth = wall_depth(&places[1], px, 0.2) as f32;
        twice += 1;
        right += usize::from((found.depths[i] - truth).abs() < 0.05 * truth);
    }
    assert!(twice > WIDTH * HEIGHT / 2, "{twice}");
    assert!(right * 100 > twice * 95, "{right} of {twice}");
}

#[test]
fn a_chain_ends_at_the_first_outlier() {
    let places = [0.0, 0.4, 0.8, 1.2].map(|x| camera([x, 0.0, 0.0], 0.0));
    // 9 px for each 0.4 m is a wall 4 m away; the second link says 2 m, and the third is right again.
    let (good, bad) = (vec![-9.0; WIDTH * HEIGHT], vec![-18.0; WIDTH * HEIGHT]);
    let step = |to: usize, disparities| Step {
        camera: places[to],
        rectified: EVEN,
        back: EVEN,
        width: WIDTH,
        height: HEIGHT,
        disparities,
    };
    let chain = [step(1, &good), step(2, &bad), step(3, &good)];
    let found = link(places[0], [WIDTH, HEIGHT], &[&chain], &links()).unwrap();
    let middle = HEIGHT / 2 * WIDTH + 60;
    assert_eq!(found.estimates[middle], 1);
    assert!((found.depths[middle] - 4.0).abs() < 1e-3);
    let whole = [step(1, &good), step(2, &good), step(3, &good)];
    let found = link(places[0], [WIDTH, HEIGHT], &[&whole], &links()).unwrap();
    assert_eq!(found.estimates[middle], 3);
}
