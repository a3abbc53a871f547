//! `i`: assets in scopes, against places worked out by hand.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::collections::HashMap;
use std::sync::Arc;

use crate::support::{code, lot};
use glam::DVec3;
use veduta_geometry::solid::{cube, Mesh};
use veduta_grammar::engine::{
    asset_names, derive, pack, surfaces, to_place, Code, Fault, Options, Packed, State, Tree,
};
use veduta_grammar::shape::{Asset, Form, Geometry, Scope};

const LOW: DVec3 = DVec3::new(-1.0, 0.0, -0.25);
const SIZE: DVec3 = DVec3::new(2.0, 1.0, 0.5);

/// A box of 2 m by 1 m by 0.5 m, about its middle in x and z.
fn mesh() -> Mesh {
    cube().mapped(|unit| LOW + unit * SIZE)
}

/// A closed shape in the same box that no turn makes its own mirror image: a corner of the box.
fn hand() -> Mesh {
    let at = |x: f64, y: f64, z: f64| LOW + DVec3::new(x, y, z) * SIZE;
    let [origin, x, y, z] = [
        at(0.0, 0.0, 0.0),
        at(1.0, 0.2, 0.0),
        at(0.3, 1.0, 0.0),
        at(0.0, 0.0, 1.0),
    ];
    let mut mesh = Mesh::with_points(vec![origin, x, y, z]);
    for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
        mesh.push_face(&[face]);
    }
    mesh
}

fn options() -> Options {
    let made = |name: &str, mesh: Mesh| {
        let asset = Asset::new(name.into(), mesh, (LOW, LOW + SIZE)).unwrap();
        (asset.name.clone(), Arc::new(asset))
    };
    let panel = |name: &str, mesh: Mesh| {
        let (name, asset) = made(name, mesh);
        let mut asset = Asset::clone(&asset);
        asset.panel = true;
        (name, Arc::new(asset))
    };
    let in_plane = |name: &str, mesh: Mesh| {
        let (name, asset) = made(name, mesh);
        let mut asset = Asset::clone(&asset);
        asset.in_plane = true;
        (name, Arc::new(asset))
    };
    Options {
        assets: Arc::new(HashMap::from([
            made("box", mesh()),
            made("builtin/box", mesh()),
            in_plane("pane", mesh()),
            panel("panel", mesh()),
            made("hand", hand()),
        ])),
        ..Options::default()
    }
}

fn derived(text: &str, start: State) -> Result<Tree, Fault> {
    let code = code(text);
    derive(&code, code.start.unwrap(), start, &options())
}

fn tree(text: &str) -> Tree {
    derived(text, lot()).unwrap()
}

/// Origin and size of the scope of the only leaf.
fn scope(operations: &str) -> ([f64; 3], [f64; 3]) {
    let tree = tree(&format!("Lot --> {operations}"));
    let leaves: Vec<_> = tree.leaves().collect();
    assert_eq!(leaves.len(), 1);
    let scope = leaves[0].state.form.scope;
    (scope.origin.to_array(), scope.size.to_array())
}

fn packed(tree: &Tree) -> Packed {
    pack(tree)
}

#[test]
fn an_asset_fills_the_scope() {
    let whole = scope("s(4, 3, 2) i(\"box\")");
    assert_eq!(whole, ([0.0; 3], [4.0, 3.0, 2.0]));
}

#[test]
fn an_asset_keeps_its_proportion_where_the_scope_is_flat() {
    // Stretched by 2 along x and by 3 along y, so by 2.5 along z; a flat scope stays where it is.
    let flat = scope("s(4, 3, 0) i(\"box\")");
    assert_eq!(flat, ([0.0; 3], [4.0, 3.0, 1.25]));
    // One that says so has its plane z = 0 in the wall: it began at -0.25. No name does.
    let own = scope("s(4, 3, 0) i(\"pane\")");
    assert_eq!(own, ([0.0, 0.0, -0.625], [4.0, 3.0, 1.25]));
    assert_eq!(scope("s(4, 3, 0) i(\"builtin/box\")"), flat);
    // A panel has a hundredth of that, and fills what is not flat as others do.
    let thin = scope("s(4, 3, 0) i(\"panel\")");
    assert_eq!(thin, ([0.0; 3], [4.0, 3.0, 0.0125]));
    assert_eq!(scope("s(4, 3, 2) i(\"panel\")").1, [4.0, 3.0, 2.0]);
    assert_eq!(scope("s(0, 4, 0) i(\"panel\")").1, [8.0, 4.0, 2.0]);
    // By 4 along y alone.
    let line = scope("s(0, 4, 0) i(\"box\")");
    assert_eq!(line, ([-4.0, 0.0, -1.0], [8.0, 4.0, 2.0]));
    let point = scope("t(1, 0, 0) s(0, 0, 0) i(\"box\")");
    assert_eq!(point, ([0.0, 0.0, -0.25], SIZE.to_array()));
}

