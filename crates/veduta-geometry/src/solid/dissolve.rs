//! Faces that lie in one plane and belong together as one face.
//!
//! Splits cut a wall into cells, whose corners lie in the middle of their neighbours' edges. Here
//! the corners of each are put into the edges of the others, edges that run against each other
//! cancel, and what is left are the outlines and holes of the faces as they were meant. Corners that
//! no face turns at are dropped from all of them, so that what was closed stays so.

use foldhash::{HashMap, HashSet};
use glam::DVec3;

use super::loops::{nested, traced};
use super::points_near::PointsNear;
use super::weld::weld;

/// Normals this near to each other (1 - cosine) are those of one plane.
const PARALLEL: f64 = 1e-9;
/// A corner that turns by less (sine) is none.
const STRAIGHT: f64 = 1e-6;
/// Texture coordinates this near are the same.
const SAME_UV: f64 = 1e-4;
/// The share of a face's area that may be lost.
const LOST_AREA: f64 = 1e-6;

/// A face of some rings, the outline first; each corner has a place and texture coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    pub rings: Vec<Vec<Corner>>,
    /// Sheets of one group may become one.
    pub group: u32,
    /// Sheets of one solid share edges.
    pub solid: u32,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    pub place: DVec3,
    pub uv: [f64; 2],
}

/// The sheets of each group that touch in one plane as one, in the order of the first of each.
/// Texture coordinates must go on over the edges between them. Places nearer to each other than
/// `near` (m) are one.
pub fn dissolve(sheets: &[Sheet], near: f64) -> Vec<Sheet> {
    let places: Vec<DVec3> = corners(sheets).map(|corner| corner.place).collect();
    let numbers = weld(&places, near);
    let mut all = Faces::new(sheets, &numbers);
    let solids: Vec<u32> = unique(sheets.iter().map(|sheet| sheet.solid));
    for &solid in &solids {
        let members: Vec<usize> = (0..sheets.len())
            .filter(|&index| sheets[index].solid == solid)
            .collect();
        all.put_corners_in(&members, &places, near);
    }
    let mut whole: Vec<Whole> = Vec::new();
    for members in all.together(sheets, &places) {
        whole.extend(all.as_one(&members, &places));
    }
    let mut found = Vec::new();
    let turns = turning(&whole, &places, sheets);
    for one in &whole {
        let solid = sheets[one.first].solid;
        let corner = |number: &u32| Corner {
            place: places[*number as usize],
            uv: one.uv.get(number).copied().unwrap_or_default(),
        };
        let kept = |ring: &Vec<u32>| -> Vec<Corner> {
            let turning = ring
                .iter()
                .filter(|&&number| turns.contains(&(solid, number)));
            turning.map(corner).collect()
        };
        found.push(Sheet {
            rings: one.rings.iter().map(kept).collect(),
            group: sheets[one.first].group,
            solid,
        });
    }
    found
}

/// A face of point numbers, made of one or more sheets.
struct Whole {
    first: usize,
    rings: Vec<Vec<u32>>,
    uv: HashMap<u32, [f64; 2]>,
}

type Numbered = (u32, [f64; 2]);

/// The rings of all sheets, over the numbers of their places.
struct Faces {
    rings: Vec<Vec<Vec<Numbered>>>,
}

impl Faces {
    fn new(sheets: &[Sheet], numbers: &[u32]) -> Self {
        let mut at = numbers.iter();
        let mut rings = Vec::with_capacity(sheets.len());
        for sheet in sheets {
            let mut own = Vec::with_capacity(sheet.rings.len());
            for ring in &sheet.rings {
                let each = ring.iter().zip(at.by_ref());
                let mut numbered: Vec<Numbered> = each.map(|(c, &n)| (n, c.uv)).collect();
                numbered.dedup_by_key(|corner| corner.0);
                while numbered.len() > 1
                    && numbered.first().map(|c| c.0) == numbered.last().map(|c| c.0)
                {
                    numbered.pop();
                }
                own.push(numbered);
            }
            own.retain(|ring| ring.len() >= 3);
            rings.push(own);
        }
        Self { rings }
    }

    /// Puts the corners of each of these sheets into the edges of the others that they lie on.
    fn put_corners_in(&mut self, members: &[usize], places: &[DVec3], near: f64) {
        let all = members
            .iter()
            .flat_map(|&index| self.rings[index].iter().flatten());
        let known = PointsNear::new(unique(all.map(|corner| corner.0)), places);
        for &index in members {
            for ring in &mut self.rings[index] {
                let mut longer = Vec::with_capacity(ring.len());
                for (k, &from) in ring.iter().enumerate() {
                    let to = ring[(k + 1) % ring.len()];
                    longer.push(from);
                    for (share, number) in known.between(from.0, to.0, near) {
                        let uv = [0, 1].map(|c| from.1[c] + share * (to.1[c] - from.1[c]));
                        longer.push((number, uv));
                    }
                }
                *ring = longer;
            }
        }
    }

