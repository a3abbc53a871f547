//! A batch shows what went in: its triangles, put back in place, against the polygons themselves.

use glam::{DQuat, DVec3};
use veduta_tiles::{batch, Batch, Building, Repeated};

/// Quads of 1 x 2 m in rows on walls that face different ways, and one large one.
struct Columns {
    positions: Vec<[f64; 3]>,
    rings: Vec<i64>,
    polygons: Vec<i64>,
    feature: Vec<u32>,
    material: Vec<u32>,
    piece: Vec<u32>,
}

fn columns(windows: usize, heading: f64) -> Columns {
    let turn = DQuat::from_rotation_z(heading);
    let mut made = Columns {
        positions: Vec::new(),
        rings: vec![0],
        polygons: vec![0],
        feature: Vec::new(),
        material: Vec::new(),
        piece: Vec::new(),
    };
    let mut quad = |low: DVec3, width: f64, height: f64, feature: u32, piece: u32| {
        for (x, z) in [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)] {
            let corner = turn * (low + DVec3::new(x, 0.0, z));
            made.positions.push(corner.to_array());
        }
        made.rings.push(made.positions.len() as i64);
        made.polygons.push(made.rings.len() as i64 - 1);
        made.feature.push(feature);
        made.material.push(u32::from(piece > 0));
        made.piece.push(piece);
    };
    quad(DVec3::new(0.0, 0.3, 0.0), 60.0, 12.0, 0, 0);
    for window in 0..windows {
        let at = DVec3::new(1.37 * window as f64, 0.0, 1.1);
        let piece = window as u32 + 1;
        quad(at, 1.0, 2.0, piece, piece);
        quad(at + DVec3::new(0.2, -0.1, 0.5), 0.3335, 0.7, piece, piece);
    }
    made
}

fn building(columns: &Columns, offset: [f64; 3]) -> Building<'_> {
    Building {
        positions: &columns.positions,
        ring_offsets: &columns.rings,
        polygon_offsets: &columns.polygons,
        feature: &columns.feature,
        material: &columns.material,
        piece: &columns.piece,
        part: &columns.piece,
        uv: &[],
        mapped: &[],
        plain: &[],
        offset,
    }
}

/// Feature and corners (z up) of all triangles that are drawn.
fn drawn(batch: &Batch) -> Vec<(u32, [DVec3; 3])> {
    let z_up = |p: DVec3| DVec3::new(p.x, -p.z, p.y);
    let mut found = Vec::new();
    for mesh in &batch.merged {
        let point = |k: u32| {
            let p = &mesh.positions[4 * k as usize..][..3];
            let steps = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
            z_up(DVec3::from(batch.grid_low) + steps * DVec3::from(batch.grid_step))
        };
        for t in mesh.indices.chunks_exact(3) {
            let feature = mesh.features[t[0] as usize];
            assert!(t.iter().all(|k| mesh.features[*k as usize] == feature));
            found.push((feature, [point(t[0]), point(t[1]), point(t[2])]));
        }
    }
    for mesh in &batch.repeated {
        for (k, &feature) in mesh.features.iter().enumerate() {
            let t = &mesh.translations[3 * k..][..3];
            let r = &mesh.rotations[4 * k..][..4];
            let turn = DQuat::from_array([r[0], r[1], r[2], r[3]].map(|c| f64::from(c) / 32767.0));
            let at = DVec3::new(f64::from(t[0]), f64::from(t[1]), f64::from(t[2]));
            let point = |k: u16| {
                let p = &mesh.positions[4 * usize::from(k)..][..3];
                let own = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
                z_up((turn.normalize() * own + at) * Repeated::step_m())
            };
            for t in mesh.indices.chunks_exact(3) {
                found.push((feature, [point(t[0]), point(t[1]), point(t[2])]));
            }
        }
    }
    found
}

fn area(corners: [DVec3; 3]) -> DVec3 {
    (corners[1] - corners[0]).cross(corners[2] - corners[0]) / 2.0
}

#[test]
fn repeated_windows_are_one_mesh_and_stand_where_they_were() {
    let street = [columns(40, 0.0), columns(40, 0.7)];
    let offsets = [[0.0, 0.0, 0.0], [-20.0, 80.0, 3.0]];
    let buildings: Vec<_> = street
        .iter()
        .zip(offsets)
        .map(|(c, offset)| building(c, offset))
        .collect();
    let batch = batch(&buildings, &[]).unwrap();
    assert_eq!(batch.dropped, [0; 0]);
    assert_eq!(batch.repeated.len(), 1);
    assert_eq!(batch.repeated[0].features.len(), 80);
    assert_eq!(batch.triangles, 2 * (2 + 40 * 4));
    let all = drawn(&batch);
    assert_eq!(all.len(), batch.triangles);
    // Each feature keeps its area vector (sum over both buildings), and no corner strays.
    for feature in 0..=40 {
        let told: DVec3 = all
            .iter()
            .filter(|(f, _)| *f == feature)
            .map(|(_, corners)| area(*corners))
            .sum();
        let size = if feature == 0 {
            720.0
        } else {
            2.0 + 0.3335 * 0.7
        };
        let facing = DVec3::NEG_Y + DQuat::from_rotation_z(0.7) * DVec3::NEG_Y;
        assert!(
            (told - facing * size).length() < 0.02 * size,
            "{feature}: {told}"
        );
    }
    for (_, corners) in &all {
        for corner in corners {
            let nearest = buildings
                .iter()
                .flat_map(|b| {
                    let offset = DVec3::from(b.offset);
                    b.positions.iter().map(move |p| DVec3::from(*p) + offset)
                })
                .map(|p| p.distance(*corner))
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 4e-3, "{corner} is {nearest} m from where it was");
        }
    }
}

#[test]
fn what_is_no_polygon_is_counted_and_left_out() {
    let mut one = columns(1, 0.0);
    let (a, b) = (one.positions[4], one.positions[5]);
    one.positions[6] = a;
    one.positions[7] = b;
    let found = batch(&[building(&one, [0.0; 3])], &[]).unwrap();
    assert_eq!(found.dropped, [1]);
    assert_eq!(found.triangles, 4);
}

#[test]
fn nothing_is_nothing() {
    let none = Columns {
        positions: Vec::new(),
        rings: vec![0],
        polygons: vec![0],
        feature: Vec::new(),
        material: Vec::new(),
        piece: Vec::new(),
    };
    let found = batch(&[building(&none, [0.0; 3])], &[]).unwrap();
    assert_eq!((found.triangles, found.merged.len()), (0, 0));
}
