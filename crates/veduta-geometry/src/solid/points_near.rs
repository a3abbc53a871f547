//! Points by where they are: which of them lie on an edge.

use glam::DVec3;

/// Cells are halved no more often than this.
const MOST_HALVINGS: usize = 20;
/// Cells for each point.
const CELLS: usize = 4;

/// Points in the cells of a grid over them.
pub(super) struct PointsNear<'a> {
    places: &'a [DVec3],
    low: DVec3,
    size: f64,
    counts: [usize; 3],
    /// The first point of each cell, with the end.
    first: Vec<u32>,
    numbers: Vec<u32>,
}

impl<'a> PointsNear<'a> {
    /// Those of some numbers among places.
    pub fn new(numbers: Vec<u32>, places: &'a [DVec3]) -> Self {
        let own = || numbers.iter().map(|&number| places[number as usize]);
        let low = own().fold(DVec3::INFINITY, DVec3::min);
        let extent = own().fold(DVec3::NEG_INFINITY, DVec3::max) - low;
        let mut size = extent.max_element().max(f64::MIN_POSITIVE);
        for _ in 0..MOST_HALVINGS {
            let finer = cells(extent, size / 2.0).iter().product::<usize>();
            if finer > CELLS * numbers.len() {
                break;
            }
            size /= 2.0;
        }
        let counts = cells(extent, size);
        let mut found = Self {
            places,
            low,
            size,
            counts,
            first: vec![0; counts.iter().product::<usize>() + 1],
            numbers: Vec::new(),
        };
        let cell_of = |number: u32| found.index(found.cell(places[number as usize]));
        let mut by_cell: Vec<(usize, u32)> = numbers.iter().map(|&n| (cell_of(n), n)).collect();
        by_cell.sort_unstable();
        for (cell, _) in &by_cell {
            found.first[cell + 1] += 1;
        }
        for cell in 1..found.first.len() {
            found.first[cell] += found.first[cell - 1];
        }
        found.numbers = by_cell.into_iter().map(|(_, number)| number).collect();
        found
    }

    /// The points on the edge between two places, no farther off it than `near`, with their share of
    /// the way, in order; not its ends.
    pub fn between(&self, from: u32, to: u32, near: f64) -> Vec<(f64, u32)> {
        let (a, b) = (self.places[from as usize], self.places[to as usize]);
        let along = b - a;
        let length = along.length();
        let mut found = Vec::new();
        let pieces = (length / self.size).ceil().max(1.0);
        for piece in 0..pieces as usize {
            let at = |k: usize| a + along * (k as f64 / pieces);
            for number in self.around(at(piece), at(piece + 1), near) {
                let away = self.places[number as usize] - a;
                let share = away.dot(along) / (length * length);
                let is_inside = share * length > near && (1.0 - share) * length > near;
                if is_inside
                    && number != from
                    && number != to
                    && (away - share * along).length() <= near
                {
                    found.push((share, number));
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.dedup();
        found
    }

    /// The points in the cells of a box between two places.
    fn around(&self, a: DVec3, b: DVec3, near: f64) -> impl Iterator<Item = u32> + '_ {
        let (low, high) = (self.cell(a.min(b) - near), self.cell(a.max(b) + near));
        let rows = (low[2]..=high[2]).flat_map(move |z| (low[1]..=high[1]).map(move |y| [y, z]));
        rows.flat_map(move |[y, z]| {
            let first = self.first[self.index([low[0], y, z])] as usize;
            let end = self.first[self.index([high[0], y, z]) + 1] as usize;
            self.numbers[first..end].iter().copied()
        })
    }

    fn cell(&self, place: DVec3) -> [usize; 3] {
        let steps = ((place - self.low) / self.size).to_array();
        std::array::from_fn(|axis| (steps[axis].max(0.0) as usize).min(self.counts[axis] - 1))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.counts[0] * (y + self.counts[1] * z)
    }
}

fn cells(extent: DVec3, size: f64) -> [usize; 3] {
    // As many as anybody has; what is no number counts as none.
    extent
        .to_array()
        .map(|length| ((length / size) as usize).min(1 << 20) + 1)
}
