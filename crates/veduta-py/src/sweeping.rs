//! The sweeps of `veduta_carve` for Python, on the processor and on a graphics card.

use numpy::{IntoPyArray, PyArray1, PyArray3, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_carve::sweep::{sweep, Swept};
use veduta_carve::{Photo, Root, View};

use crate::carve::{cube_of, photos_of, to_python, views_of};

type Left<'py> = (
    Bound<'py, PyArray3<bool>>,
    Vec<usize>,
    Bound<'py, PyArray1<f32>>,
);

/// When a voxel is carved: disagreement of colours (grey levels) that is too much; fewer views that see
/// a voxel say nothing of it, more are not asked; the least cosine of the angle under which they do; what
/// is so near to an outline (voxels) stays where nothing else holds it up; sweeps at most.
#[pyclass(frozen, module = "veduta._core")]
pub struct SweepRule {
    pub rule: veduta_carve::sweep::SweepRule,
}

#[pymethods]
impl SweepRule {
    #[new]
    #[pyo3(signature = (*, spread, least_views, most_views, least_cosine, rim_voxels, sweeps))]
    fn new(
        spread: f32,
        least_views: usize,
        most_views: usize,
        least_cosine: f64,
        rim_voxels: f64,
        sweeps: usize,
    ) -> Self {
        let rule = veduta_carve::sweep::SweepRule {
            spread,
            least_views,
            most_views,
            least_cosine,
            rim_voxels,
            sweeps,
        };
        Self { rule }
    }
}

/// What `sweep_colours` of the processor and of a graphics card are given.
pub struct Sweeping<'a> {
    pub photos: Vec<Photo<'a>>,
    pub views: Vec<View<'a>>,
    pub root: Root,
    pub solid: Vec<bool>,
}

/// Distances to the outline of each view, and where in its picture they begin.
pub type Outlines<'a, 'py> = (
    &'a [PyReadonlyArray2<'py, f32>],
    &'a PyReadonlyArray2<'py, f64>,
);

impl<'a> Sweeping<'a> {
    pub fn new(
        cameras: &PyReadonlyArray2<'_, f64>,
        photos: &'a [PyReadonlyArray3<'_, u8>],
        (distances, corners): Outlines<'a, '_>,
        solid: &PyReadonlyArray3<'_, bool>,
        (low_m, side_m): ([f64; 3], f64),
    ) -> PyResult<Self> {
        let photos = photos_of(cameras, photos)?;
        let views = views_of(cameras, distances, corners)?;
        let levels = solid.as_array().dim().0.max(1).ilog2();
        let solid = solid.as_slice()?.to_vec();
        if photos.len() != views.len() || solid.len() != 1 << (3 * levels) {
            let text =
                "there must be a photo for each view, and a cube of 2^n voxels along each edge";
            return Err(PyValueError::new_err(text));
        }
        let root = Root {
            low_m,
            side_m,
            levels,
        };
        Ok(Self {
            photos,
            views,
            root,
            solid,
        })
    }

    /// For Python: what a sweep leaves, how many each round carved, and the spreads of the hull's voxels.
    pub fn left<'py, E: Send>(
        self,
        py: Python<'py>,
        to_python: impl FnOnce(E) -> PyErr,
        swept: impl FnOnce(&[Photo<'a>], &[View<'a>], &Root, Vec<bool>) -> Result<Swept, E> + Send,
    ) -> PyResult<Left<'py>> {
        let Self {
            photos,
            views,
            root,
            solid,
        } = self;
        let made = py.detach(|| swept(&photos, &views, &root, solid));
        let made = made.map_err(to_python)?;
        let spreads = made.hull_spreads.into_pyarray(py);
        Ok((cube_of(py, made.solid, root.levels)?, made.carved, spreads))
    }
}

/// What colours that disagree leave of the voxels of a cube: whether each is solid, how many each sweep
/// carved, and the spreads (grey levels) of the hull's own voxels. With no sweeps it only measures.
#[pyfunction]
#[pyo3(signature = (cameras, photos, distances, corners, solid, low_m, side_m, rule))]
#[allow(clippy::too_many_arguments)] // each is one thing to who calls
fn sweep_colours<'py>(
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
    given.left(py, to_python, |photos, views, root, solid| {
        sweep(photos, views, root, solid, &rule.rule)
    })
}

/// Adds the functions of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<SweepRule>()?;
    m.add_function(wrap_pyfunction!(sweep_colours, m)?)
}
