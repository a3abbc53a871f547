//! The types of roof over outlines whose volumes are worked out by hand, and over any outline.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use proptest::prelude::*;
use veduta_geometry::skeleton::SkeletonError;
use veduta_geometry::solid::{roofed, roofed_over, Along, Gables, Mesh, Overhang, RoofKind};

use crate::roof_kinds;

use roof_kinds::{fault, kinds, sheet};

type Rings = Vec<Vec<[f64; 2]>>;

/// 12 m by 8 m; the front is the first edge.
fn house() -> Rings {
    vec![vec![[0.0, 0.0], [12.0, 0.0], [12.0, 8.0], [0.0, 8.0]]]
}

fn found(kind: &RoofKind, slope: f64) -> Mesh {
    let solid = roofed(&sheet(&house()), kind, slope).unwrap();
    assert_eq!(fault(&solid, &house(), None), None, "{kind:?}");
    solid
}

fn assert_volume(kind: &RoofKind, slope: f64, faces: usize, volume: f64) {
    let solid = found(kind, slope);
    assert!(
        (solid.volume() - volume).abs() < 1e-6,
        "{kind:?}: {}",
        solid.volume()
    );
    assert_eq!(solid.face_count(), faces, "{kind:?}");
}

/// The volume between the house and a roof whose height over the distance to the eaves is straight
/// between knots: layers from one rectangle to the next (Simpson's rule is exact there).
fn layers(knots: &[[f64; 2]]) -> f64 {
    let area = |d: f64| (12.0 - 2.0 * d) * (8.0 - 2.0 * d);
    let layer = |pair: &[[f64; 2]]| {
        let ([d0, z0], [d1, z1]) = (pair[0], pair[1]);
        (z1 - z0) / 6.0 * (area(d0) + 4.0 * area(0.5 * (d0 + d1)) + area(d1))
    };
    knots.windows(2).map(layer).sum()
}

#[test]
fn two_slopes() {
    let (upper, knee) = (0.5, 2.0);
    // 2 m up at a slope of 2: 10 by 6 m are left, for a hip roof 1.5 m high.
    let frustum = 2.0 / 6.0 * (96.0 + 4.0 * 77.0 + 60.0);
    let top = 6.0 * 1.5 * (30.0 - 6.0) / 6.0;
    assert_volume(&RoofKind::Mansard { upper, knee }, 2.0, 9, frustum + top);
    let gables = Gables::Triangles;
    let section = 14.0 + 4.5;
    assert_volume(
        &RoofKind::Gambrel {
            gables,
            upper,
            knee,
        },
        2.0,
        7,
        12.0 * section,
    );
}

#[test]
fn ends_that_change() {
    let gables = Gables::Triangles;
    // The upper half of each gable leans back: a pyramid of 4 m2 and 2 m is gone.
    assert_volume(
        &RoofKind::HalfHip {
            gables,
            clipped: 0.5,
        },
        1.0,
        7,
        192.0 - 2.0 * 8.0 / 3.0,
    );
    // Over the upper 8 by 4 m of the hip roof there are gables.
    let hip = 8.0 * 4.0 * (36.0 - 8.0) / 6.0;
    let upper = 32.0 - 4.0 * 2.0 * (24.0 - 4.0) / 6.0;
    assert_volume(&RoofKind::Dutch { share: 0.5 }, 1.0, 7, hip + upper);
}

#[test]
fn slopes_of_their_own() {
    let upright = f64::INFINITY;
    let gable = RoofKind::PerEdge(vec![1.0, upright, 1.0, upright]);
    assert_volume(&gable, 1.0, 5, 192.0);
    // The ridge is 8/3 m from the front and as high.
    let salt = |front| RoofKind::Saltbox { back: 0.5, front };
    assert_volume(&salt(None), 1.0, 5, 12.0 * 8.0 * (8.0 / 3.0) / 2.0);
    assert_volume(&salt(Some(2)), 1.0, 5, 128.0);
    let edges = |edges: &[u32]| RoofKind::Gable {
        gables: Gables::Edges(edges.to_vec()),
        even: false,
    };
    assert_volume(&edges(&[1, 3]), 1.0, 5, 192.0);
    assert_volume(&edges(&[0, 2]), 1.0, 5, 12.0 * 6.0 / 2.0 * 8.0);
    assert_volume(&edges(&[1]), 1.0, 5, 192.0 - 8.0 * 4.0 * 4.0 / 6.0);
    let far = roofed(&sheet(&house()), &edges(&[9]), 1.0);
    assert_eq!(far, Err(SkeletonError::NoSuchEdge { edge: 9, edges: 4 }));
}

