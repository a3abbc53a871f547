//! Shapes: split sizes against hand-worked truth, parts against what they came from.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::support::said;
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use veduta_geometry::solid::{extrude, Mesh};
use veduta_geometry::Unlimited;
use veduta_grammar::shape::{
    cells, components, is_selected, split, Cell, Direction, Form, Geometry, Kind, Pattern, Scope,
    Size,
};

const MOST: usize = 1000;

fn absolute(size: f64) -> Pattern {
    Pattern::Part(Size::Absolute(size))
}

fn floating(size: f64) -> Pattern {
    Pattern::Part(Size::Floating(size))
}

fn relative(size: f64) -> Pattern {
    Pattern::Part(Size::Relative(size))
}

fn repeat(patterns: &[Pattern]) -> Pattern {
    Pattern::Repeat(patterns.to_vec())
}

fn lengths(patterns: &[Pattern], whole: f64) -> Vec<(usize, f64)> {
    cells(patterns, whole, MOST)
        .unwrap()
        .iter()
        .map(|cell| (cell.part, (cell.length * 1e6).round() / 1e6))
        .collect()
}

#[test]
fn absolute_parts_stop_at_the_end() {
    let parts = [2.0, 1.0, 1.0, 2.0, 1.0].map(absolute);
    assert_eq!(
        lengths(&parts, 5.0),
        [(0, 2.0), (1, 1.0), (2, 1.0), (3, 1.0)]
    );
}

#[test]
fn parts_without_length_do_not_exist() {
    let parts = [1.5, -2.0, 1.5, 1.5, 0.0, 1.5].map(absolute);
    assert_eq!(
        lengths(&parts, 5.0),
        [(0, 1.5), (2, 1.5), (3, 1.5), (5, 0.5)]
    );
}

#[test]
fn floating_parts_share_the_rest() {
    let parts = [absolute(1.0), floating(3.0), absolute(1.0)];
    assert_eq!(lengths(&parts, 5.0), [(0, 1.0), (1, 3.0), (2, 1.0)]);
    assert_eq!(lengths(&parts, 8.0), [(0, 1.0), (1, 6.0), (2, 1.0)]);
    assert_eq!(lengths(&parts, 1.5), [(0, 1.0), (2, 0.5)]);
    let pair = [floating(1.0), relative(0.5), floating(3.0)];
    assert_eq!(lengths(&pair, 8.0), [(0, 1.0), (1, 4.0), (2, 3.0)]);
}

#[test]
fn a_repeat_comes_closest_to_its_floating_size() {
    assert_eq!(lengths(&[repeat(&[floating(2.1)])], 10.0), [(0, 2.0); 5]);
    assert_eq!(lengths(&[repeat(&[floating(3.0)])], 10.0).len(), 3);
    assert_eq!(lengths(&[repeat(&[floating(4.0)])], 1.0), [(0, 1.0)]);
    let windows = [
        absolute(1.0),
        repeat(&[absolute(1.0), floating(2.0)]),
        absolute(1.0),
    ];
    let found = lengths(&windows, 10.0);
    assert_eq!(found.len(), 8);
    assert_eq!(
        &found[1..3],
        &[(1, 1.0), (2, (5.0f64 / 3.0 * 1e6).round() / 1e6)]
    );
}

#[test]
fn an_absolute_repeat_is_cut_off_at_the_end() {
    assert_eq!(lengths(&[repeat(&[absolute(2.0)])], 10.0), [(0, 2.0); 5]);
    assert_eq!(
        lengths(&[repeat(&[absolute(4.0)])], 10.0),
        [(0, 4.0), (0, 4.0), (0, 2.0)]
    );
}

#[test]
fn what_floats_beside_an_absolute_repeat_takes_the_rest() {
    let parts = [floating(1.0), repeat(&[absolute(4.0)]), floating(1.0)];
    assert_eq!(
        lengths(&parts, 11.0),
        [(0, 1.5), (1, 4.0), (1, 4.0), (2, 1.5)]
    );
}

#[test]
fn a_repeat_in_a_repeat() {
    let inner = repeat(&[absolute(1.0), floating(1.0)]);
    let outer = [repeat(&[inner, absolute(2.0)])];
    assert_eq!(
        lengths(&outer, 8.0),
        [(0, 1.0), (1, 1.0), (2, 2.0), (0, 1.0), (1, 1.0), (2, 2.0)]
    );
}

