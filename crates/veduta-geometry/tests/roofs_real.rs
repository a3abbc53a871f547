//! Roofs over 120 real buildings that other roof software fails on. What is asserted of them is
//! measured here anew, without the library's own check.

use std::collections::HashMap;

use veduta_geometry::skeleton::{roof, Eaves, FaceOrigin, Roof, SkeletonError};

use crate::footprints;

use footprints::hard_footprints;

/// The same numbers on every run (a linear congruence, after Knuth).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        let (a, c) = (6_364_136_223_846_793_005, 1_442_695_040_888_963_407);
        self.0 = self.0.wrapping_mul(a).wrapping_add(c);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Roof, walls down to -3 m and base as polygons of nodes; a hole is a polygon of its own.
fn solid(eaves: &Eaves, roof: &Roof) -> Vec<Vec<u32>> {
    let foot = |vertex: usize| (roof.nodes_m.len() + vertex) as u32;
    let mut polygons: Vec<Vec<u32>> = roof.faces.iter().flat_map(|f| f.rings.clone()).collect();
    polygons.extend(roof.rest.iter().flat_map(|rest| rest.rings.clone()));
    let mut base: HashMap<u32, u32> = HashMap::new();
    for vertex in 0..eaves.len() {
        let next = eaves.next(vertex);
        polygons.push(vec![foot(vertex), foot(next), next as u32, vertex as u32]);
        base.insert(foot(next), foot(vertex));
    }
    while let Some(&start) = base.keys().min() {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(to) = base.remove(&at) {
            ring.push(at);
            at = to;
        }
        polygons.push(ring);
    }
    polygons
}

/// Every side fits one other side, and the polygons around a node are one fan. A node at which the
/// hole of a level polygon touches its outline is between two parts of one polygon.
fn assert_manifold(eaves: &Eaves, roof: &Roof, name: &str) {
    let polygons = solid(eaves, roof);
    let touches = |node: &u32| {
        let visits = |rings: &[Vec<u32>]| rings.iter().flatten().filter(|n| *n == node).count();
        roof.rest.iter().any(|rest| visits(&rest.rings) > 1)
    };
    let mut sides = HashMap::new();
    // At each node: from the node before it to the node after it, in each polygon.
    let mut around: HashMap<u32, HashMap<u32, u32>> = HashMap::new();
    for ring in &polygons {
        for (k, &node) in ring.iter().enumerate() {
            let next = ring[(k + 1) % ring.len()];
            let before = ring[(k + ring.len() - 1) % ring.len()];
            assert_eq!(
                sides.insert((node, next), ()),
                None,
                "{name}: side used twice"
            );
            let fan = around.entry(node).or_default();
            assert_eq!(fan.insert(before, next), None, "{name}: node {node}");
        }
    }
    for &(from, to) in sides.keys() {
        assert!(
            sides.contains_key(&(to, from)),
            "{name}: open side {from} {to}"
        );
    }
    for (node, fan) in around {
        let mut count = 0;
        for start in fan.keys().take(1) {
            let mut at = fan[start];
            count += 1;
            while at != *start {
                at = fan[&at];
                count += 1;
            }
        }
        assert!(
            count == fan.len() || touches(&node),
            "{name}: node {node} joins two surfaces"
        );
    }
}

/// Each face planar within 1e-9, counter-clockwise and simple from above, and all of them together
/// as large as the eaves.
fn assert_covers(eaves: &Eaves, roof: &Roof, name: &str) {
    let mut covered_m2 = 0.0;
    let size_m = eaves.diagonal_m();
    for face in &roof.faces {
        let place = |&node: &u32| roof.nodes_m[node as usize];
        let ring: Vec<[f64; 3]> = face.rings[0].iter().map(place).collect();
        assert!(
            face.rings.len() == 1 && ring.iter().all(|p| p[2] >= 0.0),
            "{name}"
        );
        let normal = newell(&ring);
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        for point in &ring {
            let off: f64 = (0..3)
                .map(|k| normal[k] / length * (point[k] - ring[0][k]))
                .sum();
            assert!(off.abs() < 1e-9 * size_m, "{name}: {off} m off the plane");
        }
        if matches!(face.origin, FaceOrigin::Edge(edge) if eaves.speeds()[edge as usize] > 0.0) {
            assert!(normal[2] > 0.0, "{name}: a face lies upside down");
            assert!(
                is_simple(&ring, 1e-9 * size_m),
                "{name}: a face crosses itself"
            );
            covered_m2 += 0.5 * normal[2];
        }
    }
    let area_m2 = eaves.area_m2();
    let error = (covered_m2 / area_m2 - 1.0).abs();
    assert!(error < 1e-6, "{name}: {covered_m2} m2 of {area_m2} m2");
}

/// Twice the area vector.
fn newell(ring: &[[f64; 3]]) -> [f64; 3] {
    let o = ring[0];
    let mut sum = [0.0; 3];
    for pair in ring.windows(2) {
        let (a, b) = (
            [0, 1, 2].map(|k| pair[0][k] - o[k]),
            [0, 1, 2].map(|k| pair[1][k] - o[k]),
        );
        for k in 0..3 {
            let (u, v) = ((k + 1) % 3, (k + 2) % 3);
            sum[k] += a[u] * b[v] - a[v] * b[u];
        }
    }
    sum
}

