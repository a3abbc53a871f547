//! Ready-made geometry that shapes are filled with.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use veduta_geometry::solid::Mesh;

use super::scope::over;

/// A mesh from outside, in metres in its own frame (y up). It is the same for all shapes that it is
/// put into; each stretches it to its scope.
#[derive(Debug, Clone, PartialEq)]
pub struct Asset {
    pub name: Arc<str>,
    low: DVec3,
    size: DVec3,
    unit: Arc<Mesh>,
    solid: bool,
}

impl Asset {
    /// `low` and `high` are the corners of the box that will fill scopes. None where there is no
    /// face, where a place is no number, or where points lie off a box that is flat.
    pub fn new(name: Arc<str>, mesh: Mesh, (low, high): (DVec3, DVec3)) -> Option<Self> {
        let size = high - low;
        let fits = |point: &DVec3| {
            let off = (*point - low).abs();
            point.is_finite() && (0..3).all(|axis| size[axis] > 0.0 || off[axis] == 0.0)
        };
        if mesh.is_empty() || !size.is_finite() || !mesh.points.iter().all(fits) {
            return None;
        }
        let solid = mesh.is_closed();
        let unit = Arc::new(mesh.mapped(|point| over(point - low, size)));
        Some(Self {
            name,
            low,
            size,
            unit,
            solid,
        })
    }
}

/// An asset in the box that it fills; `z_up` where z is up in the asset's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    pub asset: Arc<Asset>,
    pub z_up: bool,
}

/// From a frame with z up to one with y up: a quarter turn about x.
const Y_FROM_Z: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);

impl Instance {
    /// From the asset's frame to one with y up.
    pub fn upright(&self) -> DMat3 {
        if self.z_up {
            Y_FROM_Z
        } else {
            DMat3::IDENTITY
        }
    }

    /// The lower corner of the asset's box, and its size (m), y up.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let (a, b) = (self.asset.low, self.asset.low + self.asset.size);
        let (a, b) = (self.upright() * a, self.upright() * b);
        (a.min(b), (a - b).abs())
    }

    pub fn is_solid(&self) -> bool {
        self.asset.solid
    }

    /// The faces in shares of the box.
    pub fn mesh(&self) -> Arc<Mesh> {
        if !self.z_up {
            return self.asset.unit.clone();
        }
        let flip = |unit: DVec3| DVec3::new(unit.x, unit.z, 1.0 - unit.y);
        let flat = self.bounds().1.z == 0.0;
        let turned = Mesh::clone(&self.asset.unit).mapped(flip);
        Arc::new(match flat {
            true => turned.mapped(|unit| unit.with_z(0.0)),
            false => turned,
        })
    }
}