#[test]
fn too_many_parts_are_refused() {
    let error = cells(&[repeat(&[absolute(1e-3)])], 1e9, MOST).unwrap_err();
    assert_eq!(error.most, MOST);
}

fn any_size() -> impl Strategy<Value = Pattern> {
    (0..3, 0.05..4.0f64).prop_map(|(kind, size)| match kind {
        0 => absolute(size),
        1 => relative(size / 8.0),
        _ => floating(size),
    })
}

fn any_pattern() -> impl Strategy<Value = Vec<Pattern>> {
    let part = any_size().prop_recursive(2, 8, 3, |inner| {
        prop::collection::vec(inner, 1..3).prop_map(Pattern::Repeat)
    });
    prop::collection::vec(part, 1..6)
}

proptest! {
    #[test]
    fn cells_lie_side_by_side_within_the_whole(parts in any_pattern(), whole in 0.1..40.0f64) {
        let found = cells(&parts, whole, 100_000).unwrap();
        let mut at = 0.0;
        for cell in &found {
            prop_assert!((cell.start - at).abs() < 1e-9);
            prop_assert!(cell.length > 0.0);
            at = cell.start + cell.length;
        }
        prop_assert!(at <= whole + 1e-9);
    }

    #[test]
    fn what_floats_fills_the_whole(parts in any_pattern(), whole in 20.0..40.0f64) {
        let mut with_rest = parts;
        with_rest.push(floating(0.01));
        let found = cells(&with_rest, whole, 100_000).unwrap();
        let sum: f64 = found.iter().map(|cell| cell.length).sum();
        prop_assert!((sum - whole).abs() < 1e-5, "{sum} of {whole}");
    }
}

fn box_of(x: f64, y: f64, z: f64) -> Form {
    Form {
        scope: Scope::of_size(DVec3::new(x, y, z)),
        geometry: Geometry::Box,
    }
}

#[test]
fn the_faces_of_a_box() {
    use Direction::{Back, Bottom, Front, Left, Right, Top};
    let faces = components(&box_of(2.0, 3.0, 4.0), Kind::Faces);
    let looks: Vec<_> = faces.iter().map(|face| face.direction.unwrap()).collect();
    assert_eq!(looks, [Bottom, Top, Front, Back, Left, Right]);
    let sizes: Vec<_> = faces.iter().map(|f| f.form.scope.size.to_array()).collect();
    assert_eq!(sizes[1], [2.0, 4.0, 0.0]);
    assert_eq!(sizes[2], [2.0, 3.0, 0.0]);
    assert_eq!(sizes[5], [4.0, 3.0, 0.0]);
    let right = &faces[5].form.scope;
    assert_eq!(right.origin, DVec3::new(2.0, 0.0, 4.0));
    assert_eq!(right.axes.x_axis, DVec3::NEG_Z);
    assert_eq!(right.axes.y_axis, DVec3::Y);
}

fn turned() -> impl Strategy<Value = DMat3> {
    (-3.0..3.0f64, -3.0..3.0f64, -3.0..3.0f64)
        .prop_map(|(a, b, c)| DMat3::from_euler(glam::EulerRot::XYZ, a, b, c))
}

