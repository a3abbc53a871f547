//! `insertAlongUV`: assets laid over faces, against volumes and places worked out by hand.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::collections::HashMap;
use std::sync::Arc;

use crate::support::{code, fault, lot, lot_of, solid};
use glam::DVec3;
use proptest::prelude::*;
use veduta_geometry::solid::{cube, Mesh};
use veduta_grammar::engine::{asset_names, derive, Fault, Options, State, Tree};
use veduta_grammar::shape::Asset;

/// A box, a tent over the same square whose ridge runs along x, and a fence in one plane.
fn options() -> Options {
    let whole = |mesh: Mesh, name: &str, low: DVec3, size: DVec3| {
        let placed = mesh.mapped(|unit| low + unit * size);
        let asset = Asset::new(name.into(), placed, (low, low + size)).unwrap();
        (asset.name.clone(), Arc::new(asset))
    };
    let low = DVec3::new(3.0, 1.0, -2.0);
    let fence = Mesh::polygon(&[[DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y]]);
    Options {
        assets: Arc::new(HashMap::from([
            whole(cube(), "box", low, DVec3::new(4.0, 0.5, 2.0)),
            whole(tent(), "tent", DVec3::ZERO, DVec3::ONE),
            whole(fence, "fence", DVec3::ZERO, DVec3::new(2.0, 1.0, 0.0)),
        ])),
        ..Options::default()
    }
}

/// A prism of volume 1/2 in the unit cube, its ridge at z = 1/2.
fn tent() -> Mesh {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let mut mesh = Mesh::with_points(vec![
        at(0.0, 0.0, 0.0),
        at(1.0, 0.0, 0.0),
        at(1.0, 0.0, 1.0),
        at(0.0, 0.0, 1.0),
        at(0.0, 1.0, 0.5),
        at(1.0, 1.0, 0.5),
    ]);
    for ring in [
        &[0, 1, 2, 3][..],
        &[3, 2, 5, 4],
        &[1, 0, 4, 5],
        &[0, 3, 4],
        &[2, 1, 5],
    ] {
        mesh.push_face(&[ring]);
    }
    assert!(mesh.is_closed() && (mesh.volume() - 0.5).abs() < 1e-12);
    mesh
}

fn laid(text: &str, start: State) -> Result<Tree, Fault> {
    let code = code(text);
    derive(&code, code.start.unwrap(), start, &options())
}

fn one(operations: &str) -> (Mesh, f64) {
    solid(&laid(&format!("Lot --> {operations} A."), lot()).unwrap())
}

#[test]
fn a_box_covers_the_face_once() {
    let (mesh, volume) = one("insertAlongUV(0, \"box\", 2)");
    assert!((volume - 120.0).abs() < 1e-9, "{volume}");
    assert_eq!(mesh.face_count(), 6);
    let (low, high) = mesh.bounds().unwrap();
    assert!(low.abs_diff_eq(DVec3::ZERO, 1e-9));
    assert!(high.abs_diff_eq(DVec3::new(10.0, 2.0, 6.0), 1e-9));
}

#[test]
fn tiles_that_touch_are_one_body() {
    // 3 by 2 boxes: tops and floors, and 10 walls around; those between them are gone.
    let (mesh, volume) = one("scaleUV(0, 3, 2) insertAlongUV(0, \"box\", 2)");
    assert!((volume - 120.0).abs() < 1e-9, "{volume}");
    assert_eq!(mesh.face_count(), 22);
}

#[test]
fn the_height_may_be_below_the_face() {
    let (mesh, volume) = one("insertAlongUV(0, \"box\", -2)");
    assert!((volume - 120.0).abs() < 1e-9, "{volume}");
    assert!((mesh.bounds().unwrap().0.y + 2.0).abs() < 1e-9);
    // The box begins at 1 m, which is twice its own height, above its origin.
    let (mesh, _) = one("insertAlongUV(0, \"box\", 3, scope.y, keepPosition)");
    let (low, high) = mesh.bounds().unwrap();
    assert!((low.y - 6.0).abs() < 1e-9 && (high.y - 9.0).abs() < 1e-9);
}

#[test]
fn x_runs_along_u_and_z_against_v() {
    // u along the 10 m, v to the north, against z. The box with its middle on u = 0 gives halves.
    let set_up = "setupProjection(0, scope.xz, 4, 4) projectUV(0) scaleUV(0, 1, -1)";
    let (mesh, volume) = one(&format!("{set_up} insertAlongUV(0, \"tent\", 1)"));
    // Ridges at z = 2 and z = 6: one whole tent of 4 m and half of one of 2 m.
    assert!((volume - 10.0 * (2.0 + 1.0)).abs() < 1e-9, "{volume}");
    let ridge = mesh
        .points
        .iter()
        .filter(|point| (point.y - 1.0).abs() < 1e-9);
    for point in ridge {
        let off = (point.z - 2.0).abs().min((point.z - 6.0).abs());
        assert!(off < 1e-9, "{point}");
    }
}

