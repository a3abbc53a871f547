//! Texture coordinates as whole steps: from the upper left, in the first repeats of the texture.

use std::collections::BTreeMap;

use crate::building::Building;
use crate::repeats::Piece;

/// The finest step, as a share of the texture.
const FINEST: f64 = 1.0 / 4096.0;
/// Coordinates this far below a whole number are taken for it.
const WHOLE: f64 = 1e-4;

/// The step of each material that has a texture: the finest power of two with which all its pieces
/// fit into 16 bits.
pub(crate) fn steps(buildings: &[Building<'_>], pieces: &[Piece]) -> BTreeMap<u32, f64> {
    let mut found = BTreeMap::new();
    for piece in pieces {
        let building = &buildings[piece.building];
        let Some((material, low, high)) = extent(building, &piece.polygons) else {
            continue;
        };
        let reach = (high[0] - low[0]).max(high[1] - low[1]);
        let needed = (reach / f64::from(u16::MAX)).max(FINEST);
        let step = found.entry(material).or_insert(FINEST);
        while *step < needed {
            *step *= 2.0;
        }
    }
    found
}

/// How the vertices of a piece lie on its texture.
pub(crate) struct Mapping {
    low: [f64; 2],
    step: f64,
}

impl Mapping {
    /// None where the piece has no texture.
    pub fn of(
        building: &Building<'_>,
        polygons: &[usize],
        steps: &BTreeMap<u32, f64>,
    ) -> Option<Self> {
        let (material, low, _) = extent(building, polygons)?;
        let step = *steps.get(&material)?;
        Some(Self { low, step })
    }

    /// The steps of a vertex.
    pub fn at(&self, building: &Building<'_>, vertex: usize) -> [u16; 2] {
        let own = upper_left(building.uv[vertex]);
        std::array::from_fn(|k| {
            let steps = ((own[k] - self.low[k]) / self.step).round();
            steps.clamp(0.0, f64::from(u16::MAX)) as u16
        })
    }
}

/// The material of a piece with a texture, whole repeats below its coordinates, and the highest.
fn extent(building: &Building<'_>, polygons: &[usize]) -> Option<(u32, [f64; 2], [f64; 2])> {
    let material = building.material[*polygons.first()?];
    if building.uv.is_empty() || building.mapped.get(material as usize) != Some(&true) {
        return None;
    }
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for vertex in polygons.iter().flat_map(|&p| building.vertices(p)) {
        let own = upper_left(building.uv[vertex]);
        for k in 0..2 {
            low[k] = low[k].min(own[k]);
            high[k] = high[k].max(own[k]);
        }
    }
    Some((material, low.map(|c| (c + WHOLE).floor()), high))
}

/// Rule files count from the lower left, glTF from the upper. What is no number lies in the corner.
fn upper_left([u, v]: [f32; 2]) -> [f64; 2] {
    [f64::from(u), 1.0 - f64::from(v)].map(|c| if c.is_finite() { c } else { 0.0 })
}
