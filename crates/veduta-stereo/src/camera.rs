//! A pinhole camera: x right, y down, z forward; the upper left pixel's centre is (0.5, 0.5).

use crate::error::StereoError;

pub type Vector = [f64; 3];
pub type Matrix = [[f64; 3]; 3];

#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Focal lengths and principal point (px).
    pub focal: [f64; 2],
    pub centre: [f64; 2],
    /// Camera from world.
    pub turn: Matrix,
    pub shift: Vector,
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn times(m: &Matrix, v: Vector) -> Vector {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// The transpose of a matrix times a vector.
pub fn back(m: &Matrix, v: Vector) -> Vector {
    std::array::from_fn(|i| m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2])
}

impl Camera {
    pub fn new(
        focal: [f64; 2],
        centre: [f64; 2],
        turn: Matrix,
        shift: Vector,
    ) -> Result<Self, StereoError> {
        let entries = turn.iter().flatten().chain(&shift).chain(&centre);
        let usable = focal.iter().all(|f| f.is_finite() && *f > 0.0);
        if !usable || !entries.into_iter().all(|one| one.is_finite()) {
            return Err(StereoError::Camera);
        }
        Ok(Self {
            focal,
            centre,
            turn,
            shift,
        })
    }

    /// A point of the world in the camera's frame.
    pub fn seen(&self, point: Vector) -> Vector {
        let turned = times(&self.turn, point);
        std::array::from_fn(|i| turned[i] + self.shift[i])
    }

    /// The pixel of a point in the camera's frame.
    pub fn pixel(&self, seen: Vector) -> [f64; 2] {
        [
            self.focal[0] * seen[0] / seen[2] + self.centre[0],
            self.focal[1] * seen[1] / seen[2] + self.centre[1],
        ]
    }

    /// The ray through a pixel, in the camera's frame, 1 deep.
    pub fn ray(&self, px: [f64; 2]) -> Vector {
        [
            (px[0] - self.centre[0]) / self.focal[0],
            (px[1] - self.centre[1]) / self.focal[1],
            1.0,
        ]
    }

    /// The point of the world that a pixel shows at a depth.
    pub fn point(&self, px: [f64; 2], depth: f64) -> Vector {
        let ray = self.ray(px);
        self.world(std::array::from_fn(|i| ray[i] * depth))
    }

    /// A point of the camera's frame in the world.
    pub fn world(&self, seen: Vector) -> Vector {
        back(&self.turn, std::array::from_fn(|i| seen[i] - self.shift[i]))
    }

    /// Where it stands.
    pub fn eye(&self) -> Vector {
        self.world([0.0; 3])
    }
}

/// How pixels of one camera at a depth are found in another: other = far * (x, y, 1) + near / depth.
#[derive(Clone, Copy, Debug)]
pub struct Transfer {
    pub far: [[f32; 3]; 3],
    pub near: [f32; 3],
}

impl Transfer {
    pub fn new(from: &Camera, to: &Camera) -> Self {
        // R = R2 R1^T, t = t2 - R t1; far = K2 R K1^-1, near = K2 t.
        let turn: Matrix =
            std::array::from_fn(|r| std::array::from_fn(|c| dot(to.turn[r], from.turn[c])));
        let moved = times(&turn, from.shift);
        let shift: Vector = std::array::from_fn(|i| to.shift[i] - moved[i]);
        let [fx, fy] = from.focal;
        let [cx, cy] = from.centre;
        let unlens = |row: Vector| -> Vector {
            [
                row[0] / fx,
                row[1] / fy,
                row[2] - row[0] * cx / fx - row[1] * cy / fy,
            ]
        };
        let lens = |axis: usize, v: Vector, depth: f64| match axis {
            2 => depth,
            _ => to.focal[axis] * v[axis] + to.centre[axis] * depth,
        };
        let rows: [Vector; 3] = std::array::from_fn(|axis| {
            let row = std::array::from_fn(|column| {
                let v = [turn[0][column], turn[1][column], turn[2][column]];
                lens(axis, v, v[2])
            });
            unlens(row)
        });
        Self {
            far: rows.map(|row| row.map(|one| one as f32)),
            near: std::array::from_fn(|axis| lens(axis, shift, shift[2]) as f32),
        }
    }

    /// Homogeneous pixel in the other view of pixel `at` whose inverse depth is given.
    #[inline]
    pub fn apply(&self, at: [f32; 2], inverse: f32) -> [f32; 3] {
        std::array::from_fn(|i| {
            self.far[i][0] * at[0]
                + self.far[i][1] * at[1]
                + self.far[i][2]
                + self.near[i] * inverse
        })
    }
}
