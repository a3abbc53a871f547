//! Whether a roof is one: closed, planar, and over every point of the eaves exactly once.
//!
//! The faces are a closed surface over the eaves whose sides fit in pairs. If every face is a
//! simple polygon that runs counter-clockwise and the areas add up to that of the eaves, no two
//! faces overlap. Standing faces (speed 0) have no area from above; they are measured in their own
//! plane.

use super::eaves::ring_area_m2;
use super::roof::{FaceOrigin, Roof, RoofFace};
use super::tolerance::{AREA_SHARE, CROSSING_SHARE, PLANE_SHARE};
use super::{Eaves, RoofFault};

/// How sound a roof is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Soundness {
    /// The farthest that a node is off the plane of its face (m).
    pub off_plane_m: f64,
    /// The area of the faces and of the rest, seen from above (m2).
    pub covered_m2: f64,
    /// The height of the top (m).
    pub top_m: f64,
}

/// Measures a roof, or says what is wrong with it.
pub fn check(eaves: &Eaves, roof: &Roof) -> Result<Soundness, RoofFault> {
    let mut found = Soundness::default();
    for (node, &[_, _, height_m]) in roof.nodes_m.iter().enumerate() {
        if height_m < 0.0 || height_m.is_nan() {
            let node = node as u32;
            return Err(RoofFault::Below { node, height_m });
        }
        found.top_m = found.top_m.max(height_m);
    }
    check_closed(eaves, roof)?;
    let mut has_face = vec![false; eaves.len()];
    let mut flat = Vec::new();
    for (number, face) in roof.faces.iter().enumerate() {
        let frame = Frame::of(eaves, roof, number, face)?;
        if let FaceOrigin::Edge(edge) = face.origin {
            has_face[edge as usize] = true;
        }
        let area_m2 = check_face(eaves, roof, number, &frame, &mut flat, &mut found)?;
        if frame.speed > 0.0 {
            found.covered_m2 += area_m2;
        }
    }
    if let Some(edge) = has_face.iter().position(|has| !has) {
        return Err(RoofFault::NoFace { edge });
    }
    for rest in &roof.rest {
        for ring in &rest.rings {
            let level = ring.iter().map(|&node| roof.nodes_m[node as usize]);
            flat.clear();
            flat.extend(level.map(|[x, y, _]| [x, y]));
            found.covered_m2 += ring_area_m2(&flat);
        }
    }
    let area_m2 = eaves.area_m2();
    let covered_m2 = found.covered_m2;
    if (covered_m2 - area_m2).abs() > AREA_SHARE * area_m2 {
        return Err(RoofFault::Area {
            covered_m2,
            area_m2,
        });
    }
    Ok(found)
}

/// Every side is there once, and once in the opposite direction, unless it is an edge of the eaves.
fn check_closed(eaves: &Eaves, roof: &Roof) -> Result<(), RoofFault> {
    let faces = roof.faces.iter().map(|face| &face.rings);
    let rings = faces.chain(roof.rest.iter().map(|rest| &rest.rings));
    let mut sides: Vec<(u32, u32, bool)> = Vec::with_capacity(8 * roof.faces.len());
    for ring in rings.flatten() {
        let mut from = ring[ring.len() - 1];
        for &to in ring {
            sides.push((from.min(to), from.max(to), from < to));
            from = to;
        }
    }
    for edge in 0..eaves.len() {
        let (from, to) = (eaves.next(edge) as u32, edge as u32);
        sides.push((from.min(to), from.max(to), from < to));
    }
    sides.sort_unstable();
    let open = |pair: &[(u32, u32, bool)]| {
        pair.len() < 2
            || (pair[0].0, pair[0].1) != (pair[1].0, pair[1].1)
            || pair[0].2
            || !pair[1].2
    };
    match sides.chunks(2).find(|pair| open(pair)) {
        Some(pair) => Err(RoofFault::Open {
            from: pair[0].0,
            to: pair[0].1,
        }),
        None => Ok(()),
    }
}

/// The plane of a face: a point of it, the direction along it, and the speed.
struct Frame {
    origin_m: [f64; 2],
    along: [f64; 2],
    speed: f64,
}

impl Frame {
    fn of(eaves: &Eaves, roof: &Roof, number: usize, face: &RoofFace) -> Result<Self, RoofFault> {
        let no_outline = RoofFault::NoOutline { face: number };
        match face.rings.first() {
            Some(outline) if outline.len() >= 3 => {
                let (origin_m, along, speed) = match face.origin {
                    FaceOrigin::Edge(edge) => {
                        let edge = edge as usize;
                        let speed = eaves.speeds()[edge];
                        (eaves.points_m()[edge], eaves.along(edge), speed)
                    }
                    FaceOrigin::Step { .. } => step_frame(roof, outline),
                };
                let length = along[0].hypot(along[1]);
                Ok(Self {
                    origin_m,
                    along: along.map(|c| c / length),
                    speed,
                })
            }
            _ => Err(no_outline),
        }
    }

