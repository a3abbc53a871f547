//! `veduta_drive`'s flood for Python: foreground points of a scan become pixels of an image.

use numpy::ndarray::Array2;
use numpy::{
    IntoPyArray, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_drive::{flood, FloodRules, Picture, Seed};

use crate::localise::DriveFault;

/// (h, w) the depth of the nearest foreground whose flood reaches a pixel (m), infinity where none
/// does. pixels: (h, w, 3). misfit: (h, w) correspondence error to the background (px), NaN where none
/// is. seeds: (n, 2) columns and rows of foreground points, depth_m: (n,) how far each is. A flood keeps
/// within `reach` pixels of its seed, to colours within `colour` of the seed's, and to pixels that fit
/// the background at most `slack` better than the seed, and no better than `least`.
#[pyfunction]
#[pyo3(signature = (pixels, misfit, seeds, depth_m, *, reach, colour, slack, least))]
#[allow(clippy::too_many_arguments)] // each is a number of its own to who calls
fn flood_foreground<'py>(
    py: Python<'py>,
    pixels: PyReadonlyArray3<'py, u8>,
    misfit: PyReadonlyArray2<'py, f32>,
    seeds: PyReadonlyArray2<'py, i64>,
    depth_m: PyReadonlyArray1<'py, f32>,
    reach: usize,
    colour: u8,
    slack: f32,
    least: f32,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (height, width) = (pixels.shape()[0], pixels.shape()[1]);
    if seeds.shape()[1] != 2 || seeds.shape()[0] != depth_m.shape()[0] {
        let text = "there must be a depth for each foreground point, and two numbers for its place";
        return Err(DriveFault::new_err(text));
    }
    let colours: Vec<u8> = pixels.as_array().iter().copied().collect();
    let misfits: Vec<f32> = misfit.as_array().iter().copied().collect();
    // A place before the first pixel becomes one behind the last: it is refused below.
    let places = seeds.as_array();
    let given: Vec<Seed> = places
        .rows()
        .into_iter()
        .zip(depth_m.as_array())
        .map(|(place, depth)| Seed {
            column: usize::try_from(place[0]).unwrap_or(usize::MAX),
            row: usize::try_from(place[1]).unwrap_or(usize::MAX),
            depth: *depth,
        })
        .collect();
    let rules = FloodRules {
        reach,
        colour,
        slack,
        least,
    };
    let found = py
        .detach(|| {
            let picture = Picture {
                width,
                height,
                colours: &colours,
                misfit: &misfits,
            };
            flood(&picture, &given, rules)
        })
        .map_err(|error| DriveFault::new_err(error.to_string()))?;
    let shaped = Array2::from_shape_vec((height, width), found)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(shaped.into_pyarray(py))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(flood_foreground, m)?)
}
