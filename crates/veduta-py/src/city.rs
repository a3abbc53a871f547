//! The geometry of a derived building as CityJSON has it: texts, since its numbers are texts.
//!
//! <https://www.cityjson.org/specs/2.0.1/> section 3. Vertices are whole millimetres.

use std::collections::{HashMap, HashSet};
use std::fmt::Write as _;

use veduta_geometry::{triangulate_sound, PolygonSet};

use crate::city_looks::{colour, texture_of, FaceLook, Looks, Material, Tinted};
use crate::derived_lot::Derived;
use crate::flat::Flat;
use crate::tiles::Textures;
use crate::volumes::{block, ground, VolumeFace};

const STEPS_PER_M: f64 = 1000.0;
const PLANE_TOLERANCE_M: f64 = 1e-3;
/// A face whose normal leans at least this much up or down is a floor or a ceiling.
const LEVEL: f64 = 0.7;

/// A building's own geometry, its installations, and the vertices of all.
pub(crate) struct CityText {
    /// A MultiSurface or a Solid; empty where all surfaces are installations.
    pub body: String,
    /// Class, rule, colour (sRGB, as `#rrggbb`) and geometry of each.
    pub installations: Vec<(u8, String, String, String)>,
    /// Three whole numbers each, as a JSON array.
    pub vertices: String,
    /// The pictures of `textures` that faces show, with their tints, as the geometries count them.
    pub textures: Vec<Tinted>,
    /// `materials` and `vertices-texture`, as JSON arrays.
    pub materials: String,
    pub corners: String,
}

pub type Vertex = [i64; 3];

/// The vertices so far, each once.
#[derive(Default)]
struct Grid {
    vertices: Vec<Vertex>,
    known: HashMap<Vertex, u32>,
}

impl Grid {
    fn number(&mut self, vertex: Vertex) -> u32 {
        *self.known.entry(vertex).or_insert_with(|| {
            self.vertices.push(vertex);
            self.vertices.len() as u32 - 1
        })
    }
}

struct Face {
    feature: usize,
    /// sRGB, of 255.
    colour: [u8; 3],
    look: FaceLook,
    rings: Vec<Vec<u32>>,
    normal_z: f64,
}

/// The texts of a building at its place (m, z up). `kinds` has the semantic surface of each class,
/// "" for what is an installation; `code` the class of a name; `textures` their mean colours.
/// Faces of a surface that differ in colour are semantic surfaces of their own. `volume`: the building at its lowest
/// level of detail, for further geometries of LoD 1.2 and 2.2 where it gives closed volumes.
pub(crate) fn city(
    lot: &Derived,
    volume: Option<&Derived>,
    place: [f64; 3],
    kinds: &[String],
    textures: &Textures,
    code: impl Fn(&str) -> u8,
) -> Result<CityText, String> {
    let mut grid = Grid::default();
    let faces = faces(lot, place, textures, &mut grid)?;
    let classes: Vec<u8> = lot.surfaces.class.iter().map(|name| code(name)).collect();
    let kind = |feature: usize| kinds[usize::from(classes[feature])].as_str();
    let mut body = Vec::new();
    let mut of_feature: Vec<Vec<&Face>> = vec![Vec::new(); classes.len()];
    for face in &faces {
        if kind(face.feature).is_empty() {
            of_feature[face.feature].push(face);
        } else {
            body.push(face);
        }
    }
    let mut rows: HashMap<(usize, [u8; 3]), usize> = HashMap::new();
    let mut surfaces = Vec::new();
    let values: Vec<usize> = body
        .iter()
        .map(|face| {
            *rows.entry((face.feature, face.colour)).or_insert_with(|| {
                surfaces.push(surface(lot, face, kind(face.feature)));
                surfaces.len() - 1
            })
        })
        .collect();
    let mut looks = Looks::default();
    let installations = of_feature
        .iter()
        .enumerate()
        .filter(|(_, all)| !all.is_empty());
    let installations = installations.map(|(feature, all)| {
        let (surfaces, values) = by_direction(all);
        let text = geometry(all, &surfaces, &values, &mut looks);
        let colour = hexed(all[0].colour);
        (classes[feature], lot.names[feature].clone(), colour, text)
    });
    let installations: Vec<_> = installations.collect();
    let mut own = Vec::new();
    if !body.is_empty() {
        own.push(geometry(&body, &surfaces, &values, &mut looks));
    }
    if let Some(volume) = volume {
        own.extend(volumes(volume, place, kinds, textures, &code, &mut grid)?);
    }
    Ok(CityText {
        body: own.join(","),
        installations,
        vertices: vertices_text(&grid.vertices),
        textures: looks.textures().to_vec(),
        materials: looks.materials_text(),
        corners: looks.corners_text(),
    })
}