    /// Sheets that may become one: of one group, in one plane, with an edge in common over which
    /// the texture goes on.
    fn together(&self, sheets: &[Sheet], places: &[DVec3]) -> Vec<Vec<usize>> {
        let normals: Vec<DVec3> = self
            .rings
            .iter()
            .map(|rings| area(rings, places).normalize_or_zero())
            .collect();
        let mut at_edge: Vec<([u32; 4], AtEdge)> = Vec::new();
        for (index, sheet) in sheets.iter().enumerate() {
            for ring in &self.rings[index] {
                for (k, &a) in ring.iter().enumerate() {
                    let b = ring[(k + 1) % ring.len()];
                    let (low, high) = if a.0 < b.0 { (a, b) } else { (b, a) };
                    let key = [sheet.solid, sheet.group, low.0, high.0];
                    at_edge.push((key, (index, low.1, high.1)));
                }
            }
        }
        at_edge.sort_unstable_by_key(|(key, (index, ..))| (*key, *index));
        let mut root: Vec<usize> = (0..sheets.len()).collect();
        for same in at_edge.chunk_by(|one, other| one.0 == other.0) {
            for (k, (_, here)) in same.iter().enumerate() {
                for (_, other) in &same[..k] {
                    let in_plane = normals[here.0].dot(normals[other.0]).abs() >= 1.0 - PARALLEL;
                    if in_plane && is_same(here.1, other.1) && is_same(here.2, other.2) {
                        let (a, b) = (find(&mut root, here.0), find(&mut root, other.0));
                        root[a.max(b)] = a.min(b);
                    }
                }
            }
        }
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); sheets.len()];
        for index in 0..sheets.len() {
            groups[find(&mut root, index)].push(index);
        }
        groups.retain(|group| !group.is_empty());
        groups
    }

    /// Some sheets of one plane as the faces that they make together; as they are where that fails.
    fn as_one(&self, members: &[usize], places: &[DVec3]) -> Vec<Whole> {
        if members.len() < 2 {
            return self.as_they_are(members);
        }
        let mut uv = HashMap::default();
        let mut count: HashMap<(u32, u32), i32> = HashMap::default();
        let mut order = Vec::new();
        for ring in members.iter().flat_map(|&index| &self.rings[index]) {
            for (k, &(a, at)) in ring.iter().enumerate() {
                let b = ring[(k + 1) % ring.len()].0;
                uv.entry(a).or_insert(at);
                order.push((a, b));
                *count.entry((a, b)).or_insert(0) += 1;
                *count.entry((b, a)).or_insert(0) -= 1;
            }
        }
        let mut edges = Vec::new();
        for edge in order {
            if let Some(left) = count.get_mut(&edge) {
                if *left > 0 {
                    *left -= 1;
                    edges.push(edge);
                }
            }
        }
        let sum: DVec3 = members
            .iter()
            .map(|&index| area(&self.rings[index], places))
            .sum();
        let faces = nested(places, traced(places, &edges, sum), sum);
        let found: DVec3 = faces
            .iter()
            .flatten()
            .map(|ring| ring_area(ring, places))
            .sum();
        if found.distance(sum) <= LOST_AREA * sum.length().max(1e-6) {
            let first = members[0];
            return faces
                .into_iter()
                .map(|rings| Whole {
                    first,
                    rings,
                    uv: uv.clone(),
                })
                .collect();
        }
        self.as_they_are(members)
    }

    fn as_they_are(&self, members: &[usize]) -> Vec<Whole> {
        let alone = |&index: &usize| Whole {
            first: index,
            rings: self.rings[index]
                .iter()
                .map(|ring| ring.iter().map(|corner| corner.0).collect())
                .collect(),
            uv: self.rings[index].iter().flatten().copied().collect(),
        };
        members
            .iter()
            .map(alone)
            .filter(|one| !one.rings.is_empty())
            .collect()
    }
}

/// A sheet at an edge, with its texture coordinates at both ends.
type AtEdge = (usize, [f64; 2], [f64; 2]);

/// The corners, by solid and number, at which some face turns.
fn turning(whole: &[Whole], places: &[DVec3], sheets: &[Sheet]) -> HashSet<(u32, u32)> {
    let mut found = HashSet::default();
    for one in whole {
        for ring in &one.rings {
            for (k, &number) in ring.iter().enumerate() {
                let at = |step: usize| places[ring[(k + step) % ring.len()] as usize];
                let here = places[number as usize];
                let (to, from) = (at(1) - here, here - at(ring.len() - 1));
                let turn = from.cross(to).length();
                if turn > STRAIGHT * from.length() * to.length() || from.dot(to) < 0.0 {
                    found.insert((sheets[one.first].solid, number));
                }
            }
        }
    }
    found
}

fn corners(sheets: &[Sheet]) -> impl Iterator<Item = &Corner> {
    sheets.iter().flat_map(|sheet| sheet.rings.iter().flatten())
}

fn unique(numbers: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut all: Vec<u32> = numbers.collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn find(root: &mut [usize], mut at: usize) -> usize {
    while root[at] != at {
        root[at] = root[root[at]];
        at = root[at];
    }
    at
}

fn is_same(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).abs() <= SAME_UV && (a[1] - b[1]).abs() <= SAME_UV
}

fn area(rings: &[Vec<Numbered>], places: &[DVec3]) -> DVec3 {
    let numbers = |ring: &Vec<Numbered>| ring.iter().map(|corner| corner.0).collect::<Vec<_>>();
    rings
        .iter()
        .map(|ring| ring_area(&numbers(ring), places))
        .sum()
}

fn ring_area(ring: &[u32], places: &[DVec3]) -> DVec3 {
    let first = places[ring[0] as usize];
    let away = |k: usize| places[ring[k] as usize] - first;
    (1..ring.len().saturating_sub(1))
        .map(|k| 0.5 * away(k).cross(away(k + 1)))
        .sum()
}
