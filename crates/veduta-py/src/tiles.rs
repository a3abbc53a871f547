//! Derived lots put together for a tile: its meshes, its surfaces and its materials.

use std::collections::HashMap;

use pyo3::prelude::*;
use veduta_grammar::engine::Look;
use veduta_grammar::shape::Slot;
use veduta_tiles::{batch, batch_whole, Batch, Building};

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
    pub provenance: Vec<u8>,
    pub rules: Vec<String>,
}

/// Class, provenance, sRGB colour, opacity, and the number of the texture.
pub type MaterialRow = (u8, u8, [f32; 3], f32, Option<u32>);

/// The textures that rules may name: each with its mean sRGB colour, which stands for it where
/// `shown` is false.
#[derive(Default)]
pub struct Textures {
    pub named: Vec<(String, [f32; 3])>,
    pub shown: bool,
}

impl Textures {
    /// The colour and the texture of a look; a texture that nobody knows is not there.
    pub fn seen(&self, look: &Look) -> ([f32; 3], Option<u32>) {
        self.seen_as(look.colour, look.texture.as_deref())
    }

    /// The number of a texture; None where nobody knows it.
    pub fn number(&self, name: &str) -> Option<u32> {
        let place = self.named.iter().position(|(own, _)| own == name)?;
        Some(place as u32)
    }

    /// The same of the slot of an asset in a shape of this colour.
    pub fn seen_in(&self, slot: &Slot, shape: [f32; 3]) -> ([f32; 3], Option<u32>) {
        let texture = slot.texture.as_ref().map(|texture| texture.name.as_ref());
        match texture.filter(|name| self.number(name).is_some()) {
            Some(name) => self.seen_as(slot.colour_in(shape), Some(name)),
            None => (slot.plain_in(shape), None),
        }
    }

    /// The same of a colour and the name of a texture.
    pub fn seen_as(&self, colour: [f32; 3], texture: Option<&str>) -> ([f32; 3], Option<u32>) {
        let known = texture.and_then(|name| {
            let number = self.number(name)?;
            Some((number, self.named[number as usize].1))
        });
        match known {
            Some((number, _)) if self.shown => (colour, Some(number)),
            // A product of sRGB values is nearly that of light.
            Some((_, mean)) => ([0, 1, 2].map(|k| colour[k] * mean[k]), None),
            None => (colour, None),
        }
    }
}

/// What a tile tells of surfaces: names by their codes, the last of each for all others.
pub struct Codes {
    pub classes: Vec<String>,
    pub provenances: Vec<String>,
}

/// The number of each name; the last is that of all others.
struct Numbers<'a> {
    known: HashMap<&'a str, u8>,
    other: u8,
}

impl<'a> Numbers<'a> {
    fn of(names: &'a [String]) -> Self {
        Self {
            known: names.iter().map(String::as_str).zip(0..).collect(),
            other: (names.len() - 1) as u8,
        }
    }

    fn of_name(&self, name: &str) -> u8 {
        self.known.get(name).copied().unwrap_or(self.other)
    }
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
    pub materials: Vec<MaterialRow>,
    /// Surfaces of each class, by lot.
    pub counts: Vec<Vec<u32>>,
}

pub fn tile(
    lots: &[&Derived],
    places: &[[f64; 3]],
    codes: &Codes,
    textures: &Textures,
    whole: bool,
) -> Result<TileBuffers, String> {
    let mut making = Making {
        classes: Numbers::of(&codes.classes),
        class_count: codes.classes.len(),
        provenances: Numbers::of(&codes.provenances),
        textures,
        rules: HashMap::new(),
        surfaces: Surfaces::default(),
        materials: Materials::default(),
        counts: Vec::with_capacity(lots.len()),
        stands: Stands::default(),
    };
    let each = lots.iter().zip(places);
    let columns: Vec<Columns> = each.map(|(lot, &place)| making.add(lot, place)).collect();
    making.finish(lots, places, &columns, whole)
}

/// A tile while lots are added to it.
struct Making<'a> {
    classes: Numbers<'a>,
    class_count: usize,
    provenances: Numbers<'a>,
    textures: &'a Textures,
    rules: HashMap<&'a str, usize>,
    surfaces: Surfaces,
    materials: Materials,
    counts: Vec<Vec<u32>>,
    stands: Stands,
}

impl<'a> Making<'a> {
    /// Adds what a lot has that is not in its polygons, and gives the columns of these.
    fn add(&mut self, lot: &'a Derived, place: [f64; 3]) -> Columns {
        let first = self.surfaces.class.len() as u32;
        self.add_surfaces(lot);
        let of_feature = &lot.surfaces.of_feature;
        let provenance = &self.surfaces.provenance[first as usize..];
        let told: Vec<u8> = of_feature.iter().map(|&s| provenance[s as usize]).collect();
        let material = self.polygon_materials(lot, &told);
        self.add_assets(lot, place, first, &told);
        let leaves = &lot.packed.polygon_feature;
        let of = |column: &[u32]| leaves.iter().map(|&leaf| column[leaf as usize]).collect();
        let mut feature: Vec<u32> = of(of_feature);
        feature.iter_mut().for_each(|own| *own += first);
        Columns {
            feature,
            material,
            piece: of(&lot.pieces),
            part: leaves.iter().map(|&leaf| leaf as u32).collect(),
        }
    }