/// The sound polygons, on whole millimetres; what collapses there is left out.
fn faces(
    lot: &Derived,
    place: [f64; 3],
    textures: &Textures,
    grid: &mut Grid,
) -> Result<Vec<Face>, String> {
    let flat = Flat::of(&lot.packed)?;
    let set = PolygonSet::of_any_rings(&flat.positions, &flat.rings, &flat.polygons);
    let set = set.map_err(|error| error.to_string())?;
    let sound = triangulate_sound(&set, PLANE_TOLERANCE_M);
    let mut found = Vec::new();
    for polygon in (0..set.len()).filter(|&polygon| sound.is_sound[polygon]) {
        let texture = texture_of(lot, &flat, polygon, textures);
        let (mut on_grid, mut on_picture) = (Vec::new(), Vec::new());
        for range in set.rings(polygon) {
            let (ring, corners) = ring_on_grid(lot, &set, range, place);
            if ring.len() > 2 {
                on_grid.push(ring);
                on_picture.push(corners);
            }
        }
        let is_whole = on_grid.iter().all(|ring: &Vec<Vertex>| {
            let distinct: HashSet<&Vertex> = ring.iter().collect();
            distinct.len() == ring.len()
        });
        if on_grid.is_empty() || !is_whole {
            continue;
        }
        let mut number = |vertex: Vertex| grid.number(vertex);
        let rings = on_grid.into_iter();
        let leaf = flat.feature[polygon] as usize;
        let ([red, green, blue], opacity) = colour(lot, &flat, polygon, textures);
        let material: Material = [red, green, blue, opacity];
        found.push(Face {
            feature: lot.surfaces.of_feature[leaf] as usize,
            colour: [red, green, blue],
            look: FaceLook {
                material,
                texture: texture.map(|texture| (texture, on_picture)),
            },
            rings: rings
                .map(|ring| ring.into_iter().map(&mut number).collect())
                .collect(),
            normal_z: sound.normals[polygon][2],
        });
    }
    Ok(found)
}

/// A ring at its place on whole millimetres without corners that fall together, and where its
/// corners lie on the picture.
fn ring_on_grid(
    lot: &Derived,
    set: &PolygonSet,
    range: std::ops::Range<usize>,
    place: [f64; 3],
) -> (Vec<Vertex>, Vec<[f32; 2]>) {
    let (mut ring, mut corners): (Vec<Vertex>, Vec<[f32; 2]>) = (Vec::new(), Vec::new());
    for vertex in range {
        let own: [f64; 3] = set.position_m(vertex);
        let point = [0, 1, 2].map(|k| ((own[k] + place[k]) * STEPS_PER_M).round() as i64);
        if ring.last() != Some(&point) {
            ring.push(point);
            corners.push(lot.packed.uv.get(vertex).copied().unwrap_or_default());
        }
    }
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
        corners.pop();
    }
    (ring, corners)
}

