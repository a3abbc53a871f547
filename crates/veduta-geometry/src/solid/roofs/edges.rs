//! Which edges carry what: gables, slopes, and how far they reach out.

use super::Overhang;
use crate::skeleton::{roof_within, Eaves, FaceOrigin, SkeletonError};
use crate::solid::inset::{grown, Rings};
use crate::Budget;

/// The edges of a face that stay upright to the top.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Gables {
    /// No edge.
    None,
    /// Where a hip roof has a triangle; of two side by side, the first.
    #[default]
    Triangles,
    /// These, counted through all rings.
    Edges(Vec<u32>),
}

impl Gables {
    /// Whether each edge carries a gable.
    pub fn of(&self, even: &Eaves, budget: &dyn Budget) -> Result<Vec<bool>, SkeletonError> {
        let mut upright = vec![false; even.len()];
        match self {
            Self::None => {}
            Self::Triangles => {
                let hip = roof_within(even, None, budget)?;
                for face in &hip.faces {
                    let FaceOrigin::Edge(edge) = face.origin else {
                        continue;
                    };
                    let edge = edge as usize;
                    let beside = upright[even.previous(edge)] || upright[even.next(edge)];
                    if face.rings[0].len() == 3 && !beside {
                        upright[edge] = true;
                    }
                }
            }
            Self::Edges(edges) => {
                for &edge in edges {
                    let edge = edge as usize;
                    if edge >= even.len() {
                        let edges = even.len();
                        return Err(SkeletonError::NoSuchEdge { edge, edges });
                    }
                    upright[edge] = true;
                }
            }
        }
        Ok(upright)
    }
}

/// The polygon grown by an overhang, and the edge that each of its edges comes from.
pub fn reaching(
    rings: &Rings,
    upright: &[bool],
    overhang: Overhang,
    budget: &dyn Budget,
) -> Result<(Rings, Vec<u32>), SkeletonError> {
    if overhang == Overhang::default() {
        return Ok((rings.clone(), (0..upright.len() as u32).collect()));
    }
    let distance = |&is: &bool| if is { overhang.gables } else { overhang.eaves };
    let distances: Vec<f64> = upright.iter().map(distance).collect();
    let larger = grown(rings, &distances, budget, |_, _| {})?;
    Ok((larger.rings, larger.along))
}
