//! The leaves of a derivation as columns of polygons, in the frame of places.
//!
//! Frame of places: metres, right-handed, x east, y north, z up. Rule files have y up and z south.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::{cube, Mesh};

use super::laid::{laid, normal};
use super::state::Look;
use super::texture_map::{axes_of, TextureMap};
use super::tree::{Node, Tree};
use crate::shape::{over, Asset, Geometry, Instance, Scope, View};

/// Polygons of all leaves. A polygon's first ring is its outline; each leaf with geometry is one
/// feature, in the order of the tree.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Packed {
    /// Vertices (m); each belongs to one ring.
    pub positions: Vec<[f64; 3]>,
    /// Texture coordinates from the lower left.
    pub uv: Vec<[f32; 2]>,
    /// The first vertex of each ring, with the end.
    pub ring_offsets: Vec<i64>,
    /// The first ring of each polygon, with the end.
    pub polygon_offsets: Vec<i64>,
    pub polygon_feature: Vec<i32>,
    /// The node in the tree of each feature.
    pub feature_node: Vec<u32>,
    /// The place of each feature's look in `looks`.
    pub feature_look: Vec<u32>,
    /// Size of each feature's scope along x and y (m).
    pub feature_size: Vec<[f64; 2]>,
    pub looks: Vec<Arc<Look>>,
    /// Leaves that are assets stretched to their scopes have no polygons but one row each here.
    pub instance_feature: Vec<i32>,
    /// The place of each instance's asset in `assets`.
    pub instance_asset: Vec<u32>,
    /// 3 x 4 by rows: from the asset's frame (m; z up, as places have it) to that of places.
    pub instance_transform: Vec<[f64; 12]>,
    pub assets: Vec<Arc<Asset>>,
}

/// A place of rule files in the frame of places.
pub fn to_place(point: DVec3) -> [f64; 3] {
    [point.x, -point.z, point.y]
}

/// A place in the frame of places as rule files have it.
pub fn from_place(point: [f64; 3]) -> DVec3 {
    DVec3::new(point[0], point[2], -point[1])
}

/// Packs the leaves of a tree that have geometry.
pub fn pack(tree: &Tree) -> Packed {
    let mut packer = Packer {
        packed: room(tree),
        cube: cube(),
        known: HashMap::new(),
    };
    for &leaf in &tree.leaves {
        packer.leaf(leaf, &tree.nodes[leaf as usize]);
    }
    packer.packed
}

/// Empty columns with room for all leaves but instances.
fn room(tree: &Tree) -> Packed {
    let (mut vertices, mut rings, mut polygons) = (0, 0, 0);
    for leaf in tree.leaves() {
        let counts = match &leaf.state.form.geometry {
            Geometry::Rectangle(_) => (4, 1, 1),
            Geometry::Box => (24, 6, 6),
            Geometry::Faces { mesh, .. } => {
                let of_faces = mesh.faces().map(|face| face.ring_count()).sum();
                (mesh.corner_count(), of_faces, mesh.face_count())
            }
            Geometry::Nothing | Geometry::Instance(_) => (0, 0, 0),
        };
        vertices += counts.0;
        rings += counts.1;
        polygons += counts.2;
    }
    let offsets = |count: usize| {
        let mut offsets = Vec::with_capacity(count + 1);
        offsets.push(0);
        offsets
    };
    let features = tree.leaves.len();
    Packed {
        positions: Vec::with_capacity(vertices),
        uv: Vec::with_capacity(vertices),
        ring_offsets: offsets(rings),
        polygon_offsets: offsets(polygons),
        polygon_feature: Vec::with_capacity(polygons),
        feature_node: Vec::with_capacity(features),
        feature_look: Vec::with_capacity(features),
        feature_size: Vec::with_capacity(features),
        ..Packed::default()
    }
}

struct Packer {
    packed: Packed,
    /// What a box in shares of its scope is: most leaves are one.
    cube: Mesh,
    /// Looks by their address: children share that of their parent.
    known: HashMap<*const Look, u32>,
}

impl Packer {
    fn leaf(&mut self, number: u32, node: &Node) {
        let form = &node.state.form;
        let feature = self.packed.feature_node.len() as i32;
        match &form.geometry {
            Geometry::Nothing => return,
            Geometry::Faces { mesh, .. } => self.faces(mesh, node, feature),
            Geometry::Rectangle(axis) => {
                let corners = crate::shape::rectangle(*axis);
                let (u, v) = axes_of(form);
                let places = corners.map(|corner| form.scope.world(corner));
                let map = map_on(node, || places.to_vec());
                for (corner, place) in corners.into_iter().zip(places) {
                    let own = [corner[u], corner[v]];
                    self.vertex(place, map.map_or(own, |map| map.at(place)));
                }
                self.end_ring();
                self.end_polygon(feature);
            }
            Geometry::Box => {
                let cube = std::mem::take(&mut self.cube);
                self.faces(&cube, node, feature);
                self.cube = cube;
            }
            Geometry::Instance(instance) => match placed(&form.scope, instance) {
                Some(transform) => self.instance(instance, transform, feature),
                None => self.faces(&instance.mesh(), node, feature),
            },
        }
        let look = self.look(&node.state.look);
        let size = form.scope.size;
        self.packed.feature_node.push(number);
        self.packed.feature_look.push(look);
        self.packed.feature_size.push([size.x, size.y]);
    }