    /// Along the face, inwards from its foot, and how far off its plane.
    fn place(&self, [x, y, z]: [f64; 3]) -> ([f64; 2], f64) {
        let (dx, dy) = (x - self.origin_m[0], y - self.origin_m[1]);
        let along = self.along[0] * dx + self.along[1] * dy;
        let inwards = self.along[0] * dy - self.along[1] * dx;
        let off = (inwards - self.speed * z) / 1f64.hypot(self.speed);
        let up = if self.speed > 0.0 { inwards } else { z };
        ([along, up], off)
    }
}

/// A step stands on the line through its two nodes that are farthest apart on the ground; it is
/// seen from the side on which its outline runs counter-clockwise.
fn step_frame(roof: &Roof, outline: &[u32]) -> ([f64; 2], [f64; 2], f64) {
    let place = |node: &u32| roof.nodes_m[*node as usize];
    let [x, y, z] = place(&outline[0]);
    let to = |node: &u32| [place(node)[0] - x, place(node)[1] - y];
    let mut along = [0.0_f64, 0.0];
    for [dx, dy] in outline.iter().map(to) {
        if dx.hypot(dy) > along[0].hypot(along[1]) {
            along = [dx, dy];
        }
    }
    let flat: Vec<[f64; 2]> = outline
        .iter()
        .map(|node| {
            let [dx, dy] = to(node);
            [along[0] * dx + along[1] * dy, place(node)[2] - z]
        })
        .collect();
    if ring_area_m2(&flat) < 0.0 {
        along = along.map(|c| -c);
    }
    ([x, y], along, 0.0)
}

/// Planar, counter-clockwise and simple; gives the area in its own plane, from above where the
/// face slopes (m2).
fn check_face(
    eaves: &Eaves,
    roof: &Roof,
    face: usize,
    frame: &Frame,
    flat: &mut Vec<[f64; 2]>,
    found: &mut Soundness,
) -> Result<f64, RoofFault> {
    let diagonal_m = eaves.diagonal_m();
    let rings = &roof.faces[face].rings;
    let mut area_m2 = 0.0;
    flat.clear();
    for ring in rings {
        let start = flat.len();
        for &node in ring {
            let (place, off) = frame.place(roof.nodes_m[node as usize]);
            found.off_plane_m = found.off_plane_m.max(off.abs());
            if off.abs() > PLANE_SHARE * diagonal_m || off.is_nan() {
                return Err(RoofFault::NotPlanar {
                    face,
                    node,
                    deviation_m: off.abs(),
                });
            }
            flat.push(place);
        }
        area_m2 += ring_area_m2(&flat[start..]);
    }
    if area_m2 < -CROSSING_SHARE * diagonal_m * diagonal_m || area_m2.is_nan() {
        return Err(RoofFault::Flipped { face, area_m2 });
    }
    if rings.iter().map(Vec::len).sum::<usize>() > 3
        && crosses(rings, flat, CROSSING_SHARE * diagonal_m)
    {
        return Err(RoofFault::SelfCrossing { face });
    }
    Ok(area_m2)
}

/// Whether two sides cross by more than `depth`. Touching is allowed.
fn crosses(rings: &[Vec<u32>], flat: &[[f64; 2]], depth: f64) -> bool {
    let mut sides = Vec::with_capacity(flat.len());
    let mut start = 0;
    for ring in rings {
        let count = ring.len();
        sides.extend((0..count).map(|k| (start + k, start + (k + 1) % count)));
        start += count;
    }
    sides.iter().enumerate().any(|(place, &(a, b))| {
        sides[place + 1..]
            .iter()
            .any(|&(c, d)| cross_deeper([flat[a], flat[b]], [flat[c], flat[d]], depth))
    })
}

fn cross_deeper([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2], depth: f64) -> bool {
    (0..2).all(|axis| {
        a[axis].min(b[axis]) <= c[axis].max(d[axis]) && c[axis].min(d[axis]) <= a[axis].max(b[axis])
    }) && parted([a, b], [c, d], depth)
        && parted([c, d], [a, b], depth)
}

/// Whether the ends of the second segment are on both sides of the first, each farther than
/// `depth` from its line.
fn parted([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2], depth: f64) -> bool {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let least = depth * (dx * dx + dy * dy).sqrt();
    let off = |p: [f64; 2]| dx * (p[1] - a[1]) - dy * (p[0] - a[0]);
    let (one, other) = (off(c), off(d));
    (one > least && other < -least) || (one < -least && other > least)
}
