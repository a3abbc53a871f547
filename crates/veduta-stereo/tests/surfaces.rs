use std::collections::HashMap;

use crate::scene::{camera, depths, HEIGHT, WIDTH};
use veduta_stereo::consistent::Depths;
use veduta_stereo::nets::{surface, Surface};
use veduta_stereo::volume::Volume;
use veduta_stereo::StereoError;

fn wall(slant: f64) -> Surface {
    let mut volume = Volume::new(0.05, 4.0, 100_000).unwrap();
    let weights = vec![1.0f32; WIDTH * HEIGHT];
    for at in [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0]] {
        let own = camera(at, 0.0);
        let known = depths(&own, slant);
        let view = Depths {
            camera: own,
            width: WIDTH,
            height: HEIGHT,
            depths: &known,
        };
        volume.add(&view, &weights).unwrap();
    }
    surface(&volume, 0.5)
}

#[test]
fn the_surface_lies_on_the_wall_and_faces_the_cameras() {
    for slant in [0.0, 0.3] {
        let found = wall(slant);
        assert!(found.triangles.len() > 1000);
        let mut away: Vec<f64> = found
            .points
            .iter()
            .map(|p| (p[2] - 4.0 - slant * p[0]).abs())
            .collect();
        away.sort_by(f64::total_cmp);
        assert!(
            away[away.len() * 95 / 100] < 0.02,
            "{slant}: {}",
            away[away.len() * 95 / 100]
        );
        for one in &found.triangles {
            let [a, b, c] = one.map(|i| found.points[i as usize]);
            let (u, v): ([f64; 3], [f64; 3]) = (
                std::array::from_fn(|i| b[i] - a[i]),
                std::array::from_fn(|i| c[i] - a[i]),
            );
            assert!(u[0] * v[1] - u[1] * v[0] < 1e-12, "faces the cameras");
        }
    }
}

#[test]
fn an_edge_has_two_triangles_at_most_and_they_agree() {
    let found = wall(0.3);
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    for t in &found.triangles {
        for k in 0..3 {
            *edges.entry((t[k], t[(k + 1) % 3])).or_default() += 1;
        }
    }
    assert!(edges.values().all(|&count| count == 1));
}

#[test]
fn what_does_not_fit_is_refused() {
    let own = camera([0.0; 3], 0.0);
    let known = depths(&own, 0.0);
    let view = Depths {
        camera: own,
        width: WIDTH,
        height: HEIGHT,
        depths: &known,
    };
    let mut small = Volume::new(0.05, 4.0, 10).unwrap();
    let refused = small.add(&view, &vec![1.0; WIDTH * HEIGHT]);
    assert_eq!(refused.unwrap_err(), StereoError::TooManyBlocks(10));
    assert!(Volume::new(0.0, 4.0, 10).is_err());
    assert!(Volume::new(f64::NAN, 4.0, 10).is_err());
}
