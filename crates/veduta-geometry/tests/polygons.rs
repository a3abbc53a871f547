//! Properties of the triangulation, against closed forms.

use std::collections::HashMap;

use proptest::prelude::*;
use veduta_geometry::{triangulate, PolygonError, PolygonSet, Triangulation};

/// Columns of one polygon: positions, ring offsets, polygon offsets.
type Columns = (Vec<[f64; 3]>, Vec<i64>, Vec<i64>);

fn columns(rings: &[Vec<[f64; 3]>]) -> Columns {
    let mut offsets = vec![0];
    for ring in rings {
        offsets.push(offsets[offsets.len() - 1] + ring.len() as i64);
    }
    (rings.concat(), offsets, vec![0, rings.len() as i64])
}

fn run(columns: &Columns) -> Result<Triangulation, PolygonError> {
    let set = PolygonSet::new(&columns.0, &columns.1, &columns.2)?;
    triangulate(&set, 1e-6)
}

/// A rotation by two angles and a shift, so that no axis is special.
fn place(point: [f64; 2], (turn, tilt): (f64, f64)) -> [f64; 3] {
    let (x, y) = (point[0], point[1]);
    let (a, b) = (y * tilt.cos(), y * tilt.sin());
    [
        x * turn.cos() - a * turn.sin() + 3.0,
        x * turn.sin() + a * turn.cos() - 7.0,
        b + 11.0,
    ]
}

fn square(centre: [f64; 2], half: f64) -> Vec<[f64; 2]> {
    let [x, y] = centre;
    vec![
        [x - half, y - half],
        [x - half, y + half],
        [x + half, y + half],
        [x + half, y - half],
    ]
}

fn shoelace(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    0.5 * ring
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum::<f64>()
}

fn triangle_vector(points: &[[f64; 3]], triangle: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = triangle.map(|v| points[v as usize]);
    let u: Vec<f64> = (0..3).map(|k| b[k] - a[k]).collect();
    let v: Vec<f64> = (0..3).map(|k| c[k] - a[k]).collect();
    [
        0.5 * (u[1] * v[2] - u[2] * v[1]),
        0.5 * (u[2] * v[0] - u[0] * v[2]),
        0.5 * (u[0] * v[1] - u[1] * v[0]),
    ]
}

prop_compose! {
    /// A star-shaped outline of radius 5 to 9 and up to nine aligned square holes within 3.2.
    fn holed_star()(
        radii in prop::collection::vec(5.0..9.0f64, 8..40),
        holes in prop::collection::vec(prop::option::of(0.1..0.7f64), 9),
        turn in 0.0..6.2f64,
        tilt in 0.0..6.2f64,
        parallel in any::<bool>(),
    ) -> (Vec<Vec<[f64; 2]>>, (f64, f64)) {
        let count = radii.len() as f64;
        let outline = radii.iter().enumerate().map(|(k, radius)| {
            let angle = std::f64::consts::TAU * k as f64 / count;
            [radius * angle.cos(), radius * angle.sin()]
        });
        let mut rings = vec![outline.collect::<Vec<_>>()];
        for (cell, half) in holes.iter().enumerate() {
            if let Some(half) = half {
                let centre = [1.5 * (cell % 3) as f64 - 1.5, 1.5 * (cell / 3) as f64 - 1.5];
                rings.push(square(centre, *half));
            }
        }
        let angles = if parallel { (0.0, std::f64::consts::FRAC_PI_2) } else { (turn, tilt) };
        (rings, angles)
    }
}

