//! Roofs for Python: a polygon and the name of a type in, a closed solid as columns out.

use std::collections::HashMap;

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use veduta_geometry::glam::DVec3;
use veduta_geometry::skeleton::SkeletonError;
use veduta_geometry::solid::{roofed_over, Along, Gables, Mesh, Overhang, RoofKind};

create_exception!(_core, RoofFault, PyValueError);

/// The types of roof, in the order of the docs.
const NAMES: [&str; 18] = [
    "hip",
    "gable",
    "pyramid",
    "shed",
    "skillion",
    "ridge",
    "mansard",
    "gambrel",
    "half-hip",
    "dutch",
    "saltbox",
    "butterfly",
    "sawtooth",
    "cross-gable",
    "dome",
    "onion",
    "vault",
    "flat",
];

/// What a roof is made with; each is a number that its type asks for, with a default.
struct Numbers(HashMap<String, f64>);

impl Numbers {
    fn get(&self, name: &str, none: f64) -> f64 {
        self.0.get(name).copied().unwrap_or(none)
    }

    fn count(&self, name: &str, none: f64) -> u32 {
        self.get(name, none).clamp(0.0, 10_000.0) as u32
    }

    fn kind(&self, name: &str) -> Option<RoofKind> {
        let gables = Gables::Triangles;
        let along = Along::Longest;
        let (upper, knee) = (self.get("upper", 0.4), self.get("knee_m", 1.5));
        let steps = self.count("steps", 8.0).max(1);
        let height = |none| self.get("height_m", none);
        Some(match name {
            "hip" => RoofKind::HIP,
            "gable" => RoofKind::GABLE,
            "pyramid" => RoofKind::Pyramid,
            "shed" => RoofKind::Shed {
                edge: self.count("edge", 0.0),
            },
            "skillion" => {
                let angle = self.get("direction_rad", 0.0);
                let towards = DVec3::new(angle.cos(), angle.sin(), 0.0);
                RoofKind::Skillion { towards }
            }
            "ridge" => RoofKind::Ridge(along),
            "mansard" => RoofKind::Mansard { upper, knee },
            "gambrel" => RoofKind::Gambrel {
                gables,
                upper,
                knee,
            },
            "half-hip" => RoofKind::HalfHip {
                gables,
                clipped: self.get("share", 0.4),
            },
            "dutch" => RoofKind::Dutch {
                share: self.get("share", 0.6),
            },
            "saltbox" => RoofKind::Saltbox {
                back: self.get("back", 0.5),
                front: None,
            },
            "butterfly" => RoofKind::Butterfly(along),
            "sawtooth" => RoofKind::Sawtooth {
                teeth: self.count("teeth", 5.0).max(1),
                along,
            },
            "cross-gable" => RoofKind::CrossGable(along),
            "dome" => RoofKind::Dome {
                height: height(4.0),
                steps,
            },
            "onion" => RoofKind::Onion {
                height: height(6.0),
                steps,
            },
            "vault" => RoofKind::Vault {
                gables,
                height: height(3.0),
                steps,
            },
            "flat" => RoofKind::Flat {
                slab: self.get("slab_m", 0.2),
                parapet: self.get("slab_m", 0.2) + self.get("parapet_m", 0.9),
                width: self.get("width_m", 0.3),
            },
            _ => return None,
        })
    }
}

type Columns<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<u32>>,
);

/// The names of the types of roof.
#[pyfunction]
fn roof_types() -> Vec<&'static str> {
    NAMES.to_vec()
}

/// The closed solid between a polygon (x, y in metres; rings by their offsets, the outline first)
/// and a roof over it: points, the first corner of each ring, the first ring of each face (both with
/// the end), and the point of each corner. `slope` is a tangent.
#[pyfunction]
#[pyo3(signature = (kind, points_m, ring_offsets, slope, *, overhang_m=0.0, gable_overhang_m=0.0, numbers=None))]
#[allow(clippy::too_many_arguments)] // as Python calls it: with names
fn roof_solid<'py>(
    py: Python<'py>,
    kind: &str,
    points_m: PyReadonlyArray2<'py, f64>,
    ring_offsets: PyReadonlyArray1<'py, i64>,
    slope: f64,
    overhang_m: f64,
    gable_overhang_m: f64,
    numbers: Option<HashMap<String, f64>>,
) -> PyResult<Columns<'py>> {
    let numbers = Numbers(numbers.unwrap_or_default());
    let made = numbers.kind(kind);
    let kind = made.ok_or_else(|| RoofFault::new_err(format!("`{kind}` is no type of roof")))?;
    let points = points_m.as_array();
    let offsets = ring_offsets.as_array().to_vec();
    let count = points.nrows();
    let is_sound = points.ncols() == 2
        && offsets.first() == Some(&0)
        && offsets.last() == Some(&(count as i64))
        && offsets.windows(2).all(|pair| pair[0] < pair[1]);
    if !is_sound {
        let message = "points need 2 columns, and offsets rise from 0 to their number";
        return Err(RoofFault::new_err(message));
    }
    let place = |k: usize| DVec3::new(points[[k, 0]], points[[k, 1]], 0.0);
    let rings: Vec<Vec<DVec3>> = offsets
        .windows(2)
        .map(|pair| (pair[0] as usize..pair[1] as usize).map(place).collect())
        .collect();
    let overhang = Overhang {
        eaves: overhang_m,
        gables: gable_overhang_m,
    };
    let found: Result<Mesh, SkeletonError> =
        py.detach(|| roofed_over(&Mesh::polygon(&rings), &kind, slope, overhang));
    let solid = found.map_err(|why| RoofFault::new_err(why.to_string()))?;
    Ok(columns(py, &solid))
}

fn columns<'py>(py: Python<'py>, solid: &Mesh) -> Columns<'py> {
    let points = &solid.points;
    let positions = Array2::from_shape_fn((points.len(), 3), |(row, axis)| points[row][axis]);
    let mut corners = Vec::with_capacity(solid.corner_count());
    let (mut rings, mut faces) = (vec![0i64], vec![0i64]);
    for face in solid.faces() {
        for ring in face.rings() {
            corners.extend_from_slice(ring);
            rings.push(corners.len() as i64);
        }
        faces.push(rings.len() as i64 - 1);
    }
    (
        positions.into_pyarray(py),
        rings.into_pyarray(py),
        faces.into_pyarray(py),
        corners.into_pyarray(py),
    )
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("RoofFault", m.py().get_type::<RoofFault>())?;
    m.add_function(wrap_pyfunction!(roof_types, m)?)?;
    m.add_function(wrap_pyfunction!(roof_solid, m)?)
}
