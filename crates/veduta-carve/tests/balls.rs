//! A ball seen from a ring of cameras: the octree against all voxels one by one, and the sweeps.

#![allow(clippy::unwrap_used)]

mod ball;

use ball::{distances, photo, photos, ring, root, views, FOCAL};
use veduta_carve::sweep::{sweep, SweepRule};
use veduta_carve::{hull, CarveError, Root, View, Volume};
use veduta_surface::surface_nets;

fn carved(levels: u32) -> Volume {
    let field = distances(0.7);
    hull::carve(&views(&ring(), &field), root(levels)).unwrap()
}

#[test]
fn the_octree_finds_what_a_look_at_every_voxel_finds() {
    let (field, cameras) = (distances(0.7), ring());
    let views = views(&cameras, &field);
    let volume = hull::carve(&views, root(5)).unwrap();
    let mut inside = 0;
    for n in 0..32_usize.pow(3) {
        let voxel = [n / 1024, n / 32 % 32, n % 32];
        let at = volume.root.centre(voxel);
        let each = views.iter().map(|view| {
            let (pixel, depth) = view.projection.project(at);
            f64::from(view.distance_px(pixel)) * depth / FOCAL
        });
        let worst = each.fold(f64::NEG_INFINITY, f64::max);
        let found = f64::from(volume.value(voxel));
        if worst.abs() < volume.root.voxel_m() {
            assert!(
                (found - worst).abs() < 1e-4,
                "{voxel:?}: {found} not {worst}"
            );
        }
        assert_eq!(found < 0.0, worst < 0.0, "{voxel:?}");
        inside += usize::from(worst < 0.0);
    }
    assert_eq!(volume.inside(), inside);
    assert_eq!(volume.solid().iter().filter(|one| **one).count(), inside);
}

#[test]
fn most_of_a_fine_volume_is_never_divided() {
    let volume = carved(8);
    assert!(
        volume.bytes() < 256_usize.pow(3),
        "{} bytes",
        volume.bytes()
    );
    let judged: usize = volume.counts.iter().flatten().sum();
    assert!(judged < 40_000, "{judged} cubes");
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            let volume = carved(6);
            (surface_nets(&volume, 0.0, true).unwrap(), volume.solid())
        })
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn what_a_field_carves_is_gone_and_the_rest_stays() {
    let volume = carved(6);
    let along = 32_usize;
    let half = |n: usize| {
        if n / along / along < along / 2 {
            0.2
        } else {
            -0.2
        }
    };
    let field: Vec<f32> = (0..along.pow(3)).map(half).collect();
    let left = volume.deepened(&field, 5).unwrap();
    assert!(left.value([20, 35, 29]) > 0.0);
    assert_eq!(left.value([45, 35, 29]), volume.value([45, 35, 29]));
    assert!(left.inside() * 3 < volume.inside() * 2);
    let fault = volume.deepened(&field[1..], 5).err();
    assert!(matches!(
        fault,
        Some(CarveError::Field { needed: 32_768, .. })
    ));
}

/// Photos of a smaller ball with colours by direction: the hull of silhouettes that are drawn too
/// large shows colours that disagree, until the sweeps come to the ball.
#[test]
fn sweeps_dig_to_where_the_colours_agree() {
    let (field, cameras) = (distances(0.7), ring());
    let pixels: Vec<Vec<u8>> = cameras.iter().map(|one| photo(one, 0.5)).collect();
    let views = views(&cameras, &field);
    let volume = hull::carve(&views, root(5)).unwrap();
    let photos = photos(&cameras, &pixels);
    let rule = SweepRule {
        spread: 25.0,
        least_views: 3,
        most_views: 6,
        least_cosine: 0.3,
        rim_voxels: 0.0,
        sweeps: 10,
    };
    let solid = volume.solid();
    let swept = sweep(&photos, &views, &volume.root, solid.clone(), &rule).unwrap();
    let count = |of: &[bool]| of.iter().filter(|one| **one).count() as f64;
    assert!(count(&swept.solid) < 0.8 * count(&solid));
    let held = SweepRule {
        rim_voxels: 100.0,
        ..rule
    };
    let kept = sweep(&photos, &views, &volume.root, solid.clone(), &held).unwrap();
    assert_eq!(kept.solid, solid, "all voxels hold an outline up");
}

#[test]
fn faults_are_told() {
    let (field, cameras) = (distances(0.7), ring());
    let mut views = views(&cameras, &field);
    let fault = |views: &[View<'_>], root: Root| hull::carve(views, root).err();
    assert_eq!(fault(&[], root(5)), Some(CarveError::NoViews));
    let low = fault(&views, root(3));
    assert!(matches!(low, Some(CarveError::Levels { least: 4, .. })));
    let flat = Root {
        side_m: f64::NAN,
        ..root(5)
    };
    assert!(matches!(fault(&views, flat), Some(CarveError::Side { .. })));
    views[1].width += 1;
    let size = fault(&views, root(5));
    assert!(matches!(size, Some(CarveError::Size { view: 1, .. })));
}
