//! Meshes that stand in a tile, put back in place as glTF has it, against the places themselves.

use glam::{DMat3, DQuat, DVec3};
use proptest::prelude::*;
use veduta_tiles::{batch, Batch, Repeated, Standing};

/// A tetrahedron of two materials, far from its own origin.
fn mesh() -> ([[f64; 3]; 4], [[u32; 3]; 4], [u32; 4]) {
    let points = [
        [5.0, 1.0, -2.0],
        [6.3, 1.0, -2.0],
        [5.0, 3.1, -2.0],
        [5.4, 1.9, 0.7],
    ];
    (
        points,
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        [4, 4, 9, 9],
    )
}

fn place(turn: DQuat, stretch: DVec3, by: DVec3) -> [f64; 12] {
    let axes = DMat3::from_quat(turn) * DMat3::from_diagonal(stretch);
    let row = |k: usize| [axes.x_axis[k], axes.y_axis[k], axes.z_axis[k], by[k]];
    std::array::from_fn(|k| row(k / 4)[k % 4])
}

fn standing(places: Vec<[f64; 12]>) -> Standing {
    let (points, triangles, material) = mesh();
    let feature = (0..places.len() as u32).map(|k| 100 + k).collect();
    Standing {
        points: points.to_vec(),
        triangles: triangles.to_vec(),
        material: material.to_vec(),
        places,
        feature,
        ..Standing::default()
    }
}

/// Material, feature and corners (z up) of what is drawn, instances as the extension says:
/// translation after rotation after scale.
fn drawn(batch: &Batch) -> Vec<(u32, u32, [DVec3; 3])> {
    let z_up = |p: DVec3| DVec3::new(p.x, -p.z, p.y);
    let three = |all: &[f32], k: usize| {
        DVec3::new(
            f64::from(all[3 * k]),
            f64::from(all[3 * k + 1]),
            f64::from(all[3 * k + 2]),
        )
    };
    let mut found = Vec::new();
    for mesh in &batch.merged {
        let point = |k: u32| {
            let p = &mesh.positions[4 * k as usize..][..3];
            let steps = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
            z_up(DVec3::from(batch.grid_low) + steps * DVec3::from(batch.grid_step))
        };
        for t in mesh.indices.chunks_exact(3) {
            let feature = mesh.features[t[0] as usize];
            found.push((
                mesh.material,
                feature,
                [point(t[0]), point(t[1]), point(t[2])],
            ));
        }
    }
    for mesh in &batch.repeated {
        for (k, &feature) in mesh.features.iter().enumerate() {
            let r = &mesh.rotations[4 * k..][..4];
            let turn = DQuat::from_array([r[0], r[1], r[2], r[3]].map(|c| f64::from(c) / 32767.0));
            let (by, scale) = (three(&mesh.translations, k), three(&mesh.scales, k));
            let point = |k: u16| {
                let p = &mesh.positions[4 * usize::from(k)..][..3];
                let own = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
                z_up((turn.normalize() * (own * scale) + by) * Repeated::step_m())
            };
            for t in mesh.indices.chunks_exact(3) {
                found.push((
                    mesh.material,
                    feature,
                    [point(t[0]), point(t[1]), point(t[2])],
                ));
            }
        }
    }
    found.sort_by_key(|one| (one.1, one.0));
    found
}

/// Each triangle of the mesh at each place is drawn, with its corners within `off` (m).
fn check(batch: &Batch, places: &[[f64; 12]], off: f64) {
    let (points, triangles, material) = mesh();
    let found = drawn(batch);
    assert_eq!(found.len(), 4 * places.len());
    assert_eq!(batch.triangles, found.len());
    for (k, place) in places.iter().enumerate() {
        let at = |vertex: u32| {
            let p = points[vertex as usize];
            let row = |r: usize| {
                let m = &place[4 * r..];
                m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3]
            };
            DVec3::new(row(0), row(1), row(2))
        };
        for (triangle, material) in triangles.iter().zip(material) {
            let expected = triangle.map(at);
            let near = |one: &&(u32, u32, [DVec3; 3])| {
                let turned =
                    |by: usize| (0..3).all(|c| one.2[(c + by) % 3].distance(expected[c]) < off);
                one.0 == material && one.1 == 100 + k as u32 && (0..3).any(turned)
            };
            assert_eq!(
                found[4 * k..4 * k + 4].iter().filter(near).count(),
                1,
                "{expected:?}"
            );
        }
        for vertex in 0..4 {
            let point = at(vertex).to_array();
            for axis in 0..3 {
                assert!(
                    batch.low[axis] - 1e-9 <= point[axis] && point[axis] <= batch.high[axis] + 1e-9
                );
            }
        }
    }
}

proptest! {
    #[test]
    fn stretched_meshes_stand_where_they_should(
        all in prop::collection::vec((prop::array::uniform3(-3.0..3.0f64), prop::array::uniform3(0.2..4.0f64), prop::array::uniform3(-60.0..60.0f64)), 80..120)
    ) {
        let places: Vec<_> = all.into_iter().map(|(turn, stretch, by)| {
            place(DQuat::from_scaled_axis(turn.into()), stretch.into(), by.into())
        }).collect();
        let found = batch(&[], &[standing(places.clone())]).unwrap();
        prop_assert!(found.merged.is_empty());
        prop_assert_eq!(found.repeated.len(), 2);
        // A millimetre for rotations of 16 bits at 15 m from the mesh's middle.
        check(&found, &places, 2e-3);
    }
}

#[test]
fn a_mesh_that_stands_once_is_no_instance() {
    let places = vec![place(
        DQuat::from_rotation_z(0.6),
        DVec3::new(1.0, 2.0, 0.5),
        DVec3::X,
    )];
    let found = batch(&[], &[standing(places.clone())]).unwrap();
    assert!(found.repeated.is_empty());
    assert_eq!(found.merged.len(), 2);
    check(&found, &places, 1e-3);
}
