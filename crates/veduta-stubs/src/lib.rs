//! The types of the extension for Python: a stub of what `#[pyfunction]`, `#[pyclass]`,
//! `#[pymethods]` and `create_exception!` declare in its sources.
//!
//! It reads what the extension uses and no more: what it does not know is an error, never `Any`.

mod items;
mod signature;
mod types;

use items::Items;
use types::Names;

/// Why there is no stub.
#[derive(Debug, thiserror::Error)]
pub enum StubError {
    #[error("{file}: {why}")]
    Syntax { file: String, why: String },
    #[error("{file}: {name}: the type `{what}` has no counterpart in Python here")]
    Type {
        file: String,
        name: String,
        what: String,
    },
    #[error("{file}: {name}: {why}")]
    Declaration {
        file: String,
        name: String,
        why: String,
    },
}

const HEAD: &str = r#""""The private Rust extension. Generated from its sources by `make stubs`: do not edit."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

_T = TypeVar("_T", bound=np.generic)
_Array1 = np.ndarray[tuple[int], np.dtype[_T]]
_Array2 = np.ndarray[tuple[int, int], np.dtype[_T]]
_Array3 = np.ndarray[tuple[int, int, int], np.dtype[_T]]
"#;

/// The stub of these files (name and text of each), in their order; its lines are not wrapped.
pub fn stub(files: &[(String, String)]) -> Result<String, StubError> {
    let mut parsed = Vec::with_capacity(files.len());
    for (name, text) in files {
        let file = syn::parse_file(text).map_err(|why| StubError::Syntax {
            file: name.clone(),
            why: why.to_string(),
        })?;
        parsed.push((name.as_str(), file));
    }
    let names = Names::of(&parsed);
    let items = Items::of(&parsed)?;
    let mut text = String::from(HEAD);
    for (file, _) in &parsed {
        let own = items.written(file, &names)?;
        if !own.is_empty() {
            text += &format!("\n# {file}\n{own}");
        }
    }
    Ok(text)
}

/// A stub without what a formatter may change: white space, and commas before closing brackets.
pub fn unformatted(stub: &str) -> String {
    let dense: String = stub.chars().filter(|c| !c.is_whitespace()).collect();
    dense.replace(",)", ")").replace(",]", "]")
}