#[test]
fn planes() {
    let along = Along::Longest;
    assert_volume(&RoofKind::Shed { edge: 1 }, 0.5, 5, 96.0 * 6.0 / 2.0);
    let towards = DVec3::Y;
    assert_volume(&RoofKind::Skillion { towards }, 0.5, 5, 96.0 * 4.0 / 2.0);
    assert_volume(&RoofKind::Ridge(along), 1.0, 5, 192.0);
    assert_volume(&RoofKind::Ridge(Along::Edge(1)), 1.0, 5, 288.0);
    assert_volume(&RoofKind::Ridge(Along::Direction(DVec3::Y)), 1.0, 5, 288.0);
    // The valley is a tenth of its depth of 2 m over the floor.
    assert_volume(
        &RoofKind::Butterfly(along),
        0.5,
        7,
        12.0 * 8.0 * (0.2 + 1.0),
    );
    // Teeth 2 m wide and 1 m high, on a curb of 0.1 m.
    let teeth = RoofKind::Sawtooth { teeth: 4, along };
    assert_volume(&teeth, 0.5, 12, 12.0 * 8.0 * (0.1 + 0.5));
    // The lower of two ridges 4 m high is a third lower in the mean.
    assert_volume(
        &RoofKind::CrossGable(along),
        1.0,
        13,
        96.0 * 4.0 * 2.0 / 3.0,
    );
    assert_volume(&RoofKind::Pyramid, 1.0, 5, 96.0 * 4.0 / 3.0);
    let flat = RoofKind::Flat {
        slab: 0.2,
        parapet: 0.9,
        width: 0.3,
    };
    let rim = 96.0 - 11.4 * 7.4;
    assert_volume(&flat, 1.0, 4 + 1 + 4 + 4 + 1, 96.0 * 0.2 + rim * 0.7);
}

#[test]
fn round_ones() {
    let quarter = |width: f64, height: f64, steps: u32| -> Vec<[f64; 2]> {
        let knot = |k: u32| {
            let angle = FRAC_PI_2 * f64::from(k) / f64::from(steps);
            [width * (1.0 - angle.cos()), height * angle.sin()]
        };
        (0..=steps).map(knot).collect()
    };
    let dome = RoofKind::Dome {
        height: 3.0,
        steps: 6,
    };
    assert_volume(&dome, 1.0, 4 * 6 + 1, layers(&quarter(4.0, 3.0, 6)));
    let section: f64 = quarter(4.0, 3.0, 6)
        .windows(2)
        .map(|pair| (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]))
        .sum();
    let gables = Gables::Triangles;
    let vault = RoofKind::Vault {
        gables,
        height: 3.0,
        steps: 6,
    };
    assert_volume(&vault, 1.0, 2 * 6 + 3, 12.0 * section);
    // Below the belly at a fifth of the height the foot is 0.6 m narrower.
    let onion = found(
        &RoofKind::Onion {
            height: 5.0,
            steps: 4,
        },
        1.0,
    );
    let below = layers(&[[0.6, 0.0], [0.0, 1.0]]);
    let mut bulb = quarter(1.8, 2.0, 2);
    bulb.extend((1..=2).map(|k| {
        let angle = FRAC_PI_2 * f64::from(k) / 2.0;
        [1.8 + 2.2 * angle.sin(), 2.0 + 2.0 * (1.0 - angle.cos())]
    }));
    assert!((onion.volume() - below - layers(&bulb)).abs() < 1e-6);
    // The bulb has a line over the edge of its foot, too.
    assert_eq!(onion.face_count(), 4 + 4 * 5 + 4 + 1);
}

#[test]
fn even_ridges() {
    // Wings 8 m and 4 m wide have ridges 4 m and 2 m high, or both 4 m.
    let l = vec![vec![
        [0.0, 0.0],
        [20.0, 0.0],
        [20.0, 4.0],
        [8.0, 4.0],
        [8.0, 12.0],
        [0.0, 12.0],
    ]];
    let solid = roofed(&sheet(&l), &RoofKind::Hip { even: true }, 1.0).unwrap();
    assert_eq!(fault(&solid, &l, None), None);
    assert!(solid
        .points
        .iter()
        .all(|p| p.z == 0.0 || (p.z - 4.0).abs() < 1e-9));
    let uneven = roofed(&sheet(&l), &RoofKind::HIP, 1.0).unwrap();
    assert!(solid.volume() > uneven.volume());
}

