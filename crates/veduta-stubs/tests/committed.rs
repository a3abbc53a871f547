//! The stub that is committed is what the sources give.

use std::fs;
use std::path::PathBuf;

use veduta_stubs::{stub, unformatted};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn the_committed_stub_is_generated() {
    let sources = fs::read_dir(root().join("crates/veduta-py/src")).unwrap();
    let mut files: Vec<(String, String)> = sources
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "rs"))
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(path).unwrap())
        })
        .collect();
    files.sort();
    let committed = fs::read_to_string(root().join("python/veduta/_core.pyi")).unwrap();
    let same = unformatted(&stub(&files).unwrap()) == unformatted(&committed);
    assert!(
        same,
        "python/veduta/_core.pyi is out of date: run `make stubs`"
    );
}
