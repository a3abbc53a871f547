//! Rings in a plane: from loose edges, and into faces with holes.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

/// Faces that close what is open in a plane: for every edge in the plane that no other edge runs
/// against, one runs against it. `flat` says which points lie in the plane, `normal` is that of
/// the faces.
pub fn close_in_plane<'a>(
    points: &[DVec3],
    rings: impl Iterator<Item = &'a Vec<u32>>,
    flat: impl Fn(u32) -> bool,
    normal: DVec3,
) -> Vec<Vec<Vec<u32>>> {
    let mut open: HashMap<(u32, u32), i32> = HashMap::new();
    let mut order = Vec::new();
    for ring in rings {
        for k in 0..ring.len() {
            let (from, to) = (ring[k], ring[(k + 1) % ring.len()]);
            if flat(from) && flat(to) {
                order.push((to, from));
                *open.entry((to, from)).or_insert(0) += 1;
                *open.entry((from, to)).or_insert(0) -= 1;
            }
        }
    }
    let mut edges = Vec::new();
    for edge in order {
        if let Some(count) = open.get_mut(&edge) {
            if *count > 0 {
                *count -= 1;
                edges.push(edge);
            }
        }
    }
    nested(points, traced(points, &edges, normal), normal)
}

/// Rings along directed edges, each edge once. Where several go on from a point, the one that
/// turns left most sharply does, so that rings which touch in a point stay apart.
pub fn traced(points: &[DVec3], edges: &[(u32, u32)], normal: DVec3) -> Vec<Vec<u32>> {
    let flat = Flat::new(normal);
    let mut from: HashMap<u32, Vec<usize>> = HashMap::new();
    for (index, edge) in edges.iter().enumerate() {
        from.entry(edge.0).or_default().push(index);
    }
    let direction = |edge: usize| {
        let (a, b) = edges[edge];
        flat.of(points[b as usize]) - flat.of(points[a as usize])
    };
    let mut used = vec![false; edges.len()];
    let mut rings = Vec::new();
    for start in 0..edges.len() {
        let mut ring = Vec::new();
        let mut at = start;
        while !used[at] {
            used[at] = true;
            ring.push(edges[at].0);
            let Some(ways) = from.get(&edges[at].1) else {
                break;
            };
            let here = direction(at);
            let turn = |&way: &usize| here.angle_to(direction(way));
            let free = ways.iter().copied().filter(|&way| !used[way]);
            match free.max_by(|a, b| turn(a).total_cmp(&turn(b))) {
                Some(next) => at = next,
                None => break,
            }
        }
        if ring.len() >= 3 {
            rings.push(ring);
        }
    }
    rings
}

/// Each hole with the smallest outline around it; `normal` is that of the faces. A hole without
/// an outline around it, and a ring without area, belong to nothing and are left out.
pub fn nested(points: &[DVec3], rings: Vec<Vec<u32>>, normal: DVec3) -> Vec<Vec<Vec<u32>>> {
    let flat = Flat::new(normal);
    let outlines_of = |ring: &Vec<u32>| -> Vec<DVec2> {
        ring.iter().map(|&p| flat.of(points[p as usize])).collect()
    };
    let (mut outlines, mut holes) = (Vec::new(), Vec::new());
    for ring in rings {
        let shape = outlines_of(&ring);
        let area = area(&shape);
        if area > 0.0 {
            outlines.push((area, shape, vec![ring]));
        } else if area < 0.0 {
            holes.push((shape, ring));
        }
    }
    for (shape, ring) in holes {
        let around = outlines
            .iter_mut()
            .filter(|(_, outline, _)| holds(outline, &shape))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, _, rings)) = around {
            rings.push(ring);
        }
    }
    outlines.into_iter().map(|(_, _, rings)| rings).collect()
}

/// A plane's own coordinates: counter-clockwise around its normal.
struct Flat {
    u: DVec3,
    v: DVec3,
}

impl Flat {
    fn new(normal: DVec3) -> Self {
        let u = normal.any_orthonormal_vector();
        Self {
            u,
            v: normal.cross(u),
        }
    }

    fn of(&self, point: DVec3) -> DVec2 {
        DVec2::new(point.dot(self.u), point.dot(self.v))
    }
}

fn area(ring: &[DVec2]) -> f64 {
    let next = ring.iter().skip(1).chain(ring.first());
    0.5 * ring
        .iter()
        .zip(next)
        .map(|(a, b)| (*a - ring[0]).perp_dot(*b - ring[0]))
        .sum::<f64>()
}

/// Whether an outline holds a ring that does not cross it: the middle of one of its edges, which
/// is on the outline only where the two share that edge.
fn holds(outline: &[DVec2], ring: &[DVec2]) -> bool {
    is_inside(outline, 0.5 * (ring[0] + ring[1]))
}

fn is_inside(outline: &[DVec2], point: DVec2) -> bool {
    let mut inside = false;
    for (k, &a) in outline.iter().enumerate() {
        let b = outline[(k + 1) % outline.len()];
        if (a.y > point.y) != (b.y > point.y) {
            let x = a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y);
            inside ^= x > point.x;
        }
    }
    inside
}
