//! `veduta_stereo`'s search for Python: pictures and cameras in, planes out, the GIL released.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_stereo::planes::{Plane, Planes};
use veduta_stereo::search::{search, Neighbour, Search};
use veduta_stereo::{Camera, Grey, StereoError};

use crate::stereo_rules::SearchRule;

create_exception!(_core, StereoFault, PyValueError);

pub fn fault(error: StereoError) -> PyErr {
    StereoFault::new_err(error.to_string())
}

/// A camera of 16 numbers: focal lengths and principal point (px), rotation row by row, shift.
pub fn camera_of(row: &[f64]) -> PyResult<Camera> {
    if row.len() != 16 {
        return Err(StereoFault::new_err("a camera has 16 numbers"));
    }
    let turn = std::array::from_fn(|r| std::array::from_fn(|c| row[4 + 3 * r + c]));
    let shift = std::array::from_fn(|i| row[13 + i]);
    Camera::new([row[0], row[1]], [row[2], row[3]], turn, shift).map_err(fault)
}

/// The cameras of an array with a row for each.
pub fn cameras_of(rows: &PyReadonlyArray2<'_, f64>, count: usize) -> PyResult<Vec<Camera>> {
    let view = rows.as_array();
    if view.nrows() != count {
        return Err(StereoFault::new_err("one row of cameras for each picture"));
    }
    view.rows()
        .into_iter()
        .map(|row| camera_of(&row.to_vec()))
        .collect()
}

pub fn values<T: Copy + numpy::Element>(array: &PyReadonlyArray2<'_, T>) -> Vec<T> {
    array.as_array().iter().copied().collect()
}

fn grey_of(image: &PyReadonlyArray2<'_, u8>) -> PyResult<Grey> {
    let (height, width) = image.as_array().dim();
    Grey::new(width, height, &values(image)).map_err(fault)
}

fn planes_of(rows: &PyReadonlyArray2<'_, f32>, shape: (usize, usize)) -> PyResult<Planes> {
    let view = rows.as_array();
    let (height, width) = shape;
    if view.dim() != (width * height, 4) || width == 0 || height == 0 {
        return Err(StereoFault::new_err(
            "start needs 4 columns and a row for each pixel",
        ));
    }
    let planes = view.rows().into_iter().map(|row| Plane {
        inverse: row[0],
        slope: [row[1], row[2]],
    });
    Ok(Planes {
        width,
        height,
        planes: planes.collect(),
        costs: vec![f32::INFINITY; width * height],
    })
}

/// A plane for each pixel of a grey picture, by what its neighbours show: inverse depth (1/m), its
/// slopes along x and y (1/m/px), and the cost, in (pixels, 4), row by row. cameras: a row of 16
/// numbers for each neighbour (focal lengths, principal point, rotation, shift). depths: of each
/// neighbour, (h, w) in metres, or None. start: planes of this view at another size (`start_shape`).
#[pyfunction]
#[pyo3(signature = (image, camera, neighbours, cameras, depths, start, start_shape, rule))]
#[allow(clippy::too_many_arguments)] // each is one thing to who calls
fn match_planes<'py>(
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
    planes_told(py, py.detach(|| given.planes(search)).map_err(fault)?)
}

/// What `match_planes` of the processor and of a graphics card are given.
pub struct Matching {
    reference: Grey,
    camera: Camera,
    greys: Vec<Grey>,
    cameras: Vec<Camera>,
    known: Vec<Option<Vec<f32>>>,
    start: Option<Planes>,
    search: Search,
}

/// Pictures, cameras and depths of the neighbours.
pub type Others<'a, 'py> = (
    &'a [PyReadonlyArray2<'py, u8>],
    &'a PyReadonlyArray2<'py, f64>,
    &'a [Option<PyReadonlyArray2<'py, f32>>],
);

impl Matching {
    pub fn new(
        image: &PyReadonlyArray2<'_, u8>,
        camera: &PyReadonlyArray1<'_, f64>,
        others: Others<'_, '_>,
        start: (Option<&PyReadonlyArray2<'_, f32>>, (usize, usize)),
        search: Search,
    ) -> PyResult<Self> {
        let (neighbours, cameras, depths) = others;
        let greys: Vec<Grey> = neighbours.iter().map(grey_of).collect::<PyResult<_>>()?;
        if depths.len() != greys.len() {
            return Err(StereoFault::new_err("depths or None for each neighbour"));
        }
        Ok(Self {
            reference: grey_of(image)?,
            camera: camera_of(&camera.as_array().to_vec())?,
            cameras: cameras_of(cameras, greys.len())?,
            greys,
            known: depths.iter().map(|one| one.as_ref().map(values)).collect(),
            start: start.0.map(|rows| planes_of(rows, start.1)).transpose()?,
            search,
        })
    }

    /// By a search on the processor or on a card.
    pub fn planes<E>(
        self,
        by: impl FnOnce(&Grey, Camera, &[Neighbour<'_>], Option<Planes>, Search) -> Result<Planes, E>,
    ) -> Result<Planes, E> {
        let others: Vec<Neighbour<'_>> = (0..self.greys.len())
            .map(|i| Neighbour {
                image: &self.greys[i],
                camera: self.cameras[i],
                depths: self.known[i].as_deref(),
            })
            .collect();
        by(
            &self.reference,
            self.camera,
            &others,
            self.start,
            self.search,
        )
    }
}

pub fn planes_told(py: Python<'_>, found: Planes) -> PyResult<Bound<'_, PyArray2<f32>>> {
    let rows = found.planes.iter().zip(&found.costs);
    let flat: Vec<f32> = rows
        .flat_map(|(plane, cost)| [plane.inverse, plane.slope[0], plane.slope[1], *cost])
        .collect();
    let shaped = Array2::from_shape_vec((found.planes.len(), 4), flat)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(shaped.into_pyarray(py))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("StereoFault", m.py().get_type::<StereoFault>())?;
    m.add_function(wrap_pyfunction!(match_planes, m)?)
}
