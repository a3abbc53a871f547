use crate::scene::{camera, depths, HEIGHT, WIDTH};
use veduta_stereo::colour::{add_colours, Sum};
use veduta_stereo::consistent::{Agreement, Depths};
use veduta_stereo::fuse::{fuse, Shown};
use veduta_stereo::Camera;

const AGREEMENT: Agreement = Agreement {
    most_px: 1.0,
    most_share: 0.01,
};

fn map<'a>(camera: Camera, depths: &'a [f32]) -> Depths<'a> {
    Depths {
        camera,
        width: WIDTH,
        height: HEIGHT,
        depths,
    }
}

#[test]
fn views_of_one_wall_agree_where_both_see_it() {
    let cameras = [camera([0.0; 3], 0.0), camera([0.6, 0.0, 0.0], 0.1)];
    let known: Vec<Vec<f32>> = cameras.iter().map(|one| depths(one, 0.3)).collect();
    let mut wrong = known[0].clone();
    wrong[20 * WIDTH + 50] *= 1.05;
    wrong[21 * WIDTH + 50] = f32::NAN;
    let (own, other) = (map(cameras[0], &wrong), map(cameras[1], &known[1]));
    let counts = AGREEMENT.counts(&own, &[other]);
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let point = cameras[0].point(Depths::centre(x, y), f64::from(known[0][y * WIDTH + x]));
            let inside = other.cell(cameras[1].seen(point)).is_some();
            let spoiled = x == 50 && (y == 20 || y == 21);
            let got = counts[y * WIDTH + x];
            assert_eq!(got, u8::from(inside && !spoiled), "{x} {y}");
        }
    }
}

#[test]
fn each_spot_makes_one_point_on_the_wall() {
    let cameras = [camera([0.0; 3], 0.0), camera([0.3, 0.0, 0.0], 0.0)];
    let known: Vec<Vec<f32>> = cameras.iter().map(|one| depths(one, 0.0)).collect();
    let normals = vec![[0.0f32, 0.0, -1.0]; WIDTH * HEIGHT];
    let colours = [
        vec![[200u8, 0, 0]; WIDTH * HEIGHT],
        vec![[100u8, 0, 0]; WIDTH * HEIGHT],
    ];
    let shown: Vec<Shown<'_>> = (0..2)
        .map(|i| Shown {
            depths: map(cameras[i], &known[i]),
            normals: &normals,
            colours: &colours[i],
        })
        .collect();
    let mut used = vec![vec![false; WIDTH * HEIGHT]; 2];
    let (cloud, taken) = fuse(&shown, &used, AGREEMENT, 2);
    assert!(cloud.points.len() > WIDTH * HEIGHT / 2);
    assert_eq!(taken[0].len(), cloud.points.len());
    for (point, colour) in cloud.points.iter().zip(&cloud.colours) {
        assert!((point[2] - 4.0).abs() < 1e-5);
        assert_eq!(*colour, [150, 0, 0]);
    }
    assert!(cloud.views.iter().all(|&one| one == 2));
    for &at in &taken[1] {
        used[0][at as usize] = true;
    }
    let turned: Vec<Shown<'_>> = shown.into_iter().rev().collect();
    let (again, _) = fuse(&turned, &used, AGREEMENT, 2);
    assert!(again.points.len() < 60, "{}", again.points.len());
}

#[test]
fn colours_come_from_views_that_see_a_point() {
    let own = camera([0.0; 3], 0.0);
    let known = depths(&own, 0.0);
    let colours = vec![[10u8, 20, 30]; WIDTH * HEIGHT];
    let points = [
        [0.0, 0.0, 4.0],
        [0.0, 0.0, 5.0],
        [50.0, 0.0, 4.0],
        [0.0, 0.0, -4.0],
    ];
    let normals = [[0.0f32, 0.0, -1.0]; 4];
    let mut sums = [Sum::default(); 4];
    add_colours(
        &points,
        &normals,
        &map(own, &known),
        &colours,
        0.1,
        &mut sums,
    );
    assert_eq!(sums.map(|one| one.views), [1.0, 0.0, 0.0, 0.0]);
    assert!((sums[0].colour[2] / sums[0].weight - 30.0).abs() < 1e-3);
}
