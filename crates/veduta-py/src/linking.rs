//! Rectified pairs and chains of `veduta_stereo` for Python, the GIL released.

use numpy::ndarray::Array2;
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_stereo::link::{link, Homography, Linked, Step};
use veduta_stereo::pair::{confirmed, disparities, Rectified};

use crate::stereo::{camera_of, fault, values, StereoFault};
use crate::stereo_rules::{LinkRule, PairRule};

/// A step of a chain: the next view's camera, the homographies, the disparities.
pub type GivenStep<'py> = (
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, f32>,
);
pub type Found<'py> = (
    Bound<'py, PyArray1<f32>>,
    Bound<'py, PyArray1<f32>>,
    Bound<'py, PyArray1<u8>>,
);

pub fn shaped(
    py: Python<'_>,
    flat: Vec<f32>,
    shape: (usize, usize),
) -> PyResult<Bound<'_, PyArray2<f32>>> {
    let array = Array2::from_shape_vec(shape, flat);
    let array = array.map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(array.into_pyarray(py))
}

pub fn rectified<'a>(
    pixels: &'a PyReadonlyArray3<'_, u8>,
    shown: &'a PyReadonlyArray2<'_, bool>,
) -> PyResult<Rectified<'a>> {
    let (height, width, _) = pixels.as_array().dim();
    Ok(Rectified {
        width,
        height,
        pixels: pixels.as_slice()?,
        shown: shown.as_slice()?,
    })
}

/// The disparity of each pixel of a rectified picture, x there less x here (px), NaN where there is
/// none. here, there: (h, w, 3) sRGB; shown: (h, w), where each has pixels.
#[pyfunction]
fn match_pair<'py>(
    py: Python<'py>,
    here: PyReadonlyArray3<'py, u8>,
    there: PyReadonlyArray3<'py, u8>,
    shown_here: PyReadonlyArray2<'py, bool>,
    shown_there: PyReadonlyArray2<'py, bool>,
    rule: &PairRule,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (own, other) = (
        rectified(&here, &shown_here)?,
        rectified(&there, &shown_there)?,
    );
    let found = py
        .detach(|| disparities(own, other, &rule.rule))
        .map_err(fault)?;
    shaped(py, found, (own.height, own.width))
}

/// The disparities that lead back from the other picture within so many pixels; NaN elsewhere.
#[pyfunction]
fn confirm_pair<'py>(
    py: Python<'py>,
    here: PyReadonlyArray2<'py, f32>,
    there: PyReadonlyArray2<'py, f32>,
    most_px: f32,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let (height, width) = here.as_array().dim();
    let (rows, other) = there.as_array().dim();
    if rows != height || width == 0 || other == 0 {
        return Err(StereoFault::new_err("a pair has the same rows"));
    }
    let mut found = values(&here);
    let back = values(&there);
    py.detach(|| confirmed(&mut found, &back, [width, other], most_px));
    shaped(py, found, (height, width))
}

pub struct OwnStep {
    camera: veduta_stereo::Camera,
    rectified: Homography,
    back: Homography,
    width: usize,
    height: usize,
    disparities: Vec<f32>,
}

fn homography(rows: &PyReadonlyArray2<'_, f64>) -> PyResult<Homography> {
    let view = rows.as_array();
    if view.dim() != (3, 3) {
        return Err(StereoFault::new_err("a homography is 3 x 3"));
    }
    Ok(std::array::from_fn(|r| {
        std::array::from_fn(|c| view[(r, c)] as f32)
    }))
}

pub fn own_step(given: &GivenStep<'_>) -> PyResult<OwnStep> {
    let (height, width) = given.3.as_array().dim();
    Ok(OwnStep {
        camera: camera_of(&given.0.as_array().to_vec())?,
        rectified: homography(&given.1)?,
        back: homography(&given.2)?,
        width,
        height,
        disparities: values(&given.3),
    })
}

pub fn told(py: Python<'_>, found: Linked) -> Found<'_> {
    (
        found.depths.into_pyarray(py),
        found.deviations.into_pyarray(py),
        found.estimates.into_pyarray(py),
    )
}

/// Depths of a view (m, NaN where unknown) row by row, their deviations (of the inverse depth), and
/// the number of views that each was found from, by chains of links (3.3, 3.4). width, height: of the
/// view. chains: up and down the sequence, for each step the next view's camera, rectified from this
/// view's pixels, the next view's pixels from rectified ones, and the disparities.
#[pyfunction]
fn link_views<'py>(
    py: Python<'py>,
    camera: PyReadonlyArray1<'py, f64>,
    width: usize,
    height: usize,
    chains: Vec<Vec<GivenStep<'py>>>,
    rule: &LinkRule,
) -> PyResult<Found<'py>> {
    let own = camera_of(&camera.as_array().to_vec())?;
    let each = |chain: &Vec<GivenStep<'py>>| chain.iter().map(own_step).collect();
    let given: Vec<Vec<OwnStep>> = chains.iter().map(each).collect::<PyResult<_>>()?;
    let found = py
        .detach(|| {
            let steps: Vec<Vec<Step<'_>>> = given
                .iter()
                .map(|chain| chain.iter().map(step_of).collect())
                .collect();
            let chains: Vec<&[Step<'_>]> = steps.iter().map(Vec::as_slice).collect();
            link(own, [width, height], &chains, &rule.rule)
        })
        .map_err(fault)?;
    Ok(told(py, found))
}

pub fn step_of(one: &OwnStep) -> Step<'_> {
    Step {
        camera: one.camera,
        rectified: one.rectified,
        back: one.back,
        width: one.width,
        height: one.height,
        disparities: &one.disparities,
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(match_pair, m)?)?;
    m.add_function(wrap_pyfunction!(confirm_pair, m)?)?;
    m.add_function(wrap_pyfunction!(link_views, m)?)
}
