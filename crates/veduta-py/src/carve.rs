//! `veduta_carve` for Python: silhouettes and photos in, volumes and colours out, the GIL released in
//! between.

use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use veduta_carve::colours::{colours, ColourRule};
use veduta_carve::raster::rasterise;
use veduta_carve::{hull, CarveError, Photo, Projection, Root, View, Volume};
use veduta_surface::surface_nets;

use crate::surface::{arrays_of, fault_of, Arrays};

create_exception!(_core, CarveFault, PyValueError);

pub fn to_python(error: CarveError) -> PyErr {
    CarveFault::new_err(error.to_string())
}

/// Rows of 16 numbers: the matrix that projects row by row, the focal length, the centre.
fn projections_of(cameras: &PyReadonlyArray2<'_, f64>, count: usize) -> PyResult<Vec<Projection>> {
    let view = cameras.as_array();
    if view.dim() != (count, 16) {
        let text = format!("cameras must be {count} rows of 16 numbers");
        return Err(PyValueError::new_err(text));
    }
    let of = |row: usize| Projection {
        rows: std::array::from_fn(|n| std::array::from_fn(|k| view[(row, 4 * n + k)])),
        focal_px: view[(row, 12)],
        centre_m: std::array::from_fn(|axis| view[(row, 13 + axis)]),
    };
    Ok((0..count).map(of).collect())
}

fn points_of(name: &str, points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 3]>> {
    let view = points.as_array();
    if view.ncols() != 3 {
        let text = format!("{name} must have 3 columns, not {}", view.ncols());
        return Err(PyValueError::new_err(text));
    }
    Ok(view
        .rows()
        .into_iter()
        .map(|p| [p[0], p[1], p[2]])
        .collect())
}

pub fn cube_of(
    py: Python<'_>,
    solid: Vec<bool>,
    levels: u32,
) -> PyResult<Bound<'_, PyArray3<bool>>> {
    let along = 1 << levels;
    let cube = Array3::from_shape_vec((along, along, along), solid);
    let cube = cube.map_err(|why| PyValueError::new_err(why.to_string()))?;
    Ok(cube.into_pyarray(py))
}

fn triangles_of(triangles: &PyReadonlyArray2<'_, u32>, vertices: usize) -> PyResult<Vec<[u32; 3]>> {
    let view = triangles.as_array();
    if view.ncols() != 3 {
        return Err(PyValueError::new_err("triangles must have 3 columns"));
    }
    let faces: Vec<[u32; 3]> = view
        .rows()
        .into_iter()
        .map(|t| [t[0], t[1], t[2]])
        .collect();
    if faces.iter().flatten().any(|at| *at as usize >= vertices) {
        return Err(PyValueError::new_err(
            "a triangle has a vertex that is not there",
        ));
    }
    Ok(faces)
}

pub fn views_of<'a>(
    cameras: &PyReadonlyArray2<'_, f64>,
    distances: &'a [PyReadonlyArray2<'_, f32>],
    corners: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Vec<View<'a>>> {
    let projections = projections_of(cameras, distances.len())?;
    let corners = corners.as_array();
    if corners.dim() != (distances.len(), 2) {
        return Err(PyValueError::new_err(
            "corners must be a pair for each view",
        ));
    }
    let mut views = Vec::with_capacity(projections.len());
    for (at, (projection, distance)) in projections.into_iter().zip(distances).enumerate() {
        let (height, width) = distance.as_array().dim();
        views.push(View {
            projection,
            corner_px: [corners[(at, 0)], corners[(at, 1)]],
            width,
            height,
            distances_px: distance.as_slice()?,
        });
    }
    Ok(views)
}

/// What silhouettes left of a cube: signed evidence, less than zero inside.
#[pyclass(frozen, module = "veduta._core")]
pub struct CarvedVolume {
    pub volume: Volume,
}

#[pymethods]
impl CarvedVolume {
    /// Voxels whose centres are inside.
    fn inside(&self) -> usize {
        self.volume.inside()
    }

    /// Cubes of each level of the octree that are outside, inside and on a boundary.
    fn counts(&self) -> Vec<[usize; 3]> {
        self.volume.counts.clone()
    }

    /// Bytes that the evidence takes.
    fn size(&self) -> usize {
        self.volume.bytes()
    }

    /// Of each voxel (x, y, z), whether its centre is inside.
    fn solid<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<bool>>> {
        let solid = py.detach(|| self.volume.solid());
        cube_of(py, solid, self.volume.root.levels)
    }

    /// The volume without what `field` carves: signed evidence (m, less than zero where nothing is
    /// carved) over the same cube, 2^n values along each edge.
    fn deepened(&self, py: Python<'_>, field: PyReadonlyArray3<'_, f32>) -> PyResult<CarvedVolume> {
        let levels = field.as_array().dim().0.max(1).ilog2();
        let field = field.as_slice()?;
        let made = py.detach(|| self.volume.deepened(field, levels));
        let volume = made.map_err(to_python)?;
        Ok(CarvedVolume { volume })
    }

