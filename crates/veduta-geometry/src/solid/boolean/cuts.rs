//! Where the faces of two meshes meet: segments in each face, divided at common points.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::super::mesh::Mesh;
use super::super::weld::Places;
use super::flat::{distance, Polygon};
use super::{extent, MOST_PAIRS};
use crate::{Budget, Spent};

pub type Segment = (u32, u32);

/// What a corner of two faces that may meet costs, in steps of the budget.
const STEPS_PER_CORNER: usize = 4;

/// The faces of two meshes over common points, and the segments that divide each.
pub struct Cuts {
    pub points: Vec<DVec3>,
    pub polygons: [Vec<Polygon>; 2],
    /// For each face of each mesh the segments in it, those of its rings first.
    pub segments: [Vec<Vec<Segment>>; 2],
    /// For each face the faces of the other mesh in its plane.
    pub level: [Vec<Vec<usize>>; 2],
    /// The points between the ends of a segment, in order from its lower number.
    pub between: HashMap<Segment, Vec<u32>>,
    pub near: f64,
    places: Places,
}

impl Cuts {
    /// `share` of the extent of both is how far places may lie apart and still be one.
    pub fn new(a: &Mesh, b: &Mesh, share: f64) -> Self {
        let near = share * extent(a, b);
        let mut cuts = Self {
            points: Vec::new(),
            polygons: [Vec::new(), Vec::new()],
            segments: [Vec::new(), Vec::new()],
            level: [Vec::new(), Vec::new()],
            between: HashMap::new(),
            near,
            places: Places::new(near),
        };
        for (which, mesh) in [a, b].into_iter().enumerate() {
            cuts.take(which, mesh);
        }
        cuts
    }

    fn take(&mut self, which: usize, mesh: &Mesh) {
        let numbers: Vec<u32> = mesh.points.iter().map(|&point| self.point(point)).collect();
        for face in mesh.faces() {
            let mut rings: Vec<Vec<u32>> = Vec::new();
            for ring in face.rings() {
                let mut own: Vec<u32> = ring.iter().map(|&p| numbers[p as usize]).collect();
                own.dedup();
                while own.len() > 1 && own.first() == own.last() {
                    own.pop();
                }
                if own.len() >= 3 {
                    rings.push(own);
                }
            }
            if let Some(polygon) = Polygon::new(&self.points, rings) {
                self.segments[which].push(polygon.edges().collect());
                self.polygons[which].push(polygon);
                self.level[which].push(Vec::new());
            }
        }
    }

    /// The number of a place: that of a point which is there already, or a new one.
    fn point(&mut self, place: DVec3) -> u32 {
        let new = self.points.len() as u32;
        let number = self.places.number(place, new);
        if number == new {
            self.points.push(place);
        }
        number
    }

    /// Finds the segments along which faces of the two meshes meet.
    pub fn meet(&mut self, budget: &dyn Budget) -> Result<(), Spent> {
        for f in 0..self.polygons[0].len() {
            budget.take(self.polygons[1].len())?;
            for g in 0..self.polygons[1].len() {
                let (one, other) = (&self.polygons[0][f], &self.polygons[1][g]);
                let apart = one.low.cmpgt(other.high + self.near).any()
                    || other.low.cmpgt(one.high + self.near).any();
                if !apart {
                    self.meet_pair(f, g, budget)?;
                }
            }
        }
        Ok(())
    }

    fn meet_pair(&mut self, f: usize, g: usize, budget: &dyn Budget) -> Result<(), Spent> {
        let (one, other) = (&self.polygons[0][f], &self.polygons[1][g]);
        let corners = one.corner_count() + other.corner_count();
        budget.take(STEPS_PER_CORNER * corners)?;
        let (mut places, mut is_level) = (Vec::new(), [false; 2]);
        for (side, (polygon, plane)) in [(one, other), (other, one)].into_iter().enumerate() {
            let (crossed, level) = self.crossed(polygon, plane);
            is_level[side] = level;
            places.extend(crossed);
        }
        // Of a narrow face the plane is not known well: one of the two in the other suffices.
        if is_level.contains(&true) {
            let (own, others): (Vec<Segment>, Vec<Segment>) =
                (one.edges().collect(), other.edges().collect());
            self.segments[0][f].extend(others);
            self.segments[1][g].extend(own);
            self.level[0][f].push(g);
            self.level[1][g].push(f);
            return Ok(());
        }
        let along = one.normal().cross(other.normal());
        let mut stops: Vec<u32> = places.into_iter().map(|place| self.point(place)).collect();
        let at = |number: &u32| self.points[*number as usize].dot(along);
        stops.sort_by(|a, b| at(a).total_cmp(&at(b)).then(a.cmp(b)));
        stops.dedup();
        let (one, other) = (&self.polygons[0][f], &self.polygons[1][g]);
        budget.take(stops.len() * corners)?;
        for pair in stops.windows(2) {
            let ends = pair_of(pair);
            let middle = 0.5 * (self.points[ends.0 as usize] + self.points[ends.1 as usize]);
            if one.holds(middle, self.near) && other.holds(middle, self.near) {
                self.segments[0][f].push(ends);
                self.segments[1][g].push(ends);
            }
        }
        Ok(())
    }

