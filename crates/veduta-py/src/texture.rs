//! `veduta_texture` for Python: arrays in, an array out, the GIL released in between.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_texture::{label, Grid, LabelError, Seam};

create_exception!(_core, LabelFault, PyValueError);

fn to_python(error: LabelError) -> PyErr {
    LabelFault::new_err(error.to_string())
}

/// The label of each of `rows` x `columns` cells. costs: a row per cell, a column per label.
/// colours: a row per cell, three columns per label; NaN where it does not see the cell.
/// A seam costs `base` and `slope` times the disagreement beside it, at most `most`.
#[pyfunction]
#[pyo3(signature = (costs, colours, shape, *, base, slope, most, rounds))]
#[allow(clippy::too_many_arguments)] // each is a number of its own to who calls
fn label_cells<'py>(
    py: Python<'py>,
    costs: PyReadonlyArray2<'py, f32>,
    colours: PyReadonlyArray2<'py, f32>,
    shape: (usize, usize),
    base: f32,
    slope: f32,
    most: f32,
    rounds: usize,
) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let (rows, columns) = shape;
    let labels = costs.as_array().ncols();
    let given: Vec<f32> = costs.as_array().iter().copied().collect();
    let seen: Vec<f32> = colours.as_array().iter().copied().collect();
    let found = py
        .detach(|| {
            let seam = Seam { base, slope, most };
            let grid = Grid::new((rows, columns, labels), &given, &seen, seam)?;
            Ok(label(&grid, rounds))
        })
        .map_err(to_python)?;
    let shaped = Array2::from_shape_vec((rows, columns), found)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(shaped.into_pyarray(py))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("LabelFault", m.py().get_type::<LabelFault>())?;
    m.add_function(wrap_pyfunction!(label_cells, m)?)
}
