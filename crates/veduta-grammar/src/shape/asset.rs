//! Ready-made geometry that shapes are filled with.

use std::sync::{Arc, OnceLock};

use glam::{DMat3, DVec3};
use veduta_geometry::solid::Mesh;

use super::components::Kind;
use super::scope::over;

/// A mesh from outside, in metres in its own frame (y up). It is the same for all shapes that it is
/// put into; each stretches it to its scope.
#[derive(Debug, Clone, PartialEq)]
pub struct Asset {
    pub name: Arc<str>,
    low: DVec3,
    size: DVec3,
    unit: Arc<Mesh>,
    solid: bool,
    /// Whether its plane z = 0 lies in the plane of what it is put into where that is flat, as that of
    /// a window lies in the wall; others begin there.
    pub in_plane: bool,
    /// Whether it is a thin panel in a flat shape, as what stands for an asset that is not there: as
    /// deep as wide it would bury the house.
    pub panel: bool,
    face_slot: Vec<u32>,
    slots: Vec<Slot>,
    /// Where each corner lies on the picture of its slot, from the lower left, in the order of the
    /// mesh; empty where the asset has no such coordinates.
    uv: Vec<[f32; 2]>,
    /// The names of the slots, and the group of each face, where the file has them.
    labels: Labels,
    view: View,
    /// The other views of it, each made once.
    views: [OnceLock<Arc<Asset>>; 4],
}

/// How an asset differs from what its file has. Transforms stay turns and stretches, which all formats
/// can tell; what a turn cannot do is done to the mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct View {
    /// Its own mirror image, left for right, about x = 0.
    pub mirrored: bool,
    pub inside_out: bool,
}

/// What the file of an asset calls its parts.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Labels {
    /// The name of each slot's material.
    pub materials: Vec<Arc<str>>,
    /// The group of each face, by its place in `groups`.
    pub face_group: Vec<u32>,
    pub groups: Vec<Arc<str>>,
}

/// A part of an asset that looks alike: a frame, a pane.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// sRGB, 0 to 1; None for that of the shape that the asset is put into.
    pub colour: Option<[f32; 3]>,
    /// The colour where a shape has none of its own.
    pub fallback: [f32; 3],
    pub texture: Option<SlotTexture>,
}

/// The texture of a slot: its name, and where it lies.
#[derive(Debug, Clone, PartialEq)]
pub struct SlotTexture {
    pub name: Arc<str>,
    pub lies: Lies,
}

/// Where a texture lies on the faces of a slot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lies {
    /// In metres, seen from the side of a box that a face looks to most; so many metres to the right
    /// and up are one picture.
    InMetres([f64; 2]),
    /// Where the asset's own coordinates say. `mean` is the picture's mean colour (sRGB), for what
    /// becomes of the faces when they are taken out of the asset.
    ByCorners { mean: [f32; 3] },
}

/// The colour of a shape that none was given to.
const WHITE: [f32; 3] = [1.0; 3];

impl Slot {
    /// Its colour in a shape of this colour.
    pub fn colour_in(&self, shape: [f32; 3]) -> [f32; 3] {
        let own = if shape == WHITE { self.fallback } else { shape };
        self.colour.unwrap_or(own)
    }

    /// What it looks like in such a shape without its own picture: a picture that lies in metres is
    /// left out.
    pub fn plain_in(&self, shape: [f32; 3]) -> [f32; 3] {
        let colour = self.colour_in(shape);
        match self.texture.as_ref().map(|texture| texture.lies) {
            // A product of sRGB values is nearly that of light.
            Some(Lies::ByCorners { mean }) => [0, 1, 2].map(|k| colour[k] * mean[k]),
            _ => colour,
        }
    }
}

/// The faces of an asset in metres, in the frame of places (z up), as columns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AssetFaces {
    /// Each belongs to one ring.
    pub positions: Vec<[f64; 3]>,
    pub ring_offsets: Vec<i64>,
    pub polygon_offsets: Vec<i64>,
    /// The slot of each face.
    pub slot: Vec<u32>,
    /// Where each position lies on the picture of its slot, from the lower left; empty where the
    /// asset has no such coordinates.
    pub uv: Vec<[f32; 2]>,
}

