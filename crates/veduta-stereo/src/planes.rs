//! A plane through each pixel: its inverse depth there and how that changes along x and y.
//!
//! The inverse depth of a plane is an affine function of the pixel, so that a plane goes on to the
//! next pixel by an addition.

use crate::camera::Camera;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// 1 / depth at the pixel's centre (1/m).
    pub inverse: f32,
    /// Its change a pixel to the right and a pixel down (1/m/px).
    pub slope: [f32; 2],
}

impl Plane {
    /// Through the point at a depth on a ray, with a normal in the camera's frame.
    pub fn through(camera: &Camera, ray: [f32; 3], inverse: f32, normal: [f32; 3]) -> Self {
        let along: f32 = (0..3).map(|i| normal[i] * ray[i]).sum();
        // A plane seen at a grazing angle is held at 5 degrees.
        let along = if along.abs() < 0.087 { -0.087 } else { along };
        Self {
            inverse,
            slope: std::array::from_fn(|axis| {
                normal[axis] / along * inverse / camera.focal[axis] as f32
            }),
        }
    }

    /// The same plane at a pixel that lies (right, down) of its own.
    #[inline]
    pub fn gone_on(&self, right: f32, down: f32) -> Self {
        Self {
            inverse: self.inverse + right * self.slope[0] + down * self.slope[1],
            slope: self.slope,
        }
    }

    /// Its unit normal, towards the camera, in the camera's frame.
    pub fn normal(&self, camera: &Camera, px: [f32; 2]) -> [f32; 3] {
        let [sx, sy] = self.slope;
        let [fx, fy] = camera.focal.map(|one| one as f32);
        let rest = self.inverse
            - sx * (px[0] - camera.centre[0] as f32)
            - sy * (px[1] - camera.centre[1] as f32);
        let n = [fx * sx, fy * sy, rest];
        let length = n.iter().map(|one| one * one).sum::<f32>().sqrt();
        if length > 0.0 {
            n.map(|one| -one / length)
        } else {
            [0.0, 0.0, -1.0]
        }
    }
}

/// Planes of a picture with their costs, row by row.
#[derive(Clone, Debug)]
pub struct Planes {
    pub width: usize,
    pub height: usize,
    pub planes: Vec<Plane>,
    /// What the views say against each, from 0 (nothing) on.
    pub costs: Vec<f32>,
}

impl Planes {
    /// The planes for a picture of another size, whose camera is scaled with it: the nearest ones.
    pub fn resized(&self, width: usize, height: usize) -> Planes {
        let (sx, sy) = (
            self.width as f32 / width as f32,
            self.height as f32 / height as f32,
        );
        let mut planes = Vec::with_capacity(width * height);
        for y in 0..height {
            let v = (y as f32 + 0.5) * sy;
            let row = (v as usize).min(self.height - 1);
            for x in 0..width {
                let u = (x as f32 + 0.5) * sx;
                let column = (u as usize).min(self.width - 1);
                let own = self.planes[row * self.width + column];
                let moved = own.gone_on(u - column as f32 - 0.5, v - row as f32 - 0.5);
                planes.push(Plane {
                    inverse: moved.inverse,
                    slope: [moved.slope[0] * sx, moved.slope[1] * sy],
                });
            }
        }
        Planes {
            width,
            height,
            costs: vec![f32::INFINITY; planes.len()],
            planes,
        }
    }
}
