//! Closed volumes of what a building is from afar: the block over its ground, and the block with
//! its roof where ground and surfaces close.
//!
//! Biljecki, Ledoux and Stoter, An improved LOD specification for 3D building models (2016): LoD 1.2
//! is the footprint extruded to one height, LoD 2.2 has the roof's shape.

use std::collections::HashMap;

use crate::city::Vertex;

/// Rings of a face, and the class of its surface.
pub type VolumeFace = (Vec<Vec<u32>>, &'static str);
/// An outline and its holes.
type Outline = Vec<Vec<u32>>;

/// The ground that surfaces leave open at their foot, seen from below, the outline first; None where
/// it is not one area. Rings are of numbers of vertices (mm).
pub fn ground(faces: &[&Outline], vertices: &[Vertex]) -> Option<Outline> {
    let mut balance: HashMap<(u32, u32), i32> = HashMap::new();
    for ring in faces.iter().flat_map(|rings| rings.iter()) {
        for (from, to) in edges(ring) {
            *balance.entry((from, to)).or_default() += 1;
            *balance.entry((to, from)).or_default() -= 1;
        }
    }
    let open = balance.iter().filter(|(_, &count)| count > 0);
    let open: Vec<(u32, u32)> = open.map(|(&edge, _)| edge).collect();
    let z = |vertex: u32| vertices[vertex as usize][2];
    let foot = open.iter().map(|&(from, to)| z(from).min(z(to))).min()?;
    let mut before: HashMap<u32, u32> = HashMap::new();
    for &(from, to) in open
        .iter()
        .filter(|edge| z(edge.0) == foot && z(edge.1) == foot)
    {
        if before.insert(to, from).is_some() {
            return None;
        }
    }
    let mut rings = Vec::new();
    while let Some(&first) = before.keys().min() {
        let mut ring = Vec::new();
        let mut at = first;
        while let Some(next) = before.remove(&at) {
            ring.push(at);
            at = next;
        }
        if at != first {
            return None;
        }
        rings.push(ring);
    }
    // Seen from below an outline runs clockwise on the map: its area there is negative.
    rings.sort_by_key(|ring| area(ring, vertices));
    let outlines = rings.iter().filter(|ring| area(ring, vertices) < 0).count();
    (outlines == 1).then_some(rings)
}

/// The block over a ground, up to its highest vertex; new vertices come to the end.
pub fn block(
    ground: &Outline,
    top: i64,
    mut vertex: impl FnMut(u32, i64) -> u32,
) -> Vec<VolumeFace> {
    let mut faces = vec![(ground.clone(), "GroundSurface")];
    let mut roof = Vec::new();
    for ring in ground {
        let raised: Vec<u32> = ring.iter().map(|&at| vertex(at, top)).collect();
        for k in 0..ring.len() {
            let next = (k + 1) % ring.len();
            let wall = vec![ring[next], ring[k], raised[k], raised[next]];
            faces.push((vec![wall], "WallSurface"));
        }
        roof.push(raised.into_iter().rev().collect());
    }
    faces.push((roof, "RoofSurface"));
    faces
}

fn edges(ring: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]))
}

/// Twice the signed area on the map (mm2).
fn area(ring: &[u32], vertices: &[Vertex]) -> i128 {
    let cross = edges(ring).map(|(from, to)| {
        let [a, b] = [from, to].map(|at| vertices[at as usize].map(i128::from));
        a[0] * b[1] - a[1] * b[0]
    });
    cross.sum()
}
