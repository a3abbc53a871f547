//! `veduta_photos` for Python: matched points in, geometries out, the GIL released in between.

use nalgebra::Matrix3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_photos::fundamental::eight_points;
use veduta_photos::gric;
use veduta_photos::matches::paired;
use veduta_photos::robust::{
    largest_support, least_median, Band, FromEight, FromSeven, Model, Robust,
};
use veduta_photos::two_views::{self, judge_all, Kind, Settings, TwoViews};
use veduta_photos::{Match, MatchError};

create_exception!(_core, MatchFault, PyValueError);
create_exception!(_core, UnequalPointsError, MatchFault);
create_exception!(_core, PointNotFiniteError, MatchFault);
create_exception!(_core, TooFewMatchesError, MatchFault);
create_exception!(_core, DegenerateMatchesError, MatchFault);

fn to_python(error: MatchError) -> PyErr {
    let text = error.to_string();
    match error {
        MatchError::Unequal { .. } => UnequalPointsError::new_err(text),
        MatchError::NotFinite { .. } => PointNotFiniteError::new_err(text),
        MatchError::TooFew { .. } => TooFewMatchesError::new_err(text),
        MatchError::Degenerate => DegenerateMatchesError::new_err(text),
    }
}

type Points<'py> = PyReadonlyArray2<'py, f64>;
type Square<'py> = Bound<'py, PyArray2<f64>>;
type Found<'py> = (Square<'py>, f64, Bound<'py, PyArray1<bool>>);
type Judged<'py> = (
    Vec<&'static str>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<bool>>,
);

fn points_of(name: &str, points: &Points<'_>) -> PyResult<Vec<[f64; 2]>> {
    let view = points.as_array();
    if view.ncols() != 2 {
        let text = format!("{name} must have 2 columns, not {}", view.ncols());
        return Err(PyValueError::new_err(text));
    }
    Ok(view.rows().into_iter().map(|p| [p[0], p[1]]).collect())
}

fn matches_of(first: &Points<'_>, second: &Points<'_>) -> PyResult<Vec<Match>> {
    let (first, second) = (points_of("first", first)?, points_of("second", second)?);
    paired(&first, &second).map_err(to_python)
}

fn square_of(name: &str, matrix: &Points<'_>) -> PyResult<Matrix3<f64>> {
    let view = matrix.as_array();
    if view.dim() != (3, 3) {
        return Err(PyValueError::new_err(format!("{name} must be 3 by 3")));
    }
    Ok(Matrix3::from_fn(|row, column| view[(row, column)]))
}

fn array_of<'py>(py: Python<'py>, matrix: &Matrix3<f64>) -> Square<'py> {
    Array2::from_shape_fn((3, 3), |(row, column)| matrix[(row, column)]).into_pyarray(py)
}

fn found_of<'py>(py: Python<'py>, found: Robust) -> Found<'py> {
    let model = array_of(py, &found.model);
    (model, found.sigma_px, found.inliers.into_pyarray(py))
}

/// Judges pairs of photos: "general", "planar", "too-few" or "mostly-false" of each; F and H, row by
/// row in 18 columns, NaN where there is none; sigma (px) and the scores of F and H; and whether
/// each match is true. The matches of pair n are rows offsets[n] to offsets[n + 1]. The distances
/// are of both photos together; with `seven`, seven matches are drawn instead of eight.
#[pyfunction]
#[pyo3(signature = (first, second, offsets, seeds, *, draws, plane_draws, seven, least_px,
                    largest_px, least_sigma_px, min_matches, min_share))]
