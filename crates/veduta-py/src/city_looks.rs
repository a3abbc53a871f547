//! What faces of CityJSON look like: materials, textures and where corners lie on these.
//!
//! <https://www.cityjson.org/specs/2.0.1/> section "Appearance Object". CityJSON knows no tint of a
//! texture, so that a picture in another colour is another texture.

use std::collections::HashMap;
use std::fmt::Write as _;

use crate::derived_lot::Derived;
use crate::flat::Flat;
use crate::tiles::Textures;

/// The name of the only theme.
pub(crate) const THEME: &str = "rules";
/// Tints are told apart in steps of this (of 255): what differs less is one picture.
const TINT_STEP: f32 = 8.5;
/// Texture coordinates are told apart by 1e-4 of the picture.
const UV_STEPS: f64 = 1e4;

/// Colour (sRGB, of 255) of a face seen from afar, with its opacity.
pub(crate) type Material = [u8; 4];
/// The number of a picture and its tint (sRGB, of 255).
pub(crate) type Tinted = (u32, [u8; 3]);

/// The look of a face; corners are texture coordinates of each ring.
pub(crate) struct FaceLook {
    pub material: Material,
    pub texture: Option<(Tinted, Vec<Vec<[f32; 2]>>)>,
}

/// The picture of a polygon with its tint; those of assets are told by their mean colours.
pub(crate) fn texture_of(
    lot: &Derived,
    flat: &Flat<'_>,
    polygon: usize,
    textures: &Textures,
) -> Option<Tinted> {
    let packed = &lot.packed;
    if polygon >= packed.polygon_feature.len() {
        return None;
    }
    let leaf = flat.feature[polygon] as usize;
    let look = &packed.looks[packed.feature_look[leaf] as usize];
    let number = textures.number(look.texture.as_deref()?)?;
    Some((number, tint(look.colour)))
}

/// The colour of a polygon, with the mean colour of its texture, and its opacity (of 255).
pub(crate) fn colour(
    lot: &Derived,
    flat: &Flat<'_>,
    polygon: usize,
    textures: &Textures,
) -> ([u8; 3], u8) {
    let packed = &lot.packed;
    let leaf = flat.feature[polygon] as usize;
    let look = &packed.looks[packed.feature_look[leaf] as usize];
    let own = packed.polygon_feature.len();
    let of_asset = polygon.checked_sub(own).map(|row| flat.slots[row]);
    let seen = match of_asset {
        Some((asset, slot)) => {
            let slot = &packed.assets[asset as usize].slots()[slot as usize];
            textures.seen_in(slot, look.colour).0
        }
        None => textures.seen(look).0,
    };
    let byte = |share: f32| (share * 255.0).round().clamp(0.0, 255.0) as u8;
    (seen.map(byte), byte(look.opacity))
}

/// A tint in whole steps.
fn tint(colour: [f32; 3]) -> [u8; 3] {
    colour.map(|share| ((share.clamp(0.0, 1.0) * 255.0 / TINT_STEP).round() * TINT_STEP) as u8)
}

/// Materials, textures and texture vertices of a building, each once.
#[derive(Default)]
pub(crate) struct Looks {
    materials: Vec<Material>,
    textures: Vec<Tinted>,
    corners: Vec<[i64; 2]>,
    known: HashMap<[i64; 2], usize>,
}

impl Looks {
    /// The members `material` and `texture` of a geometry with these faces; `open` and `close` are
    /// the brackets of a Solid's shell.
    pub fn members(&mut self, faces: &[&FaceLook], open: &str, close: &str) -> String {
        let materials: Vec<String> = faces
            .iter()
            .map(|face| place_of(&mut self.materials, face.material).to_string())
            .collect();
        let mut text = format!(
            r#","material":{{"{THEME}":{{"values":{open}[{}]{close}}}}}"#,
            materials.join(",")
        );
        if faces.iter().any(|face| face.texture.is_some()) {
            let mapped: Vec<String> = faces.iter().map(|face| self.mapped(face)).collect();
            let _ = write!(
                text,
                r#","texture":{{"{THEME}":{{"values":{open}[{}]{close}}}}}"#,
                mapped.join(",")
            );
        }
        text
    }

