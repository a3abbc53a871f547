//! `veduta_surface` for Python: a grid of values in, a mesh out, the GIL released in between.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray3};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_surface::{surface_nets, Grid, Surface, SurfaceError};

create_exception!(_core, SurfaceFault, PyValueError);

pub type Arrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<u32>>);

pub fn fault_of(error: SurfaceError) -> PyErr {
    SurfaceFault::new_err(error.to_string())
}

pub fn arrays_of(py: Python<'_>, surface: Surface) -> Arrays<'_> {
    let positions = Array2::from(surface.positions).into_pyarray(py);
    (positions, Array2::from(surface.triangles).into_pyarray(py))
}

/// Vertices (v, 3) in samples and triangles (m, 3), counter-clockwise seen from outside, where the
/// values (x, y, z) pass the level; less is inside, NaN is not known.
#[pyfunction]
fn extract_surface<'py>(
    py: Python<'py>,
    values: PyReadonlyArray3<'py, f32>,
    level: f32,
    close: bool,
) -> PyResult<Arrays<'py>> {
    let view = values.as_array();
    let (nx, ny, nz) = view.dim();
    let standard = view.as_standard_layout();
    let Some(values) = standard.as_slice() else {
        return Err(PyValueError::new_err("the values are not contiguous"));
    };
    let made = py.detach(|| surface_nets(&Grid::new(values, [nx, ny, nz])?, level, close));
    Ok(arrays_of(py, made.map_err(fault_of)?))
}

/// Adds the functions and errors of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("SurfaceFault", m.py().get_type::<SurfaceFault>())?;
    m.add_function(wrap_pyfunction!(extract_surface, m)?)
}
