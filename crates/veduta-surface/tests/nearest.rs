//! Distances from meshes whose distances are known in closed form.

#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use veduta_surface::{nearest_on_mesh, SurfaceError};

/// A cube from -1 to 1, its faces counter-clockwise seen from outside.
fn cube() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corner = |at: u32| [0, 1, 2].map(|axis| if at >> axis & 1 == 1 { 1.0 } else { -1.0 });
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    ((0..8).map(corner).collect(), triangles.collect())
}

/// The signed distance of a point from the cube.
fn from_cube(point: [f64; 3]) -> f64 {
    let over = point.map(|value| value.abs() - 1.0);
    let outside = over.iter().map(|value| value.max(0.0).powi(2)).sum::<f64>();
    let inside = over.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
    outside.sqrt() + inside.min(0.0)
}

proptest! {
    #[test]
    fn points_about_a_cube(points in prop::collection::vec(prop::array::uniform3(-3.0..3.0), 1..60)) {
        let (positions, triangles) = cube();
        let found = nearest_on_mesh(&points, &positions, &triangles).unwrap();
        for (point, distance) in points.iter().zip(&found.distances) {
            prop_assert!((distance - from_cube(*point)).abs() < 1e-12, "{point:?}: {distance}");
        }
    }
}

#[test]
fn a_corner_and_an_edge_have_their_side() {
    let (positions, triangles) = cube();
    let points = [[2.0, 2.0, 2.0], [0.0, 1.5, 1.5], [0.9, 0.9, 0.9]];
    let found = nearest_on_mesh(&points, &positions, &triangles).unwrap();
    let wanted = [3.0_f64.sqrt(), 0.5_f64.sqrt(), -0.1];
    for (distance, wanted) in found.distances.iter().zip(wanted) {
        assert!((distance - wanted).abs() < 1e-12);
    }
    assert_eq!(found.triangles.len(), 3);
}

#[test]
fn what_is_no_mesh_is_refused() {
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let point = [[0.0, 1.0, 0.0]];
    let of =
        |points: &[[f64; 3]], triangles: &[[u32; 3]]| nearest_on_mesh(points, &flat, triangles);
    assert_eq!(of(&point, &[[0, 1, 2]]), Err(SurfaceError::NoTriangle));
    assert_eq!(of(&point, &[]), Err(SurfaceError::NoTriangle));
    let wrong = SurfaceError::Corner { index: 3, count: 3 };
    assert_eq!(of(&point, &[[0, 1, 3]]), Err(wrong));
    assert_eq!(
        of(&[[f64::NAN; 3]], &[[0, 1, 2]]),
        Err(SurfaceError::NotFinite)
    );
}
