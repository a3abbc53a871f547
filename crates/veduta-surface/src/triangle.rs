//! A triangle in space, and how far points lie from it.

pub type Vector = [f64; 3];

/// A triangle with an area. `number`: which of the mesh's it is.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    corner: Vector,
    first: Vector,
    second: Vector,
    normal: Vector,
    pub number: u32,
}

impl Triangle {
    /// None where the corners lie on a line.
    pub fn new(corners: [Vector; 3], number: u32) -> Option<Self> {
        let [corner, b, c] = corners;
        let (first, second) = (less(b, corner), less(c, corner));
        let across = cross(first, second);
        let area = dot(across, across).sqrt();
        let longest = dot(first, first).max(dot(second, second));
        (area > 1e-12 * longest).then(|| Self {
            corner,
            first,
            second,
            normal: across.map(|value| value / area),
            number,
        })
    }

    /// The lower and the upper corner of the box around it.
    pub fn bounds(&self) -> [Vector; 2] {
        let others = [
            plus(self.corner, self.first, 1.0),
            plus(self.corner, self.second, 1.0),
        ];
        let mut found = [self.corner; 2];
        for other in others {
            for axis in 0..3 {
                found[0][axis] = found[0][axis].min(other[axis]);
                found[1][axis] = found[1][axis].max(other[axis]);
            }
        }
        found
    }

    /// How far a point lies off the plane, above 0 where the corners run counter-clockwise.
    pub fn height(&self, point: Vector) -> f64 {
        dot(less(point, self.corner), self.normal)
    }

    /// The squared distance of a point.
    pub fn squared(&self, point: Vector) -> f64 {
        let away = less(point, self.spot(point));
        dot(away, away)
    }

    /// The spot that is nearest to a point.
    fn spot(&self, point: Vector) -> Vector {
        let (a, b, c) = (self.corner, self.first, self.second);
        let from_a = less(point, a);
        let (d1, d2) = (dot(b, from_a), dot(c, from_a));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        let from_b = less(from_a, b);
        let (d3, d4) = (dot(b, from_b), dot(c, from_b));
        if d3 >= 0.0 && d4 <= d3 {
            return plus(a, b, 1.0);
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return plus(a, b, d1 / (d1 - d3));
        }
        let from_c = less(from_a, c);
        let (d5, d6) = (dot(b, from_c), dot(c, from_c));
        if d6 >= 0.0 && d5 <= d6 {
            return plus(a, c, 1.0);
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return plus(a, c, d2 / (d2 - d6));
        }
        let va = d3 * d6 - d5 * d4;
        let (towards_c, towards_b) = (d4 - d3, d5 - d6);
        if va <= 0.0 && towards_c >= 0.0 && towards_b >= 0.0 {
            let share = towards_c / (towards_c + towards_b);
            return plus(plus(a, b, 1.0 - share), c, share);
        }
        let whole = va + vb + vc;
        plus(plus(a, b, vb / whole), c, vc / whole)
    }
}

fn less(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn plus(a: Vector, b: Vector, times: f64) -> Vector {
    [
        a[0] + times * b[0],
        a[1] + times * b[1],
        a[2] + times * b[2],
    ]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
