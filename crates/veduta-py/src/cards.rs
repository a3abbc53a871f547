//! A graphics card for Python, and what runs on it: `veduta_gpu`, the GIL released.

use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::create_exception;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use veduta_carve::Root;
use veduta_gpu::carve::Carver;
use veduta_gpu::link::Linker;
use veduta_gpu::pair::Matcher;
use veduta_gpu::search::Searcher;
use veduta_gpu::sweep::Sweeper;
use veduta_gpu::{Card, GpuError};
use veduta_stereo::link::Step;

use crate::carve::{views_of, CarvedVolume};
use crate::linking::{own_step, rectified, shaped, step_of, told, OwnStep};
use crate::stereo::{camera_of, planes_told, Matching};
use crate::stereo_rules::{LinkRule, PairRule, SearchRule};
use crate::sweeping::{SweepRule, Sweeping};

/// As in `linking`: the stub's types are read file by file.
type GivenStep<'py> = (
    PyReadonlyArray1<'py, f64>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, f32>,
);
type Found<'py> = (
    Bound<'py, PyArray1<f32>>,
    Bound<'py, PyArray1<f32>>,
    Bound<'py, PyArray1<u8>>,
);

type Left<'py> = (
    Bound<'py, PyArray3<bool>>,
    Vec<usize>,
    Bound<'py, PyArray1<f32>>,
);

create_exception!(_core, GpuFault, PyRuntimeError);

fn fault(error: GpuError) -> PyErr {
    GpuFault::new_err(error.to_string())
}

/// A graphics card. GpuFault says why there is none, or that it vanished.
#[pyclass(frozen, module = "veduta._core")]
struct GraphicsCard {
    card: Card,
    matcher: Matcher,
    linker: Linker,
    searcher: Searcher,
    carver: Carver,
    sweeper: Sweeper,
}

#[pymethods]
impl GraphicsCard {
    /// The fastest one. software: adapters that compute on the processor, too, for tests.
    #[new]
    #[pyo3(signature = (*, software = false))]
    fn new(py: Python<'_>, software: bool) -> PyResult<Self> {
        py.detach(|| {
            let card = Card::open(software)?;
            Ok(Self {
                matcher: Matcher::new(&card),
                linker: Linker::new(&card),
                searcher: Searcher::new(&card),
                carver: Carver::new(&card),
                sweeper: Sweeper::new(&card),
                card,
            })
        })
        .map_err(fault)
    }

    /// As its maker calls it.
    fn name(&self) -> &str {
        self.card.name()
    }

    /// Gives it back: whoever still uses it is told that it vanished.
    fn destroy(&self) {
        self.card.destroy();
    }

    /// As `carve_hull` does.
    #[allow(clippy::too_many_arguments)]
    fn carve_hull(
        &self,
        py: Python<'_>,
        cameras: PyReadonlyArray2<'_, f64>,
        distances: Vec<PyReadonlyArray2<'_, f32>>,
        corners: PyReadonlyArray2<'_, f64>,
        low_m: [f64; 3],
        side_m: f64,
        levels: u32,
    ) -> PyResult<CarvedVolume> {
        let views = views_of(&cameras, &distances, &corners)?;
        let root = Root {
            low_m,
            side_m,
            levels,
        };
        let found = py.detach(|| self.carver.carve(&self.card, &views, root));
        Ok(CarvedVolume {
            volume: found.map_err(fault)?,
        })
    }

    /// As `sweep_colours` does.
    #[pyo3(signature = (cameras, photos, distances, corners, solid, low_m, side_m, rule))]
    #[allow(clippy::too_many_arguments)] // each is one thing to who calls
    fn sweep_colours<'py>(
        &self,
        py: Python<'py>,
        cameras: PyReadonlyArray2<'py, f64>,
        photos: Vec<PyReadonlyArray3<'py, u8>>,
        distances: Vec<PyReadonlyArray2<'py, f32>>,
        corners: PyReadonlyArray2<'py, f64>,
        solid: PyReadonlyArray3<'py, bool>,
        low_m: [f64; 3],
        side_m: f64,
        rule: &SweepRule,
    ) -> PyResult<Left<'py>> {
        let outlines = (&distances[..], &corners);
        let given = Sweeping::new(&cameras, &photos, outlines, &solid, (low_m, side_m))?;
        given.left(py, fault, |photos, views, root, solid| {
            let on = &self.sweeper;
            on.sweep(&self.card, photos, views, root, solid, &rule.rule)
        })
    }

    /// As `match_planes` does.
    #[pyo3(signature = (image, camera, neighbours, cameras, depths, start, start_shape, rule))]
    #[allow(clippy::too_many_arguments)] // each is one thing to who calls
    fn match_planes<'py>(
        &self,
        py: Python<'py>,
        image: PyReadonlyArray2<'py, u8>,
        camera: PyReadonlyArray1<'py, f64>,
        neighbours: Vec<PyReadonlyArray2<'py, u8>>,
        cameras: PyReadonlyArray2<'py, f64>,
        depths: Vec<Option<PyReadonlyArray2<'py, f32>>>,
        start: Option<PyReadonlyArray2<'py, f32>>,
        start_shape: (usize, usize),
        rule: &SearchRule,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let given = Matching::new(
            &image,
            &camera,
            (&neighbours, &cameras, &depths),
            (start.as_ref(), start_shape),
            rule.rule,
        )?;
        let found = py.detach(|| {
            given.planes(|image, camera, others, start, rule| {
                self.searcher
                    .search(&self.card, image, camera, others, start, rule)
            })
        });
        planes_told(py, found.map_err(fault)?)
    }

    /// As `match_pair` does.
    fn match_pair<'py>(
        &self,
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
        let found = py.detach(|| self.matcher.disparities(&self.card, own, other, &rule.rule));
        shaped(py, found.map_err(fault)?, (own.height, own.width))
    }

    /// As `link_views` does.
    fn link_views<'py>(
        &self,
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
        let [up, down] = given.as_slice() else {
            return Err(GpuFault::new_err("a chain up and one down"));
        };
        let found = py.detach(|| {
            let up: Vec<Step<'_>> = up.iter().map(step_of).collect();
            let down: Vec<Step<'_>> = down.iter().map(step_of).collect();
            let chains: [&[Step<'_>]; 2] = [&up, &down];
            self.linker
                .link(&self.card, own, [width, height], chains, &rule.rule)
        });
        Ok(told(py, found.map_err(fault)?))
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("GpuFault", m.py().get_type::<GpuFault>())?;
    m.add_class::<GraphicsCard>()
}