#[test]
fn it_stands_on_walls_along_their_normals() {
    let wall = "extrude(4) comp(f) { front : Wall | all : NIL }\nWall -->";
    let text =
        format!("Lot --> {wall} insertAlongUV(0, \"box\", 0.5, vertex.normal, alignPosition) A.");
    let (mesh, volume) = solid(&laid(&text, lot()).unwrap());
    assert!((volume - 20.0).abs() < 1e-9, "{volume}");
    assert!((mesh.bounds().unwrap().1.z - 6.5).abs() < 1e-9);
    let along = format!("Lot --> {wall} insertAlongUV(0, \"box\", 0.5) A.");
    assert!(laid(&along, lot())
        .unwrap_err()
        .message
        .contains("vertex.normal"));
}

#[test]
fn it_bends_around_corners() {
    // The mantle of a prism of 14 sides, 3 m high: a shell between the prisms of 2 m and of 2.5 m.
    // None of its faces stands across the first, along which the texture lies.
    let text = "Lot --> primitiveCylinder(14, 2, 3) comp(f) { side = \
                insertAlongUV(0, \"box\", 0.5, vertex.normal, alignPosition) A. | all : NIL }";
    let (mesh, volume) = solid(&laid(text, lot()).unwrap());
    let prism = |radius: f64| 7.0 * (std::f64::consts::TAU / 14.0).sin() * radius * radius * 3.0;
    let truth = prism(2.5) - prism(2.0);
    assert!((volume - truth).abs() < 1e-6 * truth, "{volume} {truth}");
    assert!(mesh.is_closed());
}

#[test]
fn an_open_asset_is_cut_without_caps() {
    let text = "Lot --> scaleUV(0, 2.5, 1) insertAlongUV(0, \"fence\", 1) A.";
    let tree = laid(text, lot()).unwrap();
    let mesh = tree.leaves().next().unwrap().state.form.world_mesh();
    // Two and a half fences of 1 m over the 6 m along u, in the middle of v.
    assert!((mesh.area() - 6.0).abs() < 1e-9, "{}", mesh.area());
    assert!(mesh.points.iter().all(|point| (point.x - 5.0).abs() < 1e-9));
}

#[test]
fn what_cannot_be_laid_is_refused() {
    let flat = "setupProjection(0, scope.xy, 1, 1) projectUV(0)";
    let none = laid(
        &format!("Lot --> {flat} insertAlongUV(0, \"box\", 1)"),
        lot(),
    )
    .unwrap_err();
    assert!(none.message.contains("no extent"), "{}", none.message);
    let many = "Lot --> scaleUV(0, 1e6, 1e6) insertAlongUV(0, \"box\", 1)";
    let many = laid(many, lot()).unwrap_err();
    assert!(
        many.message.contains("more than 1000000"),
        "{}",
        many.message
    );
    let layer = laid("Lot --> insertAlongUV(10, \"box\", 1)", lot()).unwrap_err();
    assert!(layer.message.contains("layer 10"), "{}", layer.message);
    assert!(fault("Lot --> insertAlongUV(0, \"bok\", 1)").contains("`bok`"));
    let names = asset_names(&code("Lot --> insertAlongUV(0, \"bok\", 1)"));
    assert!(names.written.contains("bok"));
}

/// A lot with a bay and a court.
fn court() -> State {
    lot_of(&[
        &[
            (0.0, 0.0),
            (9.0, 0.0),
            (9.0, 7.0),
            (4.0, 7.0),
            (4.0, 5.0),
            (0.0, 5.0),
        ],
        &[(2.0, 1.0), (2.0, 3.0), (3.0, 3.0), (3.0, 1.0)],
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Boxes over any face fill all above it, however the texture lies.
    #[test]
    fn boxes_fill_what_is_above(
        scale in (0.3f64..4.0, 0.3f64..4.0),
        by in (-2.0f64..2.0, -2.0f64..2.0),
        angle in 0.0f64..360.0,
        height in 0.2f64..3.0,
    ) {
        let (su, sv) = scale;
        let (u, v) = by;
        let text = format!(
            "Lot --> rotateUV(0, {angle}) scaleUV(0, {su}, {sv}) translateUV(0, {u}, {v}) \
             insertAlongUV(0, \"box\", {height}) A."
        );
        let (_, volume) = solid(&laid(&text, court()).unwrap());
        let truth = (9.0 * 5.0 + 5.0 * 2.0 - 2.0) * height;
        prop_assert!((volume - truth).abs() < 1e-7 * truth, "{} {}", volume, truth);
    }

    /// Tents have the volume that their height has over the face.
    #[test]
    fn tents_have_the_volume_of_their_height(
        size in (1.5f64..6.0, 1.5f64..6.0),
        corner in (0.0f64..3.0, 0.0f64..3.0),
    ) {
        let (width, depth) = size;
        let (x, z) = corner;
        let text = format!(
            "Lot --> setupProjection(0, scope.xz, {width}, {depth}, {x}, {z}) projectUV(0) \
             insertAlongUV(0, \"tent\", 1) A."
        );
        let (_, volume) = solid(&laid(&text, lot()).unwrap());
        let steps = 20_000;
        let step = 6.0 / f64::from(steps);
        let truth: f64 = (0..steps)
            .map(|k| {
                let v = ((f64::from(k) + 0.5) * step - z) / depth;
                1.0 - (2.0 * v.rem_euclid(1.0) - 1.0).abs()
            })
            .sum::<f64>() * step * 10.0;
        prop_assert!((volume - truth).abs() < 1e-4 * truth, "{} {}", volume, truth);
    }
}
