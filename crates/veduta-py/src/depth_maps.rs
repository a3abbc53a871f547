//! What `veduta_stereo` makes of depth maps, for Python: agreement, clouds, surfaces, colours.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_stereo::colour::{add_colours, Sum};
use veduta_stereo::consistent::{Agreement, Depths};
use veduta_stereo::fuse::{fuse, Shown};
use veduta_stereo::nets::surface;
use veduta_stereo::volume::Volume;
use veduta_stereo::Camera;

use crate::stereo::{camera_of, cameras_of, fault, values, StereoFault};

type Maps<'py> = Vec<PyReadonlyArray2<'py, f32>>;
type Coordinates<'py> = Bound<'py, PyArray2<f64>>;
type Fused<'py> = (
    Coordinates<'py>,
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray2<u8>>,
    Bound<'py, PyArray1<u8>>,
    Vec<Bound<'py, PyArray1<u32>>>,
);

fn maps<'a>(
    shapes: &[(usize, usize)],
    depths: &'a [Vec<f32>],
    cameras: &[Camera],
) -> Vec<Depths<'a>> {
    (0..depths.len())
        .map(|i| Depths {
            camera: cameras[i],
            height: shapes[i].0,
            width: shapes[i].1,
            depths: &depths[i],
        })
        .collect()
}

fn shapes_of(depths: &Maps<'_>) -> Vec<(usize, usize)> {
    depths.iter().map(|one| one.as_array().dim()).collect()
}

fn triples<T: Copy + numpy::Element>(
    array: &PyReadonlyArray2<'_, T>,
    count: usize,
) -> PyResult<Vec<[T; 3]>> {
    let view = array.as_array();
    if view.dim() != (count, 3) {
        return Err(StereoFault::new_err(
            "3 columns and a row for each pixel or point",
        ));
    }
    Ok(view
        .rows()
        .into_iter()
        .map(|r| [r[0], r[1], r[2]])
        .collect())
}

fn rows_of<'py, T: numpy::Element>(
    py: Python<'py>,
    rows: Vec<[T; 3]>,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let count = rows.len();
    let shaped = Array2::from_shape_vec((count, 3), rows.into_flattened())
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(shaped.into_pyarray(py))
}

/// For each pixel of the first depth map, row by row, how many of the others agree with it. depths:
/// (h, w) in metres, NaN where unknown; cameras: a row of 16 numbers for each.
#[pyfunction]
#[pyo3(signature = (depths, cameras, *, most_px, most_share))]
fn agreeing_views<'py>(
    py: Python<'py>,
    depths: Vec<PyReadonlyArray2<'py, f32>>,
    cameras: PyReadonlyArray2<'py, f64>,
    most_px: f64,
    most_share: f64,
) -> PyResult<Bound<'py, PyArray1<u8>>> {
    let cameras = cameras_of(&cameras, depths.len())?;
    let shapes = shapes_of(&depths);
    let known: Vec<Vec<f32>> = depths.iter().map(values).collect();
    let views = maps(&shapes, &known, &cameras);
    let Some((own, others)) = views.split_first() else {
        return Err(StereoFault::new_err("no depth map"));
    };
    let agreement = Agreement {
        most_px,
        most_share,
    };
    let found = py.detach(|| agreement.counts(own, others));
    Ok(found.into_pyarray(py))
}

/// Points (m, world), normals, colours and numbers of views of what the first view shows and no
/// earlier one did, and the pixels of each view that went into them. normals (camera's frame) and
/// colours: (pixels, 3) of each view. used: pixels that have a point already, one array per view.
#[pyfunction]
#[pyo3(signature = (depths, cameras, normals, colours, used, *, most_px, most_share, least))]
#[allow(clippy::too_many_arguments)]
fn fuse_depths<'py>(
    py: Python<'py>,
    depths: Vec<PyReadonlyArray2<'py, f32>>,
    cameras: PyReadonlyArray2<'py, f64>,
    normals: Vec<PyReadonlyArray2<'py, f32>>,
    colours: Vec<PyReadonlyArray2<'py, u8>>,
    used: Vec<PyReadonlyArray2<'py, bool>>,
    most_px: f64,
    most_share: f64,
    least: u8,
) -> PyResult<Fused<'py>> {
    let count = depths.len();
    let shapes = shapes_of(&depths);
    let marked: Vec<_> = used.iter().map(|one| one.as_array().dim()).collect();
    if normals.len() != count || colours.len() != count || marked != shapes {
        return Err(StereoFault::new_err("one of each for every view"));
    }
    let cameras = cameras_of(&cameras, count)?;
    let known: Vec<Vec<f32>> = depths.iter().map(values).collect();
    let used: Vec<Vec<bool>> = used.iter().map(values).collect();
    let views = maps(&shapes, &known, &cameras);
    let normals: Vec<Vec<[f32; 3]>> = each_triples(&normals, &known)?;
    let colours: Vec<Vec<[u8; 3]>> = each_triples(&colours, &known)?;
    let (found, taken) = py.detach(|| {
        let shown: Vec<Shown<'_>> = (0..count)
            .map(|i| Shown {
                depths: views[i],
                normals: &normals[i],
                colours: &colours[i],
            })
            .collect();
        let agreement = Agreement {
            most_px,
            most_share,
        };
        fuse(&shown, &used, agreement, least)
    });
    Ok((
        rows_of(py, found.points)?,
        rows_of(py, found.normals)?,
        rows_of(py, found.colours)?,
        found.views.into_pyarray(py),
        taken.into_iter().map(|one| one.into_pyarray(py)).collect(),
    ))
}

