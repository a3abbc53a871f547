//! A piece in a frame of its own: congruent pieces look the same there.

use glam::{DMat3, DQuat, DVec3};

/// Vertices are told apart from a millimetre on.
pub(crate) const STEP_M: f64 = 1e-3;
/// Sizes in rule files are often half millimetres: rounding must not cut there.
const BIAS: f64 = 0.137;
/// A piece that reaches farther from its first vertex does not fit into 16 bits.
const REACH: i32 = i16::MAX as i32;

/// How a piece stands in the tile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Motion {
    pub origin: DVec3,
    pub axes: DMat3,
}

impl Motion {
    /// The frame of a polygon: its first vertex, its first edge, its normal. None where the edge
    /// has no length across the normal.
    pub fn of(outline: &[DVec3], normal: DVec3) -> Option<Self> {
        let (&origin, &next) = (outline.first()?, outline.get(1)?);
        let edge = next - origin;
        let x = (edge - normal * edge.dot(normal)).try_normalize()?;
        let axes = DMat3::from_cols(x, normal.cross(x), normal);
        Some(Self { origin, axes })
    }

    /// A point of the tile in this frame, in whole steps.
    pub fn local(&self, point: DVec3) -> [i32; 3] {
        let own = self.axes.transpose() * (point - self.origin);
        own.to_array()
            .map(|c| (c / STEP_M + 0.5 + BIAS).floor() as i32)
    }

    /// Rotation and place in the y-up frame.
    pub fn y_up(&self) -> (DQuat, DVec3) {
        let turn = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);
        (DQuat::from_mat3(&(turn * self.axes)), turn * self.origin)
    }
}

/// What two congruent pieces have in common: the sizes of their rings, and all vertices.
pub(crate) type Key = Vec<i32>;

/// Appends a polygon to a key; false where it reaches too far.
pub(crate) fn describe(key: &mut Key, motion: &Motion, rings: &[Vec<DVec3>]) -> bool {
    key.push(-(rings.len() as i32));
    for ring in rings {
        key.push(ring.len() as i32);
        for &point in ring {
            let local = motion.local(point);
            if local.iter().any(|c| c.abs() > REACH) {
                return false;
            }
            key.extend(local);
        }
    }
    true
}