proptest! {
    #[test]
    fn area_count_and_orientation_are_kept((flat, angles) in holed_star()) {
        let rings: Vec<Vec<[f64; 3]>> = flat
            .iter()
            .map(|ring| ring.iter().map(|&p| place(p, angles)).collect())
            .collect();
        let columns = columns(&rings);
        let found = run(&columns).unwrap();

        let vertices: usize = flat.iter().map(Vec::len).sum();
        let holes = flat.len() - 1;
        prop_assert_eq!(found.triangles.len(), vertices + 2 * holes - 2);

        let expected = shoelace(&flat[0]) - flat[1..].iter().map(|r| shoelace(r).abs()).sum::<f64>();
        prop_assert!((found.areas_m2[0] - expected).abs() < 1e-9 * expected.abs().max(1.0));
        let mut sum = 0.0;
        for &triangle in &found.triangles {
            let vector = triangle_vector(&columns.0, triangle);
            let along: f64 = (0..3).map(|k| vector[k] * found.normals[0][k]).sum();
            prop_assert!(along > -1e-12);
            sum += along;
        }
        prop_assert!((sum - expected).abs() < 1e-9 * expected.abs().max(1.0));
    }

    #[test]
    fn the_border_of_the_triangles_is_the_rings((flat, angles) in holed_star()) {
        let rings: Vec<Vec<[f64; 3]>> = flat
            .iter()
            .map(|ring| ring.iter().map(|&p| place(p, angles)).collect())
            .collect();
        let found = run(&columns(&rings)).unwrap();
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for [a, b, c] in &found.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((*from, *to)).or_default() += 1;
                *edges.entry((*to, *from)).or_default() -= 1;
            }
        }
        let mut first = 0u32;
        for ring in &rings {
            let count = ring.len() as u32;
            for k in 0..count {
                let edge = (first + k, first + (k + 1) % count);
                prop_assert_eq!(edges.remove(&edge), Some(1));
                prop_assert_eq!(edges.remove(&(edge.1, edge.0)), Some(-1));
            }
            first += count;
        }
        prop_assert!(edges.values().all(|&balance| balance == 0));
    }

    #[test]
    fn a_reversed_outline_turns_the_normal((flat, angles) in holed_star()) {
        let mut rings: Vec<Vec<[f64; 3]>> = flat
            .iter()
            .map(|ring| ring.iter().map(|&p| place(p, angles)).collect())
            .collect();
        let there = run(&columns(&rings)).unwrap();
        rings[0].reverse();
        let back = run(&columns(&rings)).unwrap();
        for axis in 0..3 {
            prop_assert!((there.normals[0][axis] + back.normals[0][axis]).abs() < 1e-9);
        }
        prop_assert!((there.areas_m2[0] - back.areas_m2[0]).abs() < 1e-9);
    }

    #[test]
    fn any_columns_give_triangles_or_a_reason(
        points in prop::collection::vec(prop::array::uniform3(-3..3i32), 0..12),
        rings in prop::collection::vec(-1..13i64, 0..5),
        polygons in prop::collection::vec(-1..5i64, 0..4),
    ) {
        let points: Vec<[f64; 3]> = points.iter().map(|p| p.map(f64::from)).collect();
        if let Ok(set) = PolygonSet::new(&points, &rings, &polygons) {
            let _ = triangulate(&set, 1e-6);
        }
    }
}

fn corner(x: f64, z: f64) -> [f64; 3] {
    [x, 0.0, z]
}

#[test]
fn a_row_of_windows_leaves_no_t_junction() {
    let mut rings = vec![vec![
        corner(0.0, 0.0),
        corner(10.0, 0.0),
        corner(10.0, 3.0),
        corner(0.0, 3.0),
    ]];
    for k in 0..4 {
        let x = 1.0 + 2.0 * f64::from(k);
        rings.push(vec![
            corner(x, 1.0),
            corner(x, 2.0),
            corner(x + 1.0, 2.0),
            corner(x + 1.0, 1.0),
        ]);
    }
    let found = run(&columns(&rings)).unwrap();
    assert_eq!(found.triangles.len(), 20 + 8 - 2);
    assert_eq!(found.normals, vec![[0.0, -1.0, 0.0]]);
    assert!((found.areas_m2[0] - 26.0).abs() < 1e-12);
}

#[test]
fn each_fault_has_its_error() {
    let square = vec![
        corner(0.0, 0.0),
        corner(1.0, 0.0),
        corner(1.0, 1.0),
        corner(0.0, 1.0),
    ];
    let with = |index: usize, point: [f64; 3]| {
        let mut ring = square.clone();
        ring[index] = point;
        run(&columns(&[ring]))
    };
    assert!(matches!(
        with(2, [f64::NAN, 0.0, 0.0]),
        Err(PolygonError::NotFinite { vertex: 2 })
    ));
    assert!(matches!(
        with(1, corner(0.0, 0.0)),
        Err(PolygonError::RepeatedVertex { vertex: 0, .. })
    ));
    assert!(matches!(
        with(2, [1.0, 0.5, 1.0]),
        Err(PolygonError::NotPlanar { polygon: 0, .. })
    ));
    let bow_tie = vec![square[0], square[1], square[3], [1.5, 0.0, 1.5]];
    assert!(matches!(
        run(&columns(&[bow_tie])),
        Err(PolygonError::SelfCrossing { polygon: 0, .. })
    ));
    let line = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(2.0, 0.0)];
    assert!(matches!(
        run(&columns(&[line])),
        Err(PolygonError::NoArea { polygon: 0, .. })
    ));
    let short = (square[..2].to_vec(), vec![0, 2], vec![0, 1]);
    assert!(matches!(
        run(&short),
        Err(PolygonError::RingTooShort { vertices: 2, .. })
    ));
    let beyond = (square, vec![0, 9], vec![0, 1]);
    assert!(matches!(
        run(&beyond),
        Err(PolygonError::BadOffsets {
            value: 9,
            end: 4,
            ..
        })
    ));
}