/// No two sides cross by more than `depth_m`, seen from above.
fn is_simple(ring: &[[f64; 3]], depth_m: f64) -> bool {
    let side = |k: usize| (ring[k], ring[(k + 1) % ring.len()]);
    let off = |(a, b): ([f64; 3], [f64; 3]), p: [f64; 3]| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        (dx * (p[1] - a[1]) - dy * (p[0] - a[0])) / dx.hypot(dy)
    };
    let apart = |one: ([f64; 3], [f64; 3]), other: ([f64; 3], [f64; 3])| {
        let (p, q) = (off(one, other.0), off(one, other.1));
        p.min(q) > -depth_m || p.max(q) < depth_m
    };
    let count = ring.len();
    (0..count).all(|a| (0..a).all(|b| apart(side(a), side(b)) || apart(side(b), side(a))))
}

#[test]
fn every_footprint_has_a_hip_roof() {
    for (name, rings) in hard_footprints().unwrap_or_default() {
        let eaves = Eaves::even(&rings).unwrap();
        let found = roof(&eaves, None).unwrap();
        assert_manifold(&eaves, &found, &name);
        assert_covers(&eaves, &found, &name);
        assert_eq!(
            (found.attempts, found.faces.len()),
            (1, eaves.len()),
            "{name}"
        );
    }
}

#[test]
fn every_footprint_has_a_roof_of_any_slopes() {
    let mut chance = Chance(1);
    for (name, rings) in hard_footprints().unwrap_or_default() {
        for round in 0..10 {
            let speed = |chance: &mut Chance| match round % 2 {
                0 => 0.3 + 2.7 * chance.next(),
                _ => [0.5, 1.0, 2.0][(3.0 * chance.next()) as usize],
            };
            let edges = rings.iter().map(Vec::len).sum::<usize>();
            let speeds: Vec<f64> = (0..edges).map(|_| speed(&mut chance)).collect();
            let eaves = Eaves::new(&rings, &speeds).unwrap();
            let found = roof(&eaves, None).unwrap();
            assert_manifold(&eaves, &found, &name);
            assert_covers(&eaves, &found, &name);
        }
    }
}

/// Whether the outline turns inwards at both ends of an edge: where a gable can stand.
fn may_be_gable(eaves: &Eaves, edge: usize) -> bool {
    let is_convex = |vertex: usize| {
        let [a, b, c] =
            [eaves.previous(vertex), vertex, eaves.next(vertex)].map(|k| eaves.points_m()[k]);
        (b[0] - a[0]) * (c[1] - b[1]) > (b[1] - a[1]) * (c[0] - b[0])
    };
    is_convex(edge) && is_convex(eaves.next(edge))
}

#[test]
fn every_footprint_has_gables() {
    let mut chance = Chance(2);
    let mut gables = 0;
    for (name, rings) in hard_footprints().unwrap_or_default() {
        let eaves = Eaves::even(&rings).unwrap();
        for _ in 0..10 {
            let mut speeds = vec![1.0; eaves.len()];
            for edge in 0..eaves.len() {
                let beside = [eaves.previous(edge), eaves.next(edge)];
                if may_be_gable(&eaves, edge)
                    && beside.iter().all(|&other| speeds[other] > 0.0)
                    && chance.next() < 0.5
                {
                    speeds[edge] = 0.0;
                    gables += 1;
                }
            }
            let eaves = eaves.with_speeds(&speeds).unwrap();
            let found = roof(&eaves, None).unwrap();
            assert_manifold(&eaves, &found, &name);
            assert_covers(&eaves, &found, &name);
        }
    }
    assert!(
        gables == 0 || gables > 1000,
        "{gables} gables are too few to say anything"
    );
}

#[test]
fn every_footprint_can_be_cut_at_any_height() {
    let mut chance = Chance(3);
    for (name, rings) in hard_footprints().unwrap_or_default() {
        let eaves = Eaves::even(&rings).unwrap();
        let whole = roof(&eaves, None).unwrap();
        for round in 0..6 {
            let node = whole.nodes_m[eaves.len()..]
                [(chance.next() * (whole.nodes_m.len() - eaves.len()) as f64) as usize];
            let stop_m = if round % 2 == 0 {
                node[2]
            } else {
                node[2] * chance.next()
            };
            let cut = roof(&eaves, Some(stop_m)).unwrap();
            assert_manifold(&eaves, &cut, &name);
            assert!(
                cut.nodes_m
                    .iter()
                    .all(|node| node[2] <= stop_m * (1.0 + 1e-9)),
                "{name}"
            );
        }
    }
}

#[test]
fn walls_that_stand_all_around_have_no_top() {
    for (name, rings) in hard_footprints().unwrap_or_default() {
        let still = vec![0.0; rings.iter().map(Vec::len).sum()];
        let found = roof(&Eaves::new(&rings, &still).unwrap(), None);
        assert!(
            matches!(found, Err(SkeletonError::Unbounded { .. })),
            "{name}"
        );
    }
}
