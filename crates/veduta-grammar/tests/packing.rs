//! Leaves as columns: what was derived is what is there.

#![allow(clippy::unwrap_used)] // helpers of tests

use veduta_grammar::engine::{derive, lot_form, lower, pack, surfaces, Options, Packed, State};
use veduta_grammar::{check, Program, Source};

fn packed(text: &str, rings: &[Vec<[f64; 3]>]) -> Packed {
    let program = Program::single(Source::new("test.cga", text));
    let code = lower(&program, &check(&program)).code;
    let start = State::new(lot_form(rings).unwrap(), 0);
    pack(&derive(&code, 0, start, &Options::default()).unwrap())
}

fn square(low: f64, high: f64, up: f64) -> Vec<[f64; 3]> {
    vec![
        [low, low, up],
        [high, low, up],
        [high, high, up],
        [low, high, up],
    ]
}

fn area(packed: &Packed, polygon: usize) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let rings = packed.polygon_offsets[polygon]..packed.polygon_offsets[polygon + 1];
    for ring in rings {
        let from = packed.ring_offsets[ring as usize] as usize;
        let to = packed.ring_offsets[ring as usize + 1] as usize;
        for k in from..to {
            let a = packed.positions[k];
            let b = packed.positions[if k + 1 == to { from } else { k + 1 }];
            for axis in 0..3 {
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                sum[axis] += 0.5 * (a[u] * b[v] - a[v] * b[u]);
            }
        }
    }
    sum
}

#[test]
fn a_lot_stays_where_it_is() {
    let found = packed("Lot -->", &[square(2.0, 6.0, 3.0)]);
    assert_eq!(found.positions.len(), 4);
    assert_eq!(area(&found, 0), [0.0, 0.0, 16.0]);
    for point in &found.positions {
        assert!(square(2.0, 6.0, 3.0).contains(point), "{point:?}");
    }
}

#[test]
fn a_lot_that_runs_clockwise_looks_up_too() {
    let mut ring = square(0.0, 4.0, 0.0);
    ring.reverse();
    assert_eq!(area(&packed("Lot -->", &[ring]), 0)[2], 16.0);
}

#[test]
fn a_courtyard_stays_open() {
    let mut hole = square(3.0, 5.0, 0.0);
    hole.reverse();
    let rings = [square(0.0, 8.0, 0.0), hole];
    let found = packed("Lot --> extrude(10) color(1, 0, 0)", &rings);
    assert_eq!(found.polygon_feature.len(), 2 + 8);
    assert_eq!(found.looks.len(), 1);
    assert_eq!(found.looks[0].colour, [1.0, 0.0, 0.0]);
    let up: f64 = (0..10).map(|p| area(&found, p)[2].max(0.0)).sum();
    assert!((up - 60.0).abs() < 1e-9);
    let volume: f64 = (0..10)
        .map(|p| {
            let ring = found.polygon_offsets[p] as usize;
            let first = found.positions[found.ring_offsets[ring] as usize];
            let area = area(&found, p);
            (0..3).map(|axis| first[axis] * area[axis]).sum::<f64>() / 3.0
        })
        .sum();
    assert!((volume - 600.0).abs() < 1e-9, "{volume}");
}

#[test]
fn fronts_look_away_from_the_lot() {
    let text = "Lot --> extrude(3) comp(f) { front : F. | all : NIL }";
    let found = packed(text, &[square(0.0, 4.0, 0.0)]);
    // x of the scope runs along the first edge: the front is at the street, in the south.
    assert_eq!(area(&found, 0), [0.0, -12.0, 0.0]);
    assert_eq!(found.uv[2], [1.0, 1.0]);
}

#[test]
fn what_encloses_nothing_is_no_lot() {
    assert!(lot_form(&[]).is_none());
    assert!(lot_form(&[vec![[0.0; 3], [1.0, 0.0, 0.0]]]).is_none());
    let line = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    assert!(lot_form(&[line]).is_none());
}