impl Asset {
    /// `low` and `high` are the corners of the box that will fill scopes. None where there is no
    /// face, where a place is no number, or where points lie off a box that is flat.
    pub fn new(name: Arc<str>, mesh: Mesh, (low, high): (DVec3, DVec3)) -> Option<Self> {
        let size = high - low;
        let fits = |point: &DVec3| {
            let off = (*point - low).abs();
            point.is_finite() && (0..3).all(|axis| size[axis] > 0.0 || off[axis] == 0.0)
        };
        if mesh.is_empty() || !size.is_finite() || !mesh.points.iter().all(fits) {
            return None;
        }
        let solid = mesh.is_closed();
        let face_slot = vec![0; mesh.face_count()];
        let unit = Arc::new(mesh.mapped(|point| over(point - low, size)));
        Some(Self {
            name,
            low,
            size,
            unit,
            solid,
            in_plane: false,
            panel: false,
            face_slot,
            slots: vec![Slot {
                colour: None,
                fallback: WHITE,
                texture: None,
            }],
            uv: Vec::new(),
            labels: Labels::default(),
            view: View::default(),
            views: Default::default(),
        })
    }

    /// What the parts are called; None where the numbers do not fit.
    pub fn with_labels(self, labels: Labels) -> Option<Self> {
        let is_known = |&group: &u32| (group as usize) < labels.groups.len();
        let fits = labels.materials.len() == self.slots.len()
            && labels.face_group.len() == self.unit.face_count()
            && labels.face_group.iter().all(is_known);
        fits.then_some(Self { labels, ..self })
    }

    /// The names of what it is taken apart into: its groups, or its materials.
    pub fn part_names(&self, kind: Kind) -> Vec<Arc<str>> {
        let names = match kind {
            Kind::Materials => &self.labels.materials,
            _ => &self.labels.groups,
        };
        match names[..] {
            [] => vec!["".into()],
            _ => names.clone(),
        }
    }

    /// The part of each face; empty where the file has no parts.
    fn part_of_face(&self, kind: Kind) -> &[u32] {
        match kind {
            Kind::Materials if !self.labels.materials.is_empty() => &self.face_slot,
            Kind::Materials => &[],
            _ => &self.labels.face_group,
        }
    }

    /// The slot that all faces of a part have; None where they have several.
    pub fn slot_of_part(&self, kind: Kind, part: usize) -> Option<&Slot> {
        let each = self.part_of_face(kind).iter().zip(&self.face_slot);
        let mut slots = each
            .filter(|(own, _)| **own as usize == part)
            .map(|(_, &slot)| slot);
        let first = slots.next()?;
        slots
            .all(|slot| slot == first)
            .then(|| &self.slots[first as usize])
    }

    /// The slot of each face; None where the numbers do not fit.
    pub fn with_slots(self, face_slot: Vec<u32>, slots: Vec<Slot>) -> Option<Self> {
        let is_known = |&slot: &u32| (slot as usize) < slots.len();
        let fits = face_slot.len() == self.unit.face_count() && face_slot.iter().all(is_known);
        fits.then_some(Self {
            face_slot,
            slots,
            ..self
        })
    }

    /// Where each corner of the mesh lies on the picture of its slot; None where the numbers do not
    /// fit.
    pub fn with_uv(self, uv: Vec<[f32; 2]>) -> Option<Self> {
        let fits = uv.len() == self.unit.corner_count();
        let is_sound = uv.iter().flatten().all(|share| share.is_finite());
        (fits && is_sound).then_some(Self { uv, ..self })
    }

    pub fn view(&self) -> View {
        self.view
    }

    /// The asset mirrored or turned inside out; the same one each time.
    pub fn seen(self: &Arc<Self>, view: View) -> Arc<Self> {
        if view == self.view {
            return self.clone();
        }
        let place = usize::from(view.mirrored) + 2 * usize::from(view.inside_out);
        let made = self.views[place].get_or_init(|| Arc::new(self.made(view)));
        made.clone()
    }

    fn made(&self, view: View) -> Self {
        let mirrors = view.mirrored != self.view.mirrored;
        let mut unit = Mesh::clone(&self.unit);
        let (mut low, mut uv) = (self.low, self.uv.clone());
        if mirrors {
            unit = unit.mapped(|point| mirrored(point, DVec3::new(-1.0, 1.0, 1.0), self.size));
            low.x = -(low.x + self.size.x);
        }
        if mirrors != (view.inside_out != self.view.inside_out) {
            unit = unit.reversed();
            let mut rest = &mut uv[..];
            let rings = self.unit.faces().flat_map(|face| face.rings());
            for size in rings.map(<[u32]>::len).filter(|_| !self.uv.is_empty()) {
                let (ring, after) = rest.split_at_mut(size);
                ring.reverse();
                rest = after;
            }
        }
        Self {
            name: self.name.clone(),
            low,
            unit: Arc::new(unit),
            face_slot: self.face_slot.clone(),
            slots: self.slots.clone(),
            uv,
            labels: self.labels.clone(),
            view,
            views: Default::default(),
            ..*self
        }
    }

