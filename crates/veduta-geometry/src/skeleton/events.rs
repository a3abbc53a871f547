//! What can happen to a wavefront next: edges that shrink to nothing, and reflex corners that run
//! into an edge opposite (Aichholzer, Aurenhammer, Alberts and Gaertner, "A novel type of skeleton
//! for polygons", 1995; with speeds: Biedl et al., "Weighted straight skeletons in the plane", 2015).
//!
//! The queue holds each event that would happen if all corners went on as they do now. An event
//! names the corners that it depends on; it is void once one of them is gone or has another
//! neighbour, and the corners that replace them bring events of their own.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::corner::{Corner, Quick};
use super::double_double::{dot, Dd};
use super::front::Front;
use super::planes::Plane;
use crate::{Budget, Spent};

/// What a corner and an edge cost that may meet, in steps of the budget.
pub const STEPS_PER_PAIR: usize = 4;

/// What happens. Corners are named by number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Happening {
    /// The edge from `start` to `end` has shrunk to nothing.
    Collapse { start: u32, end: u32 },
    /// A reflex corner runs into the inner part of the edge from `start` to `end`.
    Split { corner: u32, start: u32, end: u32 },
    /// Two reflex corners meet, and the edge that ends at `first` lies in one plane with the edge
    /// that begins at `second`.
    Bridge { first: u32, second: u32 },
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    pub time: Dd,
    pub what: Happening,
}

impl Eq for Event {}