    /// For each ring of a face the number of its texture and those of its corners.
    fn mapped(&mut self, face: &FaceLook) -> String {
        let Some((texture, rings)) = &face.texture else {
            return "[[null]]".into();
        };
        let number = place_of(&mut self.textures, *texture);
        let rings: Vec<String> = rings
            .iter()
            .map(|ring| {
                let mut text = format!("[{number}");
                for &corner in ring {
                    let _ = write!(text, ",{}", self.corner(corner));
                }
                text.push(']');
                text
            })
            .collect();
        format!("[{}]", rings.join(","))
    }

    fn corner(&mut self, uv: [f32; 2]) -> usize {
        let steps = uv.map(|share| (f64::from(share) * UV_STEPS).round() as i64);
        *self.known.entry(steps).or_insert_with(|| {
            self.corners.push(steps);
            self.corners.len() - 1
        })
    }

    /// The textures in the order of their numbers.
    pub fn textures(&self) -> &[Tinted] {
        &self.textures
    }

    /// `materials` as a JSON array.
    pub fn materials_text(&self) -> String {
        let each = self.materials.iter().map(|&[red, green, blue, opacity]| {
            let [r, g, b, o] = [red, green, blue, opacity].map(|part| f64::from(part) / 255.0);
            let tag = if opacity == 255 {
                String::new()
            } else {
                format!("{opacity:02x}")
            };
            format!(
                r##"{{"name":"#{red:02x}{green:02x}{blue:02x}{tag}","diffuseColor":[{r:.3},{g:.3},{b:.3}],"transparency":{:.3}}}"##,
                1.0 - o
            )
        });
        format!("[{}]", each.collect::<Vec<_>>().join(","))
    }

    /// `vertices-texture` as a JSON array, from the lower left.
    pub fn corners_text(&self) -> String {
        let each = self
            .corners
            .iter()
            .map(|&[u, v]| format!("[{},{}]", u as f64 / UV_STEPS, v as f64 / UV_STEPS));
        format!("[{}]", each.collect::<Vec<_>>().join(","))
    }
}

/// The place of one of a few things, appended where it is new.
fn place_of<T: PartialEq>(all: &mut Vec<T>, one: T) -> usize {
    all.iter()
        .position(|known| *known == one)
        .unwrap_or_else(|| {
            all.push(one);
            all.len() - 1
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textures_and_corners_are_numbered_once() {
        let square = vec![vec![[0.0, 0.0], [2.5, 0.0], [2.5, 1.0]]];
        let face = |colour| FaceLook {
            material: [10, 20, 30, 255],
            texture: Some(((7, tint(colour)), square.clone())),
        };
        let plain = FaceLook {
            material: [10, 20, 30, 128],
            texture: None,
        };
        let mut looks = Looks::default();
        let (first, near) = (face([1.0, 1.0, 1.0]), face([0.99, 1.0, 1.0]));
        let other = face([0.5, 1.0, 1.0]);
        let text = looks.members(&[&first, &near, &other, &plain], "", "");
        assert_eq!(
            text,
            r#","material":{"rules":{"values":[0,0,0,1]}},"texture":{"rules":{"values":[[[0,0,1,2]],[[0,0,1,2]],[[1,0,1,2]],[[null]]]}}"#
        );
        assert_eq!(looks.textures(), [(7, [255; 3]), (7, [127, 255, 255])]);
        assert_eq!(looks.corners_text(), "[[0,0],[2.5,0],[2.5,1]]");
        assert!(looks.materials_text().contains(r#""transparency":0.498"#));
    }

    #[test]
    fn what_has_no_texture_says_nothing_of_textures() {
        let plain = FaceLook {
            material: [1, 2, 3, 255],
            texture: None,
        };
        let text = Looks::default().members(&[&plain], "[", "]");
        assert_eq!(text, r#","material":{"rules":{"values":[[0]]}}"#);
    }
}