#[test]
fn overhangs_go_on_down() {
    let out = Overhang {
        eaves: 0.5,
        gables: 0.25,
    };
    let over = |kind: &RoofKind| roofed_over(&sheet(&house()), kind, 1.0, out).unwrap();
    let lowest = |mesh: &Mesh| mesh.bounds().unwrap().0.z;
    let highest = |mesh: &Mesh| mesh.bounds().unwrap().1.z;
    let gables = Gables::Triangles;
    for (kind, floor, top) in [
        (RoofKind::HIP, -0.5, 4.0),
        (
            RoofKind::Mansard {
                upper: 0.5,
                knee: 1.0,
            },
            -0.5,
            2.5,
        ),
        (
            RoofKind::Dome {
                height: 3.0,
                steps: 6,
            },
            -0.5,
            3.0,
        ),
        (
            RoofKind::HalfHip {
                gables,
                clipped: 0.5,
            },
            -0.5,
            4.0,
        ),
        (RoofKind::Dutch { share: 0.5 }, -0.5, 4.0),
        (RoofKind::Shed { edge: 0 }, -0.5, 8.5),
        (RoofKind::Ridge(Along::Longest), -0.5, 4.0),
        (RoofKind::Pyramid, -0.5, 4.0),
        (
            RoofKind::Saltbox {
                back: 1.0,
                front: None,
            },
            -0.5,
            4.0,
        ),
    ] {
        let solid = over(&kind);
        assert!(solid.is_closed(), "{kind:?}");
        assert!(
            (lowest(&solid) - floor).abs() < 1e-9,
            "{kind:?}: {}",
            lowest(&solid)
        );
        assert!(
            (highest(&solid) - top).abs() < 1e-9,
            "{kind:?}: {}",
            highest(&solid)
        );
    }
}

#[test]
fn a_pyramid_needs_a_place_in_sight_of_all_edges() {
    let u = vec![vec![
        [0.0, 0.0],
        [9.0, 0.0],
        [9.0, 9.0],
        [6.0, 9.0],
        [6.0, 3.0],
        [3.0, 3.0],
        [3.0, 9.0],
        [0.0, 9.0],
    ]];
    let none = roofed(&sheet(&u), &RoofKind::Pyramid, 1.0);
    assert_eq!(none, Err(SkeletonError::NoApex));
    // The mean of the corners of this L is outside; its kernel is the corner square.
    let l = vec![vec![
        [0.0, 0.0],
        [20.0, 0.0],
        [20.0, 2.0],
        [2.0, 2.0],
        [2.0, 20.0],
        [0.0, 20.0],
    ]];
    let solid = roofed(&sheet(&l), &RoofKind::Pyramid, 1.0).unwrap();
    assert_eq!(fault(&solid, &l, None), None);
    let top = solid
        .points
        .iter()
        .max_by(|a, b| a.z.total_cmp(&b.z))
        .unwrap();
    assert!(top.x > 0.0 && top.x < 2.0 && top.y > 0.0 && top.y < 2.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn all_types_close_over_any_outline(
        radii in prop::collection::vec(2.0..9.0f64, 3..16),
        hole in prop::option::of(prop::collection::vec(0.3..0.7f64, 3..6)),
        slope in 0.1..4.0f64,
        out in 0.0..0.5f64,
    ) {
        let ring = |radii: &[f64], sign: f64| -> Vec<[f64; 2]> {
            let step = sign * std::f64::consts::TAU / radii.len() as f64;
            let corner = |(k, r): (usize, &f64)| {
                [r * (step * k as f64).cos(), r * (step * k as f64).sin()]
            };
            radii.iter().enumerate().map(corner).collect()
        };
        // A triangle reaches in to half of its radius.
        let mut rings = vec![ring(&radii, 1.0)];
        rings.extend(hole.filter(|_| radii.len() > 4).map(|radii| ring(&radii, -1.0)));
        for (name, kind) in kinds() {
            match roofed(&sheet(&rings), &kind, slope) {
                Ok(solid) => prop_assert_eq!(fault(&solid, &rings, None), None, "{}", name),
                Err(SkeletonError::NoApex) => prop_assert_eq!(name, "pyramid"),
                Err(SkeletonError::FoldedGable) => prop_assert_eq!(name, "even gable"),
                Err(error) => prop_assert!(false, "{name}: {error}"),
            }
            let over = Overhang { eaves: out, gables: out };
            if let Ok(solid) = roofed_over(&sheet(&rings), &kind, slope, over) {
                prop_assert!(solid.is_closed() && solid.volume() > 0.0, "{name} hangs over");
            }
        }
    }
}
