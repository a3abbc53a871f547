//! `veduta_surface` for Python: a grid of values in, a mesh out; points and a mesh in, distances out.
//! The GIL is released in between.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_surface::{nearest_on_mesh, surface_nets, vertex_pieces, Grid, Surface, SurfaceError};

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

pub type Nearest<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<u32>>);

/// Signed distances of points (n, 3) from a mesh, above 0 on the side from which its triangles (m, 3)
/// run counter-clockwise, and the nearest triangle of each.
#[pyfunction]
fn distances_from_mesh<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    positions: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, u32>,
) -> PyResult<Nearest<'py>> {
    let points = rows_of(&points)?;
    let positions = rows_of(&positions)?;
    let triangles = rows_of(&triangles)?;
    let found = py.detach(|| nearest_on_mesh(&points, &positions, &triangles));
    let found = found.map_err(fault_of)?;
    Ok((
        found.distances.into_pyarray(py),
        found.triangles.into_pyarray(py),
    ))
}

/// The piece (v,) of each of so many vertices of triangles (m, 3): those of one triangle are of one.
#[pyfunction]
fn pieces_of_mesh<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray2<'py, u32>,
    vertices: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let triangles = rows_of(&triangles)?;
    let found = py.detach(|| vertex_pieces(&triangles, vertices));
    Ok(found.map_err(fault_of)?.into_pyarray(py))
}

fn rows_of<T: numpy::Element + Copy>(array: &PyReadonlyArray2<'_, T>) -> PyResult<Vec<[T; 3]>> {
    let view = array.as_array();
    if view.ncols() != 3 {
        return Err(PyValueError::new_err("rows must have three columns"));
    }
    Ok(view
        .rows()
        .into_iter()
        .map(|row| [row[0], row[1], row[2]])
        .collect())
}

/// Adds the functions and errors of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("SurfaceFault", m.py().get_type::<SurfaceFault>())?;
    m.add_function(wrap_pyfunction!(extract_surface, m)?)?;
    m.add_function(wrap_pyfunction!(pieces_of_mesh, m)?)?;
    m.add_function(wrap_pyfunction!(distances_from_mesh, m)?)
}
