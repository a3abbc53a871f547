//! Roofs made of planes that do not begin at the eaves: the plan is cut along lines, and each part
//! has its own plane.

use glam::DVec3;

use super::field::{field, Plane};
use crate::solid::cut::scored;
use crate::solid::inset::Rings;
use crate::solid::Mesh;

/// What counts as nothing, as a share of the extent.
const NEAR_SHARE: f64 = 1e-9;
/// The least height of a valley over the floor, as a share of the rise: so that it does not cut the
/// solid in two.
const CURB_SHARE: f64 = 0.1;

/// A polygon with x across the roof, and the extent of its walls along x and y.
pub struct Across {
    rings: Rings,
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Across {
    pub fn of(rings: &Rings) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in rings.iter().flatten() {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        Self {
            rings: rings.clone(),
            low,
            high,
        }
    }

    /// A larger polygon with the same planes over it.
    pub fn grown(self, rings: Rings) -> Self {
        Self { rings, ..self }
    }

    pub fn width(&self) -> f64 {
        self.high[0] - self.low[0]
    }

    fn near(&self) -> f64 {
        NEAR_SHARE * self.width().hypot(self.high[1] - self.low[1])
    }

    fn plan(&self) -> Mesh {
        let ring = |ring: &Vec<[f64; 2]>| -> Vec<DVec3> {
            ring.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
        };
        Mesh::polygon(&self.rings.iter().map(ring).collect::<Vec<_>>())
    }

    /// One plane that rises with x.
    pub fn shed(&self, slope: f64) -> Mesh {
        let plane = [slope, 0.0, -slope * self.low[0]];
        self.over(&self.plan(), 0.0, |_| plane)
    }

    /// Two planes that meet in a ridge at the share `at` of the width, each with its own slope.
    pub fn ridge(&self, slope: f64) -> Mesh {
        let middle = 0.5 * (self.low[0] + self.high[0]);
        self.cut_at(&[middle], |x| {
            if x < middle {
                [slope, 0.0, -slope * self.low[0]]
            } else {
                [-slope, 0.0, slope * self.high[0]]
            }
        })
    }

    /// Two planes that fall to a valley in the middle.
    pub fn butterfly(&self, slope: f64) -> Mesh {
        let middle = 0.5 * (self.low[0] + self.high[0]);
        let curb = CURB_SHARE * 0.5 * slope * self.width();
        self.cut_at(&[middle], |x| {
            if x < middle {
                [-slope, 0.0, slope * middle + curb]
            } else {
                [slope, 0.0, -slope * middle + curb]
            }
        })
    }

    /// Planes that rise over each tooth and end upright.
    pub fn sawtooth(&self, slope: f64, teeth: u32) -> Mesh {
        let step = self.width() / f64::from(teeth);
        let curb = CURB_SHARE * slope * step;
        let starts: Vec<f64> = (0..teeth)
            .map(|tooth| self.low[0] + step * f64::from(tooth))
            .collect();
        let lines: Vec<f64> = starts[1..]
            .iter()
            .map(|&at| self.beside_corners(at))
            .collect();
        self.cut_at(&lines, |x| {
            let tooth = lines.partition_point(|&line| line < x);
            [slope, 0.0, curb - slope * starts[tooth]]
        })
    }

    /// Two ridges of one height at right angles, with a gable on each of four sides.
    pub fn crossed(&self, height: f64) -> Mesh {
        let centre = [0, 1].map(|axis| 0.5 * (self.low[axis] + self.high[axis]));
        let half = [0, 1].map(|axis| 0.5 * (self.high[axis] - self.low[axis]));
        let share = |x: f64, y: f64| [(x - centre[0]) / half[0], (y - centre[1]) / half[1]];
        let near = self.near();
        let (mut plan, _) = scored(&self.plan(), 0, &[centre[0]], near, |_| false);
        (plan, _) = scored(&plan, 1, &[centre[1]], near, |_| false);
        let turned = plan.mapped(|p| {
            let [u, v] = share(p.x, p.y);
            DVec3::new(u + v, u - v, 0.0)
        });
        let (mut plan, _) = scored(&turned, 0, &[0.0], NEAR_SHARE, |_| false);
        (plan, _) = scored(&plan, 1, &[0.0], NEAR_SHARE, |_| false);
        let plan = plan.mapped(|p| {
            let (u, v) = (0.5 * (p.x + p.y), 0.5 * (p.x - p.y));
            DVec3::new(centre[0] + half[0] * u, centre[1] + half[1] * v, 0.0)
        });
        // Where it hangs over, the lowest places are not at corners.
        self.over(&plan, CURB_SHARE, |[x, y]| {
            let [u, v] = share(x, y);
            let axis = usize::from(v.abs() < u.abs());
            let fall = -[u, v][axis].signum() * height / half[axis];
            let mut plane = [0.0, 0.0, height - fall * centre[axis]];
            plane[axis] = fall;
            plane
        })
    }

    fn cut_at(&self, lines: &[f64], plane: impl Fn(f64) -> Plane) -> Mesh {
        let (plan, _) = scored(&self.plan(), 0, lines, self.near(), |_| false);
        self.over(&plan, 0.0, |[x, _]| plane(x))
    }

    /// The solid with the plane that `plane` gives for a place within each face. What hangs over
    /// below height 0 gets its floor by the share `deeper` farther down.
    fn over(&self, plan: &Mesh, deeper: f64, plane: impl Fn([f64; 2]) -> Plane) -> Mesh {
        let mut heights: Vec<Plane> = plan
            .faces()
            .map(|face| {
                let (mut sum, mut count) = (DVec3::ZERO, 0.0);
                for point in face.points() {
                    sum += point;
                    count += 1.0;
                }
                let middle = sum / count;
                plane([middle.x, middle.y])
            })
            .collect();
        let mut lowest: f64 = 0.0;
        for (face, [x, y, base]) in plan.faces().zip(&heights) {
            lowest = face
                .points()
                .map(|p| x * p.x + y * p.y + base)
                .fold(lowest, f64::min);
        }
        lowest *= 1.0 + deeper;
        for plane in &mut heights {
            plane[2] -= lowest;
        }
        let steepest = heights.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        let solid = field(&self.rings, plan, &heights, self.near() * steepest);
        solid.mapped(|p| p + DVec3::Z * lowest)
    }

    /// A line near to the one wanted that no corner lies on: an upright wall through a corner
    /// would touch another one.
    fn beside_corners(&self, wanted: f64) -> f64 {
        let apart = 1e3 * self.near();
        let is_free = |at: f64| {
            self.rings
                .iter()
                .flatten()
                .all(|p| (p[0] - at).abs() > apart)
        };
        let nearby = (0..64).map(|k| wanted + 4.0 * apart * f64::from(k));
        nearby.into_iter().find(|&at| is_free(at)).unwrap_or(wanted)
    }
}
