//! Points at one place as one point.

use foldhash::HashMap;
use glam::DVec3;

use super::mesh::Mesh;

/// The points of a mesh with those nearer to each other than `near` as one: for each point the
/// number of the first at its place.
pub fn weld(points: &[DVec3], near: f64) -> Vec<u32> {
    let mut places = Places::new(near);
    let mut first = Vec::with_capacity(points.len());
    for (number, &point) in points.iter().enumerate() {
        first.push(places.number(point, number as u32));
    }
    first
}

/// Meshes as one with points at one place as one point. Faces that shrink to nothing are left out.
pub fn joined(parts: &[&Mesh], near: f64) -> Mesh {
    let mut all = Mesh::new();
    for part in parts {
        all.append(part);
    }
    let first = weld(&all.points, near);
    let mut whole = Mesh::with_points(all.points.clone());
    for face in all.faces() {
        let mut rings = Vec::with_capacity(face.ring_count());
        for (index, ring) in face.rings().enumerate() {
            let mut own: Vec<u32> = ring.iter().map(|&point| first[point as usize]).collect();
            own.dedup();
            while own.len() > 1 && own.first() == own.last() {
                own.pop();
            }
            if own.len() >= 3 {
                rings.push(own);
            } else if index == 0 {
                break;
            }
        }
        if !rings.is_empty() {
            whole.push_face(&rings);
        }
    }
    whole.compact()
}

/// The side of a cell of known places, in the length within which places are one.
const CELL: f64 = 16.0;

/// Places that are known, by their numbers.
pub(super) struct Places {
    near: f64,
    cells: HashMap<[i64; 3], Vec<(DVec3, u32)>>,
}

impl Places {
    pub fn new(near: f64) -> Self {
        Self {
            near: if near > 0.0 { near } else { f64::MIN_POSITIVE },
            cells: HashMap::default(),
        }
    }

    /// The number of the known place that is near enough, else `new`, which is known from then on.
    pub fn number(&mut self, place: DVec3, new: u32) -> u32 {
        // Most places are nearer to no other cell than to their own.
        let (low, high) = (self.cell(place - self.near), self.cell(place + self.near));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for &(known, number) in self.cells.get(&[x, y, z]).into_iter().flatten() {
                        if known.distance(place) <= self.near {
                            return number;
                        }
                    }
                }
            }
        }
        self.cells
            .entry(self.cell(place))
            .or_default()
            .push((place, new));
        new
    }

    fn cell(&self, place: DVec3) -> [i64; 3] {
        (place / (CELL * self.near))
            .to_array()
            .map(|c| c.floor() as i64)
    }
}
