//! Forms of older rule files, and of files of others: they derive as they were meant.

use std::collections::HashMap;
use std::sync::Arc;

use veduta_grammar::engine::{lower, Files, Options, Value};
use veduta_grammar::{check, Program, Source};

use super::support::{said, said_with, tree};

fn sizes(text: &str) -> Vec<String> {
    said(text)
}

#[test]
fn a_group_without_a_star_stands_once() {
    let told = |cells: &str| {
        sizes(&format!(
            "Lot --> split(x) {{ {cells} }} A --> print(scope.sx)"
        ))
    };
    // The lot is 10 m wide.
    assert_eq!(
        told("2 : A | { ~1 : A | 3 : A } | 1 : A"),
        ["2", "4", "3", "1"]
    );
    assert_eq!(told("2 : A | { ~1 : A }* | 2 : A").len(), 8);
    assert_eq!(told("{ { 4 : A } | ~1 : A }"), ["4", "6"]);
}

#[test]
fn the_axes_of_the_world_are_directions() {
    let height = |direction: &str| {
        let found = tree(&format!("Lot --> extrude({direction}, 7)"));
        let leaf = found.leaves().next().unwrap();
        leaf.state.form.world_mesh().volume()
    };
    for direction in ["world.y", "world.up", "y"] {
        assert!(
            (height(direction) - 10.0 * 6.0 * 7.0).abs() < 1e-9,
            "{direction}"
        );
    }
}

#[test]
fn older_operations_do_what_newer_ones_do() {
    assert_eq!(said("Lot --> innerRect print(geometry.area)"), ["60"]);
    assert_eq!(
        said("Lot --> offsetUV(0, 0.5, 0) print(geometry.uMin(0))"),
        ["0.5"]
    );
    let moved = "setupProjection(0, scope.xz, 2, 2, 1) projectUV(0) print(geometry.uMin(0))";
    assert_eq!(said(&format!("Lot --> {moved}")), ["-0.5"]);
    // The lot of 4 m x 6 m begins with an edge along x.
    for (edge, along) in [(0, "4"), (1, "6"), (-1, "6")] {
        let align = format!("alignScopeToGeometry(yUp, {edge}) print(scope.sx)");
        assert_eq!(said(&format!("Lot --> s(4, '1, '1) {align}")), [along]);
    }
}

#[test]
fn cells_without_a_size_take_what_is_left() {
    let told = |cells: &str| said(&format!("Lot --> split(x) {cells} A --> print(scope.sx)"));
    // The lot is 10 m wide.
    assert_eq!(told("{ A }"), ["10"]);
    assert_eq!(
        told("{ 2 : A | split(z) { 1 : A | ~1 : NIL } | 3 : A }"),
        ["2", "5", "3"]
    );
    assert_eq!(
        told("{ 4 : A | split(x) { 2 : A }* }"),
        ["4", "2", "2", "2"]
    );
}

#[test]
fn colours_of_three_digits_and_an_older_name_of_the_opacity() {
    let values = "print(material.color.rgb) print(material.color.a)";
    assert_eq!(
        said(&format!("Lot --> color(\"#1af\") {values}")),
        ["#11aaff", "1"]
    );
    assert_eq!(
        said(&format!("Lot --> color(\"#1af8\") {values}"))[0],
        "#11aaff"
    );
    let half = "set(material.color.a, 0.5) print(material.opacity)";
    assert_eq!(said(&format!("Lot --> {half}")), ["0.5"]);
}

#[test]
fn a_texture_as_high_as_a_flat_shape_derives() {
    let flat = "setupProjection(0, scope.xy, 2, '1) projectUV(0) print(geometry.uMin(0))";
    assert_eq!(said(&format!("Lot --> {flat}")), ["0"]);
}

fn project() -> Options {
    let names = [
        "a/roof.png",
        "a/wall_1.jpg",
        "a/wall_2.jpg",
        "heights.csv",
        "wall.jpg",
    ];
    let table = "name;height\nhouse;9.5\ntower;40\n";
    let files = Files {
        names: names.iter().map(|&name| name.into()).collect(),
        texts: HashMap::from([
            ("heights.csv".into(), table.into()),
            ("a/wall.mtl".into(), MATERIAL.into()),
        ]),
        pictures: HashMap::from([("wall.jpg".into(), [400.0, 200.0])]),
        metadata: HashMap::from([(
            "a/tree.glb".into(),
            HashMap::from([("species".into(), Value::text("Tilia"))]),
        )]),
    };
    Options {
        files: Arc::new(files),
        ..Options::default()
    }
}

const MATERIAL: &str = "# of a wall\nnewmtl brick\nKd 0.5 0.25 0\nd 0.5\nNs 20\n\
                        map_Kd -s 2 2 2 red.jpg\nnewmtl another\nKd 1 1 1\n";

