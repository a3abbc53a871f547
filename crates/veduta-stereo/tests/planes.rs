use crate::scene::{camera, depths, picture, HEIGHT, WIDTH};
use veduta_stereo::camera::Transfer;
use veduta_stereo::patch::Window;
use veduta_stereo::planes::{Plane, Planes};
use veduta_stereo::search::{search, Neighbour, Search};
use veduta_stereo::{Camera, StereoError};

const SETTINGS: Search = Search {
    window: Window {
        step_px: 2.0,
        gamma_grey: 20.0,
        gamma_px: 8.0,
        noise_grey: 2.0,
    },
    sweeps: 5,
    near: 1.5,
    far: 12.0,
    views: 1,
    consistency: 0.1,
    most_px: 3.0,
    vary_depth: 0.05,
    vary_normal: 0.7,
    seed: 3,
};

fn found(slant: f64, seed: u64) -> (Planes, Vec<f32>) {
    let own = camera([0.0, 0.0, 0.0], 0.0);
    let others = [
        camera([0.5, 0.0, 0.0], 0.05),
        camera([-0.5, 0.05, 0.1], -0.04),
    ];
    let pictures: Vec<_> = others.iter().map(|one| picture(one, slant)).collect();
    let neighbours: Vec<Neighbour<'_>> = (0..2)
        .map(|i| Neighbour {
            image: &pictures[i],
            camera: others[i],
            depths: None,
        })
        .collect();
    let settings = Search { seed, ..SETTINGS };
    let made = search(&picture(&own, slant), own, &neighbours, None, settings).unwrap();
    (made, depths(&own, slant))
}

/// Share of the pixels away from the border whose depth is within a share of the truth.
fn right(made: &Planes, truth: &[f32], within: f32) -> f64 {
    let (mut good, mut all) = (0, 0);
    for y in 8..HEIGHT - 8 {
        for x in 12..WIDTH - 12 {
            let i = y * WIDTH + x;
            let depth = 1.0 / made.planes[i].inverse;
            all += 1;
            good += usize::from((depth - truth[i]).abs() < within * truth[i]);
        }
    }
    f64::from(good as u32) / f64::from(all)
}

#[test]
fn a_wall_is_found_wherever_it_is_slanted() {
    for slant in [0.0, 0.4, -0.7] {
        let (made, truth) = found(slant, 3);
        assert!(right(&made, &truth, 0.01) > 0.97, "slant {slant}");
    }
}

#[test]
fn the_same_seed_gives_the_same_planes() {
    assert_eq!(found(0.4, 5).0.planes, found(0.4, 5).0.planes);
    assert_ne!(found(0.4, 5).0.planes, found(0.4, 6).0.planes);
}

#[test]
fn normals_are_those_of_the_wall() {
    let (made, truth) = found(0.4, 3);
    let own = camera([0.0, 0.0, 0.0], 0.0);
    // z = 4 + 0.4 x: (0.4, 0, -1) towards the camera.
    let wanted = [0.4f32, 0.0, -1.0].map(|one| one / 1.16f32.sqrt());
    let mut angles: Vec<f32> = (0..truth.len())
        .map(|i| {
            let px = [(i % WIDTH) as f32 + 0.5, (i / WIDTH) as f32 + 0.5];
            let normal = made.planes[i].normal(&own, px);
            let along: f32 = (0..3).map(|k| normal[k] * wanted[k]).sum();
            along.clamp(-1.0, 1.0).acos().to_degrees()
        })
        .collect();
    angles.sort_by(f32::total_cmp);
    assert!(angles[angles.len() / 2] < 6.0);
}

#[test]
fn a_transfer_is_projection_and_back() {
    let (from, to) = (
        camera([0.1, -0.2, 0.3], 0.2),
        camera([0.9, 0.1, -0.2], -0.3),
    );
    let transfer = Transfer::new(&from, &to);
    for (px, depth) in [([3.0, 70.0], 2.0), ([90.5, 8.25], 7.5), ([48.0, 36.0], 4.0)] {
        let wanted = to.pixel(to.seen(from.point(px, depth)));
        let got = transfer.apply(px.map(|one| one as f32), 1.0 / depth as f32);
        for axis in 0..2 {
            assert!((f64::from(got[axis] / got[2]) - wanted[axis]).abs() < 1e-3);
        }
    }
}

#[test]
fn planes_go_on_and_grow_with_the_picture() {
    let own = camera([0.0; 3], 0.0);
    let truth = depths(&own, 0.4);
    let at = |x: usize, y: usize| 1.0 / truth[y * WIDTH + x];
    let first = Plane {
        inverse: at(20, 30),
        slope: [at(21, 30) - at(20, 30), at(20, 31) - at(20, 30)],
    };
    assert!((first.gone_on(30.0, 12.0).inverse - at(50, 42)).abs() < 1e-4);
    let all = Planes {
        width: WIDTH,
        height: HEIGHT,
        planes: (0..WIDTH * HEIGHT)
            .map(|i| first.gone_on((i % WIDTH) as f32 - 20.0, (i / WIDTH) as f32 - 30.0))
            .collect(),
        costs: vec![0.0; WIDTH * HEIGHT],
    };
    let twice = all.resized(2 * WIDTH, 2 * HEIGHT);
    let large = Camera::new([180.0, 180.0], [96.0, 72.0], own.turn, own.shift).unwrap();
    let depth = crate::scene::wall_depth(&large, [101.5, 85.5], 0.4) as f32;
    let got = twice.planes[85 * 2 * WIDTH + 101];
    assert!((1.0 / got.inverse - depth).abs() < 0.002);
}

#[test]
fn what_cannot_be_searched_is_refused() {
    let own = camera([0.0; 3], 0.0);
    let image = picture(&own, 0.0);
    let none = search(&image, own, &[], None, SETTINGS).unwrap_err();
    assert_eq!(none, StereoError::NoNeighbour);
    let neighbour = [Neighbour {
        image: &image,
        camera: own,
        depths: Some(&[1.0, 2.0]),
    }];
    let size = search(&image, own, &neighbour, None, SETTINGS).unwrap_err();
    assert!(matches!(size, StereoError::Size { given: 2, .. }));
    let turned = Search {
        near: 3.0,
        far: 2.0,
        ..SETTINGS
    };
    let range = search(&image, own, &neighbour, None, turned).unwrap_err();
    assert!(matches!(range, StereoError::Range { .. }));
    let flat = Camera::new([0.0, 1.0], [0.0; 2], own.turn, own.shift);
    assert_eq!(flat.unwrap_err(), StereoError::Camera);
}