fn each_triples<T: Copy + numpy::Element>(
    arrays: &[PyReadonlyArray2<'_, T>],
    known: &[Vec<f32>],
) -> PyResult<Vec<Vec<[T; 3]>>> {
    let pairs = arrays.iter().zip(known);
    pairs.map(|(one, own)| triples(one, own.len())).collect()
}

/// Signed distances to what depth maps show, near the surface alone.
#[pyclass(module = "veduta._core")]
struct DepthVolume {
    volume: Volume,
}

#[pymethods]
impl DepthVolume {
    /// voxel_m: side of a voxel. truncation_voxels: how far behind and before a surface is measured.
    /// most_blocks: of 8 x 8 x 8 voxels (4 kB) that may be taken.
    #[new]
    fn new(voxel_m: f64, truncation_voxels: f64, most_blocks: usize) -> PyResult<Self> {
        let volume = Volume::new(voxel_m, truncation_voxels, most_blocks).map_err(fault)?;
        Ok(Self { volume })
    }

    /// Takes in a depth map, (h, w) in metres with NaN where unknown, each pixel with its weight.
    fn add(
        &mut self,
        py: Python<'_>,
        depths: PyReadonlyArray2<'_, f32>,
        camera: PyReadonlyArray1<'_, f64>,
        weights: PyReadonlyArray2<'_, f32>,
    ) -> PyResult<()> {
        let camera = camera_of(&camera.as_array().to_vec())?;
        let (height, width) = depths.as_array().dim();
        if weights.as_array().dim() != (height, width) {
            return Err(StereoFault::new_err("a weight for each pixel"));
        }
        let (known, weights) = (values(&depths), values(&weights));
        let view = Depths {
            camera,
            width,
            height,
            depths: &known,
        };
        let volume = &mut self.volume;
        py.detach(|| volume.add(&view, &weights)).map_err(fault)
    }

    /// Blocks that are taken.
    fn blocks(&self) -> usize {
        self.volume.blocks.len()
    }

    /// Vertices (m, world) and triangles of the surface, where voxels have at least this weight.
    fn surface<'py>(
        &self,
        py: Python<'py>,
        least: f32,
    ) -> PyResult<(Coordinates<'py>, Bound<'py, PyArray2<u32>>)> {
        let found = py.detach(|| surface(&self.volume, least));
        Ok((rows_of(py, found.points)?, rows_of(py, found.triangles)?))
    }
}

/// Adds what a view shows of each point to `sums`, (n, 5): red, green and blue times their weight,
/// the weight, and the number of views. colours: (pixels, 3). within_m: how far the view's depth may
/// lie from a point that it sees.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
fn add_point_colours<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    normals: PyReadonlyArray2<'py, f32>,
    depths: PyReadonlyArray2<'py, f32>,
    camera: PyReadonlyArray1<'py, f64>,
    colours: PyReadonlyArray2<'py, u8>,
    within_m: f64,
    sums: PyReadonlyArray2<'py, f32>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let camera = camera_of(&camera.as_array().to_vec())?;
    let (height, width) = depths.as_array().dim();
    let known = values(&depths);
    let view = Depths {
        camera,
        width,
        height,
        depths: &known,
    };
    let colours = triples(&colours, known.len())?;
    let count = points.as_array().nrows();
    let (points, normals) = (triples(&points, count)?, triples(&normals, count)?);
    if sums.as_array().dim() != (count, 5) {
        return Err(StereoFault::new_err(
            "sums need 5 columns and a row for each point",
        ));
    }
    let rows = sums.as_array();
    let mut totals: Vec<Sum> = rows
        .rows()
        .into_iter()
        .map(|row| Sum {
            colour: [row[0], row[1], row[2]],
            weight: row[3],
            views: row[4],
        })
        .collect();
    py.detach(|| add_colours(&points, &normals, &view, &colours, within_m, &mut totals));
    let flat: Vec<f32> = totals
        .into_iter()
        .flat_map(|one| {
            let [r, g, b] = one.colour;
            [r, g, b, one.weight, one.views]
        })
        .collect();
    let shaped = Array2::from_shape_vec((count, 5), flat)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(shaped.into_pyarray(py))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<DepthVolume>()?;
    m.add_function(wrap_pyfunction!(agreeing_views, m)?)?;
    m.add_function(wrap_pyfunction!(fuse_depths, m)?)?;
    m.add_function(wrap_pyfunction!(add_point_colours, m)?)
}
