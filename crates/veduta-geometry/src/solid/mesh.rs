//! Faces with holes over shared points, as columns.

use std::collections::HashMap;
use std::ops::Range;

use glam::DVec3;

/// Planar faces with holes over shared points.
///
/// Columns: the point of each corner, the first corner of each ring and the first ring of each
/// face, the last two with the end appended. The first ring of a face is its outline,
/// counter-clockwise seen from outside; the others are its holes, clockwise. Units and frame are
/// the caller's.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    pub points: Vec<DVec3>,
    corners: Vec<u32>,
    rings: Vec<u32>,
    faces: Vec<u32>,
}

/// A face of a mesh: its rings as slices of point numbers.
#[derive(Debug, Clone, Copy)]
pub struct Face<'a> {
    mesh: &'a Mesh,
    index: usize,
}

impl Default for Mesh {
    fn default() -> Self {
        Self::new()
    }
}

impl Mesh {
    pub fn new() -> Self {
        Self {
            points: Vec::new(),
            corners: Vec::new(),
            rings: vec![0],
            faces: vec![0],
        }
    }

    /// No faces yet, over these points.
    pub fn with_points(points: Vec<DVec3>) -> Self {
        Self {
            points,
            ..Self::new()
        }
    }

    /// One face whose rings have points of their own, the outline first.
    pub fn polygon<R: AsRef<[DVec3]>>(rings: &[R]) -> Self {
        let mut mesh = Self::new();
        let mut numbers = Vec::with_capacity(rings.len());
        for ring in rings {
            let first = mesh.points.len() as u32;
            mesh.points.extend_from_slice(ring.as_ref());
            numbers.push((first..mesh.points.len() as u32).collect::<Vec<_>>());
        }
        mesh.push_face(&numbers);
        mesh
    }

    /// Adds a face of these rings of point numbers, the outline first.
    pub fn push_face<R: AsRef<[u32]>>(&mut self, rings: &[R]) {
        for ring in rings {
            self.corners.extend_from_slice(ring.as_ref());
            self.rings.push(self.corners.len() as u32);
        }
        self.faces.push(self.rings.len() as u32 - 1);
    }

    /// Adds a point; its number.
    pub fn push_point(&mut self, point: DVec3) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// Adds all faces of another mesh, with points of their own.
    pub fn append(&mut self, other: &Self) {
        let offset = |numbers: &[u32], by: usize| -> Vec<u32> {
            numbers.iter().map(|&number| number + by as u32).collect()
        };
        let (rings, faces) = (self.corners.len(), self.rings.len() - 1);
        self.corners
            .extend(offset(&other.corners, self.points.len()));
        self.rings.extend(offset(&other.rings[1..], rings));
        self.faces.extend(offset(&other.faces[1..], faces));
        self.points.extend_from_slice(&other.points);
    }

    /// The mesh without points that no face uses.
    pub fn compact(self) -> Self {
        let all = 0..self.face_count();
        self.of_faces(all)
    }

    /// Some of the faces with their points.
    pub fn of_faces(&self, faces: impl IntoIterator<Item = usize>) -> Self {
        let mut numbers: Vec<Option<u32>> = vec![None; self.points.len()];
        let mut part = Self::new();
        for index in faces {
            let mut rings = Vec::with_capacity(self.face(index).ring_count());
            for ring in self.face(index).rings() {
                let number = |&point: &u32| {
                    *numbers[point as usize]
                        .get_or_insert_with(|| part.push_point(self.points[point as usize]))
                };
                rings.push(ring.iter().map(number).collect::<Vec<_>>());
            }
            part.push_face(&rings);
        }
        part
    }

    pub fn face_count(&self) -> usize {
        self.faces.len() - 1
    }

    pub fn corner_count(&self) -> usize {
        self.corners.len()
    }

    /// About how many bytes it takes.
    pub fn byte_count(&self) -> usize {
        24 * self.points.len() + 4 * self.corner_count() + 8 * self.face_count()
    }

    pub fn is_empty(&self) -> bool {
        self.face_count() == 0
    }