    fn add_surfaces(&mut self, lot: &'a Derived) {
        let (building, surfaces) = (self.counts.len() as u16, &mut self.surfaces);
        let mut count = vec![0; self.class_count];
        for (row, name) in lot.names.iter().enumerate() {
            let class = self.classes.of_name(&lot.surfaces.class[row]);
            count[usize::from(class)] += 1;
            surfaces.class.push(class);
            surfaces.building.push(building);
            let next = self.rules.len();
            let rule = *self.rules.entry(name.as_str()).or_insert(next);
            if rule == next {
                surfaces.rules.push(name.clone());
            }
            surfaces.rule.push(rule.min(usize::from(u16::MAX)) as u16);
            let [width, height] = lot.surfaces.size[row];
            surfaces.width_mm.push(millimetres(width));
            surfaces.height_mm.push(millimetres(height));
        }
        self.counts.push(count);
        let told = lot.surfaces.provenance.iter();
        let told = told.map(|name| self.provenances.of_name(name));
        surfaces.provenance.extend(told);
    }

    /// The number of each polygon's material; `told` is the provenance of each leaf.
    fn polygon_materials(&mut self, lot: &Derived, told: &[u8]) -> Vec<u32> {
        let mut numbers = HashMap::new();
        let mut material = |&leaf: &i32| {
            let leaf = leaf as usize;
            let (look, told) = (lot.packed.feature_look[leaf], told[leaf]);
            *numbers.entry((look, told)).or_insert_with(|| {
                let look = &lot.packed.looks[look as usize];
                let (colour, texture) = self.textures.seen(look);
                let kind = (self.classes.of_name(&look.class), told);
                self.materials.number(kind, colour, look.opacity, texture)
            })
        };
        let leaves = lot.packed.polygon_feature.iter();
        leaves.map(&mut material).collect()
    }

    /// Adds the assets that stand in a lot whose surfaces count from `first`.
    fn add_assets(&mut self, lot: &Derived, place: [f64; 3], first: u32, told: &[u8]) {
        self.stands.add(lot, place, first, |leaf, look, slot| {
            let kind = (self.classes.of_name(&look.class), told[leaf]);
            let (colour, texture) = self.textures.seen_in(slot, look.colour);
            let number = self.materials.number(kind, colour, look.opacity, texture);
            (number, texture.is_some())
        });
    }

    /// The buffers of all lots; `whole` where the cells of a surface are one face, without cracks.
    fn finish(
        mut self,
        lots: &[&Derived],
        places: &[[f64; 3]],
        columns: &[Columns],
        whole: bool,
    ) -> Result<TileBuffers, String> {
        let each = self.materials.rows.iter();
        let mapped: Vec<bool> = each.map(|(.., texture)| texture.is_some()).collect();
        let plain = if whole {
            self.materials.plain(self.textures)
        } else {
            Vec::new()
        };
        let each = lots.iter().zip(columns).zip(places);
        let buildings: Vec<Building<'_>> = each
            .map(|((lot, columns), &offset)| Building {
                positions: &lot.packed.positions,
                ring_offsets: &lot.packed.ring_offsets,
                polygon_offsets: &lot.packed.polygon_offsets,
                feature: &columns.feature,
                material: &columns.material,
                piece: &columns.piece,
                part: &columns.part,
                uv: &lot.packed.uv,
                mapped: &mapped,
                plain: &plain,
                offset,
            })
            .collect();
        let stands = self.stands.finish()?;
        let put_together = if whole { batch_whole } else { batch };
        let batch = put_together(&buildings, &stands).map_err(|error| error.to_string())?;
        Ok(TileBuffers {
            batch,
            surfaces: self.surfaces,
            materials: self.materials.rows,
            counts: self.counts,
        })
    }
}

fn millimetres(size_m: f64) -> u16 {
    let size = (size_m * 1000.0).round();
    if size.is_finite() && (0.0..f64::from(NO_SIZE)).contains(&size) {
        size as u16
    } else {
        NO_SIZE
    }
}

/// Class and provenance, colour with opacity, texture.
type MaterialKey = ((u8, u8), [u8; 4], Option<u32>);

/// Looks that are told apart: of another class, provenance or texture, or of another colour of 8 bits.
#[derive(Default)]
struct Materials {
    rows: Vec<MaterialRow>,
    known: HashMap<MaterialKey, u32>,
}

impl Materials {
    /// For each material one without a texture, of the same colour in the mean.
    fn plain(&mut self, textures: &Textures) -> Vec<u32> {
        let own = self.rows.clone();
        let each = own.into_iter().zip(0..);
        each.map(|((class, told, colour, opacity, texture), number)| {
            let named = texture.and_then(|texture| textures.named.get(texture as usize));
            named.map_or(number, |(_, mean)| {
                let seen = [0, 1, 2].map(|k| colour[k] * mean[k]);
                self.number((class, told), seen, opacity, None)
            })
        })
        .collect()
    }

    /// `kind` is class and provenance.
    fn number(
        &mut self,
        kind: (u8, u8),
        colour: [f32; 3],
        opacity: f32,
        texture: Option<u32>,
    ) -> u32 {
        let [r, g, b] = colour;
        let bytes = [r, g, b, opacity].map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8);
        let next = self.rows.len() as u32;
        let number = *self.known.entry((kind, bytes, texture)).or_insert(next);
        if number == next {
            let [r, g, b, opacity] = bytes.map(|c| f32::from(c) / 255.0);
            self.rows
                .push((kind.0, kind.1, [r, g, b], opacity, texture));
        }
        number
    }
}
