//! `veduta_geometry` for Python: columns in, columns out, the GIL released in between.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_geometry::solid::{dissolve, Corner, Sheet};
use veduta_geometry::{triangulate, triangulate_sound, PolygonError, PolygonSet, Triangulation};

use crate::derived_lot::rows;

create_exception!(_core, PolygonFault, PyValueError);
create_exception!(_core, BadOffsetsError, PolygonFault);
create_exception!(_core, NotFiniteError, PolygonFault);
create_exception!(_core, RingTooShortError, PolygonFault);
create_exception!(_core, RepeatedVertexError, PolygonFault);
create_exception!(_core, NoAreaError, PolygonFault);
create_exception!(_core, NotPlanarError, PolygonFault);
create_exception!(_core, SelfCrossingError, PolygonFault);

fn to_python(error: &PolygonError) -> PyErr {
    let text = error.to_string();
    match error {
        PolygonError::BadOffsets { .. } => BadOffsetsError::new_err(text),
        PolygonError::NotFinite { .. } => NotFiniteError::new_err(text),
        PolygonError::RingTooShort { .. } => RingTooShortError::new_err(text),
        PolygonError::RepeatedVertex { .. } => RepeatedVertexError::new_err(text),
        PolygonError::NoArea { .. } => NoAreaError::new_err(text),
        PolygonError::NotPlanar { .. } => NotPlanarError::new_err(text),
        PolygonError::SelfCrossing { .. } => SelfCrossingError::new_err(text),
    }
}

type Columns<'py> = (
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
);

/// Triangles, the polygon of each triangle, unit normals and areas (m2) of columnar polygons.
#[pyfunction]
fn triangulate_polygons<'py>(
    py: Python<'py>,
    positions_m: PyReadonlyArray2<'py, f64>,
    ring_offsets: PyReadonlyArray1<'py, i64>,
    polygon_offsets: PyReadonlyArray1<'py, i64>,
    tolerance_m: f64,
) -> PyResult<Columns<'py>> {
    let points = points_of(&positions_m)?;
    let rings: Vec<i64> = ring_offsets.as_array().to_vec();
    let polygons: Vec<i64> = polygon_offsets.as_array().to_vec();
    let found: Result<Triangulation, PolygonError> = py.detach(|| {
        let set = PolygonSet::new(&points, &rings, &polygons)?;
        triangulate(&set, tolerance_m)
    });
    let found = found.map_err(|error| to_python(&error))?;
    Ok((
        rows(&found.triangles).into_pyarray(py),
        found.triangle_polygon.into_pyarray(py),
        rows(&found.normals).into_pyarray(py),
        found.areas_m2.into_pyarray(py),
    ))
}

type Dissolved<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<u32>>,
);

/// Polygons of one group that touch in one plane as one: positions, texture coordinates, offsets of
/// rings and polygons, and the group of each. Polygons of one solid share their corners.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // columns
fn dissolve_polygons<'py>(
    py: Python<'py>,
    positions_m: PyReadonlyArray2<'py, f64>,
    uv: PyReadonlyArray2<'py, f64>,
    ring_offsets: PyReadonlyArray1<'py, i64>,
    polygon_offsets: PyReadonlyArray1<'py, i64>,
    group: PyReadonlyArray1<'py, u32>,
    solid: PyReadonlyArray1<'py, u32>,
    near_m: f64,
) -> PyResult<Dissolved<'py>> {
    let (points, uv) = (points_of(&positions_m)?, uv.as_array());
    let (group, solid) = (group.as_array(), solid.as_array());
    let wide = uv.ncols() == 2 && uv.nrows() == points.len();
    let polygons: Vec<i64> = polygon_offsets.as_array().to_vec();
    if !wide || group.len() + 1 != polygons.len() || solid.len() != group.len() {
        return Err(PyValueError::new_err("the columns do not fit each other"));
    }
    let rings: Vec<i64> = ring_offsets.as_array().to_vec();
    let set = PolygonSet::new(&points, &rings, &polygons).map_err(|error| to_python(&error))?;
    let corner = |vertex: usize| Corner {
        place: points[vertex].into(),
        uv: [uv[[vertex, 0]], uv[[vertex, 1]]],
    };
    let sheets: Vec<Sheet> = (0..set.len())
        .map(|polygon| Sheet {
            rings: set
                .rings(polygon)
                .map(|ring| ring.map(corner).collect())
                .collect(),
            group: group[polygon],
            solid: solid[polygon],
        })
        .collect();
    let found = py.detach(|| dissolve(&sheets, near_m));
    let (mut places, mut coordinates) = (Vec::new(), Vec::new());
    let (mut ring_ends, mut polygon_ends) = (vec![0], vec![0]);
    for ring in found.iter().flat_map(|sheet| &sheet.rings) {
        places.extend(ring.iter().map(|corner| corner.place.to_array()));
        coordinates.extend(ring.iter().map(|corner| corner.uv));
        ring_ends.push(places.len() as i64);
    }
    let mut count = 0;
    for sheet in &found {
        count += sheet.rings.len() as i64;
        polygon_ends.push(count);
    }
    let groups: Vec<u32> = found.iter().map(|sheet| sheet.group).collect();
    Ok((
        rows(&places).into_pyarray(py),
        rows(&coordinates).into_pyarray(py),
        ring_ends.into_pyarray(py),
        polygon_ends.into_pyarray(py),
        groups.into_pyarray(py),
    ))
}

/// Which of columnar polygons `triangulate_polygons` takes.
#[pyfunction]
fn sound_polygons<'py>(
    py: Python<'py>,
    positions_m: PyReadonlyArray2<'py, f64>,
    ring_offsets: PyReadonlyArray1<'py, i64>,
    polygon_offsets: PyReadonlyArray1<'py, i64>,
    tolerance_m: f64,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let points = points_of(&positions_m)?;
    let rings: Vec<i64> = ring_offsets.as_array().to_vec();
    let polygons: Vec<i64> = polygon_offsets.as_array().to_vec();
    let found: Result<Vec<bool>, PolygonError> = py.detach(|| {
        let set = PolygonSet::of_any_rings(&points, &rings, &polygons)?;
        Ok(triangulate_sound(&set, tolerance_m).is_sound)
    });
    Ok(found.map_err(|error| to_python(&error))?.into_pyarray(py))
}

fn points_of(positions_m: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 3]>> {
    let view = positions_m.as_array();
    if view.ncols() != 3 {
        return Err(PyValueError::new_err(format!(
            "positions_m must have 3 columns, not {}",
            view.ncols()
        )));
    }
    let rows = view.rows().into_iter();
    Ok(rows.map(|p| [p[0], p[1], p[2]]).collect())
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = m.py();
    m.add("PolygonFault", py.get_type::<PolygonFault>())?;
    m.add("BadOffsetsError", py.get_type::<BadOffsetsError>())?;
    m.add("NotFiniteError", py.get_type::<NotFiniteError>())?;
    m.add("RingTooShortError", py.get_type::<RingTooShortError>())?;
    m.add("RepeatedVertexError", py.get_type::<RepeatedVertexError>())?;
    m.add("NoAreaError", py.get_type::<NoAreaError>())?;
    m.add("NotPlanarError", py.get_type::<NotPlanarError>())?;
    m.add("SelfCrossingError", py.get_type::<SelfCrossingError>())?;
    m.add_function(wrap_pyfunction!(dissolve_polygons, m)?)?;
    m.add_function(wrap_pyfunction!(triangulate_polygons, m)?)?;
    m.add_function(wrap_pyfunction!(sound_polygons, m)?)
}