    /// Where the rings of a polygon meet a plane, and whether it lies in the plane.
    fn crossed(&self, polygon: &Polygon, plane: &Polygon) -> (Vec<DVec3>, bool) {
        let height = |point: u32| {
            let above = plane.above(self.points[point as usize]);
            if above.abs() <= self.near {
                0.0
            } else {
                above
            }
        };
        let mut found = Vec::new();
        let mut is_level = true;
        for (from, to) in polygon.edges() {
            // From the lower number on, so that both faces at an edge find the same place.
            let (from, to) = (from.min(to), from.max(to));
            let (a, b) = (height(from), height(to));
            let (p, q) = (self.points[from as usize], self.points[to as usize]);
            is_level &= a == 0.0 && b == 0.0;
            if a == 0.0 {
                found.push(p);
            }
            if b == 0.0 {
                found.push(q);
            }
            if a * b < 0.0 {
                found.push(p + (q - p) * (a / (a - b)));
            }
        }
        (found, is_level)
    }

    /// Divides all segments at the points that lie on them and where they cross; false where that
    /// is too much work.
    pub fn divide(&mut self, budget: &dyn Budget) -> Result<bool, Spent> {
        let mut on: HashMap<Segment, Vec<u32>> = HashMap::new();
        for which in 0..2 {
            for face in 0..self.polygons[which].len() {
                let segments = &mut self.segments[which][face];
                for segment in segments.iter_mut() {
                    *segment = (segment.0.min(segment.1), segment.0.max(segment.1));
                }
                segments.sort_unstable();
                segments.dedup();
                if segments.len().saturating_mul(segments.len()) > MOST_PAIRS {
                    return Ok(false);
                }
                self.divide_in(which, face, &mut on, budget)?;
            }
        }
        for (&(from, to), numbers) in &mut on {
            let (start, end) = (self.points[from as usize], self.points[to as usize]);
            let share = |number: &u32| (self.points[*number as usize] - start).dot(end - start);
            numbers.sort_by(|a, b| share(a).total_cmp(&share(b)).then(a.cmp(b)));
            numbers.dedup();
            numbers.retain(|&number| number != from && number != to);
        }
        self.between = on;
        Ok(true)
    }

    fn divide_in(
        &mut self,
        which: usize,
        face: usize,
        on: &mut HashMap<Segment, Vec<u32>>,
        budget: &dyn Budget,
    ) -> Result<(), Spent> {
        let segments = self.segments[which][face].clone();
        let polygon = &self.polygons[which][face];
        let mut corners: Vec<u32> = segments.iter().flat_map(|&(a, b)| [a, b]).collect();
        corners.sort_unstable();
        corners.dedup();
        let flat = |number: u32| polygon.flat(self.points[number as usize]);
        let corners: Vec<(u32, DVec2)> = corners.into_iter().map(|c| (c, flat(c))).collect();
        let ends: Vec<[DVec2; 2]> = segments.iter().map(|&(a, b)| [flat(a), flat(b)]).collect();
        for (segment, [from, to]) in segments.iter().zip(&ends) {
            budget.take(corners.len())?;
            let (low, high) = (from.min(*to) - self.near, from.max(*to) + self.near);
            for (number, place) in &corners {
                let beside = place.cmplt(low).any() || place.cmpgt(high).any();
                if !beside && distance(*place, *from, *to) <= self.near {
                    on.entry(*segment).or_default().push(*number);
                }
            }
        }
        let mut crossings = Vec::new();
        for (k, &one) in segments.iter().enumerate() {
            budget.take(segments.len() - k)?;
            for (j, &other) in segments.iter().enumerate().skip(k + 1) {
                if let Some(place) = crossing(ends[k], ends[j], self.near) {
                    crossings.push((one, other, polygon.place(place)));
                }
            }
        }
        for (one, other, place) in crossings {
            let number = self.point(place);
            on.entry(one).or_default().push(number);
            on.entry(other).or_default().push(number);
        }
        Ok(())
    }
}

fn pair_of(pair: &[u32]) -> Segment {
    (pair[0].min(pair[1]), pair[0].max(pair[1]))
}

/// Where two segments cross away from their ends. Those that touch with an end, or run along each
/// other, are divided there already.
fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2], near: f64) -> Option<DVec2> {
    let apart = a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any();
    let touch = || {
        let ends = [
            distance(a, c, d),
            distance(b, c, d),
            distance(c, a, b),
            distance(d, a, b),
        ];
        ends.into_iter().any(|far| far <= near)
    };
    if apart || touch() {
        return None;
    }
    let (along, other) = (b - a, d - c);
    let across = along.perp_dot(other);
    let share = (c - a).perp_dot(other) / across;
    let share_other = (c - a).perp_dot(along) / across;
    let inside = (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&share_other);
    inside.then(|| a + along * share)
}
