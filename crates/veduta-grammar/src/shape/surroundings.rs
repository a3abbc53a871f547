//! What is around the components of a shape: its border, and the edges of roofs.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use veduta_geometry::solid::{weld, Face, Mesh};

use super::components::Kind;
use super::form::{Form, TOLERANCE};
use super::selecting::is_aslant;

/// An edge as roofs have them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoofEdge {
    /// The level lower end of a slope.
    Eave,
    /// Slopes meet and fall away from it; it is not level, and begins at an eave.
    Hip,
    /// Slopes meet and rise from it.
    Valley,
    /// Slopes meet and fall away from it, and it is no hip.
    Ridge,
}

/// What is around a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Surroundings {
    /// An edge of one face alone, a face that has such an edge, a vertex at such an edge.
    pub border: bool,
    pub roof: Option<RoofEdge>,
}

/// What is around each component, by the numbers that [`super::components`] gives them.
pub fn surroundings(form: &Form, kind: Kind) -> Vec<Surroundings> {
    let mesh = form.world_mesh();
    let extent = form.scope.size.length();
    let mut sides = Sides::of(&mesh, extent);
    let up = form.scope.axes.y_axis;
    if matches!(kind, Kind::Edges | Kind::FaceEdges) {
        sides.find_eaves(&mesh, up, extent);
    }
    let of_edge = |from: u32, to: u32, extent: f64| Surroundings {
        border: sides.faces(from, to).len() == 1,
        roof: sides.roof_edge(&mesh, from, to, up, extent),
    };
    let border = |border: bool| Surroundings { border, roof: None };
    match kind {
        Kind::Faces => {
            let alone = |face: Face<'_>| face.edges().any(|(a, b)| sides.faces(a, b).len() == 1);
            mesh.faces().map(|face| border(alone(face))).collect()
        }
        Kind::FaceEdges => {
            let all = mesh.faces().flat_map(Face::edges);
            all.map(|(a, b)| of_edge(a, b, extent)).collect()
        }
        Kind::Edges => {
            let mut seen = HashSet::new();
            let all = mesh.faces().flat_map(Face::edges);
            let first = all.filter(|&(a, b)| {
                let has_length = mesh.points[a as usize] != mesh.points[b as usize];
                has_length && seen.insert((a.min(b), a.max(b)))
            });
            first.map(|(a, b)| of_edge(a, b, extent)).collect()
        }
        Kind::Vertices => sides.at_border(&mesh).into_iter().map(border).collect(),
        Kind::FaceVertices => {
            let at_border = sides.at_border(&mesh);
            let corners = mesh.faces().flat_map(|face| face.rings().flatten());
            corners
                .map(|&point| border(at_border[point as usize]))
                .collect()
        }
        Kind::Groups | Kind::Materials => Vec::new(),
        Kind::Holes => {
            let count = mesh.faces().map(|face| face.ring_count() - 1).sum();
            vec![border(true); count]
        }
    }
}

/// The faces at each edge, with points at one place as one.
struct Sides {
    first: Vec<u32>,
    faces: HashMap<(u32, u32), Vec<usize>>,
    /// The ends of all eaves.
    eaves: HashSet<u32>,
}

impl Sides {
    fn of(mesh: &Mesh, extent: f64) -> Self {
        let first = weld(&mesh.points, extent * TOLERANCE);
        let mut sides = Self {
            first,
            faces: HashMap::new(),
            eaves: HashSet::new(),
        };
        for face in mesh.faces() {
            for (from, to) in face.edges() {
                let key = sides.key(from, to);
                sides.faces.entry(key).or_default().push(face.index());
            }
        }
        sides
    }

    fn key(&self, from: u32, to: u32) -> (u32, u32) {
        let (a, b) = (self.first[from as usize], self.first[to as usize]);
        (a.min(b), a.max(b))
    }

    fn faces(&self, from: u32, to: u32) -> &[usize] {
        self.faces
            .get(&self.key(from, to))
            .map_or(&[], Vec::as_slice)
    }

    /// Of each point, whether an edge of one face alone ends there.
    fn at_border(&self, mesh: &Mesh) -> Vec<bool> {
        let mut found = vec![false; mesh.points.len()];
        for (a, b) in mesh.faces().flat_map(Face::edges) {
            if self.faces(a, b).len() == 1 {
                found[a as usize] = true;
                found[b as usize] = true;
            }
        }
        found
    }

    fn find_eaves(&mut self, mesh: &Mesh, up: DVec3, extent: f64) {
        for (from, to) in mesh.faces().flat_map(Face::edges) {
            if self.roof_edge(mesh, from, to, up, extent) == Some(RoofEdge::Eave) {
                let (from, to) = self.key(from, to);
                self.eaves.extend([from, to]);
            }
        }
    }

    fn is_at_eave(&self, from: u32, to: u32) -> bool {
        let (from, to) = self.key(from, to);
        self.eaves.contains(&from) || self.eaves.contains(&to)
    }

    fn roof_edge(
        &self,
        mesh: &Mesh,
        from: u32,
        to: u32,
        up: DVec3,
        extent: f64,
    ) -> Option<RoofEdge> {
        let along = mesh.points[to as usize] - mesh.points[from as usize];
        let is_level = along.dot(up).abs() <= 1e-6 * along.length().max(extent * TOLERANCE);
        let slopes: Vec<usize> = self
            .faces(from, to)
            .iter()
            .copied()
            .filter(|&face| is_aslant(mesh.face(face).normal().dot(up)))
            .collect();
        match slopes[..] {
            [one, other] if one != other => {
                let rises = |face: usize| self.inward(mesh, face, from, to).dot(up) > 0.0;
                let (a, b) = (mesh.face(one).normal(), self.inward(mesh, other, from, to));
                Some(if a.dot(b) > 0.0 {
                    RoofEdge::Valley
                } else if !is_level {
                    match self.is_at_eave(from, to) {
                        true => RoofEdge::Hip,
                        false => RoofEdge::Ridge,
                    }
                } else if rises(one) || rises(other) {
                    return None;
                } else {
                    RoofEdge::Ridge
                })
            }
            [one] if is_level && self.inward(mesh, one, from, to).dot(up) > 0.0 => {
                Some(RoofEdge::Eave)
            }
            _ => None,
        }
    }

    /// From an edge into one of its faces.
    fn inward(&self, mesh: &Mesh, face: usize, from: u32, to: u32) -> DVec3 {
        let key = self.key(from, to);
        let face = mesh.face(face);
        let own = face.edges().find(|&(a, b)| self.key(a, b) == key);
        let (a, b) = own.unwrap_or((from, to));
        let along = mesh.points[b as usize] - mesh.points[a as usize];
        face.normal().cross(along)
    }
}