#[test]
fn an_asset_may_keep_its_size() {
    let kept = scope("s(4, 3, 2) i(\"box\", yUp, keepSizeAndPosition)");
    assert_eq!(kept, (LOW.to_array(), SIZE.to_array()));
    let centred = scope("s(4, 3, 2) i(\"box\", yUp, keepSizeAlignPosition)");
    assert_eq!(centred, ([1.0, 0.0, 0.75], SIZE.to_array()));
}

#[test]
fn an_asset_with_z_up_is_turned() {
    // z from -0.25 to 0.25 becomes y; y from 0 to 1 becomes z from -1 to 0.
    let turned = scope("s(0, 0, 0) i(\"box\", zUp)");
    assert_eq!(turned, ([-1.0, -0.25, -1.0], [2.0, 0.5, 1.0]));
}

#[test]
fn an_asset_is_one_instance_until_its_faces_are_needed() {
    let whole = tree("Lot --> s(2, 1, 0.5) i(\"box\") t(1, 2, 3) color(\"#ff0000\") A.");
    let found = packed(&whole);
    assert_eq!(found.instance_feature, [0]);
    assert!(found.positions.is_empty());
    assert_eq!(found.assets[0].name.as_ref(), "box");
    let opened = tree("Lot --> s(2, 1, 0.5) i(\"box\") comp(f) { all : A }");
    let found = packed(&opened);
    assert!(found.instance_feature.is_empty());
    assert_eq!(found.polygon_feature.len(), 6);
    let halves = tree("Lot --> s(2, 1, 0.5) i(\"box\") split(x) { '0.5 : A | '0.5 : B }");
    let volumes: Vec<f64> = halves
        .leaves()
        .map(|leaf| leaf.state.form.world_mesh().volume())
        .collect();
    assert!(
        volumes.iter().all(|volume| (volume - 0.5).abs() < 1e-12),
        "{volumes:?}"
    );
}

#[test]
fn the_classes_of_instances_are_kept() {
    let tree = tree("Lot --> set(material.name, \"window\") s(2, 1, 0) i(\"box\")");
    let found = packed(&tree);
    let surfaces = surfaces(&tree, &found, &Code::default());
    assert_eq!(surfaces.class[0].as_ref(), "window");
    let feature = found.instance_feature[0] as usize;
    assert_eq!(surfaces.of_feature[feature], 0);
}

#[test]
fn shapes_can_ask_for_their_asset() {
    let asked = "print(geometry.isInstanced) print(geometry.nFaces) print(geometry.volume)";
    let found = tree(&format!("Lot --> s(2, 1, 0.5) i(\"box\") {asked}"));
    assert_eq!(found.messages, ["true", "6", "1"]);
}

#[test]
fn an_asset_that_is_missing_is_named() {
    let fault = derived("Lot --> i(\"bok\")", lot()).unwrap_err();
    assert_eq!(fault.missing_asset.as_deref(), Some("bok"));
    assert!(fault.message.contains("`bok`"), "{}", fault.message);
}

#[test]
fn an_asset_pressed_flat_is_faces() {
    let found = packed(&tree("Lot --> s(2, 1, 0.5) i(\"box\") s('1, '1, 0)"));
    assert!(found.instance_feature.is_empty());
    assert_eq!(found.polygon_feature.len(), 6);
}

/// Where the transform puts each point of the asset is where the shape's own faces have it.
#[test]
fn transforms_put_assets_where_their_faces_are() {
    for (number, turn) in ["0, 0, 0", "0, 90, 0", "30, 20, 10", "-75, 160, 5"]
        .iter()
        .enumerate()
    {
        let up = if number % 2 == 0 { "yUp" } else { "zUp" };
        let text = format!("Lot --> s(3, 2, 0.7) t(5, 1, -2) r({turn}) i(\"box\", {up})");
        let tree = derived(&text, turned(0.3 * number as f64)).unwrap();
        let leaf = tree.leaves().next().unwrap();
        let wanted = leaf.state.form.world_mesh();
        let row = packed(&tree).instance_transform[0];
        for (point, world) in mesh().points.iter().zip(&wanted.points) {
            let from = to_place(*point);
            let to: Vec<f64> = (0..3)
                .map(|k| (0..3).map(|j| row[4 * k + j] * from[j]).sum::<f64>() + row[4 * k + 3])
                .collect();
            let truth = to_place(*world);
            assert!(
                (0..3).all(|k| (to[k] - truth[k]).abs() < 1e-9),
                "{to:?} {truth:?}"
            );
        }
    }
}

