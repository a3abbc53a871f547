//! Cells of a wall as one face, and no crack where they meet what is cut otherwise.

use std::collections::HashMap;

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use veduta_tiles::{batch, batch_whole, Batch, Building};

/// Polygons of one ring each, with a surface and a material.
#[derive(Default)]
struct Columns {
    positions: Vec<[f64; 3]>,
    uv: Vec<[f32; 2]>,
    rings: Vec<i64>,
    polygons: Vec<i64>,
    feature: Vec<u32>,
    material: Vec<u32>,
    piece: Vec<u32>,
}

impl Columns {
    /// A rectangle of the plane y = 0, turned; its texture lies in metres.
    fn cell(&mut self, turn: DQuat, x: [f64; 2], z: [f64; 2], (feature, material): (u32, u32)) {
        if self.rings.is_empty() {
            (self.rings, self.polygons) = (vec![0], vec![0]);
        }
        for (x, z) in [(x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1])] {
            self.positions
                .push((turn * DVec3::new(x, 0.0, z)).to_array());
            self.uv.push([x as f32, z as f32]);
        }
        self.rings.push(self.positions.len() as i64);
        self.polygons.push(self.rings.len() as i64 - 1);
        self.feature.push(feature);
        self.material.push(material);
        self.piece.push(self.piece.len() as u32);
    }

    fn building<'a>(&'a self, mapped: &'a [bool], plain: &'a [u32]) -> Building<'a> {
        Building {
            positions: &self.positions,
            ring_offsets: &self.rings,
            polygon_offsets: &self.polygons,
            feature: &self.feature,
            material: &self.material,
            piece: &self.piece,
            part: &self.piece,
            uv: &self.uv,
            mapped,
            plain,
            offset: [0.0; 3],
        }
    }
}

/// A wall of floors, each cut into bays at places of its own, with a window in each bay.
fn wall(turn: DQuat, cuts: &[Vec<f64>]) -> Columns {
    let mut made = Columns::default();
    for (floor, cuts) in cuts.iter().enumerate() {
        let z = floor as f64 * 3.1;
        let ends = [&[0.0][..], cuts, &[12.0]].concat();
        for bay in ends.windows(2) {
            let (left, right) = (bay[0], bay[1]);
            let (low, high) = (left + 0.3 * (right - left), right - 0.3 * (right - left));
            made.cell(turn, [left, right], [z, z + 0.8], (0, 0));
            made.cell(turn, [left, low], [z + 0.8, z + 2.4], (0, 0));
            made.cell(turn, [low, high], [z + 0.8, z + 2.4], (1, 1));
            made.cell(turn, [high, right], [z + 0.8, z + 2.4], (0, 0));
            made.cell(turn, [left, right], [z + 2.4, z + 3.1], (0, 0));
        }
    }
    made
}

/// Places and the triangles over them, of all materials.
fn triangles(batch: &Batch) -> Vec<[[u16; 3]; 3]> {
    assert!(batch.repeated.is_empty());
    let mut found = Vec::new();
    for mesh in &batch.merged {
        let place = |vertex: u32| {
            let at = 4 * vertex as usize;
            [0, 1, 2].map(|k| mesh.positions[at + k])
        };
        let each = mesh.indices.chunks_exact(3);
        found.extend(each.map(|t| [place(t[0]), place(t[1]), place(t[2])]));
    }
    found
}

/// Edges that no other edge runs against.
fn open_edges(triangles: &[[[u16; 3]; 3]]) -> Vec<([u16; 3], [u16; 3])> {
    let mut balance: HashMap<([u16; 3], [u16; 3]), i32> = HashMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *balance.entry((*from, *to)).or_default() += 1;
            *balance.entry((*to, *from)).or_default() -= 1;
        }
    }
    let left = balance.into_iter().filter(|(_, count)| *count > 0);
    left.map(|(edge, _)| edge).collect()
}

proptest! {
    /// The rounded triangles of a wall that is cut anyhow are open along its outline alone.
    #[test]
    fn no_crack_is_left(
        heading in 0.0..3.0f64,
        cuts in prop::collection::vec(prop::collection::vec(0.05..0.95f64, 0..5), 1..5),
    ) {
        let cuts: Vec<Vec<f64>> = cuts
            .into_iter()
            .map(|mut cuts| {
                cuts.sort_by(f64::total_cmp);
                cuts.dedup_by(|a, b| *a - *b < 0.03);
                cuts.into_iter().map(|share| 12.0 * share).collect()
            })
            .collect();
        let turn = DQuat::from_rotation_z(heading);
        let columns = wall(turn, &cuts);
        let found = batch_whole(&[columns.building(&[], &[])], &[]).unwrap();
        let top = 3.1 * cuts.len() as f64;
        for (from, to) in open_edges(&triangles(&found)) {
            // Back from the rounded frame, y-up, to the wall's own.
            let [from, to] = [from, to].map(|place| {
                let step: [f64; 3] =
                    std::array::from_fn(|k| found.grid_low[k] + f64::from(place[k]) * found.grid_step[k]);
                turn.inverse() * DVec3::new(step[0], -step[2], step[1])
            });
            let is_side = |x: f64| (from.x - x).abs() < 2e-3 && (to.x - x).abs() < 2e-3;
            let is_end = |z: f64| (from.z - z).abs() < 2e-3 && (to.z - z).abs() < 2e-3;
            prop_assert!(
                is_side(0.0) || is_side(12.0) || is_end(0.0) || is_end(top),
                "{from} to {to}"
            );
        }
    }
}

/// The same wall by `batch` has cracks: what the test above can find is there to be found.
#[test]
fn cells_alone_have_cracks() {
    let columns = wall(DQuat::from_rotation_z(0.3), &[vec![4.0, 7.0], vec![5.1]]);
    let found = batch(&[columns.building(&[], &[])], &[]).unwrap();
    let whole = batch_whole(&[columns.building(&[], &[])], &[]).unwrap();
    // The outline has four sides; each side is some edges long.
    assert!(open_edges(&triangles(&found)).len() > 2 * open_edges(&triangles(&whole)).len());
    assert!(whole.triangles < found.triangles);
}

/// The texture goes on over the joined cells, and a face too narrow for it takes the plain material.
#[test]
fn a_face_keeps_its_texture_unless_it_is_narrow() {
    let mut columns = Columns::default();
    let turn = DQuat::IDENTITY;
    columns.cell(turn, [0.0, 2.0], [0.0, 0.25], (0, 0));
    columns.cell(turn, [0.0, 1.3], [0.25, 3.0], (0, 0));
    columns.cell(turn, [1.3, 2.0], [0.25, 3.0], (0, 0));
    columns.cell(turn, [5.0, 5.2], [0.0, 2.0], (0, 0));
    let found = batch_whole(&[columns.building(&[true, false], &[1])], &[]).unwrap();
    let [wall, strip] = &found.merged[..] else {
        panic!("{} meshes", found.merged.len())
    };
    assert_eq!((wall.material, wall.indices.len()), (0, 6));
    assert_eq!(
        (strip.material, strip.indices.len(), strip.uv.len()),
        (1, 6, 0)
    );
    let step = found.uv_steps[&0];
    let mut seen: Vec<(i64, i64)> = wall
        .uv
        .chunks_exact(2)
        .map(|uv| {
            let [u, v] = [uv[0], uv[1]].map(|steps| (f64::from(steps) * step).round() as i64);
            (u, v)
        })
        .collect();
    seen.sort_unstable();
    // 2 m by 3 m, from the upper left.
    assert_eq!(seen, [(0, 0), (0, 3), (2, 0), (2, 3)]);
}
