//! A face as a polygon in its own plane.

use glam::{DMat3, DVec3};

use super::mesh::{Face, Mesh};

/// The plane of a face with axes of its own: x and y in it, z along its normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Level {
    axes: DMat3,
    height: f64,
}

impl Level {
    pub fn of(mesh: &Mesh, face: Face<'_>) -> Self {
        let normal = face.normal();
        let (x, y) = normal.any_orthonormal_pair();
        Self {
            axes: DMat3::from_cols(x, y, normal),
            height: mesh.points[face.outline()[0] as usize].dot(normal),
        }
    }

    /// The same with x along a direction, seen from above; as before where that is upright.
    pub fn along(self, x: DVec3) -> Self {
        let normal = self.axes.z_axis;
        let x = (x - normal * x.dot(normal)).normalize_or(self.axes.x_axis);
        Self {
            axes: DMat3::from_cols(x, normal.cross(x), normal),
            ..self
        }
    }

    /// The plane moved by `up` along its normal.
    pub fn raised(self, up: f64) -> Self {
        Self {
            height: self.height + up,
            ..self
        }
    }

    /// The rings of a face in the plane, in the unit of the mesh.
    pub fn flat(&self, mesh: &Mesh, face: Face<'_>) -> Vec<Vec<[f64; 2]>> {
        let local = self.axes.transpose();
        face.rings()
            .map(|ring| {
                let flat = |&point: &u32| {
                    let own = local * mesh.points[point as usize];
                    [own.x, own.y]
                };
                ring.iter().map(flat).collect()
            })
            .collect()
    }

    /// A place of the plane, `up` above it, in space.
    pub fn place(&self, flat: [f64; 2], up: f64) -> DVec3 {
        self.axes * DVec3::new(flat[0], flat[1], self.height + up)
    }
}