/// The places of the first asset's faces where its first instance stands, and its volume there (m3).
fn standing(found: &Packed) -> (Vec<[f64; 3]>, f64) {
    let faces = found.assets[0].faces();
    let row = found.instance_transform[0];
    let at = |point: &[f64; 3]| {
        [0, 1, 2].map(|k| (0..3).map(|j| row[4 * k + j] * point[j]).sum::<f64>() + row[4 * k + 3])
    };
    let places: Vec<[f64; 3]> = faces.positions.iter().map(at).collect();
    let rings = faces.ring_offsets.windows(2);
    let volume = rings.map(|ends| {
        let ring = &places[ends[0] as usize..ends[1] as usize];
        let [a, b, c] = [0, 1, 2].map(|k| DVec3::from_array(ring[k]));
        a.dot(b.cross(c)) / 6.0
    });
    let volume = volume.sum();
    (places, volume)
}

/// Mirrored and turned inside out an asset stays an asset: its faces are where the shape's own are, they
/// look the same way, and its place is a turn with stretches.
#[test]
fn mirrored_assets_stay_assets() {
    for (number, operations) in [
        "mirror(true, false, false)",
        "mirror(false, true, false)",
        "mirror(false, true, true)",
        "mirror(true, true, true)",
        "reverseNormals()",
        "s(-2, '1, '1)",
        "s('1, -1, -3)",
        "s(-1, -2, -3) mirror(true, false, false) r(10, 20, 30)",
    ]
    .iter()
    .enumerate()
    {
        let up = if number % 2 == 0 { "yUp" } else { "zUp" };
        let text = format!("Lot --> s(3, 2, 0.7) t(5, 1, -2) i(\"hand\", {up}) {operations}");
        let tree = derived(&text, turned(0.3 * number as f64)).unwrap();
        let wanted = tree.leaves().next().unwrap().state.form.world_mesh();
        let found = packed(&tree);
        assert!(found.positions.is_empty(), "{operations}");
        let (places, volume) = standing(&found);
        let near = |a: &[f64; 3], b: &[f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-9);
        for point in &wanted.points {
            let truth = to_place(*point);
            assert!(
                places.iter().any(|place| near(place, &truth)),
                "{operations}: {truth:?}"
            );
        }
        assert!(
            (volume - wanted.volume()).abs() < 1e-9,
            "{operations}: {volume}"
        );
        let row = found.instance_transform[0];
        let column = |j: usize| DVec3::new(row[j], row[4 + j], row[8 + j]);
        assert!(
            column(0).cross(column(1)).dot(column(2)) > 0.0,
            "{operations}"
        );
    }
}

#[test]
fn a_mirrored_asset_is_written_once_for_all_shapes() {
    let both = "Lot --> [ i(\"hand\") A ] [ i(\"hand\") mirror(true, false, false) A ] \
                [ i(\"hand\") mirror(false, true, false) A ] NIL";
    let found = packed(&tree(both));
    assert_eq!(found.instance_asset, [0, 1, 1]);
    let again = packed(&tree(both));
    assert_eq!(found.assets[1].view(), again.assets[1].view());
    assert!(found.assets[1].view().mirrored && !found.assets[1].view().inside_out);
}

/// A lot that does not lie along the axes of the world.
fn turned(angle: f64) -> State {
    let scope = Scope {
        origin: DVec3::new(7.0, 0.0, -3.0),
        axes: glam::DMat3::from_rotation_y(angle),
        size: DVec3::new(10.0, 0.0, 6.0),
    };
    State::new(
        Form {
            scope,
            geometry: Geometry::Rectangle(1),
        },
        0,
    )
}

#[test]
fn names_are_found_in_the_rules() {
    let found = asset_names(&code(
        "const own = \"c\"\nLot --> [ i(\"a\") ] split(x) { { ~1 : A }* }\nA --> 50% : i(own) else : i(\"b\")",
    ));
    let names: Vec<&str> = found.written.iter().map(AsRef::as_ref).collect();
    assert_eq!(names, ["a", "b", "c"]);
    assert!(!found.computed);
    assert!(asset_names(&code("attr n = 1\nLot --> i(\"a\" + n)")).computed);
}

#[test]
fn an_asset_must_fit_its_box() {
    let flat = (DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0));
    assert!(Asset::new("box".into(), cube(), flat).is_none());
    assert!(Asset::new("box".into(), Mesh::new(), (DVec3::ZERO, DVec3::ONE)).is_none());
    let nowhere = cube().mapped(|point| point / 0.0);
    assert!(Asset::new("box".into(), nowhere, (DVec3::ZERO, DVec3::ONE)).is_none());
}
