//! A ball seen from a ring of cameras: the octree against all voxels one by one, and the sweeps.

#![allow(clippy::unwrap_used)]

use veduta_carve::sweep::{sweep, SweepRule};
use veduta_carve::{hull, CarveError, Photo, Projection, Root, View, Volume};
use veduta_surface::surface_nets;

const SIZE: usize = 120;
const FOCAL: f64 = 150.0;
const AWAY: f64 = 3.0;

/// A camera on the ring about z that looks at the origin.
fn camera(angle: f64, height: f64) -> Projection {
    let (across, up) = (height.cos(), height.sin());
    let back = [angle.cos() * across, angle.sin() * across, up];
    let right = [-angle.sin(), angle.cos(), 0.0];
    let forward = back.map(|one| -one);
    let down = [
        forward[1] * right[2] - forward[2] * right[1],
        forward[2] * right[0] - forward[0] * right[2],
        forward[0] * right[1] - forward[1] * right[0],
    ];
    let centre = back.map(|one| one * AWAY);
    let row = |axis: [f64; 3]| {
        let shift: f64 = (0..3).map(|n| axis[n] * centre[n]).sum();
        [axis[0], axis[1], axis[2], -shift]
    };
    let (x, y, z) = (row(right), row(down), row(forward));
    let half = SIZE as f64 / 2.0;
    Projection {
        rows: [
            std::array::from_fn(|n| FOCAL * x[n] + half * z[n]),
            std::array::from_fn(|n| FOCAL * y[n] + half * z[n]),
            z,
        ],
        focal_px: FOCAL,
        centre_m: centre,
    }
}

fn ring() -> Vec<Projection> {
    let height = |n: u32| if n % 2 == 0 { 0.2 } else { -0.4 };
    let angle = |n: u32| f64::from(n) * std::f64::consts::PI / 6.0;
    (0..12).map(|n| camera(angle(n), height(n))).collect()
}

/// The distances to the circle that a ball about the origin shows.
fn distances(radius: f64) -> Vec<f32> {
    let shown = FOCAL * radius / (AWAY * AWAY - radius * radius).sqrt();
    let middle = SIZE as f64 / 2.0;
    let place = |n: usize| [n % SIZE, n / SIZE].map(|one| one as f64 + 0.5 - middle);
    let of = |n: usize| (place(n)[0].hypot(place(n)[1]) - shown) as f32;
    (0..SIZE * SIZE).map(of).collect()
}

fn views<'a>(cameras: &[Projection], distances_px: &'a [f32]) -> Vec<View<'a>> {
    let of = |projection: &Projection| View {
        projection: *projection,
        corner_px: [0.0; 2],
        width: SIZE,
        height: SIZE,
        distances_px,
    };
    cameras.iter().map(of).collect()
}

fn root(levels: u32) -> Root {
    Root {
        low_m: [-1.0, -1.1, -0.9],
        side_m: 2.0,
        levels,
    }
}

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
    let shown: Vec<Vec<u8>> = cameras.iter().map(|one| photo(one, 0.5)).collect();
    let views = views(&cameras, &field);
    let volume = hull::carve(&views, root(5)).unwrap();
    let of = |(projection, pixels): (&Projection, &'_ Vec<u8>)| (*projection, pixels.clone());
    let kept: Vec<(Projection, Vec<u8>)> = cameras.iter().zip(&shown).map(of).collect();
    let photos: Vec<Photo<'_>> = kept
        .iter()
        .map(|(projection, pixels)| Photo {
            projection: *projection,
            width: SIZE,
            height: SIZE,
            pixels,
        })
        .collect();
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

/// What a camera sees of a ball about the origin.
fn photo(camera: &Projection, radius: f64) -> Vec<u8> {
    let (half, forward) = (SIZE as f64 / 2.0, camera.centre_m.map(|one| -one / AWAY));
    let axis = |n: usize| -> [f64; 3] {
        std::array::from_fn(|k| (camera.rows[n][k] - half * forward[k]) / FOCAL)
    };
    let (right, down) = (axis(0), axis(1));
    let colour = |n: usize| {
        let [x, y] = [n % SIZE, n / SIZE].map(|one| (one as f64 + 0.5 - half) / FOCAL);
        let ray: [f64; 3] = std::array::from_fn(|k| forward[k] + x * right[k] + y * down[k]);
        let a: f64 = ray.iter().map(|one| one * one).sum();
        let b: f64 = (0..3).map(|k| ray[k] * camera.centre_m[k]).sum();
        let root = b * b - a * (AWAY * AWAY - radius * radius);
        if root < 0.0 {
            return [0; 3];
        }
        let t = (-b - root.sqrt()) / a;
        [0, 1, 2].map(|k| (128.0 + 120.0 * (9.0 * (camera.centre_m[k] + t * ray[k])).sin()) as u8)
    };
    (0..SIZE * SIZE).flat_map(colour).collect()
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
