//! What holds of a program that all tests of a crate are in.

/// Fails where a file of tests in a folder is no module of the program's source.
pub fn assert_whole(folder: &str, source: &str) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let name = path.file_stem().unwrap().to_str().unwrap();
            let here = source.contains(&format!("\nmod {name};\n"));
            assert!(here || name == "main", "{name}.rs is not in main.rs");
        }
    }
}
