//! `veduta_fauna` for Python: how well a figure covers silhouettes.

use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyReadonlyArray3, PyUntypedArrayMethods,
};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_fauna::{Capsules, CoverError, Looked};

create_exception!(_core, CoverFault, PyValueError);

type Told<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray3<f64>>,
    Bound<'py, PyArray2<f64>>,
);

fn to_python(error: CoverError) -> PyErr {
    CoverFault::new_err(error.to_string())
}

fn numbers(given: &PyReadonlyArray1<'_, i64>) -> PyResult<Vec<usize>> {
    given
        .as_array()
        .iter()
        .map(|&value| {
            usize::try_from(value).map_err(|_| CoverFault::new_err(format!("no joint is {value}")))
        })
        .collect()
}

fn pairs(flat: impl Iterator<Item = f32>) -> Vec<[f32; 2]> {
    let all: Vec<f32> = flat.collect();
    all.chunks_exact(2).map(|p| [p[0], p[1]]).collect()
}

/// Soft occupancy of tapered capsules against silhouettes, with its gradients.
///
/// start, end: (s,) joints of each segment. joints: (t, j, 2). deep: (j,) half of the thickness.
/// places: (p, 2) looked at. shares: (t, p) how much of each place the silhouette has. weights: (p,)
/// how much it counts. soft: how wide an edge is. All lengths are in one unit. The loss (t,) of each
/// frame, and its gradients by joints (t, j, 2) and thicknesses (t, j).
#[pyfunction]
#[allow(clippy::too_many_arguments)] // as Python calls it: with names
fn capsules_cover<'py>(
    py: Python<'py>,
    start: PyReadonlyArray1<'py, i64>,
    end: PyReadonlyArray1<'py, i64>,
    joints: PyReadonlyArray3<'py, f32>,
    deep: PyReadonlyArray1<'py, f32>,
    places: PyReadonlyArray2<'py, f32>,
    shares: PyReadonlyArray2<'py, f32>,
    weights: PyReadonlyArray1<'py, f32>,
    soft: f32,
) -> PyResult<Told<'py>> {
    if joints.shape()[2] != 2 || places.shape()[1] != 2 {
        return Err(CoverFault::new_err(
            "joints and places must have two coordinates",
        ));
    }
    let (frames, count) = (joints.shape()[0], joints.shape()[1]);
    let (start, end) = (numbers(&start)?, numbers(&end)?);
    let joints = pairs(joints.as_array().iter().copied());
    let places = pairs(places.as_array().iter().copied());
    let deep: Vec<f32> = deep.as_array().to_vec();
    let weights: Vec<f32> = weights.as_array().to_vec();
    let shares: Vec<f32> = shares.as_array().iter().copied().collect();
    let found = py
        .detach(|| {
            let capsules = Capsules {
                start: &start,
                end: &end,
                deep: &deep,
            };
            let looked = Looked {
                places: &places,
                weights: &weights,
                shares: &shares,
                soft,
            };
            veduta_fauna::cover(&capsules, &joints, &looked)
        })
        .map_err(to_python)?;
    let flat: Vec<f64> = found.by_joint.into_iter().flatten().collect();
    Ok((
        PyArray1::from_vec(py, found.loss),
        PyArray1::from_vec(py, flat).reshape([frames, count, 2])?,
        PyArray1::from_vec(py, found.by_deep).reshape([frames, count])?,
    ))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("CoverFault", m.py().get_type::<CoverFault>())?;
    m.add_function(wrap_pyfunction!(capsules_cover, m)?)
}
