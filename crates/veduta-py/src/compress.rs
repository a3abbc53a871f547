//! Compression of columns for Python.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// A column as EXT_meshopt_compression has it, mode ATTRIBUTES; `stride` in bytes.
#[pyfunction]
fn compress_attributes(py: Python<'_>, data: &[u8], stride: usize) -> PyResult<Py<PyBytes>> {
    let found = py.detach(|| veduta_tiles::compress_attributes(data, stride));
    let bad = || PyValueError::new_err("the stride is no multiple of four, or cuts an element");
    Ok(PyBytes::new(py, &found.ok_or_else(bad)?).unbind())
}

/// The same for whole numbers of `stride` bytes (2 or 4), mode INDICES.
#[pyfunction]
fn compress_indices(py: Python<'_>, data: &[u8], stride: usize) -> PyResult<Py<PyBytes>> {
    if !(stride == 2 || stride == 4) || data.len() % stride != 0 {
        return Err(PyValueError::new_err("indices have two or four bytes"));
    }
    let made = py.detach(|| {
        let each = data.chunks_exact(stride).map(|word| {
            let bytes = word.iter().rev();
            bytes.fold(0u32, |number, byte| (number << 8) | u32::from(*byte))
        });
        veduta_tiles::compress_indices(each)
    });
    Ok(PyBytes::new(py, &made).unbind())
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(compress_attributes, m)?)?;
    m.add_function(wrap_pyfunction!(compress_indices, m)?)
}
