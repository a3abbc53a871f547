//! All tests of the crate from outside, as one program: each program of its own would have the
//! same generic code compiled and linked again.

#[cfg(test)]
#[path = "support/draw.rs"]
mod draw;
#[cfg(test)]
#[path = "support/footprints.rs"]
mod footprints;
#[cfg(test)]
#[path = "support/roof_kinds.rs"]
mod roof_kinds;
#[cfg(test)]
#[path = "support/shapes.rs"]
mod shapes;

mod booleans;
mod booleans_random;
mod dissolving;
mod insets;
mod outlines_clean;
mod polygons;
mod roof_times;
mod roof_types;
mod roof_volumes;
mod roofs_by_hand;
mod roofs_everywhere;
mod roofs_real;
mod solids;

#[test]
fn every_file_of_tests_is_in_this_program() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let name = path.file_stem().unwrap().to_str().unwrap();
            let line = format!("\nmod {name};\n");
            let here = include_str!("main.rs").contains(&line);
            assert!(here || name == "main", "{name}.rs is not in main.rs");
        }
    }
}
