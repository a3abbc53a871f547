//! The wavefront: closed chains of corners, and the graph of what they have drawn so far.

use super::corner::{Corner, Meeting};
use super::double_double::{cross, dot, Dd};
use super::planes::{corner_shift, local, Plane};
use super::tolerance::{CORNER_SHIFT_SHARE, PARALLEL, STEP_SINE};
use super::{Eaves, SkeletonError};

/// A node of the drawing: place from the centre of the bounding box (m), and time.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    pub place_m: [f64; 2],
    pub time: f64,
}

/// One side of a face, the face to its left.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    pub face: u32,
    pub from: u32,
    pub to: u32,
}

#[derive(Debug)]
pub struct Front {
    /// One plane per edge of the eaves; then one per step.
    pub planes: Vec<Plane>,
    pub corners: Vec<Corner>,
    /// The vertices of the eaves; then what the events made.
    pub nodes: Vec<Node>,
    pub sides: Vec<Side>,
    /// The corners that are alive, and where each is in this list.
    alive: Vec<u32>,
    place_in_alive: Vec<u32>,
    /// The edges before and after each step.
    steps: Vec<(u32, u32)>,
}

impl Front {
    /// The wavefront as it starts, on the eaves.
    pub fn on_eaves(eaves: &Eaves, planes: Vec<Plane>) -> Result<Self, SkeletonError> {
        let count = eaves.len();
        let mut front = Self {
            planes,
            corners: Vec::with_capacity(3 * count),
            nodes: Vec::with_capacity(3 * count),
            sides: Vec::with_capacity(8 * count),
            alive: Vec::with_capacity(2 * count),
            place_in_alive: Vec::with_capacity(3 * count),
            steps: Vec::new(),
        };
        for vertex in 0..count {
            front.nodes.push(Node {
                place_m: local(eaves, vertex),
                time: 0.0,
            });
            front.sides.push(Side {
                face: vertex as u32,
                from: vertex as u32,
                to: eaves.next(vertex) as u32,
            });
        }
        let mut ends = Vec::with_capacity(count);
        for vertex in 0..count {
            ends.push(front.first_corner(eaves, vertex)?);
        }
        for (vertex, &(_, last)) in ends.iter().enumerate() {
            front.link(last, ends[eaves.next(vertex)].0);
        }
        Ok(front)
    }

    /// The corner at a vertex of the eaves: first and last, as a step has two.
    fn first_corner(&mut self, eaves: &Eaves, vertex: usize) -> Result<(u32, u32), SkeletonError> {
        let (before, after) = (eaves.previous(vertex) as u32, vertex as u32);
        let point = local(eaves, vertex).map(Dd::from);
        let meeting = Meeting::of(&self.planes, before, after, STEP_SINE);
        let place = match meeting {
            Meeting::Corner | Meeting::Same => {
                self.crossing(before, after, Dd::ZERO)
                    .ok_or(SkeletonError::NearlyParallel {
                        vertex,
                        shift_m: f64::INFINITY,
                    })?
            }
            Meeting::Flat | Meeting::Step { .. } => {
                let shift_m = Dd::from(corner_shift(vertex) * eaves.diagonal_m());
                let along = self.planes[before as usize].along();
                let foot = self.foot(before, point);
                [0, 1].map(|axis| foot[axis] + along[axis] * shift_m)
            }
        };
        let shift_m = distance_m(place, point);
        let shorter_m = [vertex, eaves.previous(vertex)]
            .map(|edge| eaves.along(edge))
            .map(|[x, y]| x.hypot(y))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        if shift_m > CORNER_SHIFT_SHARE * shorter_m || shift_m.is_nan() {
            return Err(SkeletonError::NearlyParallel { vertex, shift_m });
        }
        if let Meeting::Step { up } = meeting {
            return self.first_step((before, after), up, place, vertex as u32);
        }
        let corner = self.add(before, after, place, Dd::ZERO, vertex as u32)?;
        Ok((corner, corner))
    }

