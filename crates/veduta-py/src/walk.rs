//! `veduta_walk` for Python: arrays in, arrays out, the GIL released in between.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_walk::costs::{label_costs, Label, Levels, Node, Patches};
use veduta_walk::grid::Grid;
use veduta_walk::image::Grey;
use veduta_walk::potts;
use veduta_walk::raster::{rasterise, Scene};
use veduta_walk::WalkError;

create_exception!(_core, WalkFault, PyValueError);

type Columns<'py> = PyReadonlyArray2<'py, f32>;
type Labelled<'py> = (Bound<'py, PyArray1<u32>>, f64, f64);
type Drawn<'py> = (
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray2<i32>>,
);

fn to_python(error: WalkError) -> PyErr {
    WalkFault::new_err(error.to_string())
}

fn rows_of<T: numpy::Element + Copy, const N: usize>(
    name: &str,
    array: &PyReadonlyArray2<'_, T>,
) -> PyResult<Vec<[T; N]>> {
    let view = array.as_array();
    if view.ncols() != N {
        let text = format!("{name} must have {N} columns, not {}", view.ncols());
        return Err(WalkFault::new_err(text));
    }
    Ok(view
        .rows()
        .into_iter()
        .map(|row| std::array::from_fn(|k| row[k]))
        .collect())
}

fn images_of(images: &[Columns<'_>]) -> PyResult<Vec<Grey>> {
    let of = |image: &Columns<'_>| {
        let view = image.as_array();
        Grey::new(view.ncols(), view.nrows(), view.iter().copied().collect())
    };
    images
        .iter()
        .map(|one| of(one).map_err(to_python))
        .collect()
}

/// The cost of each label (columns) at each node (rows): 1 - correlation, 4 where it lies outside.
///
/// first, second: grey images, each shrunk by each of the scales. own, there: (n, 2) where a node
/// lies in `first` and, by geometry, in `second` (px of the unshrunk images). scale: (n) index of
/// its scale; negative: it is the larger in `first`. lines: (n, 3) epipolar lines in `second` of
/// unit normal, 0 for none. offsets: (l, 2) px in `second`; steps: (l) along the scales.
#[pyfunction]
#[pyo3(signature = (first, second, scales, own, there, scale, lines, offsets, steps, *, radius, band_px, noise))]
#[allow(clippy::too_many_arguments)]
fn walk_label_costs<'py>(
    py: Python<'py>,
    first: Vec<Columns<'py>>,
    second: Vec<Columns<'py>>,
    scales: Vec<f32>,
    own: Columns<'py>,
    there: Columns<'py>,
    scale: PyReadonlyArray1<'py, i32>,
    lines: Columns<'py>,
    offsets: Columns<'py>,
    steps: PyReadonlyArray1<'py, i32>,
    radius: i32,
    band_px: f32,
    noise: f32,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let levels = Levels {
        first: images_of(&first)?,
        second: images_of(&second)?,
        scales,
    };
    let (own, there) = (
        rows_of::<_, 2>("own", &own)?,
        rows_of::<_, 2>("there", &there)?,
    );
    let (lines, offsets) = (
        rows_of::<_, 3>("lines", &lines)?,
        rows_of::<_, 2>("offsets", &offsets)?,
    );
    let (scale, steps) = (scale.as_array().to_vec(), steps.as_array().to_vec());
    let even = own.len() == there.len() && own.len() == scale.len() && own.len() == lines.len();
    if !even || offsets.len() != steps.len() {
        return Err(WalkFault::new_err("columns do not belong together"));
    }
    let nodes: Vec<Node> = (0..own.len())
        .map(|k| Node {
            own: own[k],
            there: there[k],
            scale: scale[k],
            line: lines[k],
        })
        .collect();
    let labels: Vec<Label> = offsets
        .iter()
        .zip(&steps)
        .map(|(&offset, &step)| Label { offset, step })
        .collect();
    let patches = Patches {
        radius,
        band_px,
        noise,
    };
    let costs = py
        .detach(|| label_costs(&levels, &nodes, &labels, patches))
        .map_err(to_python)?;
    shaped(py, (nodes.len(), labels.len()), costs)
}

/// A labelling of low Potts energy, its energy, and what no labelling goes below.
///
/// costs: (n, l). node: (rows, columns) the numbers of the nodes row by row, -1 for none. right,
/// down: the weight between a node and the one on its right, below it. solver: "trws" or "icm".
#[pyfunction]
#[pyo3(signature = (costs, node, right, down, solver, *, rounds))]
fn walk_potts<'py>(
    py: Python<'py>,
    costs: Columns<'py>,
    node: PyReadonlyArray2<'py, i32>,
    right: Columns<'py>,
    down: Columns<'py>,
    solver: &str,
    rounds: usize,
) -> PyResult<Labelled<'py>> {
    let labels = costs.as_array().ncols();
    let values: Vec<f32> = costs.as_array().iter().copied().collect();
    let numbers: Vec<i32> = node.as_array().iter().copied().collect();
    let shape = node.as_array().dim();
    let right: Vec<f32> = right.as_array().iter().copied().collect();
    let down: Vec<f32> = down.as_array().iter().copied().collect();
    let solve = match solver {
        "trws" => potts::trws,
        "icm" => potts::icm,
        _ => return Err(WalkFault::new_err(format!("no solver {solver}"))),
    };
    let found = py
        .detach(|| {
            solve(
                &Grid::new(shape, &numbers, &right, &down)?,
                &values,
                labels,
                rounds,
            )
        })
        .map_err(to_python)?;
    Ok((found.labels.into_pyarray(py), found.energy, found.bound))
}

/// Triangles drawn: (h, w) depth, infinite where nothing is; (h w, c) what the surface carries there;
/// (h, w) which triangle it is, -1 for none.
///
/// screen: (v, 3) x and y (px) and depth (m) of the vertices. carried: (v, c). triangles: (t, 3).
#[pyfunction]
#[pyo3(signature = (screen, carried, triangles, width, height, *, near))]
fn walk_rasterise<'py>(
    py: Python<'py>,
    screen: Columns<'py>,
    carried: Columns<'py>,
    triangles: PyReadonlyArray2<'py, u32>,
    width: usize,
    height: usize,
    near: f32,
) -> PyResult<Drawn<'py>> {
    let columns = carried.as_array().ncols();
    let points = rows_of::<_, 3>("screen", &screen)?;
    let corners = rows_of::<_, 3>("triangles", &triangles)?;
    let values: Vec<f32> = carried.as_array().iter().copied().collect();
    let drawn = py
        .detach(|| {
            let scene = Scene {
                screen: &points,
                carried: &values,
                width: columns,
                triangles: &corners,
            };
            rasterise(&scene, (width, height), near)
        })
        .map_err(to_python)?;
    Ok((
        shaped(py, (height, width), drawn.depth)?,
        shaped(py, (height * width, columns), drawn.carried)?,
        shaped(py, (height, width), drawn.triangle)?,
    ))
}

fn shaped<T: numpy::Element>(
    py: Python<'_>,
    shape: (usize, usize),
    values: Vec<T>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let array = Array2::from_shape_vec(shape, values)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    Ok(array.into_pyarray(py))
}

/// Adds the functions and the error of this file to the module.
pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("WalkFault", m.py().get_type::<WalkFault>())?;
    m.add_function(wrap_pyfunction!(walk_label_costs, m)?)?;
    m.add_function(wrap_pyfunction!(walk_potts, m)?)?;
    m.add_function(wrap_pyfunction!(walk_rasterise, m)?)
}
