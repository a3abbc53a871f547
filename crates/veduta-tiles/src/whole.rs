//! Buildings whose cells are faces again.
//!
//! Rules cut a wall into cells, whose corners lie in the middle of their neighbours' edges. Once
//! places are rounded to the grid of a tile, such corners lie beside those edges, and the sky shines
//! through between them. From where single cells are not told apart, those of a surface become the
//! faces that they were cut from, and the corners of each face stand in the edges of the others.

use foldhash::HashMap;
use glam::DVec3;
use veduta_geometry::solid::{dissolve, Corner, Sheet};

use crate::building::Building;

/// Places nearer than this are one (m): far above what splits leave between cells, far below what
/// rules mean.
const NEAR_M: f64 = 1e-5;
/// Buildings of more polygons stay as they are: the work grows faster than they do.
const MOST_POLYGONS: usize = 20_000;
/// Faces narrower than this (m) show no texture from where cells are not told apart: reveals.
const NARROW_M: f64 = 0.4;

/// The columns of a building, made anew.
#[derive(Debug, Default)]
pub(crate) struct Whole {
    positions: Vec<[f64; 3]>,
    ring_offsets: Vec<i64>,
    polygon_offsets: Vec<i64>,
    feature: Vec<u32>,
    material: Vec<u32>,
    /// Each polygon is one.
    piece: Vec<u32>,
    uv: Vec<[f32; 2]>,
}

impl Whole {
    /// The cells of each surface in one plane, of one material and over which the texture goes on,
    /// as one face; None where there is too much of them.
    pub fn of(building: &Building<'_>) -> Option<Self> {
        if building.feature.len() > MOST_POLYGONS {
            return None;
        }
        let mut looks = Vec::new();
        let mut known = HashMap::default();
        let sheets: Vec<Sheet> = (0..building.feature.len())
            .map(|polygon| {
                let look = (building.feature[polygon], building.material[polygon]);
                let next = looks.len() as u32;
                let group = *known.entry(look).or_insert(next);
                if group == next {
                    looks.push(look);
                }
                sheet(building, polygon, group)
            })
            .collect();
        let mut made = Self {
            ring_offsets: vec![0],
            polygon_offsets: vec![0],
            ..Self::default()
        };
        for sheet in dissolve(&sheets, NEAR_M) {
            let (feature, material) = looks[sheet.group as usize];
            let plain = building.plain.get(material as usize);
            let plain = plain.filter(|_| width_m(&sheet) < NARROW_M);
            made.push(&sheet, (feature, *plain.unwrap_or(&material)));
        }
        Some(made)
    }

    /// These columns as a building that stands where another does.
    pub fn building<'a>(&'a self, of: &Building<'a>) -> Building<'a> {
        Building {
            positions: &self.positions,
            ring_offsets: &self.ring_offsets,
            polygon_offsets: &self.polygon_offsets,
            feature: &self.feature,
            material: &self.material,
            piece: &self.piece,
            part: &self.piece,
            uv: if of.uv.is_empty() { &[] } else { &self.uv },
            ..*of
        }
    }

    fn push(&mut self, sheet: &Sheet, (feature, material): (u32, u32)) {
        let mut rings = sheet.rings.iter();
        let Some(outline) = rings.next().filter(|ring| ring.len() >= 3) else {
            return;
        };
        for ring in std::iter::once(outline).chain(rings.filter(|ring| ring.len() >= 3)) {
            for corner in ring {
                self.positions.push(corner.place.to_array());
                self.uv.push(corner.uv.map(|c| c as f32));
            }
            self.ring_offsets.push(self.positions.len() as i64);
        }
        self.polygon_offsets
            .push(self.ring_offsets.len() as i64 - 1);
        self.feature.push(feature);
        self.material.push(material);
        self.piece.push(self.piece.len() as u32);
    }
}

/// The width of the strip that has a face's area and the length of its outline and holes.
fn width_m(sheet: &Sheet) -> f64 {
    let (mut area, mut around) = (DVec3::ZERO, 0.0);
    for ring in &sheet.rings {
        let Some(first) = ring.first() else { continue };
        for (k, corner) in ring.iter().enumerate() {
            let next = &ring[(k + 1) % ring.len()];
            area += 0.5 * (corner.place - first.place).cross(next.place - first.place);
            around += corner.place.distance(next.place);
        }
    }
    2.0 * area.length() / around
}

fn sheet(building: &Building<'_>, polygon: usize, group: u32) -> Sheet {
    let material = building.material[polygon] as usize;
    let is_mapped = !building.uv.is_empty() && building.mapped.get(material) == Some(&true);
    let corner = |vertex: usize| Corner {
        place: DVec3::from_array(building.positions[vertex]),
        uv: if is_mapped {
            building.uv[vertex].map(f64::from)
        } else {
            [0.0; 2]
        },
    };
    Sheet {
        rings: building
            .ranges(polygon)
            .map(|ring| ring.map(corner).collect())
            .collect(),
        group,
        solid: 0,
    }
}
