//! The oriented box of a shape.

use glam::{DMat3, DVec3, EulerRot};

/// An oriented box: the frame in which a shape is split, moved and measured (CGA's scope).
///
/// Frame of rule files: metres, right-handed, y up; a lot lies in x and z. `axes` has the box's
/// unit directions as columns, `origin` is its lower left back corner, `size` its extent along
/// each. A flat shape has size 0 along one of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scope {
    pub origin: DVec3,
    pub axes: DMat3,
    pub size: DVec3,
}

impl Scope {
    /// The box from the origin along the world's axes.
    pub fn of_size(size: DVec3) -> Self {
        Self {
            origin: DVec3::ZERO,
            axes: DMat3::IDENTITY,
            size,
        }
    }

    /// A place given in shares of the box's size, in the world.
    pub fn world(&self, unit: DVec3) -> DVec3 {
        self.origin + self.axes * (unit * self.size)
    }

    /// A place in the world in shares of the box's size; 0 along a direction without extent.
    pub fn unit(&self, world: DVec3) -> DVec3 {
        over(self.axes.transpose() * (world - self.origin), self.size)
    }

    /// The part of the box from `start` on, `length` long, along one axis (m).
    pub fn part(&self, axis: usize, start: f64, length: f64) -> Self {
        let mut part = *self;
        part.origin += self.axes.col(axis) * start;
        part.size[axis] = length;
        part
    }

    /// The box moved along its own axes (m).
    pub fn moved(&self, by: DVec3) -> Self {
        Self {
            origin: self.origin + self.axes * by,
            ..*self
        }
    }

    /// The box with its frame turned (columns of `turn` in its own frame), about a point of it
    /// that is given in shares of its size.
    pub fn turned(&self, turn: DMat3, pivot: DVec3) -> Self {
        let fixed = self.world(pivot);
        let axes = self.axes * turn;
        Self {
            origin: fixed - axes * (pivot * self.size),
            axes,
            size: self.size,
        }
    }
}

/// Component-wise quotient, 0 where the divisor is.
pub fn over(length: DVec3, size: DVec3) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|axis| {
        if size[axis] == 0.0 {
            0.0
        } else {
            length[axis] / size[axis]
        }
    }))
}

/// A turn by degrees about x, y and z of a frame: about x first, then about y, then about z, each as
/// the frame had them at first.
pub fn turn(degrees: DVec3) -> DMat3 {
    let [x, y, z] = degrees.to_array().map(f64::to_radians);
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// The degrees that [`turn`] makes these axes of; about y from -90 to 90.
pub fn degrees_of(axes: DMat3) -> DVec3 {
    let (z, y, x) = axes.to_euler(EulerRot::ZYX);
    DVec3::new(x, y, z).map(f64::to_degrees)
}
