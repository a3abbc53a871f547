//! The rules of `veduta_stereo` for Python: what the processor and a graphics card are told alike.

use pyo3::prelude::*;
use veduta_stereo::link;
use veduta_stereo::pair;
use veduta_stereo::patch::Window;
use veduta_stereo::path::Path;
use veduta_stereo::search::Search;

/// How `match_planes` looks for planes. near, far: the depths that are tried (m). views: of the
/// neighbours, so many of least cost count. step_px, gamma_grey, gamma_px, noise_grey: of a window.
/// consistency, most_px: the cost per pixel by which a neighbour's depth leads elsewhere, and the
/// most. vary_depth, vary_normal: how far planes are varied at random.
#[pyclass(frozen, module = "veduta._core")]
pub struct SearchRule {
    pub rule: Search,
}

#[pymethods]
impl SearchRule {
    #[new]
    #[pyo3(signature = (*, near, far, sweeps, views, step_px, gamma_grey, gamma_px, noise_grey,
                        consistency, most_px, vary_depth, vary_normal, seed))]
    #[allow(clippy::too_many_arguments)] // each is a number of its own to who calls
    fn new(
        near: f32,
        far: f32,
        sweeps: usize,
        views: usize,
        step_px: f32,
        gamma_grey: f32,
        gamma_px: f32,
        noise_grey: f32,
        consistency: f32,
        most_px: f32,
        vary_depth: f32,
        vary_normal: f32,
        seed: u64,
    ) -> Self {
        let window = Window {
            step_px,
            gamma_grey,
            gamma_px,
            noise_grey,
        };
        Self {
            rule: Search {
                window,
                sweeps,
                near,
                far,
                views,
                consistency,
                most_px,
                vary_depth,
                vary_normal,
                seed,
            },
        }
    }
}

/// How `match_pair` matches. low, count: the disparities that are tried. rows, gamma_colour,
/// gamma_px, most: of the costs (3.1, 3.2). path: what a step of one disparity along a row costs,
/// and one of more; None takes the least cost of each pixel.
#[pyclass(frozen, module = "veduta._core")]
pub struct PairRule {
    pub rule: pair::PairRule,
}

#[pymethods]
impl PairRule {
    #[new]
    #[pyo3(signature = (*, low, count, rows, gamma_colour, gamma_px, most, path))]
    fn new(
        low: i32,
        count: usize,
        rows: usize,
        gamma_colour: f64,
        gamma_px: f64,
        most: u8,
        path: Option<(u16, u16)>,
    ) -> Self {
        Self {
            rule: pair::PairRule {
                low,
                count,
                rows,
                gamma_colour,
                gamma_px,
                most,
                path: path.map(|(step, jump)| Path { step, jump }),
            },
        }
    }
}

/// When a chain of `link_views` goes on. deviation_px: of a link. most_deviations: an estimate that
/// is farther off is an outlier. most_across_px: from the epipolar line. near, far: depths (m).
#[pyclass(frozen, module = "veduta._core")]
pub struct LinkRule {
    pub rule: link::LinkRule,
}

#[pymethods]
impl LinkRule {
    #[new]
    #[pyo3(signature = (*, deviation_px, most_deviations, most_across_px, near, far))]
    fn new(
        deviation_px: f32,
        most_deviations: f32,
        most_across_px: f32,
        near: f32,
        far: f32,
    ) -> Self {
        Self {
            rule: link::LinkRule {
                deviation_px,
                most_deviations,
                most_across_px,
                near,
                far,
            },
        }
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<SearchRule>()?;
    m.add_class::<PairRule>()?;
    m.add_class::<LinkRule>()
}