#[allow(clippy::too_many_arguments)]
fn judge_pairs<'py>(
    py: Python<'py>,
    first: Points<'py>,
    second: Points<'py>,
    offsets: PyReadonlyArray1<'py, i64>,
    seeds: PyReadonlyArray1<'py, i64>,
    draws: usize,
    plane_draws: usize,
    seven: bool,
    least_px: f64,
    largest_px: f64,
    least_sigma_px: f64,
    min_matches: usize,
    min_share: f64,
) -> PyResult<Judged<'py>> {
    let matches = matches_of(&first, &second)?;
    let offsets = offsets.as_array().to_vec();
    let seeds = seeds.as_array().to_vec();
    let pairs = pairs_of(&matches, &offsets, &seeds)?;
    let settings = Settings {
        draws,
        plane_draws,
        seven,
        band: Band {
            least_px,
            largest_px,
        },
        least_sigma_px,
        min_matches,
        min_share,
    };
    let judged = py.detach(|| judge_all(&pairs, &settings));
    Ok((
        judged.iter().map(|one| name_of(one.kind)).collect(),
        Array2::from_shape_fn((judged.len(), 18), |(row, at)| number_of(&judged[row], at))
            .into_pyarray(py),
        Array2::from_shape_fn((judged.len(), 3), |(row, at)| match at {
            0 => judged[row].sigma_px,
            _ => judged[row].scores[at - 1],
        })
        .into_pyarray(py),
        judged
            .into_iter()
            .flat_map(|one| one.inliers)
            .collect::<Vec<bool>>()
            .into_pyarray(py),
    ))
}

fn pairs_of(matches: &[Match], offsets: &[i64], seeds: &[i64]) -> PyResult<Vec<(Vec<Match>, u64)>> {
    let ends = offsets.first() == Some(&0) && offsets.last() == Some(&(matches.len() as i64));
    let rising = offsets.windows(2).all(|two| two[0] <= two[1]);
    if !ends || !rising || offsets.len() != seeds.len() + 1 {
        let text = "offsets must rise from 0 to the number of matches, one more than seeds";
        return Err(PyValueError::new_err(text));
    }
    let each = offsets.windows(2).zip(seeds);
    Ok(each
        .map(|(two, &seed)| {
            let own = matches[two[0] as usize..two[1] as usize].to_vec();
            (own, seed as u64)
        })
        .collect())
}

fn name_of(kind: Kind) -> &'static str {
    match kind {
        Kind::General => "general",
        Kind::Planar => "planar",
        Kind::TooFew => "too-few",
        Kind::MostlyFalse => "mostly-false",
    }
}

fn number_of(one: &TwoViews, at: usize) -> f64 {
    let (model, at) = if at < 9 {
        (&one.fundamental, at)
    } else {
        (&one.homography, at - 9)
    };
    model.map_or(f64::NAN, |known| known[(at / 3, at % 3)])
}

/// F, sigma (px, of both photos together) and the matches that are taken to be true; None where no
/// draw gives one. method: "ransac", "lmeds" (each with the linear fit over what it keeps) or
/// "lmeds-m" (the M-estimator after it). limit_px: the distance up to which RANSAC counts a match;
/// where there is none, each draw's own sigma says it (algorithm 3).
#[pyfunction]
#[pyo3(signature = (first, second, method, *, draws, seed, seven, limit_px))]
#[allow(clippy::too_many_arguments)]
fn robust_fundamental<'py>(
    py: Python<'py>,
    first: Points<'py>,
    second: Points<'py>,
    method: &str,
    draws: usize,
    seed: u64,
    seven: bool,
    limit_px: Option<f64>,
) -> PyResult<Option<Found<'py>>> {
    let matches = matches_of(&first, &second)?;
    let found = py.detach(|| {
        if seven {
            by_method::<FromSeven>(&matches, method, draws, seed, limit_px)
        } else {
            by_method::<FromEight>(&matches, method, draws, seed, limit_px)
        }
    });
    let found = found.ok_or_else(|| PyValueError::new_err(format!("no method {method}")))?;
    Ok(found.map(|one| found_of(py, one)))
}

/// None where there is no such method.
fn by_method<M: Model>(
    matches: &[Match],
    method: &str,
    draws: usize,
    seed: u64,
    limit_px: Option<f64>,
) -> Option<Option<Robust>> {
    let band = Band::OPEN;
    let fitted = |drawn: Robust| drawn.fitted::<M>(matches, band).or(Some(drawn));
    match method {
        "ransac" => Some(largest_support::<M>(matches, draws, seed, limit_px)),
        "lmeds" => Some(least_median::<M>(matches, draws, seed, band).and_then(fitted)),
        "lmeds-m" => Some(two_views::fundamental::<M>(matches, draws, seed, band)),
        _ => None,
    }
}