proptest! {
    /// The short way for boxes gives what the long way for faces does.
    #[test]
    fn a_box_is_its_faces(axes in turned(), x in 0.5..9.0f64, y in 0.5..9.0f64, z in 0.5..9.0f64) {
        let mut short = box_of(x, y, z);
        short.scope.axes = axes;
        let mesh = std::sync::Arc::new(short.geometry.mesh());
        let long = Form { geometry: Geometry::Faces { mesh, solid: true }, ..short.clone() };
        let pairs = components(&short, Kind::Faces).into_iter().zip(components(&long, Kind::Faces));
        for (one, other) in pairs {
            prop_assert_eq!(one.direction, other.direction);
            let (a, b) = (one.form.world_mesh(), other.form.world_mesh());
            prop_assert!((a.area() - b.area()).abs() < 1e-6);
            prop_assert!(a.face(0).normal().abs_diff_eq(b.face(0).normal(), 1e-6));
            let middle = |mesh: &Mesh| mesh.points.iter().sum::<DVec3>() / 4.0;
            prop_assert!(middle(&a).abs_diff_eq(middle(&b), 1e-6));
            prop_assert_eq!(&other.form.geometry, &Geometry::Rectangle(2));
        }
    }

    #[test]
    fn parts_add_up(axis in 0usize..3, at in 0.05..0.95f64) {
        let profile = [(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (3.0, 4.0), (0.0, 2.0)];
        let gable = Mesh::polygon(&[profile.map(|(x, y)| DVec3::new(x, y, 0.0))]);
        let form = Form::around(extrude(&gable, 5.0 * DVec3::Z), DMat3::IDENTITY, true);
        let size = form.scope.size[axis];
        let cut = |start, length| Cell { part: 0, start, length };
        let pair = [cut(0.0, at * size), cut(at * size, (1.0 - at) * size)];
        for adjust in [true, false] {
            let parts = split(&form, axis, &pair, adjust, &Unlimited).unwrap();
            prop_assert_eq!(parts.len(), 2);
            let volume: f64 = parts.iter().map(|(_, part)| part.world_mesh().volume()).sum();
            prop_assert!((volume - 90.0).abs() < 1e-6, "{volume}");
            for (_, part) in parts {
                prop_assert!(part.world_mesh().is_closed());
                let points = part.geometry.mesh().points;
                let fits = |p: &DVec3| p.cmpge(DVec3::splat(-1e-9)).all() && p.cmple(DVec3::splat(1.0 + 1e-9)).all();
                prop_assert!(points.iter().all(fits));
            }
        }
    }
}

#[test]
fn the_sides_of_a_roof_look_up() {
    let profile = [(0.0, 0.0), (6.0, 0.0), (3.0, 3.0)];
    let gable = Mesh::polygon(&[profile.map(|(x, y)| DVec3::new(x, y, 0.0))]);
    let form = Form::around(extrude(&gable, 5.0 * DVec3::Z), DMat3::IDENTITY, true);
    let faces = components(&form, Kind::Faces);
    let tops = faces
        .iter()
        .filter(|face| is_selected("top", face.direction) == Some(true));
    assert_eq!(tops.count(), 2);
    assert_eq!(is_selected("upwards", None), None);
}

#[test]
fn edges_and_corners() {
    let form = box_of(2.0, 3.0, 4.0);
    let edges = components(&form, Kind::Edges);
    let sum: f64 = edges.iter().map(|edge| edge.form.scope.size.x).sum();
    assert_eq!((edges.len(), sum), (12, 36.0));
    assert_eq!(components(&form, Kind::Vertices).len(), 8);
}

#[test]
fn primitives_fill_the_scope_as_assets_do() {
    let sizes = "print(scope.sx) print(scope.sy) print(scope.sz)";
    // A lot of 10 m by 6 m: the height is the mean of the two.
    assert_eq!(
        said(&format!("Lot --> primitiveCube() {sizes}")),
        ["10", "8", "6"]
    );
    assert_eq!(
        said(&format!("Lot --> s(0, 0, 0) primitiveCube() {sizes}")),
        ["1", "1", "1"]
    );
    // Of a size of its own it stands in the middle of the floor.
    let places = "print(scope.tx) print(scope.ty) print(scope.tz)";
    assert_eq!(
        said(&format!("Lot --> primitiveCube(1, 2, 3) {places}")),
        ["4.5", "0", "1.5"]
    );
    assert_eq!(
        said(&format!("Lot --> primitiveQuad(4, 2) {places}")),
        ["3", "0", "2"]
    );
}

#[test]
fn flat_primitives_lie_in_the_plane_of_a_flat_scope() {
    let of_front = |operation: &str, asked: &str| {
        said(&format!(
            "Lot --> extrude(3) comp(f) {{ front : {operation} {asked} NIL }}"
        ))
    };
    let told = "print(geometry.area) print(scope.sx) print(scope.sy) print(scope.sz)";
    assert_eq!(of_front("primitiveQuad()", told), ["30", "10", "3", "0"]);
    assert_eq!(of_front("primitiveQuad(4, 1)", told), ["4", "4", "1", "0"]);
    assert_eq!(of_front("primitiveDisk(4)", &told[21..]), ["10", "3", "0"]);
    assert_eq!(
        of_front("primitiveDisk(4)", "print(geometry.isOriented(front))"),
        ["true"]
    );
    let middle = "print(rint(1e6 * scope.sx) / 1e6) print(scope.sz) print(rint(1e6 * scope.elevation) / 1e6)";
    assert_eq!(of_front("primitiveDisk(4, 1)", middle), ["2", "0", "0.5"]);
}
