//! The regions that are the surface of a union, a difference or an intersection, as a mesh.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::super::cleanup::without_idle_points;
use super::super::loops::{nested, traced};
use super::super::mesh::Mesh;
use super::{Boolean, Combined, Overlay, Region, Side};

/// The sine of an angle up to which edges are straight.
const STRAIGHT: f64 = 1e-9;

/// The faces of the result; `closed` says of each mesh whether it is.
pub fn of(overlay: &Overlay, operation: Boolean, closed: [bool; 2]) -> Combined {
    let mut mesh = Mesh::with_points(overlay.points.clone());
    let mut sources = Vec::new();
    for which in 0..2 {
        let mut by_face: HashMap<usize, Vec<&Region>> = HashMap::new();
        for region in &overlay.regions[which] {
            if stays(region.side, which, operation, closed) {
                by_face.entry(region.face).or_default().push(region);
            }
        }
        let mut faces: Vec<_> = by_face.into_iter().collect();
        faces.sort_unstable_by_key(|(face, _)| *face);
        let inward = which == 1 && operation == Boolean::Subtract;
        for (face, regions) in faces {
            let normal = overlay.normals[which][face];
            for mut rings in together(&overlay.points, &regions, normal) {
                if inward {
                    rings.iter_mut().for_each(|ring| ring.reverse());
                }
                mesh.push_face(&rings);
                sources.push((which == 1, face));
            }
        }
    }
    Combined {
        mesh: without_idle_points(&mesh, STRAIGHT).compact(),
        sources,
    }
}

/// Whether a region is on the surface of the result.
fn stays(side: Side, which: usize, operation: Boolean, closed: [bool; 2]) -> bool {
    let is_first = which == 0;
    match operation {
        Boolean::Union => match side {
            Side::Out => true,
            Side::In => !closed[1 - which] || !closed[which],
            Side::Same => is_first,
            // Closed meshes that touch open into each other there.
            Side::Opposite => is_first && closed != [true; 2],
        },
        // What is open has no inside that the other could be in.
        _ if !is_first && !closed[0] => false,
        Boolean::Subtract => match side {
            Side::Out => is_first,
            Side::In => !is_first,
            Side::Opposite => is_first && closed[1],
            Side::Same => is_first && closed[1] && !closed[0],
        },
        Boolean::Intersect => match side {
            Side::In => true,
            Side::Out => false,
            Side::Same => is_first,
            Side::Opposite => is_first && !closed[0] && !closed[1],
        },
    }
}

/// Regions of one face as few faces: edges between two of them go.
fn together(points: &[DVec3], regions: &[&Region], normal: DVec3) -> Vec<Vec<Vec<u32>>> {
    if let [region] = regions {
        return vec![region.rings.clone()];
    }
    let mut edges = Vec::new();
    for ring in regions.iter().flat_map(|region| &region.rings) {
        for (k, &from) in ring.iter().enumerate() {
            edges.push((from, ring[(k + 1) % ring.len()]));
        }
    }
    let all: HashSet<(u32, u32)> = edges.iter().copied().collect();
    edges.retain(|&(from, to)| !all.contains(&(to, from)));
    nested(points, traced(points, &edges, normal), normal)
}
