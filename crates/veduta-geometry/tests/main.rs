//! All tests of the crate from outside, as one program: each program of its own would have the
//! same generic code compiled and linked again.

#[cfg(test)]
#[path = "support/draw.rs"]
mod draw;
#[cfg(test)]
#[path = "support/footprints.rs"]
mod footprints;
#[cfg(test)]
#[path = "support/program.rs"]
mod program;
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
    program::assert_whole(folder, include_str!("main.rs"));
}
