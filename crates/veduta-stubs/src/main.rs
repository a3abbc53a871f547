//! `veduta-stubs FOLDER` prints the stub of the sources that lie in a folder.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs};

fn main() -> ExitCode {
    let made = match env::args().nth(1) {
        Some(folder) => stub_of(Path::new(&folder)),
        None => Err("usage: veduta-stubs FOLDER".into()),
    };
    match made {
        Ok(text) => {
            print!("{text}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("veduta-stubs: {why}");
            ExitCode::FAILURE
        }
    }
}

fn stub_of(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|end| end == "rs") {
            let name = path.file_name().unwrap_or_default();
            files.push((
                name.to_string_lossy().into_owned(),
                fs::read_to_string(&path)?,
            ));
        }
    }
    files.sort();
    Ok(veduta_stubs::stub(&files)?)
}
