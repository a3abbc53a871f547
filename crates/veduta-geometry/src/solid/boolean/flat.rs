//! Polygons in their own planes: what lies in them, and a place well within them.

use glam::{DVec2, DVec3};

/// A face with its plane and its rings in it.
pub struct Polygon {
    pub rings: Vec<Vec<u32>>,
    pub low: DVec3,
    pub high: DVec3,
    x: DVec3,
    y: DVec3,
    normal: DVec3,
    height: f64,
    flat: Vec<Vec<DVec2>>,
}

impl Polygon {
    /// None without area.
    pub fn new(points: &[DVec3], rings: Vec<Vec<u32>>) -> Option<Self> {
        let origin = points[*rings.first()?.first()? as usize];
        let mut twice = DVec3::ZERO;
        let (mut low, mut high) = (origin, origin);
        for ring in &rings {
            for (k, &from) in ring.iter().enumerate() {
                let (a, b) = (
                    points[from as usize],
                    points[ring[(k + 1) % ring.len()] as usize],
                );
                twice += (a - origin).cross(b - origin);
                (low, high) = (low.min(a), high.max(a));
            }
        }
        let normal = twice.try_normalize()?;
        let (x, y) = normal.any_orthonormal_pair();
        let corners: usize = rings.iter().map(Vec::len).sum();
        let all = rings.iter().flatten();
        let height = all.map(|&p| points[p as usize].dot(normal)).sum::<f64>() / corners as f64;
        let mut polygon = Self {
            rings,
            low,
            high,
            x,
            y,
            normal,
            height,
            flat: Vec::new(),
        };
        let flat = |ring: &Vec<u32>| -> Vec<DVec2> {
            ring.iter()
                .map(|&p| polygon.flat(points[p as usize]))
                .collect()
        };
        let flat = polygon.rings.iter().map(flat).collect();
        polygon.flat = flat;
        Some(polygon)
    }

    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    pub fn above(&self, place: DVec3) -> f64 {
        place.dot(self.normal) - self.height
    }

    pub fn flat(&self, place: DVec3) -> DVec2 {
        DVec2::new(place.dot(self.x), place.dot(self.y))
    }

    pub fn place(&self, flat: DVec2) -> DVec3 {
        self.x * flat.x + self.y * flat.y + self.normal * self.height
    }

    pub fn corner_count(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// Edges of all rings, as numbers of points.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.rings.iter().flat_map(|ring| {
            let next = ring.iter().skip(1).chain(ring.first());
            ring.iter().copied().zip(next.copied())
        })
    }

    /// Whether a place of the plane is in the polygon, or nearer to its border than `near`.
    pub fn holds(&self, place: DVec3, near: f64) -> bool {
        let flat = self.flat(place);
        is_in(&self.flat, flat) || (near > 0.0 && self.is_on_border(flat, near))
    }

    fn is_on_border(&self, flat: DVec2, near: f64) -> bool {
        self.flat.iter().any(|ring| {
            (0..ring.len()).any(|k| distance(flat, ring[k], ring[(k + 1) % ring.len()]) <= near)
        })
    }
}

/// How far a place is from a segment.
pub fn distance(place: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let squared = along.length_squared();
    let share = if squared > 0.0 {
        ((place - from).dot(along) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    place.distance(from + along * share)
}

/// Whether a place is within an odd number of rings.
pub fn is_in<R: AsRef<[DVec2]>>(rings: &[R], place: DVec2) -> bool {
    let mut is_in = false;
    for ring in rings {
        let ring = ring.as_ref();
        for (k, &a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            if (a.y > place.y) != (b.y > place.y) {
                let x = a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y);
                is_in ^= x > place.x;
            }
        }
    }
    is_in
}

/// A place within a polygon with holes, far from its border: the middle of the widest stretch of
/// the lines halfway between corners. None of a polygon without area.
pub fn inner_place(rings: &[Vec<DVec2>]) -> Option<DVec2> {
    const LINES: usize = 16;
    let mut heights: Vec<f64> = rings.iter().flatten().map(|corner| corner.y).collect();
    heights.sort_by(f64::total_cmp);
    let mut gaps: Vec<(f64, f64)> = heights.windows(2).map(|w| (w[0], w[1])).collect();
    gaps.sort_by(|a, b| (b.1 - b.0).total_cmp(&(a.1 - a.0)));
    let mut best: Option<(f64, DVec2)> = None;
    for (low, high) in gaps.into_iter().take(LINES) {
        if high <= low {
            break;
        }
        let y = 0.5 * (low + high);
        let mut crossings = Vec::new();
        for ring in rings {
            for (k, &a) in ring.iter().enumerate() {
                let b = ring[(k + 1) % ring.len()];
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                }
            }
        }
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let room = (pair[1] - pair[0]).min(high - low);
            if best.is_none_or(|(most, _)| room > most) {
                best = Some((room, DVec2::new(0.5 * (pair[0] + pair[1]), y)));
            }
        }
    }
    best.filter(|(room, _)| *room > 0.0).map(|(_, place)| place)
}

/// The area within a ring, below zero for one that runs clockwise.
pub fn area(ring: &[DVec2]) -> f64 {
    let next = ring.iter().skip(1).chain(ring.first());
    let twice = ring.iter().zip(next);
    0.5 * twice
        .map(|(a, b)| (*a - ring[0]).perp_dot(*b - ring[0]))
        .sum::<f64>()
}
