//! The planes in which the faces of the roof lie, one per edge, each a hair off its place.
//!
//! A point (x, y) at time t is on the plane of an edge where `normal . (x, y) + offset = speed t`;
//! the unit normal points inwards. Real outlines are full of coincidences: walls in one line, bays
//! of the same width, regular polygons. Edges in one line share their line here, exactly; all other
//! coincidences are dissolved by turning and shifting each line by a share of 1e-14, which is less
//! than outlines are rounded to. What then happens "at once" happens one after the other, and only
//! the coincidences of edges that share a line need rules of their own.

use super::double_double::{dot, Dd};
use super::tolerance::{JITTER, JITTER_GROWTH, SAME_SPEED};
use super::Eaves;

/// Marks the chance of steps, and that of the places of corners in a straight wall.
const STEPS: u64 = 1 << 48;
const CORNERS: u64 = 1 << 49;

/// The plane of an edge of the wavefront.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    pub normal: [Dd; 2],
    pub offset: Dd,
    pub speed: f64,
    /// Planes of one class are the same plane.
    pub class: u32,
    /// `normal` and `offset` in single doubles, for quick refusals.
    pub quick_normal: [f64; 2],
    pub quick_offset: f64,
}

impl Plane {
    fn new(normal: [Dd; 2], offset: Dd, speed: f64, class: u32) -> Self {
        Self {
            normal,
            offset,
            speed,
            class,
            quick_normal: normal.map(Dd::to_f64),
            quick_offset: offset.to_f64(),
        }
    }

    /// The standing plane across this one through `point`, its inner side ahead along the edge,
    /// or behind; a hair off the right angle, as other steps across the same edge would be
    /// parallel to it.
    pub fn across(&self, point: [Dd; 2], ahead: bool, class: u32) -> Self {
        let turn = Dd::from(JITTER * chance(u64::from(class) | STEPS));
        let along = self.along();
        let turned = [0, 1].map(|axis| (along[axis] + self.normal[axis] * turn) * shrink(turn));
        let normal = if ahead { turned } else { turned.map(|c| -c) };
        Self::new(normal, -dot(normal, point), 0.0, class)
    }

    /// The unit vector along the edge, the inner side to its left.
    pub fn along(&self) -> [Dd; 2] {
        [self.normal[1], -self.normal[0]]
    }

    /// The same in single doubles.
    pub fn quick_along(&self) -> [f64; 2] {
        [self.quick_normal[1], -self.quick_normal[0]]
    }

    pub fn is_same_speed(&self, other: &Self) -> bool {
        (self.speed - other.speed).abs() <= SAME_SPEED * self.speed.max(other.speed)
    }
}

/// The line of some edges, as it is.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Unit normal, inwards.
    pub normal: [f64; 2],
    pub offset_m: f64,
}

impl Line {
    fn of(eaves: &Eaves, edge: usize) -> Self {
        let [dx, dy] = eaves.along(edge);
        let length = dx.hypot(dy);
        let normal = [-dy / length, dx / length];
        let a = local(eaves, edge);
        Self {
            normal,
            offset_m: -(normal[0] * a[0] + normal[1] * a[1]),
        }
    }

    fn distance_m(&self, point: [f64; 2]) -> f64 {
        self.normal[0] * point[0] + self.normal[1] * point[1] + self.offset_m
    }
}

/// The lines of the eaves: each once, with the edges that lie on it.
#[derive(Debug)]
pub struct Lines {
    pub lines: Vec<Line>,
    /// The longest edge of each line, which gave it.
    longest: Vec<u32>,
    /// The line of each edge.
    pub of_edge: Vec<u32>,
}

