//! Floods against a brute-force search for connected pixels.

use veduta_drive::{flood, FloodRules, Picture, Seed};

const WIDTH: usize = 23;
const HEIGHT: usize = 17;
const RULES: FloodRules = FloodRules {
    reach: 5,
    colour: 60,
    slack: 1.0,
    least: 1.5,
};

fn noise(seed: u64, count: usize) -> Vec<u8> {
    let mut state = seed;
    (0..count)
        .map(|_| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 56) as u8
        })
        .collect()
}

/// Every pixel of the window asks its neighbours until nothing changes.
fn slowly(picture: &Picture<'_>, seed: Seed) -> Vec<bool> {
    let at = |x: usize, y: usize| y * WIDTH + x;
    let start = at(seed.column, seed.row);
    let limit = (picture.misfit[start] - RULES.slack).max(RULES.least);
    let mut taken = vec![false; WIDTH * HEIGHT];
    taken[start] = true;
    let mut changed = true;
    while changed {
        changed = false;
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let here = at(x, y);
                let inside =
                    x.abs_diff(seed.column) <= RULES.reach && y.abs_diff(seed.row) <= RULES.reach;
                let alike = (0..3).all(|c| {
                    picture.colours[3 * here + c].abs_diff(picture.colours[3 * start + c])
                        <= RULES.colour
                });
                let beside = (x > 0 && taken[at(x - 1, y)])
                    || (x + 1 < WIDTH && taken[at(x + 1, y)])
                    || (y > 0 && taken[at(x, y - 1)])
                    || (y + 1 < HEIGHT && taken[at(x, y + 1)]);
                if !taken[here] && inside && alike && beside && picture.misfit[here] >= limit {
                    taken[here] = true;
                    changed = true;
                }
            }
        }
    }
    taken
}

#[test]
fn floods_are_what_a_slow_search_finds() {
    for round in 0..20 {
        // Few grey levels, so that floods get far.
        let grey: Vec<u8> = noise(round, WIDTH * HEIGHT)
            .iter()
            .map(|v| v / 64 * 40)
            .collect();
        let colours: Vec<u8> = grey.iter().flat_map(|v| [*v, *v, *v]).collect();
        let misfit: Vec<f32> = noise(round + 100, WIDTH * HEIGHT)
            .iter()
            .map(|v| {
                if *v > 250 {
                    f32::NAN
                } else {
                    f32::from(*v) / 40.0
                }
            })
            .collect();
        let picture = Picture {
            width: WIDTH,
            height: HEIGHT,
            colours: &colours,
            misfit: &misfit,
        };
        let seeds: Vec<Seed> = noise(round + 200, 14)
            .chunks(2)
            .enumerate()
            .map(|(number, v)| Seed {
                column: v[0] as usize % WIDTH,
                row: v[1] as usize % HEIGHT,
                depth: 3.0 + number as f32,
            })
            .filter(|seed| !misfit[seed.row * WIDTH + seed.column].is_nan())
            .collect();
        let found = flood(&picture, &seeds, RULES).unwrap();
        let mut wanted = vec![f32::INFINITY; WIDTH * HEIGHT];
        for seed in &seeds {
            for (own, taken) in wanted.iter_mut().zip(slowly(&picture, *seed)) {
                if taken {
                    *own = own.min(seed.depth);
                }
            }
        }
        assert_eq!(found, wanted);
    }
}

#[test]
fn a_seed_outside_is_refused() {
    let (colours, misfit) = (vec![0; 3 * 4], vec![9.0; 4]);
    let picture = Picture {
        width: 2,
        height: 2,
        colours: &colours,
        misfit: &misfit,
    };
    let seed = Seed {
        column: 2,
        row: 0,
        depth: 1.0,
    };
    let told = flood(&picture, &[seed], RULES).unwrap_err().to_string();
    assert!(told.contains("column 2, row 0"), "{told}");
}

#[test]
fn a_table_of_another_size_is_refused() {
    let (colours, misfit) = (vec![0; 3 * 4], vec![9.0; 3]);
    let picture = Picture {
        width: 2,
        height: 2,
        colours: &colours,
        misfit: &misfit,
    };
    assert!(flood(&picture, &[], RULES).is_err());
}
