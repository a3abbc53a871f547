//! PatchMatch: costs of given planes are the same; planes that are found agree within a tolerance.

use veduta_gpu::search::Searcher;
use veduta_stereo::patch::Window;
use veduta_stereo::planes::Planes;
use veduta_stereo::search::{search, Neighbour, Search};
use veduta_stereo::Grey;

use crate::card;
use crate::scene::{camera, depths, picture};

const SLANT: f64 = 0.4;
const SETTINGS: Search = Search {
    window: Window {
        step_px: 2.0,
        gamma_grey: 20.0,
        gamma_px: 8.0,
        noise_grey: 2.0,
    },
    sweeps: 4,
    near: 1.5,
    far: 12.0,
    views: 2,
    consistency: 0.1,
    most_px: 3.0,
    vary_depth: 0.05,
    vary_normal: 0.7,
    seed: 0x1_0000_0003,
};

/// By the loops and by the shader. known: whether the neighbours have depths.
fn both(sweeps: usize, start: Option<Planes>, known: bool) -> Option<(Planes, Planes)> {
    let card = card()?;
    let own = camera([0.0, 0.0, 0.0], 0.0);
    let others = [
        camera([0.5, 0.0, 0.0], 0.05),
        camera([-0.5, 0.05, 0.1], -0.04),
        camera([0.1, 0.4, 0.0], 0.0),
    ];
    let pictures: Vec<Grey> = others.iter().map(|one| picture(one, SLANT)).collect();
    let mut truths: Vec<Vec<f32>> = others.iter().map(|one| depths(one, SLANT)).collect();
    truths[1]
        .iter_mut()
        .step_by(7)
        .for_each(|one| *one = f32::NAN);
    let neighbours: Vec<Neighbour<'_>> = (0..3)
        .map(|i| Neighbour {
            image: &pictures[i],
            camera: others[i],
            depths: (known && i < 2).then_some(truths[i].as_slice()),
        })
        .collect();
    let settings = Search { sweeps, ..SETTINGS };
    let image = picture(&own, SLANT);
    let loops = search(&image, own, &neighbours, start.clone(), settings).unwrap();
    let searcher = Searcher::new(&card);
    let shader = searcher.search(&card, &image, own, &neighbours, start, settings);
    Some((loops, shader.unwrap()))
}

fn share(of: usize, holds: impl Fn(usize) -> bool) -> f64 {
    (0..of).filter(|i| holds(*i)).count() as f64 / of as f64
}

#[test]
fn the_same_planes_cost_the_same() {
    for known in [false, true] {
        let Some((loops, shader)) = both(0, None, known) else {
            return;
        };
        assert_eq!(loops.planes, shader.planes);
        let pixels = loops.costs.len();
        // A window at the border of a view may be in for one and out for the other.
        let near = share(pixels, |i| (loops.costs[i] - shader.costs[i]).abs() < 1e-3);
        assert!(near > 0.999, "{near}");
    }
}

#[test]
fn the_planes_that_are_found_agree() {
    for known in [false, true] {
        let Some((loops, shader)) = both(4, None, known) else {
            return;
        };
        let pixels = loops.costs.len();
        let depth = |planes: &Planes, i: usize| 1.0 / planes.planes[i].inverse;
        let same = share(pixels, |i| {
            let (one, other) = (depth(&loops, i), depth(&shader, i));
            (one - other).abs() < 0.005 * one
        });
        let mean = |planes: &Planes| planes.costs.iter().sum::<f32>() / pixels as f32;
        assert!(same > 0.97, "{same}");
        assert!((mean(&loops) - mean(&shader)).abs() < 0.003);
    }
}

#[test]
fn coarse_planes_are_gone_on_from() {
    let Some((coarse, _)) = both(3, None, false) else {
        return;
    };
    let Some((loops, shader)) = both(1, Some(coarse), true) else {
        return;
    };
    let pixels = loops.costs.len();
    let same = share(pixels, |i| {
        let (one, other) = (loops.planes[i].inverse, shader.planes[i].inverse);
        (one - other).abs() < 0.005 * one
    });
    assert!(same > 0.97, "{same}");
}
