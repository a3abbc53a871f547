//! Texture coordinates as whole steps: from the upper left, in the first repeats of the texture.

use std::collections::BTreeMap;

use crate::building::Building;
use crate::repeats::Piece;
use crate::standing::Standing;

/// The finest step, as a share of the texture.
const FINEST: f64 = 1.0 / 4096.0;
/// Coordinates this far below a whole number are taken for it.
const WHOLE: f64 = 1e-4;

/// The step of each material that has a texture: the finest power of two with which all its pieces
/// fit into 16 bits.
pub(crate) fn steps(
    buildings: &[Building<'_>],
    pieces: &[Piece],
    standing: &[Standing],
) -> BTreeMap<u32, f64> {
    let mut found = BTreeMap::new();
    let mut reach = |material: u32, (low, high): Extent| {
        let reach = (high[0] - low[0]).max(high[1] - low[1]);
        let needed = (reach / f64::from(u16::MAX)).max(FINEST);
        let step = found.entry(material).or_insert(FINEST);
        while *step < needed {
            *step *= 2.0;
        }
    };
    for piece in pieces {
        if let Some((material, uv)) = mapped(&buildings[piece.building], &piece.polygons) {
            reach(material, extent(uv));
        }
    }
    for one in standing {
        for (material, uv) in one.mapped() {
            reach(material, extent(uv.into_iter()));
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
        let (material, uv) = mapped(building, polygons)?;
        let step = *steps.get(&material)?;
        Some(Self::over(uv, step))
    }

    /// Of what has these texture coordinates.
    pub fn over(uv: impl Iterator<Item = [f32; 2]>, step: f64) -> Self {
        let (low, _) = extent(uv);
        Self { low, step }
    }

    /// The steps of texture coordinates.
    pub fn at(&self, uv: [f32; 2]) -> [u16; 2] {
        let own = upper_left(uv);
        std::array::from_fn(|k| {
            let steps = ((own[k] - self.low[k]) / self.step).round();
            steps.clamp(0.0, f64::from(u16::MAX)) as u16
        })
    }
}

/// The material of a piece with a texture, and the texture coordinates of its vertices.
fn mapped<'a>(
    building: &'a Building<'_>,
    polygons: &'a [usize],
) -> Option<(u32, impl Iterator<Item = [f32; 2]> + 'a)> {
    let material = building.material[*polygons.first()?];
    if building.uv.is_empty() || building.mapped.get(material as usize) != Some(&true) {
        return None;
    }
    let vertices = polygons.iter().flat_map(|&p| building.vertices(p));
    Some((material, vertices.map(|vertex| building.uv[vertex])))
}

/// Whole repeats below texture coordinates, and the highest of them.
type Extent = ([f64; 2], [f64; 2]);

fn extent(uv: impl Iterator<Item = [f32; 2]>) -> Extent {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for own in uv.map(upper_left) {
        for k in 0..2 {
            low[k] = low[k].min(own[k]);
            high[k] = high[k].max(own[k]);
        }
    }
    (low.map(|c| (c + WHOLE).floor()), high)
}

/// Rule files count from the lower left, glTF from the upper. What is no number lies in the corner.
fn upper_left([u, v]: [f32; 2]) -> [f64; 2] {
    [f64::from(u), 1.0 - f64::from(v)].map(|c| if c.is_finite() { c } else { 0.0 })
}
