//! Outlines as they come, mended so that they are eaves: or refused with the reason.
//!
//! Mended: rings that run the wrong way round, closing points, double points, points on a straight
//! wall, spikes, outlines that touch themselves (they come apart there into several outlines, or
//! into an outline and a hole) and parts that touch an edge (they are moved off it). Refused:
//! outlines that cross themselves, and whatever would change the area by more than is allowed.

use super::eaves::ring_area_m2;
use super::rings::Untangler;
use super::simple::inside;
use super::tolerance::{CleanTolerance, LARGEST_COORDINATE_M, MOST_VERTICES};
use super::touch::{move_apart, snap};
use super::{Eaves, SkeletonError};

/// What has become of an outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Cleaned {
    /// One polygon per part that hangs together, the largest first.
    pub eaves: Vec<Eaves>,
    /// For each of them and each of its edges, the edge of the input that it comes from; where
    /// several have become one, the longest.
    pub edges: Vec<Vec<u32>>,
    /// By how much the area has changed (m2).
    pub area_change_m2: f64,
}

/// A vertex, and the edge that begins there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub point_m: [f64; 2],
    edge: u32,
    length_m: f64,
}

pub(super) type Ring = Vec<Vertex>;

/// Mends an outline and its holes; `speeds` has one entry per edge, through all rings, and edge
/// `e` begins at point `e`. Rings may or may not repeat their first point at the end.
pub fn clean(
    rings: &[Vec<[f64; 2]>],
    speeds: &[f64],
    tolerance: &CleanTolerance,
) -> Result<Cleaned, SkeletonError> {
    let mut mended = read(rings, speeds)?;
    let before_m2: f64 = mended.iter().map(|ring| area_m2(ring)).sum();
    tidy(&mut mended, speeds, tolerance);
    snap(&mut mended, tolerance.touch_m);
    let mut mended = taken_apart(&mended);
    tidy(&mut mended, speeds, tolerance);
    if move_apart(&mut mended, tolerance) {
        tidy(&mut mended, speeds, tolerance);
    }
    let (outlines, holes): (Vec<Ring>, Vec<Ring>) =
        mended.into_iter().partition(|ring| area_m2(ring) > 0.0);
    if outlines.is_empty() {
        return Err(SkeletonError::Vanished);
    }
    let polygons = with_holes(outlines, holes)?;
    let after_m2: f64 = polygons.iter().flatten().map(|ring| area_m2(ring)).sum();
    let (change_m2, most_m2) = (
        (after_m2 - before_m2).abs(),
        tolerance.area_share * before_m2.abs(),
    );
    if change_m2 > most_m2 || change_m2.is_nan() {
        return Err(SkeletonError::AreaChange { change_m2, most_m2 });
    }
    let mut cleaned = Cleaned {
        eaves: Vec::with_capacity(polygons.len()),
        edges: Vec::with_capacity(polygons.len()),
        area_change_m2: after_m2 - before_m2,
    };
    for polygon in polygons {
        let edges: Vec<u32> = polygon.iter().flatten().map(|v| v.edge).collect();
        let own: Vec<f64> = edges.iter().map(|&edge| speeds[edge as usize]).collect();
        let points: Vec<Vec<[f64; 2]>> = polygon.iter().map(|ring| points_m(ring)).collect();
        cleaned.eaves.push(Eaves::new(&points, &own)?);
        cleaned.edges.push(edges);
    }
    Ok(cleaned)
}

/// The rings with their edges numbered, the first counter-clockwise, the others clockwise.
fn read(rings: &[Vec<[f64; 2]>], speeds: &[f64]) -> Result<Vec<Ring>, SkeletonError> {
    let vertices = rings.iter().map(Vec::len).sum();
    if vertices > MOST_VERTICES {
        return Err(SkeletonError::TooMany {
            vertices,
            most: MOST_VERTICES,
        });
    }
    if speeds.len() != vertices {
        return Err(SkeletonError::SpeedCount {
            speeds: speeds.len(),
            edges: vertices,
        });
    }
    let mut first = 0;
    let mut read = Vec::with_capacity(rings.len());
    for (number, ring) in rings.iter().enumerate() {
        if ring.is_empty() {
            return Err(SkeletonError::RingTooShort {
                ring: number,
                vertices: 0,
            });
        }
        let is_wild = |p: &[f64; 2]| {
            p.iter()
                .any(|c| !c.is_finite() || c.abs() > LARGEST_COORDINATE_M)
        };
        if let Some(vertex) = ring.iter().position(is_wild) {
            return Err(SkeletonError::NotFinite {
                vertex: first + vertex,
            });
        }
        let backwards = (ring_area_m2(ring) > 0.0) != (number == 0);
        let count = ring.len();
        let vertex = |k: usize| {
            let (from, to, edge) = if backwards {
                (
                    count - 1 - k,
                    (2 * count - 2 - k) % count,
                    (2 * count - 2 - k) % count,
                )
            } else {
                (k, (k + 1) % count, k)
            };
            Vertex {
                point_m: ring[from],
                edge: (first + edge) as u32,
                length_m: distance_m(ring[from], ring[to]),
            }
        };
        read.push((0..count).map(vertex).collect());
        first += count;
    }
    Ok(read)
}

