//! The closed solid between a plan and a height over each of its faces, with upright walls where
//! heights part.

use std::collections::HashMap;

use glam::DVec3;

use crate::solid::inset::Rings;
use crate::solid::mesh::{Face, Mesh};

/// The height over a face of the plan: `x * [0] + y * [1] + [2]`.
pub type Plane = [f64; 3];

/// The solid over a plan: a level floor at height 0, the faces at their heights, a wall over each
/// edge of the rings, and a wall wherever neighbours differ in height.
///
/// `plan` is the polygon of `rings` in faces over shared points; its first points are the corners
/// of the rings, in their order. Heights up to `least` are none; a height above the floor is needed
/// everywhere but at corners. Neighbours may not change places in height along an edge.
pub fn field(rings: &Rings, plan: &Mesh, heights: &[Plane], least: f64) -> Mesh {
    let mut field = Field {
        plan,
        heights,
        least,
        solid: Mesh::with_points(
            plan.points
                .iter()
                .map(|p| DVec3::new(p.x, p.y, 0.0))
                .collect(),
        ),
        columns: HashMap::new(),
    };
    let mut sides = HashMap::new();
    for face in plan.faces() {
        let over = |ring: &[u32]| -> Vec<u32> {
            ring.iter()
                .map(|&point| field.over(face.index(), point))
                .collect()
        };
        let top: Vec<Vec<u32>> = face.rings().map(over).collect();
        field.solid.push_face(&top);
        sides.extend(face.edges().map(|side| (side, face.index())));
    }
    field.steps(&sides);
    let mut first = 0;
    let mut floor = Vec::with_capacity(rings.len());
    let next = rim(plan.faces(), &sides);
    for ring in rings {
        let end = first + ring.len() as u32;
        for corner in first..end {
            let to = if corner + 1 == end { first } else { corner + 1 };
            field.wall(corner, to, &next);
        }
        floor.push((first..end).rev().collect::<Vec<_>>());
        first = end;
    }
    field.solid.push_face(&floor);
    field.solid.compact()
}

/// From each point on the rim of a plan the next one, and the face beside that side.
fn rim<'a>(
    faces: impl Iterator<Item = Face<'a>>,
    sides: &HashMap<(u32, u32), usize>,
) -> HashMap<u32, (u32, usize)> {
    faces
        .flat_map(|face| face.edges().map(move |side| (side, face.index())))
        .filter(|((a, b), _)| !sides.contains_key(&(*b, *a)))
        .map(|((a, b), face)| (a, (b, face)))
        .collect()
}

struct Field<'a> {
    plan: &'a Mesh,
    heights: &'a [Plane],
    least: f64,
    solid: Mesh,
    /// What stands over each point of the plan: heights and points of the solid, rising.
    columns: HashMap<u32, Vec<(f64, u32)>>,
}

impl Field<'_> {
    /// The point of the solid in which a face lies over a point of the plan.
    fn over(&mut self, face: usize, point: u32) -> u32 {
        let place = self.plan.points[point as usize];
        let [x, y, base] = self.heights[face];
        let height = x * place.x + y * place.y + base;
        if height <= self.least {
            return point;
        }
        let column = self.columns.entry(point).or_default();
        let near = |known: &&(f64, u32)| (known.0 - height).abs() <= self.least;
        if let Some(known) = column.iter().find(near) {
            return known.1;
        }
        let number = self.solid.push_point(DVec3::new(place.x, place.y, height));
        let at = column.partition_point(|known| known.0 < height);
        column.insert(at, (height, number));
        number
    }

    fn height(&self, number: u32) -> f64 {
        self.solid.points[number as usize].z
    }

    /// The points over one place from one to another, without the first.
    fn along(&self, point: u32, from: u32, to: u32) -> Vec<u32> {
        let (low, high) = (self.height(from), self.height(to));
        let column = self.columns.get(&point).map_or(&[][..], Vec::as_slice);
        let between = |&&(height, number): &&(f64, u32)| {
            number != from && number != to && (height > low.min(high)) && (height < low.max(high))
        };
        let mut found: Vec<u32> = column.iter().filter(between).map(|known| known.1).collect();
        if high < low {
            found.reverse();
        }
        if from != to {
            found.push(to);
        }
        found
    }

    /// The walls between neighbours of different heights.
    fn steps(&mut self, sides: &HashMap<(u32, u32), usize>) {
        for face in self.plan.faces() {
            for (a, b) in face.edges() {
                let Some(&other) = sides.get(&(b, a)) else {
                    continue;
                };
                let [low_a, low_b] = [a, b].map(|point| self.over(other, point));
                let [high_a, high_b] = [a, b].map(|point| self.over(face.index(), point));
                let rise = self.height(high_a) + self.height(high_b)
                    - (self.height(low_a) + self.height(low_b));
                if rise <= self.least {
                    continue;
                }
                let mut ring = vec![low_a];
                if low_b != low_a {
                    ring.push(low_b);
                }
                ring.extend(self.along(b, low_b, high_b));
                if high_a != low_a {
                    ring.push(high_a);
                    ring.extend(self.along(a, high_a, low_a));
                    ring.pop();
                }
                if ring.len() >= 3 {
                    self.solid.push_face(&[ring]);
                }
            }
        }
    }

    /// The wall over an edge of the outline or of a hole.
    fn wall(&mut self, from: u32, to: u32, next: &HashMap<u32, (u32, usize)>) {
        let mut steps = Vec::new();
        let mut at = from;
        while at != to {
            let Some(&(end, face)) = next.get(&at) else {
                return;
            };
            steps.push((at, end, face));
            at = end;
        }
        let mut ring = vec![from, to];
        let mut last = to;
        for &(start, end, face) in steps.iter().rev() {
            let (upper_end, upper_start) = (self.over(face, end), self.over(face, start));
            ring.extend(self.along(end, last, upper_end));
            ring.push(upper_start);
            last = upper_start;
        }
        ring.extend(self.along(from, last, from));
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        if ring.len() >= 3 {
            self.solid.push_face(&[ring]);
        }
    }
}
