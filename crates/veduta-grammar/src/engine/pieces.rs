//! Leaves that rules may have made several times together: the frames of a window.

use std::collections::HashMap;

use super::pack::Packed;
use super::surfaces::Surfaces;
use super::tree::Tree;

/// The piece of each feature of the packed leaves: leaves of one surface and one look below one shape,
/// the highest that holds no more than `most` of their polygons.
pub fn pieces(tree: &Tree, packed: &Packed, surfaces: &Surfaces, most: u32) -> Vec<u32> {
    let mut polygons = vec![0u32; packed.feature_node.len()];
    for &feature in &packed.polygon_feature {
        polygons[feature as usize] += 1;
    }
    let mut alike: Vec<Vec<usize>> = Vec::new();
    let mut known: HashMap<(u32, u32), usize> = HashMap::new();
    for feature in 0..polygons.len() {
        let key = (surfaces.of_feature[feature], packed.feature_look[feature]);
        let group = *known.entry(key).or_insert_with(|| {
            alike.push(Vec::new());
            alike.len() - 1
        });
        alike[group].push(feature);
    }
    let mut found = vec![0u32; polygons.len()];
    let mut below = vec![0u32; tree.nodes.len()];
    let mut next = 0;
    for group in &alike {
        for &feature in group {
            climb(tree, packed.feature_node[feature], |node| {
                below[node] += polygons[feature];
            });
        }
        let mut of_top: HashMap<u32, u32> = HashMap::new();
        for &feature in group {
            let leaf = packed.feature_node[feature];
            let piece = *of_top.entry(top(tree, leaf, &below, most)).or_insert(next);
            next += u32::from(piece == next);
            found[feature] = piece;
        }
        for &feature in group {
            climb(tree, packed.feature_node[feature], |node| below[node] = 0);
        }
    }
    found
}

fn climb(tree: &Tree, leaf: u32, mut visit: impl FnMut(usize)) {
    let mut at = Some(leaf);
    while let Some(node) = at {
        visit(node as usize);
        at = tree.nodes[node as usize].parent;
    }
}

fn top(tree: &Tree, leaf: u32, below: &[u32], most: u32) -> u32 {
    let mut at = leaf;
    while let Some(parent) = tree.nodes[at as usize].parent {
        if below[parent as usize] > most {
            break;
        }
        at = parent;
    }
    at
}