fn hexed([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn surface(lot: &Derived, face: &Face, kind: &str) -> String {
    let feature = face.feature;
    let [width, height] = lot.surfaces.size[feature];
    let class = &lot.surfaces.class[feature];
    let class = if class.is_empty() { "other" } else { class };
    let mut text = format!(
        r#"{{"type":"{kind}","rule":{},"class":{},"colour":"{}""#,
        quoted(&lot.names[feature]),
        quoted(class),
        hexed(face.colour)
    );
    for (name, size) in [("width_m", width), ("height_m", height)] {
        if size.is_finite() && size > 0.0 {
            let _ = write!(text, r#","{name}":{:.3}"#, size);
        }
    }
    text.push('}');
    text
}

/// Rule names are words; what else a rule file may say is escaped.
fn quoted(text: &str) -> String {
    let mut made = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => made.extend(['\\', letter]),
            control if control.is_control() => {
                let _ = write!(made, "\\u{:04x}", control as u32);
            }
            plain => made.push(plain),
        }
    }
    made.push('"');
    made
}

fn by_direction(faces: &[&Face]) -> (Vec<String>, Vec<usize>) {
    let mut kinds: Vec<&str> = Vec::new();
    let values = faces.iter().map(|face| {
        let kind = if face.normal_z > LEVEL {
            "OuterFloorSurface"
        } else if face.normal_z < -LEVEL {
            "OuterCeilingSurface"
        } else {
            "WallSurface"
        };
        let place = kinds.iter().position(|known| *known == kind);
        place.unwrap_or_else(|| {
            kinds.push(kind);
            kinds.len() - 1
        })
    });
    let values = values.collect();
    let texts = kinds.iter().map(|kind| format!(r#"{{"type":"{kind}"}}"#));
    (texts.collect(), values)
}

/// The closed volumes of a building at its lowest level of detail.
fn volumes(
    lot: &Derived,
    place: [f64; 3],
    kinds: &[String],
    textures: &Textures,
    code: &impl Fn(&str) -> u8,
    grid: &mut Grid,
) -> Result<Vec<String>, String> {
    let mut own = Grid::default();
    let mut faces = faces(lot, place, textures, &mut own)?;
    let all: Vec<&Vec<Vec<u32>>> = faces.iter().map(|face| &face.rings).collect();
    if !all.is_empty() && is_closed(&all) {
        let faces = faces.iter().map(|face| volume_face(lot, face, kinds, code));
        return Ok(vec![solid("2.2", faces.collect(), &own.vertices, grid)]);
    }
    // A lawn around it is no part of the building.
    faces.retain(|face| volume_face(lot, face, kinds, code).1 != "GroundSurface");
    let all: Vec<&Vec<Vec<u32>>> = faces.iter().map(|face| &face.rings).collect();
    let top = own.vertices.iter().map(|vertex| vertex[2]).max();
    let (Some(foot), Some(top)) = (ground(&all, &own.vertices), top) else {
        return Ok(Vec::new());
    };
    if top <= own.vertices[foot[0][0] as usize][2] {
        return Ok(Vec::new());
    }
    let raised = |at: u32, z: i64| {
        let [x, y, _] = own.vertices[at as usize];
        own.number([x, y, z])
    };
    let block = block(&foot, top, raised);
    let mut roofed: Vec<VolumeFace> = vec![(foot, "GroundSurface")];
    let walls_and_roofs = faces.iter();
    roofed.extend(walls_and_roofs.map(|face| volume_face(lot, face, kinds, code)));
    let mut found = Vec::new();
    for (lod, faces) in [("1.2", block), ("2.2", roofed)] {
        let rings: Vec<&Vec<Vec<u32>>> = faces.iter().map(|face| &face.0).collect();
        if is_closed(&rings) {
            found.push(solid(lod, faces, &own.vertices, grid));
        }
    }
    Ok(found)
}

/// A face of a volume: what is neither roof nor ground is wall.
fn volume_face(
    lot: &Derived,
    face: &Face,
    kinds: &[String],
    code: &impl Fn(&str) -> u8,
) -> VolumeFace {
    let kind = &kinds[usize::from(code(&lot.surfaces.class[face.feature]))];
    let known = ["RoofSurface", "GroundSurface"];
    let kind = known.into_iter().find(|known| known == kind);
    (face.rings.clone(), kind.unwrap_or("WallSurface"))
}

/// A Solid whose surfaces are one of each kind.
fn solid(lod: &str, faces: Vec<VolumeFace>, vertices: &[Vertex], grid: &mut Grid) -> String {
    let kinds = ["GroundSurface", "WallSurface", "RoofSurface"];
    let surfaces = kinds
        .map(|kind| format!(r#"{{"type":"{kind}"}}"#))
        .join(",");
    let (mut boundaries, mut values) = (Vec::new(), Vec::new());
    for (rings, kind) in faces {
        let place = kinds.iter().position(|known| *known == kind).unwrap_or(1);
        values.push(place.to_string());
        let mut number = |at: u32| grid.number(vertices[at as usize]);
        let rings = rings.into_iter();
        let rings: Vec<Vec<u32>> = rings
            .map(|ring| ring.into_iter().map(&mut number).collect())
            .collect();
        boundaries.push(rings_text(&rings));
    }
    format!(
        r#"{{"type":"Solid","lod":"{lod}","boundaries":[[{}]],"semantics":{{"surfaces":[{surfaces}],"values":[[{}]]}}}}"#,
        boundaries.join(","),
        values.join(",")
    )
}

fn geometry(faces: &[&Face], surfaces: &[String], values: &[usize], looks: &mut Looks) -> String {
    let rings: Vec<&Vec<Vec<u32>>> = faces.iter().map(|face| &face.rings).collect();
    let boundaries: Vec<String> = rings.iter().map(|rings| rings_text(rings)).collect();
    let values: Vec<String> = values.iter().map(ToString::to_string).collect();
    let (kind, open, close) = if is_closed(&rings) {
        ("Solid", "[", "]")
    } else {
        ("MultiSurface", "", "")
    };
    let seen: Vec<&FaceLook> = faces.iter().map(|face| &face.look).collect();
    let look = looks.members(&seen, open, close);
    format!(
        r#"{{"type":"{kind}","lod":"3","boundaries":{open}[{}]{close},"semantics":{{"surfaces":[{}],"values":{open}[{}]{close}}}{look}}}"#,
        boundaries.join(","),
        surfaces.join(","),
        values.join(",")
    )
}

/// Whether the faces close one body: each edge is there once in each direction, and they hang
/// together.
fn is_closed(faces: &[&Vec<Vec<u32>>]) -> bool {
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    for (number, face) in faces.iter().enumerate() {
        for ring in face.iter() {
            for k in 0..ring.len() {
                let edge = (ring[k], ring[(k + 1) % ring.len()]);
                if edges.insert(edge, number).is_some() {
                    return false;
                }
            }
        }
    }
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); faces.len()];
    for (&(from, to), &face) in &edges {
        match edges.get(&(to, from)) {
            Some(&other) => beside[face].push(other),
            None => return false,
        }
    }
    let mut is_reached = vec![false; faces.len()];
    let mut open = vec![0];
    while let Some(face) = open.pop() {
        if !std::mem::replace(&mut is_reached[face], true) {
            open.extend(&beside[face]);
        }
    }
    is_reached.into_iter().all(|is| is)
}

fn rings_text(rings: &[Vec<u32>]) -> String {
    let mut text = String::from("[");
    for (k, ring) in rings.iter().enumerate() {
        text.push_str(if k == 0 { "[" } else { ",[" });
        for (k, vertex) in ring.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            let _ = write!(text, "{comma}{vertex}");
        }
        text.push(']');
    }
    text.push(']');
    text
}

fn vertices_text(vertices: &[Vertex]) -> String {
    let mut text = String::from("[");
    for (k, [x, y, z]) in vertices.iter().enumerate() {
        let comma = if k == 0 { "" } else { "," };
        let _ = write!(text, "{comma}[{x},{y},{z}]");
    }
    text.push(']');
    text
}