#[test]
fn materials_and_metadata_of_files() {
    let told = |text: &str| said_with(&format!("Lot --> {text}"), &project());
    let read = "setMaterial(readMaterial(\"/a/wall.mtl\"))";
    let names = ["name", "color.g", "opacity", "shininess", "colormap"];
    let names = names
        .map(|name| format!(" print(material.{name})"))
        .concat();
    assert_eq!(
        told(&format!("{read}{names}")),
        ["brick", "0.25", "0.5", "20", "a/red.jpg"]
    );
    let kept =
        "color(\"#102030\") setMaterial(readMaterial(\"a/wall.cgamat\")) print(material.color.rgb)";
    assert_eq!(told(kept), ["#102030"]);
    let species = |key: &str, default: &str| {
        told(&format!(
            "print(assetMetadata(\"a/tree.glb\", \"{key}\", {default}))"
        ))
    };
    assert_eq!(species("species", "\"\""), ["Tilia"]);
    assert_eq!(species("species", "4"), ["4"]);
    assert_eq!(species("age", "4"), ["4"]);
    assert_eq!(
        told("print(assetMetadata(\"none.glb\", \"age\", 5))"),
        ["5"]
    );
}

#[test]
fn files_are_found_by_patterns() {
    let told = |value: &str| said_with(&format!("Lot --> print({value})"), &project());
    assert_eq!(told("fileSearch(\"*.jpg\")"), ["wall.jpg"]);
    assert_eq!(
        told("fileSearch(\"a/wall*.jpg\")"),
        ["a/wall_1.jpg;a/wall_2.jpg"]
    );
    assert_eq!(
        told("fileSearch(\"$wall*.JPG\")"),
        ["a/wall_1.jpg;a/wall_2.jpg;wall.jpg"]
    );
    assert_eq!(told("fileSearch(\"*.gif\")"), [""]);
    assert_eq!(told("fileExists(\"/a/roof.png\")"), ["true"]);
    assert_eq!(told("fileExists(\"roof.png\")"), ["false"]);
    assert_eq!(
        told("imageInfo(\"wall.jpg\", sx) / imageInfo(\"wall.jpg\", sy)"),
        ["2"]
    );
}

#[test]
fn a_random_file_is_one_of_those_that_fit() {
    let text = "Lot --> split(x) { { 0.25 : A }* } A --> print(fileRandom(\"a/wall*\"))";
    let told = said_with(text, &project());
    let each =
        ["a/wall_1.jpg", "a/wall_2.jpg"].map(|name| told.iter().filter(|one| *one == name).count());
    assert_eq!(each[0] + each[1], 40);
    assert!(each.iter().all(|&count| count > 8), "{each:?}");
    assert_eq!(
        said_with(text, &project()),
        told,
        "the same seed, the same files"
    );
    assert_eq!(
        said_with("Lot --> print(fileRandom(\"*.tif\"))", &project()),
        [""]
    );
}

#[test]
fn tables_are_read_into_arrays() {
    let told = |value: &str| said_with(&format!("Lot --> print({value})"), &project());
    assert_eq!(told("nRows(readStringTable(\"heights.csv\"))"), ["3"]);
    assert_eq!(told("readStringTable(\"heights.csv\")[2, 0]"), ["tower"]);
    assert_eq!(told("readFloatTable(\"heights.csv\")[1, 1]"), ["9.5"]);
}

#[test]
fn names_with_spaces_are_one_cell_and_numbers_between_spaces_are_several() {
    let mut options = project();
    options.files = Arc::new(Files {
        texts: HashMap::from([
            ("streets.txt".into(), "Main Street\nHigh Street\n".into()),
            ("rows.txt".into(), "1 2.5 3\n4 5 6\n".into()),
        ]),
        ..Files::default()
    });
    let told = |value: &str| said_with(&format!("Lot --> print({value})"), &options);
    let street = told("readStringTable(\"streets.txt\")[1, 0]");
    assert_eq!(street, ["High Street"]);
    assert_eq!(told("readFloatTable(\"rows.txt\")[1, 2]"), ["6"]);
}

#[test]
fn what_no_reference_has_is_taken_for_nothing() {
    // Not the slip of a pen, so that the file derives, and says what it was taken for.
    let text = "Lot --> print(3 + geometry.lowerheight) print(2 * scope.curvature(2) + 1)";
    assert_eq!(sizes(text), ["3", "1"]);
    let program = Program::single(Source::new("test.cga", text));
    let checked = check(&program);
    assert!(checked.diagnostics[0].is_empty());
    let lowered = lower(&program, &checked);
    let told = lowered.diagnostics.into_iter().flatten();
    let told: Vec<String> = told.map(|one| one.message).collect();
    assert_eq!(
        told,
        [
            "`geometry.lowerheight` does not derive: it is taken for 0",
            "`scope.curvature` does not derive: it is taken for 0"
        ]
    );
    // A slip is one, and other names are nobody's.
    for wrong in ["geometry.aera", "scope.zx", "height", "lib.height"] {
        let program = Program::single(Source::new("test.cga", format!("Lot --> print({wrong})")));
        assert_eq!(check(&program).diagnostics[0].len(), 1, "{wrong}");
    }
}