    pub fn face(&self, index: usize) -> Face<'_> {
        Face { mesh: self, index }
    }

    pub fn faces(&self) -> impl Iterator<Item = Face<'_>> {
        (0..self.face_count()).map(|index| self.face(index))
    }

    /// Lower and upper corner of the axis-parallel box around all points; None without any.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = *self.points.first()?;
        let around = |(low, high): (DVec3, DVec3), p: &DVec3| (low.min(*p), high.max(*p));
        Some(self.points.iter().fold((first, first), around))
    }

    /// The mesh with its points moved by `map`, which must not turn faces inside out.
    pub fn mapped(mut self, map: impl Fn(DVec3) -> DVec3) -> Self {
        for point in &mut self.points {
            *point = map(*point);
        }
        self
    }

    /// The same surface seen from the other side.
    pub fn reversed(mut self) -> Self {
        for ring in self.rings.windows(2) {
            self.corners[ring[0] as usize..ring[1] as usize].reverse();
        }
        self
    }

    /// Whether each edge lies between exactly two faces that run along it in opposite directions.
    pub fn is_closed(&self) -> bool {
        let mut balance: HashMap<(u32, u32), i32> = HashMap::with_capacity(self.corners.len());
        for (from, to) in self.faces().flat_map(Face::edges) {
            let (key, sign) = if from < to {
                ((from, to), 1)
            } else {
                ((to, from), -1)
            };
            let sum = balance.entry(key).or_insert(0);
            *sum += sign;
        }
        !self.is_empty() && balance.values().all(|&sum| sum == 0)
    }

    /// Six times the enclosed volume of a closed mesh is the sum of its corner products; this is
    /// the volume.
    pub fn volume(&self) -> f64 {
        let origin = self.points.first().copied().unwrap_or_default();
        let sum: f64 = self
            .faces()
            .map(|face| (self.points[face.outline()[0] as usize] - origin).dot(face.area_vector()))
            .sum();
        sum / 3.0
    }

    /// Sum of the areas of all faces, holes taken off.
    pub fn area(&self) -> f64 {
        self.faces().map(|face| face.area_vector().length()).sum()
    }
}

impl<'a> Face<'a> {
    pub fn index(self) -> usize {
        self.index
    }

    /// The rings as point numbers, the outline first.
    pub fn rings(self) -> impl Iterator<Item = &'a [u32]> {
        let mesh = self.mesh;
        self.ring_range().map(move |ring| {
            &mesh.corners[mesh.rings[ring] as usize..mesh.rings[ring + 1] as usize]
        })
    }

    pub fn outline(self) -> &'a [u32] {
        let ring = self.ring_range().start;
        let mesh = self.mesh;
        &mesh.corners[mesh.rings[ring] as usize..mesh.rings[ring + 1] as usize]
    }

    pub fn ring_count(self) -> usize {
        self.ring_range().len()
    }

    /// Directed edges of all rings, as point numbers.
    pub fn edges(self) -> impl Iterator<Item = (u32, u32)> + 'a {
        self.rings().flat_map(|ring| {
            let shifted = ring.iter().skip(1).chain(ring.first());
            ring.iter().copied().zip(shifted.copied())
        })
    }

    pub fn points(self) -> impl Iterator<Item = DVec3> + 'a {
        let mesh = self.mesh;
        self.rings()
            .flatten()
            .map(move |&point| mesh.points[point as usize])
    }

    /// Newell's vector over all rings: along the normal, as long as the area without the holes.
    pub fn area_vector(self) -> DVec3 {
        let points = &self.mesh.points;
        let origin = points[self.outline()[0] as usize];
        let twice = self.edges().fold(DVec3::ZERO, |sum, (from, to)| {
            sum + (points[from as usize] - origin).cross(points[to as usize] - origin)
        });
        0.5 * twice
    }

    /// Unit normal; zero for a face without area.
    pub fn normal(self) -> DVec3 {
        self.area_vector().normalize_or_zero()
    }

    fn ring_range(self) -> Range<usize> {
        self.mesh.faces[self.index] as usize..self.mesh.faces[self.index + 1] as usize
    }
}
