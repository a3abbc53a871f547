//! Derived lots put together for a tile: its meshes, its surfaces and its materials.

use std::collections::HashMap;

use pyo3::prelude::*;
use veduta_tiles::{batch, Batch, Building};

use crate::derived_lot::Derived;
use crate::standing::Stands;

/// A surface without a size that 16 bits hold in millimetres.
const NO_SIZE: u16 = u16::MAX;

/// The surfaces of a tile as columns.
#[derive(Default)]
pub struct Surfaces {
    pub class: Vec<u8>,
    pub building: Vec<u16>,
    pub rule: Vec<u16>,
    pub width_mm: Vec<u16>,
    pub height_mm: Vec<u16>,
    pub rules: Vec<String>,
}

/// The columns of the buildings that go into a tile.
#[derive(Default)]
struct Columns {
    feature: Vec<u32>,
    material: Vec<u32>,
    piece: Vec<u32>,
    part: Vec<u32>,
}

/// The buffers of one tile.
#[pyclass(frozen, module = "veduta._core")]
pub struct TileBuffers {
    pub batch: Batch,
    pub surfaces: Surfaces,
    /// Class and colour.
    pub materials: Vec<(u8, [f32; 3])>,
    /// Surfaces of each class, by lot.
    pub counts: Vec<Vec<u32>>,
}

pub fn tile(
    lots: &[&Derived],
    places: &[[f64; 3]],
    classes: &[String],
) -> Result<TileBuffers, String> {
    let mut surfaces = Surfaces::default();
    let mut materials = Materials::default();
    let mut rules = HashMap::new();
    let code_of: HashMap<&str, u8> = classes.iter().map(String::as_str).zip(0..).collect();
    let other = (classes.len() - 1) as u8;
    let code = |name: &str| code_of.get(name).copied().unwrap_or(other);
    let mut counts = Vec::new();
    let mut all = Vec::new();
    let mut stands = Stands::default();
    for (number, lot) in lots.iter().enumerate() {
        let first = surfaces.class.len() as u32;
        let mut count = vec![0; classes.len()];
        for (row, name) in lot.names.iter().enumerate() {
            let class = code(&lot.surfaces.class[row]);
            count[usize::from(class)] += 1;
            surfaces.class.push(class);
            surfaces.building.push(number as u16);
            let next = rules.len();
            let rule = *rules.entry(name.as_str()).or_insert(next);
            surfaces.rule.push(rule.min(usize::from(u16::MAX)) as u16);
            let [width, height] = lot.surfaces.size[row];
            surfaces.width_mm.push(millimetres(width));
            surfaces.height_mm.push(millimetres(height));
        }
        counts.push(count);
        let looks: Vec<u32> = lot
            .packed
            .looks
            .iter()
            .map(|look| materials.number(code(&look.class), look.colour))
            .collect();
        stands.add(lot, places[number], first, |look, colour| {
            materials.number(code(&look.class), colour)
        });
        let leaves = &lot.packed.polygon_feature;
        let of = |column: &[u32]| leaves.iter().map(|&leaf| column[leaf as usize]).collect();
        all.push(Columns {
            feature: leaves
                .iter()
                .map(|&leaf| first + lot.surfaces.of_feature[leaf as usize])
                .collect(),
            material: leaves
                .iter()
                .map(|&leaf| looks[lot.packed.feature_look[leaf as usize] as usize])
                .collect(),
            piece: of(&lot.pieces),
            part: leaves.iter().map(|&leaf| leaf as u32).collect(),
        });
    }
    let mut named: Vec<(&str, usize)> = rules.into_iter().collect();
    named.sort_by_key(|(_, number)| *number);
    surfaces.rules = named
        .into_iter()
        .map(|(name, _)| name.to_string())
        .collect();
    let buildings: Vec<Building<'_>> = lots
        .iter()
        .zip(&all)
        .zip(places)
        .map(|((lot, columns), &offset)| Building {
            positions: &lot.packed.positions,
            ring_offsets: &lot.packed.ring_offsets,
            polygon_offsets: &lot.packed.polygon_offsets,
            feature: &columns.feature,
            material: &columns.material,
            piece: &columns.piece,
            part: &columns.part,
            offset,
        })
        .collect();
    let batch = batch(&buildings, &stands.finish()?).map_err(|error| error.to_string())?;
    Ok(TileBuffers {
        batch,
        surfaces,
        materials: materials.rows,
        counts,
    })
}

fn millimetres(size_m: f64) -> u16 {
    let size = (size_m * 1000.0).round();
    if size.is_finite() && (0.0..f64::from(NO_SIZE)).contains(&size) {
        size as u16
    } else {
        NO_SIZE
    }
}

/// Looks that are told apart: of another class, or of another colour of 8 bits.
#[derive(Default)]
struct Materials {
    rows: Vec<(u8, [f32; 3])>,
    known: HashMap<(u8, [u8; 3]), u32>,
}

impl Materials {
    fn number(&mut self, class: u8, colour: [f32; 3]) -> u32 {
        let bytes = colour.map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8);
        let next = self.rows.len() as u32;
        let number = *self.known.entry((class, bytes)).or_insert(next);
        if number == next {
            self.rows.push((class, bytes.map(|c| f32::from(c) / 255.0)));
        }
        number
    }
}