    /// The lower corner of its box, and its size (m), in its own frame.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.low, self.size)
    }

    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// The box around all points (m), in the frame of places.
    pub fn reach(&self) -> ([f64; 3], [f64; 3]) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &unit in &self.unit.points {
            let point = self.place(unit);
            (low, high) = (low.min(point), high.max(point));
        }
        (low.to_array(), high.to_array())
    }

    /// A point of the unit box in metres, in the frame of places.
    fn place(&self, unit: DVec3) -> DVec3 {
        let point = self.low + unit * self.size;
        DVec3::new(point.x, -point.z, point.y)
    }

    /// The faces as a place has them where the asset is not stretched.
    pub fn faces(&self) -> AssetFaces {
        let mut found = AssetFaces {
            ring_offsets: vec![0],
            polygon_offsets: vec![0],
            slot: self.face_slot.clone(),
            uv: self.uv.clone(),
            ..AssetFaces::default()
        };
        for face in self.unit.faces() {
            for ring in face.rings() {
                let points = ring.iter().map(|&point| self.unit.points[point as usize]);
                let placed = points.map(|unit| self.place(unit).to_array());
                found.positions.extend(placed);
                found.ring_offsets.push(found.positions.len() as i64);
            }
            let end = found.ring_offsets.len() as i64 - 1;
            found.polygon_offsets.push(end);
        }
        found
    }
}

/// An asset in the box that it fills; `z_up` where z is up in the asset's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    pub asset: Arc<Asset>,
    pub z_up: bool,
    /// -1 along the axes of the box in which it is mirrored, about the middle of the box.
    pub signs: DVec3,
    pub inside_out: bool,
}

/// A point in shares of a box of this size, mirrored in it; where the box is flat it stays.
fn mirrored(unit: DVec3, signs: DVec3, size: DVec3) -> DVec3 {
    let turned = (unit - 0.5) * signs + 0.5;
    DVec3::select(size.cmpeq(DVec3::ZERO), unit, turned)
}

/// From a frame with z up to one with y up: a quarter turn about x.
const Y_FROM_Z: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);

impl Instance {
    pub fn new(asset: Arc<Asset>, z_up: bool) -> Self {
        Self {
            asset,
            z_up,
            signs: DVec3::ONE,
            inside_out: false,
        }
    }

    /// Whether it is its own mirror image, however it is turned.
    pub fn is_mirrored(&self) -> bool {
        self.signs.element_product() < 0.0
    }

    /// From the asset's frame to one with y up.
    pub fn upright(&self) -> DMat3 {
        if self.z_up {
            Y_FROM_Z
        } else {
            DMat3::IDENTITY
        }
    }

    /// The lower corner of the asset's box, and its size (m), y up.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let (a, b) = (self.asset.low, self.asset.low + self.asset.size);
        let (a, b) = (self.upright() * a, self.upright() * b);
        (a.min(b), (a - b).abs())
    }

    pub fn is_solid(&self) -> bool {
        self.asset.solid
    }

    /// The parts that have faces, by their numbers, in shares of the box; none where the file has no
    /// parts.
    pub fn parts(&self, kind: Kind) -> Vec<(usize, Mesh)> {
        let mesh = self.mesh();
        let of_face = self.asset.part_of_face(kind);
        let count = of_face.iter().max().map_or(0, |&last| last as usize + 1);
        let mut faces = vec![Vec::new(); count];
        for (face, &part) in of_face.iter().enumerate() {
            faces[part as usize].push(face);
        }
        let parts = faces.into_iter().enumerate();
        let parts = parts.filter(|(_, faces)| !faces.is_empty());
        parts
            .map(|(part, faces)| (part, mesh.of_faces(faces)))
            .collect()
    }

    /// The faces in shares of the box.
    pub fn mesh(&self) -> Arc<Mesh> {
        let size = self.bounds().1;
        let mut mesh = self.asset.unit.clone();
        if self.z_up {
            let flip = |unit: DVec3| DVec3::new(unit.x, unit.z, 1.0 - unit.y);
            let turned = Mesh::clone(&mesh).mapped(flip);
            mesh = Arc::new(match size.z == 0.0 {
                true => turned.mapped(|unit| unit.with_z(0.0)),
                false => turned,
            });
        }
        if self.signs != DVec3::ONE {
            let turned = Mesh::clone(&mesh);
            mesh = Arc::new(turned.mapped(|unit| mirrored(unit, self.signs, size)));
        }
        if self.is_mirrored() != self.inside_out {
            mesh = Arc::new(Mesh::clone(&mesh).reversed());
        }
        mesh
    }
}
