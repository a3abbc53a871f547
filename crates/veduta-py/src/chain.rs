//! `veduta_facade` for Python: arrays in, plain lists out, the GIL released in between.

use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use veduta_facade::columns::ColumnChain;
use veduta_facade::floors::{FloorChain, FloorSolution};
use veduta_facade::sums::DiagonalSums;
use veduta_facade::{skyline, ChainError};

create_exception!(_core, ChainFault, PyValueError);
create_exception!(_core, ChainSizeError, ChainFault);
create_exception!(_core, ChainLabelsError, ChainFault);

fn to_python(error: ChainError) -> PyErr {
    let text = error.to_string();
    match error {
        ChainError::Size { .. } => ChainSizeError::new_err(text),
        ChainError::Labels { .. } => ChainLabelsError::new_err(text),
    }
}

/// One row per image column that minimises unary plus truncated linear costs, exactly.
#[pyfunction]
fn skyline_chain(
    py: Python<'_>,
    unary: PyReadonlyArray2<'_, f32>,
    slope: f32,
    jump: f32,
) -> PyResult<Vec<usize>> {
    let view = unary.as_array();
    let (rows, columns) = view.dim();
    let values: Vec<f32> = view.iter().copied().collect();
    py.detach(|| skyline::solve(&values, rows, columns, slope, jump))
        .map_err(to_python)
}

type Scale<'py> = (
    Vec<usize>,
    f64,
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray1<'py, f64>,
);
type Chains = Vec<Vec<Option<(f64, Vec<usize>)>>>;

/// The best chain of floors for every scale `(heights, neutral, eaves, boundary, ground)` and every count.
#[pyfunction]
fn floor_chain(
    py: Python<'_>,
    distance: PyReadonlyArray2<'_, f32>,
    scales: Vec<Scale<'_>>,
    similarity: f64,
    height_change: f64,
    max_floors: usize,
) -> PyResult<Chains> {
    let rows = distance.as_array().nrows();
    let matrix: Vec<f32> = distance.as_array().iter().copied().collect();
    let owned: Vec<_> = scales
        .iter()
        .map(|(heights, neutral, e, b, g)| {
            let [e, b, g] = [e, b, g].map(|a| a.as_array().to_vec());
            (heights.as_slice(), *neutral, e, b, g)
        })
        .collect();
    let tallest = owned
        .iter()
        .flat_map(|s| s.0.iter().copied())
        .max()
        .unwrap_or(0);
    let solved: Result<Vec<Vec<Option<FloorSolution>>>, ChainError> = py.detach(|| {
        let sums = DiagonalSums::new(&matrix, rows, tallest)?;
        owned
            .par_iter()
            .map(|(heights, neutral, eaves, boundary, ground)| {
                let chain = FloorChain {
                    heights,
                    eaves,
                    boundary,
                    ground,
                    similarity,
                    height_change,
                    neutral: *neutral,
                    max_floors,
                };
                chain.solve(&sums, rows)
            })
            .collect()
    });
    let plain = |s: FloorSolution| (s.energy, s.boundaries);
    Ok(solved
        .map_err(to_python)?
        .into_iter()
        .map(|counts| counts.into_iter().map(|s| s.map(plain)).collect())
        .collect())
}

/// The best chain of window stripes: its energy and `(position, width)` of each.
#[pyfunction]
#[pyo3(signature = (distance, evidence, jamb, widths, *, step, gap_min, gap_max, jamb_weight,
                    similarity, width_change, gap_symmetry, neutral))]
#[allow(clippy::too_many_arguments)]
fn column_chain(
    py: Python<'_>,
    distance: PyReadonlyArray2<'_, f32>,
    evidence: PyReadonlyArray1<'_, f64>,
    jamb: PyReadonlyArray1<'_, f64>,
    widths: Vec<usize>,
    step: usize,
    gap_min: usize,
    gap_max: usize,
    jamb_weight: f64,
    similarity: f64,
    width_change: f64,
    gap_symmetry: f64,
    neutral: f64,
) -> PyResult<(f64, Vec<(usize, usize)>)> {
    let matrix: Vec<f32> = distance.as_array().iter().copied().collect();
    let evidence = evidence.as_array().to_vec();
    let jamb = jamb.as_array().to_vec();
    let chain = ColumnChain {
        evidence: &evidence,
        jamb: &jamb,
        widths: &widths,
        step,
        gap_min,
        gap_max,
        jamb_weight,
        similarity,
        width_change,
        gap_symmetry,
        neutral,
    };
    let solved = py.detach(|| chain.solve(&matrix)).map_err(to_python)?;
    Ok((solved.energy, solved.stripes))
}

/// Adds the functions and errors of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = m.py();
    m.add("ChainFault", py.get_type::<ChainFault>())?;
    m.add("ChainSizeError", py.get_type::<ChainSizeError>())?;
    m.add("ChainLabelsError", py.get_type::<ChainLabelsError>())?;
    m.add_function(wrap_pyfunction!(skyline_chain, m)?)?;
    m.add_function(wrap_pyfunction!(floor_chain, m)?)?;
    m.add_function(wrap_pyfunction!(column_chain, m)?)
}