impl Lines {
    /// `near_m` is how far the ends of an edge may be from its line.
    pub fn of(eaves: &Eaves, near_m: f64) -> Self {
        let mut order: Vec<(f64, u32)> = (0..eaves.len())
            .map(|edge| {
                let [dx, dy] = eaves.along(edge);
                (dx * dx + dy * dy, edge as u32)
            })
            .collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut found = Self {
            lines: Vec::with_capacity(eaves.len()),
            longest: Vec::with_capacity(eaves.len()),
            of_edge: vec![0; eaves.len()],
        };
        for (_, edge) in order {
            let (from, along) = (local(eaves, edge as usize), eaves.along(edge as usize));
            let to = local(eaves, eaves.next(edge as usize));
            let fits = |line: &Line| {
                line.distance_m(from).abs() <= near_m
                    && line.distance_m(to).abs() <= near_m
                    && line.normal[0] * along[1] - line.normal[1] * along[0] < 0.0
            };
            let place = found.lines.iter().position(fits).unwrap_or_else(|| {
                found.lines.push(Line::of(eaves, edge as usize));
                found.longest.push(edge);
                found.lines.len() - 1
            });
            found.of_edge[edge as usize] = place as u32;
        }
        found
    }

    /// The planes of the edges, turned and shifted by chance; the chance is that of `attempt`.
    /// Speeds are shares of `fastest`.
    pub fn planes(&self, eaves: &Eaves, fastest: f64, attempt: u64) -> Vec<Plane> {
        let jitter = JITTER * JITTER_GROWTH.powi(attempt as i32);
        let moved: Vec<([Dd; 2], Dd)> = self
            .longest
            .iter()
            .enumerate()
            .map(|(line, &edge)| {
                let seed = (attempt << 32) + 2 * line as u64;
                let turn = jitter * chance(seed);
                let shift_m = jitter * eaves.diagonal_m() * chance(seed + 1);
                moved_line(eaves, edge as usize, turn, shift_m)
            })
            .collect();
        let mut planes: Vec<Plane> = Vec::with_capacity(2 * eaves.len());
        let mut last_on_line: Vec<Option<usize>> = vec![None; self.lines.len()];
        let mut last_before: Vec<Option<usize>> = Vec::with_capacity(eaves.len());
        for edge in 0..eaves.len() {
            let line = self.of_edge[edge] as usize;
            let (normal, offset) = moved[line];
            let speed = eaves.speeds()[edge] / fastest;
            let mut plane = Plane::new(normal, offset, speed, edge as u32);
            let on_line = std::iter::successors(last_on_line[line], |&other| last_before[other]);
            for other in on_line {
                if planes[other].is_same_speed(&plane) {
                    (plane.class, plane.speed) = (planes[other].class, planes[other].speed);
                    break;
                }
            }
            last_before.push(last_on_line[line].replace(edge));
            planes.push(plane);
        }
        planes
    }
}

/// A vertex, from the centre of the bounding box.
pub fn local(eaves: &Eaves, vertex: usize) -> [f64; 2] {
    let (point, centre) = (eaves.points_m()[vertex], eaves.centre_m());
    [point[0] - centre[0], point[1] - centre[1]]
}

/// Normal and offset of the line of an edge, turned about the edge's middle and then shifted.
fn moved_line(eaves: &Eaves, edge: usize, turn_rad: f64, shift_m: f64) -> ([Dd; 2], Dd) {
    let a = local(eaves, edge).map(Dd::from);
    let b = local(eaves, eaves.next(edge)).map(Dd::from);
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = dot(along, along).sqrt();
    let along = along.map(|c| c / length);
    let turn = Dd::from(turn_rad);
    let normal = [along[0] * turn - along[1], along[1] * turn + along[0]].map(|c| c * shrink(turn));
    let half = Dd::from(0.5);
    let middle = [(a[0] + b[0]) * half, (a[1] + b[1]) * half];
    (normal, Dd::from(shift_m) - dot(normal, middle))
}

/// What makes a unit vector of one that a small turn has made longer. Corners in a straight wall
/// move along the normal, and would leave the wall by 1e-27 of their way without it.
fn shrink(turn: Dd) -> Dd {
    Dd::from(1.0) - Dd::from(0.5) * turn * turn
}

/// How far a corner between edges in one line is moved along the line, by chance (a share of the
/// diagonal): those of walls opposite each other would meet.
pub fn corner_shift(vertex: usize) -> f64 {
    JITTER * chance(vertex as u64 | CORNERS)
}

/// A number from -1 to 1 that looks like chance and is always the same (SplitMix64: Steele, Lea
/// and Flood, "Fast splittable pseudorandom number generators", 2014).
fn chance(seed: u64) -> f64 {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}
