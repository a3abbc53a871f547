//! The nearest spot of a mesh to each of many points, and the side of the mesh on which they lie.
//!
//! Boxes in a binary tree, halved at the middle of the triangles along their longest axis. The
//! nearest spot of a triangle is found by the regions of its plane (Ericson 2005, section 5.1.5).

use rayon::prelude::*;

use crate::tree::Tree;
use crate::triangle::{Triangle, Vector};
use crate::SurfaceError;

/// Of squared distances: nearer to each other than this share they are one. Of the triangles that
/// share a nearest corner or edge, the one whose plane lies farthest off says the side.
const SAME: f64 = 1e-6;

/// How far points lie from a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Above 0 on the side from which the nearest triangle runs counter-clockwise.
    pub distances: Vec<f64>,
    pub triangles: Vec<u32>,
}

/// The signed distance of each point from the mesh, and the triangle that is nearest. Triangles
/// without area count for nothing.
pub fn nearest_on_mesh(
    points: &[Vector],
    positions: &[Vector],
    triangles: &[[u32; 3]],
) -> Result<Nearest, SurfaceError> {
    let finite = |one: &Vector| one.iter().all(|value| value.is_finite());
    if !points.iter().all(finite) || !positions.iter().all(finite) {
        return Err(SurfaceError::NotFinite);
    }
    let count = positions.len();
    let mut usable = Vec::with_capacity(triangles.len());
    for (number, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&index| index as usize >= count) {
            return Err(SurfaceError::Corner { index, count });
        }
        let corners = corners.map(|index| positions[index as usize]);
        usable.extend(Triangle::new(corners, number as u32));
    }
    let tree = Tree::new(usable).ok_or(SurfaceError::NoTriangle)?;
    let (distances, triangles) = points
        .par_iter()
        .map(|&point| nearest(&tree, point))
        .unzip();
    Ok(Nearest {
        distances,
        triangles,
    })
}

struct Best {
    squared: f64,
    height: f64,
    number: u32,
}

fn nearest(tree: &Tree, point: Vector) -> (f64, u32) {
    let mut best = Best {
        squared: f64::INFINITY,
        height: 0.0,
        number: 0,
    };
    let mut waiting = vec![(0.0, Tree::ROOT)];
    while let Some((bound, node)) = waiting.pop() {
        if bound > best.squared * (1.0 + SAME) {
            continue;
        }
        match tree.children(node) {
            Some(pair) => {
                let [near, far] = pair.map(|child| (tree.squared(child, point), child));
                // The nearer box is looked at first: it comes last.
                let order = if near.0 < far.0 {
                    [far, near]
                } else {
                    [near, far]
                };
                waiting.extend(order);
            }
            None => {
                for triangle in tree.leaf(node) {
                    best.take(triangle, point);
                }
            }
        }
    }
    let distance = best.squared.sqrt();
    (
        if best.height < 0.0 {
            -distance
        } else {
            distance
        },
        best.number,
    )
}

impl Best {
    fn take(&mut self, triangle: &Triangle, point: Vector) {
        let squared = triangle.squared(point);
        if squared > self.squared * (1.0 + SAME) {
            return;
        }
        let height = triangle.height(point);
        let nearer = squared < self.squared * (1.0 - SAME);
        if nearer || height.abs() > self.height.abs() {
            self.height = height;
            self.number = triangle.number;
        }
        self.squared = self.squared.min(squared);
    }
}
