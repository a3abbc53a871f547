//! All tests of the crate from outside, as one program: each program of its own would have the
//! same generic code compiled and linked again.

#[cfg(test)]
#[path = "../../veduta-geometry/tests/support/draw.rs"]
mod draw;
#[cfg(test)]
#[path = "../../veduta-geometry/tests/support/program.rs"]
mod program;
#[cfg(test)]
mod programs;
#[cfg(test)]
mod support;
#[cfg(test)]
mod trees;

mod along_uv;
mod arrays;
mod assets;
mod budgets;
mod components;
mod conformance;
mod derivation;
mod diagnostics;
mod documents;
mod edges;
mod extruding;
mod files;
mod format;
mod generated;
mod hostile;
mod importing;
mod inlining;
mod measures;
mod mutated_files;
mod occlusion;
mod older_forms;
mod packing;
mod perimeter;
mod pivots;
mod random_programs;
mod reaching;
mod rederivation;
mod reference;
mod reshaping;
mod roofs;
mod scopes;
mod setbacks;
mod shapes;
mod snapping;
mod tagging;

#[test]
fn every_file_of_tests_is_in_this_program() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests");
    program::assert_whole(folder, include_str!("main.rs"));
}