impl Ord for Event {
    fn cmp(&self, other: &Self) -> Ordering {
        self.time
            .order(other.time)
            .then_with(|| self.what.cmp(&other.what))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The events to come, the earliest first.
#[derive(Debug)]
pub struct Queue {
    heap: BinaryHeap<Reverse<Event>>,
    /// Events later than this are of no interest.
    last: f64,
    /// The diagonal of the eaves (m), for the margins of quick refusals.
    diagonal_m: f64,
}

impl Queue {
    pub fn new(vertices: usize, last: f64, diagonal_m: f64) -> Self {
        Self {
            heap: BinaryHeap::with_capacity(4 * vertices),
            last,
            diagonal_m,
        }
    }

    pub fn pop(&mut self) -> Option<Event> {
        self.heap.pop().map(|Reverse(event)| event)
    }

    fn push(&mut self, time: Dd, what: Happening) {
        if time.is_finite() && time.to_f64() <= self.last {
            self.heap.push(Reverse(Event { time, what }));
        }
    }

    /// All events of a wavefront that has just been made.
    pub fn fill(&mut self, front: &Front, budget: &dyn Budget) -> Result<(), Spent> {
        for &start in front.alive() {
            self.collapse_of(front, start, Dd::ZERO);
        }
        for &corner in front.alive() {
            if front.corner(corner).reflex {
                budget.take(STEPS_PER_PAIR * front.alive().len())?;
                self.splits_by(front, corner, Dd::ZERO);
            }
        }
        Ok(())
    }

    /// The events of a corner that has just been made at `now`.
    pub fn add_corner(&mut self, front: &Front, corner: u32, now: Dd) {
        self.add_edge(front, front.corner(corner).previous, now);
        self.add_edge(front, corner, now);
        self.splits_by(front, corner, now);
    }

    /// The events of the wavefront edge that begins at `start` and has a new end.
    pub fn add_edge(&mut self, front: &Front, start: u32, now: Dd) {
        self.collapse_of(front, start, now);
        for &corner in front.alive() {
            if front.corner(corner).reflex {
                self.split(front, corner, start, now);
            }
        }
    }

    fn splits_by(&mut self, front: &Front, corner: u32, now: Dd) {
        if front.corner(corner).reflex {
            for &start in front.alive() {
                self.split(front, corner, start, now);
            }
        }
    }

    /// When the edge from `start` shrinks to nothing. It has none left where the edges on both
    /// sides of it lie in one plane: they cut it at one point.
    fn collapse_of(&mut self, front: &Front, start: u32, now: Dd) {
        let a = front.corner(start);
        let (end, b) = (a.next, front.corner(a.next));
        let plane = &front.planes[a.after as usize];
        let class_of = |edge: u32| front.planes[edge as usize].class;
        let what = Happening::Collapse { start, end };
        if class_of(a.before) == class_of(b.after) && class_of(a.before) != plane.class {
            self.push(now, what);
        } else if self.may_collapse(a.quick(), b.quick(), plane) {
            if let Some(time) = a.time_with(b, plane.along()) {
                self.push(later(time, now), what);
            }
        }
    }

    /// False where single doubles suffice to tell that the edge grows or lives too long.
    fn may_collapse(&self, a: &Quick, b: &Quick, plane: &Plane) -> bool {
        if a.rough || b.rough {
            return true;
        }
        let along = plane.quick_along();
        let rate = along[0] * (b.speed[0] - a.speed[0]) + along[1] * (b.speed[1] - a.speed[1]);
        rate < 1e-9 * (1.0 + a.pace + b.pace)
    }

    /// When a reflex corner runs into the edge from `start`, where it does.
    fn split(&mut self, front: &Front, corner: u32, start: u32, now: Dd) {
        let (v, a) = (front.corner(corner), front.corner(start));
        let end = a.next;
        let near = [corner, v.next];
        if near.contains(&start) || start == v.previous || end == v.previous {
            return; // the edge is one of the corner's own, or shares a corner with one
        }
        let b = front.corner(end);
        let plane = &front.planes[a.after as usize];
        if !self.may_split(v.quick(), a.quick(), b.quick(), plane, now.to_f64()) {
            return;
        }
        if let Some((time, what)) = split_at(front, (corner, v), (start, a), (end, b)) {
            if time.order(now) == Ordering::Greater {
                self.push(time, what);
            }
        }
    }

    /// False where single doubles suffice to tell that the corner misses the edge. The margins are
    /// 10^6 times the rounding that is to be expected.
    fn may_split(&self, v: &Quick, a: &Quick, b: &Quick, plane: &Plane, now: f64) -> bool {
        if v.rough {
            return true;
        }
        let normal = plane.quick_normal;
        let rate = normal[0] * v.speed[0] + normal[1] * v.speed[1] - plane.speed;
        let unit = 1.0 + v.pace + plane.speed;
        if rate > -1e-6 * unit {
            return rate < 1e-9 * unit;
        }
        let ahead_m = normal[0] * v.place[0] + normal[1] * v.place[1] + plane.quick_offset
            - plane.speed * v.time;
        let time = v.time - ahead_m / rate;
        let doubt = 1e-9 * self.diagonal_m / -rate;
        if time < now - doubt || time > self.last + doubt {
            return false;
        }
        let hit = v.place_at(time);
        let along = plane.quick_along();
        let margin = 1e-9 * self.diagonal_m + doubt * unit;
        let beyond = |end: &Quick, sign: f64| {
            let place = end.place_at(time);
            let ahead = along[0] * (hit[0] - place[0]) + along[1] * (hit[1] - place[1]);
            !end.rough && sign * ahead > margin + doubt * end.pace
        };
        !beyond(a, -1.0) && !beyond(b, 1.0)
    }
}

/// The later of two times. A time that should be `now` may be a hair before it.
fn later(time: Dd, now: Dd) -> Dd {
    match time.order(now) {
        Ordering::Less => now,
        _ => time,
    }
}

/// When and how a reflex corner meets the edge from corner `a` to corner `b`.
fn split_at(
    front: &Front,
    (corner, v): (u32, &Corner),
    (start, a): (u32, &Corner),
    (end, b): (u32, &Corner),
) -> Option<(Dd, Happening)> {
    let class_of = |edge: u32| front.planes[edge as usize].class;
    let (before, after) = (class_of(v.before), class_of(v.after));
    let (own, ahead, behind) = (class_of(a.after), class_of(b.after), class_of(a.before));
    // The corner stays on its own two lines, and so cannot come to them; what begins or ends on
    // one of them at the point that is hit would have overlapped its edge.
    if own == before || own == after || ahead == after || behind == before {
        return None;
    }
    let plane = &front.planes[a.after as usize];
    let time = v.time_on(plane)?;
    let (hit, along) = (v.place_at(time), plane.along());
    let is_past = |end: &Corner| {
        let place = end.place_at(time);
        dot(along, [hit[0] - place[0], hit[1] - place[1]])
    };
    let (bridges_ahead, bridges_behind) = (ahead == before, behind == after);
    if !bridges_behind && !is_past(a).is_positive() {
        return None;
    }
    if !bridges_ahead && !is_past(b).is_negative() {
        return None;
    }
    match (bridges_ahead, bridges_behind) {
        (false, false) => Some((time, Happening::Split { corner, start, end })),
        (true, false) if b.reflex => Some((
            time,
            Happening::Bridge {
                first: corner,
                second: end,
            },
        )),
        (false, true) if a.reflex => Some((
            time,
            Happening::Bridge {
                first: start,
                second: corner,
            },
        )),
        _ => None,
    }
}
