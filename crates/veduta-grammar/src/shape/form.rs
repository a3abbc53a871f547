//! The geometric side of a shape: its scope, and what fills it.

use std::sync::Arc;

use glam::DVec3;
use veduta_geometry::solid::{self, Mesh};

use super::asset::Instance;
use super::scope::{over, Scope};

/// How far points may lie apart and still be one, as a share of the scope's size.
pub const TOLERANCE: f64 = 1e-9;

/// What a shape consists of, in shares of its scope's size: from 0 to 1 along each axis.
///
/// Most shapes of a building are rectangles and boxes that fill their scopes; they have no points
/// of their own.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Nothing to see: a scope alone.
    Nothing,
    /// The rectangle that fills a flat scope; its normal is the axis (0, 1, 2) without extent.
    Rectangle(usize),
    /// The closed box that fills the scope.
    Box,
    /// Faces with holes; `solid` where they are closed.
    Faces { mesh: Arc<Mesh>, solid: bool },
    /// An asset that fills the scope. Operations that need its faces turn it into `Faces` first.
    Instance(Instance),
}

/// A scope with its geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    pub scope: Scope,
    pub geometry: Geometry,
}

impl Form {
    /// Faces in the world, in the smallest box along `axes` that holds them.
    pub fn around(mesh: Mesh, axes: glam::DMat3, solid: bool) -> Self {
        let local = axes.transpose();
        let mesh = mesh.mapped(|point| local * point);
        let (low, high) = mesh.bounds().unwrap_or_default();
        let scope = Scope {
            origin: axes * low,
            axes,
            size: without_dust(high - low),
        };
        let unit = mesh.mapped(|point| over(point - low, scope.size));
        // What is flat encloses nothing, and its cuts would have no faces.
        let solid = solid && scope.size.cmpgt(DVec3::ZERO).all();
        Self {
            scope,
            geometry: Geometry::of(unit, solid),
        }
    }

    /// The faces in the world, in metres.
    pub fn world_mesh(&self) -> Mesh {
        self.geometry.mesh().mapped(|unit| self.scope.world(unit))
    }

    /// The same geometry in the smallest box along the same axes that holds it.
    pub fn fitted(self) -> Self {
        match self.geometry {
            Geometry::Faces { solid, .. } => {
                Self::around(self.world_mesh(), self.scope.axes, solid)
            }
            _ => self,
        }
    }
}

impl Geometry {
    /// Faces in shares of a scope; a rectangle that fills it is told as such.
    pub fn of(mesh: Mesh, solid: bool) -> Self {
        if mesh.is_empty() {
            return Self::Nothing;
        }
        if let Some(axis) = filled_axis(&mesh) {
            return Self::Rectangle(axis);
        }
        Self::Faces {
            mesh: Arc::new(mesh),
            solid,
        }
    }

    /// Whether the surface is closed.
    pub fn is_solid(&self) -> bool {
        match self {
            Self::Nothing | Self::Rectangle(_) => false,
            Self::Box => true,
            Self::Faces { solid, .. } => *solid,
            Self::Instance(instance) => instance.is_solid(),
        }
    }

    /// About how many bytes of its own it takes.
    pub fn byte_count(&self) -> usize {
        match self {
            Self::Faces { mesh, .. } => mesh.byte_count(),
            _ => 0,
        }
    }

    /// The faces of an instance; anything else as it is.
    pub fn opened(&self) -> Self {
        match self {
            Self::Instance(instance) => Self::Faces {
                mesh: instance.mesh(),
                solid: instance.is_solid(),
            },
            other => other.clone(),
        }
    }

    /// The first corner of the first face in shares of the scope; None without faces.
    pub fn first_corner(&self) -> Option<DVec3> {
        let of_mesh = |mesh: &Mesh| {
            let face = mesh.faces().next()?;
            face.outline()
                .first()
                .map(|&corner| mesh.points[corner as usize])
        };
        match self {
            Self::Nothing => None,
            Self::Rectangle(axis) => Some(rectangle(*axis)[0]),
            Self::Faces { mesh, .. } => of_mesh(mesh),
            Self::Box | Self::Instance(_) => of_mesh(&self.mesh()),
        }
    }

    /// The faces in shares of the scope.
    pub fn mesh(&self) -> Mesh {
        match self {
            Self::Nothing => Mesh::new(),
            Self::Rectangle(axis) => Mesh::polygon(&[rectangle(*axis)]),
            Self::Box => solid::cube(),
            Self::Faces { mesh, .. } => Mesh::clone(mesh),
            Self::Instance(instance) => Mesh::clone(&instance.mesh()),
        }
    }
}

/// The corners of the unit square across an axis, counter-clockwise around it. The first edge of
/// one that lies or looks along z runs along x: at the front, or at the bottom.
pub fn rectangle(axis: usize) -> [DVec3; 4] {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    if axis == 1 {
        corners.rotate_left(1);
    }
    corners.map(|(a, b)| {
        let mut corner = DVec3::ZERO;
        corner[u] = a;
        corner[v] = b;
        corner
    })
}

/// The axis of the rectangle that a mesh is, if it is one that fills its scope.
fn filled_axis(mesh: &Mesh) -> Option<usize> {
    if mesh.face_count() != 1 || mesh.corner_count() != 4 {
        return None;
    }
    let corners: Vec<DVec3> = mesh.face(0).points().collect();
    (0..3).find(|&axis| {
        let wanted = rectangle(axis);
        (0..4).any(|turn| (0..4).all(|k| corners[(k + turn) % 4].abs_diff_eq(wanted[k], TOLERANCE)))
    })
}

/// Sizes that are rounding alone are none.
fn without_dust(size: DVec3) -> DVec3 {
    let dust = size.max_element() * TOLERANCE;
    DVec3::from_array(size.to_array().map(|s| if s <= dust { 0.0 } else { s }))
}