    /// The two corners of a standing step. Its edge has no length yet.
    fn first_step(
        &mut self,
        (before, after): (u32, u32),
        up: bool,
        place: [Dd; 2],
        node: u32,
    ) -> Result<(u32, u32), SkeletonError> {
        let step = self.planes.len() as u32;
        let across = self.planes[before as usize].across(place, !up, step);
        self.planes.push(across);
        self.steps.push((before, after));
        // The two lines are parallel but for a millionth: each corner is put on its own.
        let far_place = self.crossing(step, after, Dd::ZERO).unwrap_or(place);
        let first = self.add(before, step, place, Dd::ZERO, node)?;
        let last = self.add(step, after, far_place, Dd::ZERO, node)?;
        self.link(first, last);
        Ok((first, last))
    }

    /// Makes the corner between two wavefront edges that meet; none where they are one, or lie on
    /// each other.
    pub fn join(
        &mut self,
        before: u32,
        after: u32,
        place: [Dd; 2],
        time: Dd,
        node: u32,
    ) -> Result<Option<u32>, SkeletonError> {
        match Meeting::of(&self.planes, before, after, PARALLEL) {
            Meeting::Same | Meeting::Step { .. } => Ok(None),
            Meeting::Flat | Meeting::Corner => self.add(before, after, place, time, node).map(Some),
        }
    }

    fn add(
        &mut self,
        before: u32,
        after: u32,
        place: [Dd; 2],
        time: Dd,
        node: u32,
    ) -> Result<u32, SkeletonError> {
        let corner = Corner::between(&self.planes, before, after, place, time, node).ok_or(
            SkeletonError::Degenerate {
                x_m: place[0].to_f64(),
                y_m: place[1].to_f64(),
            },
        )?;
        let id = self.corners.len() as u32;
        self.place_in_alive.push(self.alive.len() as u32);
        self.alive.push(id);
        self.corners.push(corner);
        Ok(id)
    }

    pub fn link(&mut self, from: u32, to: u32) {
        self.corners[from as usize].next = to;
        self.corners[to as usize].previous = from;
    }

    /// The edges between which a step stands.
    pub fn step_between(&self, face: u32) -> (u32, u32) {
        self.steps[face as usize + self.steps.len() - self.planes.len()]
    }

    pub fn corner(&self, id: u32) -> &Corner {
        &self.corners[id as usize]
    }

    pub fn alive(&self) -> &[u32] {
        &self.alive
    }

    pub fn add_node(&mut self, place: [Dd; 2], time: Dd) -> u32 {
        self.nodes.push(Node {
            place_m: place.map(Dd::to_f64),
            time: time.to_f64(),
        });
        self.nodes.len() as u32 - 1
    }

    /// Ends a corner at a node, and draws its way as a side of the two faces along it.
    pub fn end(&mut self, id: u32, node: u32) {
        let corner = &mut self.corners[id as usize];
        if !corner.alive {
            return;
        }
        corner.alive = false;
        let (before, after, start) = (corner.before, corner.after, corner.start);
        self.draw(before, start, node);
        self.draw(after, node, start);
        let place = self.place_in_alive[id as usize];
        self.alive.swap_remove(place as usize);
        if let Some(&moved) = self.alive.get(place as usize) {
            self.place_in_alive[moved as usize] = place;
        }
    }

    pub fn draw(&mut self, face: u32, from: u32, to: u32) {
        self.sides.push(Side { face, from, to });
    }

    /// Where the lines of two edges cross at a time.
    pub fn crossing(&self, before: u32, after: u32, time: Dd) -> Option<[Dd; 2]> {
        let (a, b) = (&self.planes[before as usize], &self.planes[after as usize]);
        let turn = cross(a.normal, b.normal);
        let ahead = |plane: &Plane| Dd::from(plane.speed) * time - plane.offset;
        let (p, q) = (ahead(a), ahead(b));
        let place = [
            (p * b.normal[1] - q * a.normal[1]) / turn,
            (q * a.normal[0] - p * b.normal[0]) / turn,
        ];
        (place[0].is_finite() && place[1].is_finite()).then_some(place)
    }

    /// The point of the line of an edge at time 0 that is nearest to `point`.
    fn foot(&self, edge: u32, point: [Dd; 2]) -> [Dd; 2] {
        let plane = &self.planes[edge as usize];
        let off = dot(plane.normal, point) + plane.offset;
        [
            point[0] - plane.normal[0] * off,
            point[1] - plane.normal[1] * off,
        ]
    }
}

fn distance_m(a: [Dd; 2], b: [Dd; 2]) -> f64 {
    (a[0] - b[0]).to_f64().hypot((a[1] - b[1]).to_f64())
}
