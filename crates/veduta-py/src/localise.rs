//! `veduta_drive` for Python: particles in a map of edges, one motion and scan at a time.

use std::sync::Mutex;

use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_drive::{DriveError, EdgeField, Filter, Settings, Start};

create_exception!(_core, DriveFault, PyValueError);

/// Pose, covariance by rows, share of points on edges, of points on the map, of free ones inside.
type Told = ([f64; 3], [f64; 9], f64, f64, f64);

fn to_python(error: DriveError) -> PyErr {
    DriveFault::new_err(error.to_string())
}

/// Poses that a vehicle may have in a map of edges (Monte-Carlo localisation).
#[pyclass(frozen, module = "veduta._core")]
pub struct VehicleParticles {
    filter: Mutex<Filter>,
}

#[pymethods]
impl VehicleParticles {
    /// distance_m: (rows from the south, columns) m to the nearest edge, negative where something
    /// stands that a scan cannot look through, NaN where nothing is known;
    /// low: the outer corner of its first cell. start, reach: x, y (m) and heading (rad), and how far
    /// each may be off. sigma_m: how far points lie from edges; `spread_share` of the particles' spread
    /// while that is more, up to `widest_sigma_m`. outlier, outside: likelihoods of points on no edge
    /// and off the map, where one on an edge has 1; blocked: of one that a beam went through and where
    /// something stands. worth: beams that a scan counts as.
    #[new]
    #[pyo3(signature = (distance_m, low, cell_m, start, reach, *, particles, first_draws, seed, sigma_m, widest_sigma_m, spread_share, outlier, outside, blocked, worth, draw_below))]
    #[allow(clippy::too_many_arguments)] // as Python calls it: with names
    fn new(
        distance_m: PyReadonlyArray2<'_, f32>,
        low: [f64; 2],
        cell_m: f64,
        start: [f64; 3],
        reach: [f64; 3],
        particles: usize,
        first_draws: usize,
        seed: u64,
        sigma_m: f64,
        widest_sigma_m: f64,
        spread_share: f64,
        outlier: f64,
        outside: f64,
        blocked: f64,
        worth: f64,
        draw_below: f64,
    ) -> PyResult<Self> {
        let (height, width) = (distance_m.shape()[0], distance_m.shape()[1]);
        let cells = distance_m.as_array().iter().copied().collect();
        let field = EdgeField::new(cells, width, height, low, cell_m).map_err(to_python)?;
        let settings = Settings {
            particles,
            first_draws,
            seed,
            sigma_m,
            widest_sigma_m,
            spread_share,
            outlier,
            outside,
            blocked,
            worth,
            draw_below,
        };
        let start = Start { pose: start, reach };
        let filter = Filter::new(field, start, settings).map_err(to_python)?;
        Ok(Self {
            filter: Mutex::new(filter),
        })
    }

    /// After a motion (forward, left in m, turn in rad) with noise of these deviations, a scan's points
    /// (n, 2) in the vehicle's frame (m), and points (k, 2) that its beams went through: mean pose,
    /// covariance by rows, share of the points within two sigma of an edge, share of them on the map,
    /// share of the second ones where something stands.
    fn step(
        &self,
        py: Python<'_>,
        motion: [f64; 3],
        noise: [f64; 3],
        points: PyReadonlyArray2<'_, f64>,
        free: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Told> {
        if !motion.iter().chain(&noise).all(|value| value.is_finite()) {
            return Err(DriveFault::new_err("a motion is no number"));
        }
        let (points, free) = (places(&points)?, places(&free)?);
        py.check_signals()?;
        let told = py.detach(|| {
            let mut filter = match self.filter.lock() {
                Ok(held) => held,
                Err(poisoned) => poisoned.into_inner(),
            };
            filter.step(motion, noise, &points, &free)
        });
        let shares = (told.share, told.known, told.through);
        Ok((told.pose, told.covariance, shares.0, shares.1, shares.2))
    }
}

fn places(given: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 2]>> {
    let view = given.as_array();
    if view.ncols() != 2 {
        let text = format!("points must have 2 columns, not {}", view.ncols());
        return Err(DriveFault::new_err(text));
    }
    if !view.iter().all(|value| value.is_finite()) {
        return Err(DriveFault::new_err("a point is no number"));
    }
    Ok(view.rows().into_iter().map(|r| [r[0], r[1]]).collect())
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("DriveFault", m.py().get_type::<DriveFault>())?;
    m.add_class::<VehicleParticles>()
}