    fn faces(&mut self, mesh: &Mesh, node: &Node, feature: i32) {
        let scope = &node.state.form.scope;
        let (u, v) = axes_of(&node.state.form);
        for face in mesh.faces() {
            let map = map_on(node, || {
                let outline = face.rings().next().into_iter().flatten();
                let places = outline.map(|&point| scope.world(mesh.points[point as usize]));
                places.collect()
            });
            for ring in face.rings() {
                for &point in ring {
                    let unit = mesh.points[point as usize];
                    let place = scope.world(unit);
                    let own = [unit[u], unit[v]];
                    self.vertex(place, map.map_or(own, |map| map.at(place)));
                }
                self.end_ring();
            }
            self.end_polygon(feature);
        }
    }

    fn vertex(&mut self, point: DVec3, uv: [f64; 2]) {
        self.packed.positions.push(to_place(point));
        self.packed.uv.push(uv.map(|c| c as f32));
    }

    fn end_ring(&mut self) {
        let end = self.packed.positions.len() as i64;
        self.packed.ring_offsets.push(end);
    }

    fn end_polygon(&mut self, feature: i32) {
        let end = self.packed.ring_offsets.len() as i64 - 1;
        self.packed.polygon_offsets.push(end);
        self.packed.polygon_feature.push(feature);
    }

    fn instance(&mut self, instance: &Instance, transform: [f64; 12], feature: i32) {
        let seen = instance.asset.seen(View {
            mirrored: instance.is_mirrored(),
            inside_out: instance.inside_out,
        });
        let assets = &mut self.packed.assets;
        let known = assets.iter().position(|other| Arc::ptr_eq(other, &seen));
        let asset = known.unwrap_or_else(|| {
            assets.push(seen);
            assets.len() - 1
        });
        self.packed.instance_feature.push(feature);
        self.packed.instance_asset.push(asset as u32);
        self.packed.instance_transform.push(transform);
    }

    fn look(&mut self, look: &Arc<Look>) -> u32 {
        if let Some(&known) = self.known.get(&Arc::as_ptr(look)) {
            return known;
        }
        let looks = &mut self.packed.looks;
        let place = looks.iter().position(|other| other == look);
        let index = place.unwrap_or_else(|| {
            looks.push(look.clone());
            looks.len() - 1
        }) as u32;
        self.known.insert(Arc::as_ptr(look), index);
        index
    }
}

/// Where the texture lies on a face with this outline (m): as the rules say, or in metres where its size
/// is known; None where it covers the scope.
fn map_on(node: &Node, outline: impl Fn() -> Vec<DVec3>) -> Option<TextureMap> {
    let extra = node.state.extra.as_ref();
    let own = extra.and_then(|extra| extra.separate[0]);
    let own = own.map(|own| own.on(&outline()));
    let told = extra.and_then(|extra| extra.maps[0]);
    let by_size = || {
        let size = node.state.look.tile?;
        Some(laid(normal(&outline()), size))
    };
    own.filter(TextureMap::is_sound).or(told).or_else(by_size)
}

/// From an asset's frame to that of places, by rows: a turn with a stretch, from the frame of the
/// mirrored asset where it is mirrored. None where its box is flat and the asset is not.
fn placed(scope: &Scope, instance: &Instance) -> Option<[f64; 12]> {
    let (low, size) = instance.bounds();
    let ratio = over(scope.size, size);
    let flat = size.cmpeq(DVec3::ZERO);
    let stretch = DVec3::select(flat, DVec3::ONE, ratio);
    if stretch.min_element() <= 0.0 {
        return None;
    }
    let place = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
    let world = scope.axes * DMat3::from_diagonal(stretch * instance.signs);
    let mut turn = place * world * instance.upright() * place.transpose();
    if instance.is_mirrored() {
        turn.x_axis = -turn.x_axis;
    }
    let turned_round = instance.signs.cmplt(DVec3::ZERO) & !flat;
    let far = DVec3::select(turned_round, scope.size, DVec3::ZERO);
    let by = place * (scope.origin + scope.axes * far - world * low);
    let row = |k: usize| [turn.x_axis[k], turn.y_axis[k], turn.z_axis[k], by[k]];
    let rows = [row(0), row(1), row(2)].concat();
    rows.try_into().ok()
}
