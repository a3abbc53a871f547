//! Which components hang together.

use std::collections::HashMap;

use glam::DVec3;
use veduta_geometry::solid::weld;

use super::form::Form;

/// Components, by their numbers in `forms`, put together with those that they hang together with:
/// two do where faces of theirs have an edge in common, or, where they have no faces, a point.
/// Groups come in the order of their first component. Points nearer than `near` (m) are one.
pub fn connected(forms: &[&Form], near: f64) -> Vec<Vec<usize>> {
    let mut points = Vec::new();
    // The edges of faces, and points as edges from themselves to themselves, with whose they are.
    let mut edges: Vec<([u32; 2], usize)> = Vec::new();
    for (at, form) in forms.iter().enumerate() {
        let mesh = form.world_mesh();
        let first = points.len() as u32;
        if mesh.is_empty() {
            let ends = bare_points(form);
            edges.extend((0..ends.len() as u32).map(|k| ([first + k; 2], at)));
            points.extend(ends);
            continue;
        }
        let own = mesh.faces().flat_map(|face| face.edges());
        edges.extend(own.map(|(a, b)| ([first + a, first + b], at)));
        points.extend_from_slice(&mesh.points);
    }
    let place = weld(&points, near);
    let mut groups = Groups::of(forms.len());
    let mut owner: HashMap<[u32; 2], usize> = HashMap::new();
    for (ends, at) in edges {
        let mut ends = ends.map(|end| place[end as usize]);
        ends.sort_unstable();
        let first = *owner.entry(ends).or_insert(at);
        groups.join(first, at);
    }
    groups.found()
}

/// The ends of an edge, or the one point of a vertex.
fn bare_points(form: &Form) -> Vec<DVec3> {
    let scope = form.scope;
    match scope.size.x > 0.0 {
        true => vec![scope.origin, scope.world(DVec3::X)],
        false => vec![scope.origin],
    }
}

/// Numbers that are joined step by step.
struct Groups {
    above: Vec<usize>,
}

impl Groups {
    fn of(count: usize) -> Self {
        Self {
            above: (0..count).collect(),
        }
    }

    fn top(&mut self, mut at: usize) -> usize {
        while self.above[at] != at {
            self.above[at] = self.above[self.above[at]];
            at = self.above[at];
        }
        at
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.top(one), self.top(other));
        self.above[one.max(other)] = one.min(other);
    }

    fn found(mut self) -> Vec<Vec<usize>> {
        let count = self.above.len();
        let mut groups = vec![Vec::new(); count];
        for at in 0..count {
            let top = self.top(at);
            groups[top].push(at);
        }
        groups.retain(|group| !group.is_empty());
        groups
    }
}