    /// Vertices (v, 3) in voxels, from the centre of the first one, and triangles (m, 3),
    /// counter-clockwise seen from outside.
    fn surface<'py>(&self, py: Python<'py>) -> PyResult<Arrays<'py>> {
        let made = py.detach(|| surface_nets(&self.volume, 0.0, true));
        Ok(arrays_of(py, made.map_err(fault_of)?))
    }
}

/// Carves a cube at `low_m`, 2^levels voxels along each edge. cameras: a row of 16 numbers for each
/// view (the projection to pixels row by row, the focal length, the centre). distances: of each view,
/// to the silhouette's outline (px), less than zero inside. corners: where in the picture they begin.
#[pyfunction]
fn carve_hull(
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
    let carved = py.detach(|| hull::carve(&views, root));
    Ok(CarvedVolume {
        volume: carved.map_err(to_python)?,
    })
}

type Coloured<'py> = (Bound<'py, PyArray2<u8>>, Bound<'py, PyArray1<u16>>);

/// Colours (v, 3) of vertices with unit normals, blended from the best views that see them, and how
/// many views do. Those that none sees take the colours around them. cameras: as in `carve_hull`.
#[pyfunction]
#[pyo3(signature = (cameras, photos, positions, normals, triangles, *, spacing_m, least_cosine,
                    power, views))]
#[allow(clippy::too_many_arguments)]
fn vertex_colours<'py>(
    py: Python<'py>,
    cameras: PyReadonlyArray2<'py, f64>,
    photos: Vec<PyReadonlyArray3<'py, u8>>,
    positions: PyReadonlyArray2<'py, f64>,
    normals: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, u32>,
    spacing_m: f64,
    least_cosine: f64,
    power: f64,
    views: usize,
) -> PyResult<Coloured<'py>> {
    let taken = photos_of(&cameras, &photos)?;
    let (positions, normals) = (
        points_of("positions", &positions)?,
        points_of("normals", &normals)?,
    );
    if normals.len() != positions.len() {
        return Err(PyValueError::new_err("each position must have a normal"));
    }
    let faces = triangles_of(&triangles, positions.len())?;
    let rule = ColourRule {
        spacing_m,
        least_cosine,
        power,
        views,
    };
    let made = py.detach(|| colours(&taken, &positions, &normals, &faces, &rule));
    let made = made.map_err(to_python)?;
    let rgb = Array2::from(made.rgb).into_pyarray(py);
    Ok((rgb, made.views.into_pyarray(py)))
}

pub fn photos_of<'a>(
    cameras: &PyReadonlyArray2<'_, f64>,
    photos: &'a [PyReadonlyArray3<'_, u8>],
) -> PyResult<Vec<Photo<'a>>> {
    let projections = projections_of(cameras, photos.len())?;
    let each = projections.into_iter().zip(photos);
    each.map(|(projection, photo)| {
        let (height, width, _) = photo.as_array().dim();
        let pixels = photo.as_slice()?;
        Ok(Photo {
            projection,
            width,
            height,
            pixels,
        })
    })
    .collect()
}

/// The triangle that each camera sees in the middle of each pixel, (h, w), -1 where there is none.
/// sizes: (width, height) of each camera.
#[pyfunction]
fn seen_triangles<'py>(
    py: Python<'py>,
    cameras: PyReadonlyArray2<'py, f64>,
    sizes: Vec<[usize; 2]>,
    positions: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, u32>,
) -> PyResult<Vec<Bound<'py, PyArray2<i32>>>> {
    let projections = projections_of(&cameras, sizes.len())?;
    let positions = points_of("positions", &positions)?;
    let faces = triangles_of(&triangles, positions.len())?;
    let made: Vec<Vec<i32>> = py.detach(|| {
        let each = projections.par_iter().zip(&sizes);
        each.map(|(camera, size)| rasterise(camera, *size, &positions, &faces).triangles)
            .collect()
    });
    let shaped = made.into_iter().zip(&sizes).map(|(one, [width, height])| {
        let shaped = Array2::from_shape_vec((*height, *width), one);
        let shaped = shaped.map_err(|why| PyValueError::new_err(why.to_string()))?;
        Ok(shaped.into_pyarray(py))
    });
    shaped.collect()
}

/// Adds the functions and errors of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("CarveFault", m.py().get_type::<CarveFault>())?;
    m.add_class::<CarvedVolume>()?;
    m.add_function(wrap_pyfunction!(carve_hull, m)?)?;
    m.add_function(wrap_pyfunction!(seen_triangles, m)?)?;
    m.add_function(wrap_pyfunction!(vertex_colours, m)?)
}
