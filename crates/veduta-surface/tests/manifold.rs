//! Surfaces of spheres and of noise, looked at edge by edge and vertex by vertex.

#![allow(clippy::unwrap_used)]

use std::collections::HashMap;

use proptest::prelude::*;
use veduta_surface::{surface_nets, Grid, Surface, SurfaceError};

fn net(values: &[f32], size: [usize; 3]) -> Surface {
    surface_nets(&Grid::new(values, size).unwrap(), 0.0, true).unwrap()
}

/// Each edge once in each direction, and around each vertex one ring of triangles.
fn assert_closed_manifold(surface: &Surface) {
    let mut next: HashMap<(u32, u32), u32> = HashMap::new();
    for [a, b, c] in &surface.triangles {
        for (from, to, across) in [(a, b, c), (b, c, a), (c, a, b)] {
            assert_ne!(from, to);
            assert_eq!(next.insert((*from, *to), *across), None, "an edge twice");
        }
    }
    assert!(next.keys().all(|(a, b)| next.contains_key(&(*b, *a))));
    let mut degree: HashMap<u32, (u32, usize)> = HashMap::new();
    for (from, to) in next.keys() {
        degree.entry(*from).or_insert((*to, 0)).1 += 1;
    }
    for (vertex, (start, count)) in degree {
        let (mut at, mut steps) = (next[&(vertex, start)], 1);
        while at != start {
            at = next[&(vertex, at)];
            steps += 1;
        }
        assert_eq!(steps, count, "two rings about a vertex");
    }
}

fn volume(surface: &Surface) -> f64 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|at| surface.positions[at as usize]);
        let cross = [
            b[1] * c[2] - b[2] * c[1],
            b[2] * c[0] - b[0] * c[2],
            b[0] * c[1] - b[1] * c[0],
        ];
        (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
    };
    surface.triangles.iter().map(of).sum()
}

fn sphere(size: usize, radius: f32) -> Vec<f32> {
    let middle = (size - 1) as f32 / 2.0;
    let at = |n: usize| [n / size / size, n / size % size, n % size].map(|one| one as f32 - middle);
    (0..size.pow(3))
        .map(|n| at(n).iter().map(|one| one * one).sum::<f32>().sqrt() - radius)
        .collect()
}

#[test]
fn a_sphere_has_its_volume_and_faces_outwards() {
    let surface = net(&sphere(40, 15.0), [40; 3]);
    assert_closed_manifold(&surface);
    let truth = 4.0 / 3.0 * std::f64::consts::PI * 15.0_f64.powi(3);
    assert!((volume(&surface) / truth - 1.0).abs() < 0.01);
    let (edges, faces) = (surface.triangles.len() * 3 / 2, surface.triangles.len());
    assert_eq!(
        surface.positions.len() + faces,
        edges + 2,
        "one piece without holes"
    );
}

#[test]
fn one_sample_inside_is_closed_even_in_the_corner_of_the_grid() {
    for at in 0..8 {
        let mut values = [1.0; 8];
        values[at] = -1.0;
        let surface = net(&values, [2; 3]);
        assert_closed_manifold(&surface);
        assert_eq!(surface.triangles.len(), 12);
        assert!(volume(&surface) > 0.0);
    }
}

#[test]
fn what_is_full_is_closed_and_what_is_empty_has_no_surface() {
    let full = net(&[-1.0; 27], [3; 3]);
    assert_closed_manifold(&full);
    assert_eq!(net(&[1.0; 27], [3; 3]), Surface::default());
    assert_eq!(net(&[], [0, 3, 3]), Surface::default());
}

#[test]
fn a_surface_ends_where_nothing_is_known() {
    let mut values = sphere(20, 7.0);
    for value in &mut values[..20 * 20 * 10] {
        *value = f32::NAN;
    }
    let whole = net(&sphere(20, 7.0), [20; 3]);
    let half = net(&values, [20; 3]);
    assert!(half.triangles.len() * 2 < whole.triangles.len());
    assert!(half.triangles.len() * 3 > whole.triangles.len());
    let open = surface_nets(&Grid::new(&[-1.0; 27], [3; 3]).unwrap(), 0.0, false).unwrap();
    assert_eq!(open.triangles.len(), 0);
}

#[test]
fn faults_are_told() {
    let size = [2; 3];
    let fault = Grid::new(&[0.0; 7], size).err();
    let (needed, given) = (8, 7);
    assert_eq!(
        fault,
        Some(SurfaceError::Size {
            size,
            needed,
            given
        })
    );
    let grid = Grid::new(&[0.0; 8], size).unwrap();
    let level = f32::INFINITY;
    assert_eq!(
        surface_nets(&grid, level, true),
        Err(SurfaceError::Level { level })
    );
}

proptest! {
    #[test]
    fn noise_is_closed_and_manifold(values in prop::collection::vec(-1.0_f32..1.0, 6 * 7 * 5)) {
        assert_closed_manifold(&net(&values, [6, 7, 5]));
    }

    #[test]
    fn signs_alone_are_enough(values in prop::collection::vec(prop::sample::select(vec![-1.0_f32, 1.0]), 216)) {
        assert_closed_manifold(&net(&values, [6; 3]));
    }
}