/// H, sigma (px, of both photos together) and the matches that are taken to be true, by LMedS.
#[pyfunction]
#[pyo3(signature = (first, second, *, draws, seed))]
fn robust_homography<'py>(
    py: Python<'py>,
    first: Points<'py>,
    second: Points<'py>,
    draws: usize,
    seed: u64,
) -> PyResult<Option<Found<'py>>> {
    let matches = matches_of(&first, &second)?;
    let found = py.detach(|| two_views::plane(&matches, draws, seed, Band::OPEN));
    Ok(found.map(|one| found_of(py, one)))
}

/// The normalised eight points over eight or more matches, each with its weight: F of unit length.
#[pyfunction]
fn linear_fundamental<'py>(
    py: Python<'py>,
    first: Points<'py>,
    second: Points<'py>,
    weights: PyReadonlyArray1<'py, f64>,
) -> PyResult<Square<'py>> {
    let matches = matches_of(&first, &second)?;
    let weights = weights.as_array().to_vec();
    if weights.len() != matches.len() || !weights.iter().all(|one| *one >= 0.0 && one.is_finite()) {
        let text = "each match must have a weight, a number from 0 on";
        return Err(PyValueError::new_err(text));
    }
    let found = py.detach(|| eight_points(&matches, Some(&weights)));
    Ok(array_of(py, &found.map_err(to_python)?))
}

/// Whether a homography is taken before a fundamental matrix, and the scores (GRIC) of the latter and
/// of the former. Each comes with the matches that it explains; the errors of the fundamental matrix
/// are the noise, of `least_sigma_px` at least.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
fn weigh_models(
    py: Python<'_>,
    first: Points<'_>,
    second: Points<'_>,
    fundamental: Points<'_>,
    homography: Points<'_>,
    of_fundamental: PyReadonlyArray1<'_, bool>,
    of_homography: PyReadonlyArray1<'_, bool>,
    least_sigma_px: f64,
) -> PyResult<(bool, f64, f64)> {
    let matches = matches_of(&first, &second)?;
    let explained = |name: &str, matrix: &Points<'_>, own: &PyReadonlyArray1<'_, bool>| {
        let inliers = own.as_array().to_vec();
        if inliers.len() != matches.len() {
            let text = "of_fundamental and of_homography must say it of each match";
            return Err(PyValueError::new_err(text));
        }
        let model = square_of(name, matrix)?;
        Ok(Robust {
            model,
            sigma_px: f64::NAN,
            inliers,
        })
    };
    let deep = explained("fundamental", &fundamental, &of_fundamental)?;
    let flat = explained("homography", &homography, &of_homography)?;
    let found = py.detach(|| gric::weigh(&deep, &flat, &matches, least_sigma_px));
    Ok((found.planar, found.scores[0], found.scores[1]))
}

/// Adds the functions and errors of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = m.py();
    m.add("MatchFault", py.get_type::<MatchFault>())?;
    m.add("UnequalPointsError", py.get_type::<UnequalPointsError>())?;
    m.add("PointNotFiniteError", py.get_type::<PointNotFiniteError>())?;
    m.add("TooFewMatchesError", py.get_type::<TooFewMatchesError>())?;
    m.add(
        "DegenerateMatchesError",
        py.get_type::<DegenerateMatchesError>(),
    )?;
    m.add_function(wrap_pyfunction!(judge_pairs, m)?)?;
    m.add_function(wrap_pyfunction!(robust_fundamental, m)?)?;
    m.add_function(wrap_pyfunction!(robust_homography, m)?)?;
    m.add_function(wrap_pyfunction!(linear_fundamental, m)?)?;
    m.add_function(wrap_pyfunction!(weigh_models, m)?)
}
