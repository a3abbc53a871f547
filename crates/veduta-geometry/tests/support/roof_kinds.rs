//! Every type of roof, and what is wrong with a solid.

use std::collections::HashMap;

use glam::DVec3;
use veduta_geometry::solid::{Along, Gables, Mesh, RoofKind};

/// Every type by its name.
pub fn kinds() -> Vec<(&'static str, RoofKind)> {
    let gables = Gables::Triangles;
    let along = Along::Longest;
    vec![
        ("hip", RoofKind::HIP),
        ("even hip", RoofKind::Hip { even: true }),
        ("gable", RoofKind::GABLE),
        (
            "even gable",
            RoofKind::Gable {
                gables: gables.clone(),
                even: true,
            },
        ),
        ("pyramid", RoofKind::Pyramid),
        ("shed", RoofKind::Shed { edge: 0 }),
        (
            "skillion",
            RoofKind::Skillion {
                towards: DVec3::new(1.0, 2.0, 0.0),
            },
        ),
        ("ridge", RoofKind::Ridge(along)),
        (
            "mansard",
            RoofKind::Mansard {
                upper: 0.4,
                knee: 1.5,
            },
        ),
        (
            "gambrel",
            RoofKind::Gambrel {
                gables: gables.clone(),
                upper: 0.4,
                knee: 1.5,
            },
        ),
        (
            "half-hip",
            RoofKind::HalfHip {
                gables: gables.clone(),
                clipped: 0.4,
            },
        ),
        ("dutch", RoofKind::Dutch { share: 0.6 }),
        (
            "saltbox",
            RoofKind::Saltbox {
                back: 0.5,
                front: None,
            },
        ),
        ("butterfly", RoofKind::Butterfly(along)),
        ("sawtooth", RoofKind::Sawtooth { teeth: 5, along }),
        ("cross-gable", RoofKind::CrossGable(along)),
        (
            "dome",
            RoofKind::Dome {
                height: 4.0,
                steps: 6,
            },
        ),
        (
            "onion",
            RoofKind::Onion {
                height: 6.0,
                steps: 8,
            },
        ),
        (
            "vault",
            RoofKind::Vault {
                gables,
                height: 3.0,
                steps: 6,
            },
        ),
        (
            "flat",
            RoofKind::Flat {
                slab: 0.2,
                parapet: 0.9,
                width: 0.3,
            },
        ),
    ]
}

/// Rings in the plane z = 0.
pub fn sheet(rings: &[Vec<[f64; 2]>]) -> Mesh {
    let ring = |ring: &Vec<[f64; 2]>| -> Vec<DVec3> {
        ring.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
    };
    Mesh::polygon(&rings.iter().map(ring).collect::<Vec<_>>())
}

/// What is wrong with a solid over rings, if anything: sides that do not pair, points that join two
/// surfaces, faces off their planes, and faces that look up and do not cover the rings once.
pub fn fault(solid: &Mesh, rings: &[Vec<[f64; 2]>], outline_m2: Option<f64>) -> Option<String> {
    let mut sides = HashMap::new();
    let mut around: HashMap<u32, HashMap<u32, u32>> = HashMap::new();
    for ring in solid.faces().flat_map(|face| face.rings()) {
        for (k, &point) in ring.iter().enumerate() {
            let next = ring[(k + 1) % ring.len()];
            let before = ring[(k + ring.len() - 1) % ring.len()];
            if sides.insert((point, next), ()).is_some() {
                return Some(format!("side {point} {next} twice"));
            }
            let [a, b, c] = [before, point, next].map(|p| solid.points[p as usize]);
            let (from, to) = (b - a, c - b);
            if from.cross(to).length() < 1e-9 * from.length() * to.length() && from.dot(to) < 0.0 {
                return Some(format!("a spike at point {point}"));
            }
            let fan = around.entry(point).or_default();
            if fan.insert(before, next).is_some() {
                return Some(format!("point {point} twice in a corner"));
            }
        }
    }
    for &(from, to) in sides.keys() {
        if !sides.contains_key(&(to, from)) {
            return Some(format!("open side {from} {to}"));
        }
    }
    for (point, fan) in &around {
        let start = *fan.keys().next().unwrap();
        let (mut at, mut count) = (fan[&start], 1);
        while at != start {
            at = fan[&at];
            count += 1;
        }
        if count != fan.len() {
            return Some(format!("point {point} joins two surfaces"));
        }
    }
    let (low, high) = solid.bounds().unwrap();
    let size = low.distance(high);
    let mut up_m2 = 0.0;
    for face in solid.faces() {
        let normal = face.normal();
        let origin = solid.points[face.outline()[0] as usize];
        let off = face.points().map(|p| (p - origin).dot(normal).abs());
        let off = off.fold(0.0, f64::max);
        if off > 2e-8 * size {
            return Some(format!("{off} m off the plane of face {}", face.index()));
        }
        if normal.z > 1e-7 {
            up_m2 += face.area_vector().z;
        }
    }
    if solid.volume() <= 0.0 {
        return Some(format!("a volume of {}", solid.volume()));
    }
    let outline_m2 = outline_m2.unwrap_or_else(|| sheet(rings).area());
    let error = (up_m2 / outline_m2 - 1.0).abs();
    (error > 1e-6).then(|| format!("{up_m2} m2 look up from {outline_m2} m2"))
}
