//! The cells of a face, what each photo costs there, and what a seam costs.

use crate::error::LabelError;

/// What a seam costs: `base` for its length, and `slope` times the disagreement of both photos on
/// its two sides, at most `most` in all. Where one of them does not see a side it is `most`.
#[derive(Clone, Copy, Debug)]
pub struct Seam {
    pub base: f32,
    pub slope: f32,
    pub most: f32,
}

/// Cells row by row; of each cell a cost per label and a colour (three channels) per label.
///
/// A colour that is not a number says that the photo does not see the cell.
pub struct Grid<'a> {
    pub rows: usize,
    pub columns: usize,
    pub labels: usize,
    costs: &'a [f32],
    disagreements: Vec<f32>,
    seam: Seam,
}

impl<'a> Grid<'a> {
    /// A grid whose columns have the right lengths and whose costs are numbers.
    pub fn new(
        (rows, columns, labels): (usize, usize, usize),
        costs: &'a [f32],
        colours: &'a [f32],
        seam: Seam,
    ) -> Result<Self, LabelError> {
        let wanted = rows * columns * labels;
        if costs.len() != wanted {
            return Err(LabelError::Costs {
                given: costs.len(),
                rows,
                columns,
                labels,
            });
        }
        if colours.len() != 3 * wanted {
            return Err(LabelError::Colours {
                given: colours.len(),
                wanted: 3 * wanted,
            });
        }
        if costs.iter().any(|cost| !cost.is_finite()) {
            return Err(LabelError::NotANumber);
        }
        Ok(Self {
            rows,
            columns,
            labels,
            costs,
            disagreements: disagreements(colours, labels),
            seam,
        })
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.rows * self.columns
    }

    /// What the labels cost at a cell.
    pub fn costs_at(&self, cell: usize) -> &[f32] {
        &self.costs[cell * self.labels..(cell + 1) * self.labels]
    }

    /// The neighbours of a cell: above, left, right, below; the first two come before it.
    pub fn neighbours(&self, cell: usize) -> [Option<usize>; 4] {
        let (row, column) = (cell / self.columns, cell % self.columns);
        [
            (row > 0).then(|| cell - self.columns),
            (column > 0).then(|| cell - 1),
            (column + 1 < self.columns).then(|| cell + 1),
            (row + 1 < self.rows).then(|| cell + self.columns),
        ]
    }

    /// How far two photos disagree at a cell; not a number where one is blind.
    fn disagreement(&self, cell: usize, labels: (usize, usize)) -> f32 {
        self.disagreements[(cell * self.labels + labels.0) * self.labels + labels.1]
    }

    /// What it costs that one of two neighbours has this label and the other that one.
    pub fn seam(&self, cells: (usize, usize), labels: (usize, usize)) -> f32 {
        if labels.0 == labels.1 {
            return 0.0;
        }
        let Seam { base, slope, most } = self.seam;
        let sum = self.disagreement(cells.0, labels) + self.disagreement(cells.1, labels);
        // The smaller of a number and what is none is the number.
        (base + slope * sum).min(most)
    }

    /// What a whole labelling costs.
    pub fn energy(&self, labelling: &[u32]) -> f64 {
        let mut sum = 0.0;
        for cell in 0..self.cells() {
            let own = labelling[cell] as usize;
            sum += f64::from(self.costs_at(cell)[own]);
            for next in self.neighbours(cell)[2..].iter().flatten() {
                sum += f64::from(self.seam((cell, *next), (own, labelling[*next] as usize)));
            }
        }
        sum
    }
}

/// Of each cell, how far each two photos disagree: the mean over the channels.
fn disagreements(colours: &[f32], labels: usize) -> Vec<f32> {
    let mut found = Vec::with_capacity(colours.len() / 3 * labels);
    for cell in colours.chunks_exact(3 * labels.max(1)) {
        for first in cell.chunks_exact(3) {
            for second in cell.chunks_exact(3) {
                let sum: f32 = (first.iter().zip(second)).map(|(a, b)| (a - b).abs()).sum();
                found.push(sum / 3.0);
            }
        }
    }
    found
}