#[test]
fn what_one_rule_makes_of_one_class_is_one_surface() {
    let text = "Lot --> split(x) { 1 : Window | 1 : Window | ~1 : Wall }
        Window --> set(material.name, \"window\") split(z) { 1 : Frame | ~1 : Pane }
        Frame --> extrude(0.1)
        Pane --> color(\"#112233\")
        Wall -->";
    let program = Program::single(Source::new("test.cga", text));
    let code = lower(&program, &check(&program)).code;
    let start = State::new(lot_form(&[square(0.0, 4.0, 0.0)]).unwrap(), 0);
    let tree = derive(&code, 0, start, &Options::default()).unwrap();
    let found = surfaces(&tree, &pack(&tree), &code);
    let names: Vec<&str> = found
        .node
        .iter()
        .map(|&n| &*tree.nodes[n as usize].name)
        .collect();
    let classes: Vec<&str> = found.class.iter().map(|class| &**class).collect();
    assert_eq!(names, ["Window", "Window", "Wall"]);
    assert_eq!(classes, ["window", "window", ""]);
    assert_eq!(found.of_feature, [0, 0, 1, 1, 2]);
    assert_eq!(found.size[0][0], 1.0);
}

#[test]
fn surfaces_are_what_the_rules_name() {
    let text = "attr surface = \"\"
        attr solid = \"\"
        attr provenance = \"invented\"
        Lot --> set(surface, \"wall\") set(material.name, \"wall\") [ Balcony ] Cells
        Cells --> split(x) { 1 : Wall. | 1 : Window | ~1 : Wall. }
        Window --> set(surface, \"window\") set(provenance, \"measured\") Pane.
        Balcony --> set(surface, \"balcony\") set(solid, \"balcony\") extrude(1)";
    let program = Program::single(Source::new("test.cga", text));
    let code = lower(&program, &check(&program)).code;
    let start = State::new(lot_form(&[square(0.0, 4.0, 0.0)]).unwrap(), 0);
    let tree = derive(&code, 0, start, &Options::default()).unwrap();
    let found = surfaces(&tree, &pack(&tree), &code);
    let texts =
        |column: &[std::sync::Arc<str>]| column.iter().map(|t| t.to_string()).collect::<Vec<_>>();
    assert_eq!(texts(&found.name), ["balcony", "wall", "window"]);
    assert_eq!(texts(&found.within), ["wall", "", "wall"]);
    assert_eq!(texts(&found.solid), ["balcony", "", ""]);
    assert_eq!(texts(&found.provenance), ["", "", "measured"]);
    // Both ends of the wall are one surface, of the size of what was cut.
    assert_eq!(found.of_feature, [0, 1, 1, 2]);
    assert_eq!(found.size[1], [4.0, 0.0]);
    assert_eq!(found.size[2][0], 1.0);
}

#[test]
fn names_of_surfaces_that_are_no_texts_say_nothing() {
    let text = "attr surface = 0  Lot --> set(surface, 3) Wall.";
    let program = Program::single(Source::new("test.cga", text));
    let code = lower(&program, &check(&program)).code;
    let start = State::new(lot_form(&[square(0.0, 4.0, 0.0)]).unwrap(), 0);
    let tree = derive(&code, 0, start, &Options::default()).unwrap();
    assert_eq!(&*surfaces(&tree, &pack(&tree), &code).name[0], "");
}

#[test]
fn each_face_has_texture_coordinates_of_its_own() {
    let uv = |tail: &str| {
        packed(
            &format!("Lot --> extrude(2) {tail}"),
            &[square(0.0, 4.0, 0.0)],
        )
        .uv
    };
    let ends = |uv: &[[f32; 2]], axis: usize| {
        let each = uv.iter().map(|one| one[axis]);
        (
            each.clone().fold(f32::INFINITY, f32::min),
            each.fold(f32::NEG_INFINITY, f32::max),
        )
    };
    // A picture from above is flat on the sides: of the whole shape v is there 0 or 1, of each face it
    // grows along the side.
    let from_above = "setupProjection(0, world.xz, 1, 1) projectUV(0)";
    let apart = uv(&format!(
        "{from_above} rotateUV(0, 45) normalizeUV(0, uv, separatePerFace)"
    ));
    assert_eq!(apart.len(), 24);
    for face in apart.chunks(4) {
        for axis in 0..2 {
            let (low, high) = ends(face, axis);
            assert!(low.abs() < 1e-6 && (high - 1.0).abs() < 1e-6, "{face:?}");
        }
    }
    // What is done to them afterwards is done on each face.
    let doubled = uv(&format!(
        "{from_above} rotateUV(0, 45) normalizeUV(0, uv, separatePerFace) scaleUV(0, 2, 3) translateUV(0, 1, 0)"
    ));
    for (face, before) in doubled.chunks(4).zip(apart.chunks(4)) {
        for (now, then) in face.iter().zip(before) {
            let wanted = [2.0 * then[0] + 1.0, 3.0 * then[1]];
            assert!((0..2).all(|axis| (now[axis] - wanted[axis]).abs() < 1e-5));
        }
    }
    // A face keeps what it had when it is taken out and divided.
    let halves = uv(
        "normalizeUV(0, uv, separatePerFace) comp(f) { front : split(x) { ~1 : A. | ~1 : B. } }",
    );
    let (first, second) = halves.split_at(4);
    assert_eq!((ends(first, 0), ends(second, 0)), ((0.0, 0.5), (0.5, 1.0)));
}
