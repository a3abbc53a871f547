//! A corner of the moving wavefront: where two of its edges meet, and how it moves.

use super::double_double::{cross, dot, Dd};
use super::planes::Plane;

/// No corner, or no node yet.
pub const NONE: u32 = u32::MAX;

/// A corner moves along a straight line from its birth to its death.
#[derive(Debug, Clone, Copy)]
pub struct Corner {
    /// The wavefront edge that ends here, counter-clockwise around the inside.
    pub before: u32,
    /// The wavefront edge that begins here.
    pub after: u32,
    pub previous: u32,
    pub next: u32,
    /// The node of its birth.
    pub start: u32,
    pub alive: bool,
    /// The inside takes more than half a turn here.
    pub reflex: bool,
    place: [Dd; 2],
    speed: [Dd; 2],
    time: Dd,
    quick: Quick,
}

/// Place and motion in single doubles, for quick refusals.
#[derive(Debug, Clone, Copy)]
pub struct Quick {
    pub place: [f64; 2],
    pub speed: [f64; 2],
    /// The length of `speed`.
    pub pace: f64,
    pub time: f64,
    /// The two edges are so nearly parallel that single doubles say nothing.
    pub rough: bool,
}

impl Quick {
    pub fn place_at(&self, time: f64) -> [f64; 2] {
        let passed = time - self.time;
        [
            self.place[0] + self.speed[0] * passed,
            self.place[1] + self.speed[1] * passed,
        ]
    }
}

/// What becomes of two wavefront edges that meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Meeting {
    /// They are two parts of one edge and grow together.
    Same,
    /// They lie in one plane; their faces are parted by a line across the edge.
    Flat,
    /// They are parallel and differ in speed. At the eaves a standing step opens between them; on
    /// the way the faster takes over. The speed of the second is higher where `up` is true.
    Step { up: bool },
    /// A corner as most are.
    Corner,
}

impl Meeting {
    /// `parallel` is the sine of the angle below which two edges are parallel.
    pub fn of(planes: &[Plane], before: u32, after: u32, parallel: f64) -> Self {
        if before == after {
            return Self::Same;
        }
        let (first, second) = (&planes[before as usize], &planes[after as usize]);
        if first.class == second.class {
            return Self::Flat;
        }
        let (a, b) = (first.quick_normal, second.quick_normal);
        let is_parallel =
            (a[0] * b[1] - a[1] * b[0]).abs() < parallel && a[0] * b[0] + a[1] * b[1] > 0.0;
        if is_parallel && !first.is_same_speed(second) {
            return Self::Step {
                up: second.speed > first.speed,
            };
        }
        Self::Corner
    }
}

impl Corner {
    /// A corner between two edges that is at `place` at `time`. Nothing where the edges are too
    /// nearly parallel for any arithmetic.
    pub fn between(
        planes: &[Plane],
        before: u32,
        after: u32,
        place: [Dd; 2],
        time: Dd,
        start: u32,
    ) -> Option<Self> {
        let (first, second) = (&planes[before as usize], &planes[after as usize]);
        if first.class == second.class {
            let speed = first.normal.map(|c| c * Dd::from(first.speed));
            return Some(Self::moving(before, after, place, speed, time, start, 1.0));
        }
        let turn = cross(first.normal, second.normal);
        let (a, b) = (Dd::from(first.speed), Dd::from(second.speed));
        let speed = [
            (a * second.normal[1] - b * first.normal[1]) / turn,
            (b * first.normal[0] - a * second.normal[0]) / turn,
        ];
        let sine = turn.to_f64();
        if sine.abs() < 1e-22 || !speed[0].is_finite() || !speed[1].is_finite() {
            return None;
        }
        Some(Self::moving(before, after, place, speed, time, start, sine))
    }

    fn moving(
        before: u32,
        after: u32,
        place: [Dd; 2],
        speed: [Dd; 2],
        time: Dd,
        start: u32,
        sine: f64,
    ) -> Self {
        let quick_speed = speed.map(Dd::to_f64);
        let pace = quick_speed[0].hypot(quick_speed[1]);
        Self {
            before,
            after,
            previous: NONE,
            next: NONE,
            start,
            alive: true,
            reflex: sine < 0.0,
            place,
            speed,
            time,
            quick: Quick {
                place: place.map(Dd::to_f64),
                speed: quick_speed,
                pace,
                time: time.to_f64(),
                rough: sine.abs() < 1e-4,
            },
        }
    }

    pub fn place_at(&self, time: Dd) -> [Dd; 2] {
        let passed = time - self.time;
        [
            self.place[0] + self.speed[0] * passed,
            self.place[1] + self.speed[1] * passed,
        ]
    }

    pub fn quick(&self) -> &Quick {
        &self.quick
    }

    /// When it is on a plane, where it comes nearer to it from the inner side.
    pub fn time_on(&self, plane: &Plane) -> Option<Dd> {
        let rate = dot(plane.normal, self.speed) - Dd::from(plane.speed);
        if !rate.is_negative() {
            return None;
        }
        let ahead =
            dot(plane.normal, self.place) + plane.offset - Dd::from(plane.speed) * self.time;
        Some(self.time - ahead / rate)
    }

    /// When the wavefront edge from this corner to `end` has shrunk to nothing; nothing where it
    /// grows.
    pub fn time_with(&self, end: &Self, along: [Dd; 2]) -> Option<Dd> {
        let apart = [end.speed[0] - self.speed[0], end.speed[1] - self.speed[1]];
        let rate = dot(along, apart);
        if !rate.is_negative() {
            return None;
        }
        let time = match self.time.order(end.time) {
            std::cmp::Ordering::Less => end.time,
            _ => self.time,
        };
        let (a, b) = (self.place_at(time), end.place_at(time));
        let length = dot(along, [b[0] - a[0], b[1] - a[1]]);
        if !length.is_positive() {
            return Some(time);
        }
        Some(time - length / rate)
    }
}