/// Drops double points, points on straight walls and spikes; and the rings of which nothing is
/// left.
fn tidy(rings: &mut Vec<Ring>, speeds: &[f64], tolerance: &CleanTolerance) {
    for ring in rings.iter_mut() {
        let mut at = 0;
        // A vertex is looked at again when a neighbour is dropped; each drop shortens the ring.
        let mut unchanged = 0;
        while ring.len() >= 3 && unchanged < ring.len() {
            let count = ring.len();
            let (before, after) = ((at + count - 1) % count, (at + 1) % count);
            if is_needless([ring[before], ring[at], ring[after]], speeds, tolerance) {
                if ring[at].length_m > ring[before].length_m {
                    ring[before].edge = ring[at].edge;
                    ring[before].length_m = ring[at].length_m;
                }
                ring.remove(at);
                at = before - usize::from(before > at);
                unchanged = 0;
            } else {
                at = after;
                unchanged += 1;
            }
        }
    }
    rings.retain(|ring| ring.len() >= 3);
}

/// Whether the middle one of three vertices says nothing.
fn is_needless([a, b, c]: [Vertex; 3], speeds: &[f64], tolerance: &CleanTolerance) -> bool {
    let (from, to) = (minus(b.point_m, a.point_m), minus(c.point_m, b.point_m));
    let (from_m, to_m) = (from[0].hypot(from[1]), to[0].hypot(to[1]));
    if from_m <= tolerance.touch_m {
        return true;
    }
    if to_m <= tolerance.touch_m {
        return false; // the next vertex is the double one
    }
    let twice_m2 = (from[0] * to[1] - from[1] * to[0]).abs();
    if from[0] * to[0] + from[1] * to[1] < 0.0 {
        return twice_m2 <= tolerance.off_line_m * from_m.max(to_m);
    }
    let straight = minus(c.point_m, a.point_m);
    speeds[a.edge as usize] == speeds[b.edge as usize]
        && twice_m2 <= tolerance.off_line_m * straight[0].hypot(straight[1])
}

/// Rings that visit a point twice, as several rings.
fn taken_apart(rings: &[Ring]) -> Vec<Ring> {
    let mut apart = Vec::with_capacity(rings.len());
    for ring in rings {
        let mut order: Vec<usize> = (0..ring.len()).collect();
        order.sort_by(|&a, &b| {
            let (p, q) = (ring[a].point_m, ring[b].point_m);
            p[0].total_cmp(&q[0])
                .then(p[1].total_cmp(&q[1]))
                .then(a.cmp(&b))
        });
        let mut name: Vec<u32> = (0..ring.len() as u32).collect();
        for pair in order.windows(2) {
            if ring[pair[0]].point_m == ring[pair[1]].point_m {
                name[pair[1]] = name[pair[0]];
            }
        }
        apart.extend(loops(ring, &name));
    }
    apart
}

/// The simple loops of a ring whose vertices have names. The edges stay those that leave.
fn loops(ring: &[Vertex], name: &[u32]) -> Vec<Ring> {
    let numbers: Vec<u32> = (0..ring.len() as u32).collect();
    let mut untangler = Untangler::new(ring.len());
    let named = untangler.untangle(&numbers, |vertex| name[vertex as usize]);
    if named.len() == 1 && named[0].len() == ring.len() {
        return vec![ring.to_vec()];
    }
    // Which edge leaves a point depends on where the loop goes next.
    let count = ring.len();
    let leaving =
        |from: u32, to: u32| (0..count).find(|&k| name[k] == from && name[(k + 1) % count] == to);
    named
        .iter()
        .map(|one| {
            let next = one.iter().cycle().skip(1);
            let pairs = one.iter().zip(next);
            pairs
                .filter_map(|(&from, &to)| leaving(from, to).map(|k| ring[k]))
                .collect()
        })
        .collect()
}

/// Gives each outline the holes in it; the largest outline first.
fn with_holes(mut outlines: Vec<Ring>, holes: Vec<Ring>) -> Result<Vec<Vec<Ring>>, SkeletonError> {
    outlines.sort_by(|a, b| area_m2(b).total_cmp(&area_m2(a)));
    let places: Vec<Vec<[f64; 2]>> = outlines.iter().map(|ring| points_m(ring)).collect();
    let mut polygons: Vec<Vec<Ring>> = outlines.into_iter().map(|ring| vec![ring]).collect();
    for (number, hole) in holes.into_iter().enumerate() {
        let around = |outline: &Vec<[f64; 2]>| inside(hole[0].point_m, outline);
        match places.iter().position(around) {
            Some(outline) => polygons[outline].push(hole),
            None => return Err(SkeletonError::HoleOutside { ring: number + 1 }),
        }
    }
    Ok(polygons)
}

fn points_m(ring: &[Vertex]) -> Vec<[f64; 2]> {
    ring.iter().map(|vertex| vertex.point_m).collect()
}

pub(super) fn area_m2(ring: &[Vertex]) -> f64 {
    ring_area_m2(&points_m(ring))
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn distance_m(a: [f64; 2], b: [f64; 2]) -> f64 {
    let [dx, dy] = minus(a, b);
    dx.hypot(dy)
}
