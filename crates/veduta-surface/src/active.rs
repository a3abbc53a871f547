//! The cells that the surface crosses, layer by layer.

use rayon::prelude::*;

use crate::cell::{doubled, sheets, Sheets};
use crate::samples::Samples;

/// A cell with samples on both sides. The grid is padded by one sample all around.
#[derive(Debug, Clone, Copy)]
pub struct Active {
    pub z: u32,
    /// Its first vertex within the layer, one for each sheet.
    pub first: u32,
    pub case: u8,
    /// The faces whose corners are joined the other way.
    pub flips: u8,
    pub values: [f32; 8],
}

/// The active cells of one x, row by row.
#[derive(Debug, Default)]
pub struct Layer {
    /// Where the cells of each y begin, one more than there are rows.
    pub rows: Vec<u32>,
    pub cells: Vec<Active>,
    pub vertices: u32,
}

impl Layer {
    pub fn row(&self, y: usize) -> &[Active] {
        &self.cells[self.rows[y] as usize..self.rows[y + 1] as usize]
    }

    pub fn find(&self, y: usize, z: usize) -> Option<&Active> {
        let row = self.row(y);
        let at = row.binary_search_by_key(&(z as u32), |cell| cell.z).ok()?;
        row.get(at)
    }
}

/// The sheets of each case, no face flipped.
pub struct Cases {
    plain: Vec<Sheets>,
}

impl Cases {
    pub fn new() -> Self {
        let plain = (0..=255).map(|case| sheets(case, 0)).collect();
        Self { plain }
    }

    pub fn of(&self, cell: &Active) -> Sheets {
        match cell.flips {
            0 => self.plain[cell.case as usize],
            flips => sheets(cell.case, flips),
        }
    }
}

/// One padded layer of samples: the value beyond the border is `beyond`.
fn padded(samples: &impl Samples, x: usize, beyond: f32, scratch: &mut [f32], into: &mut [f32]) {
    let [nx, ny, nz] = samples.size();
    into.fill(beyond);
    if x == 0 || x > nx {
        return;
    }
    samples.layer(x - 1, scratch);
    for y in 0..ny {
        into[(y + 1) * (nz + 2) + 1..][..nz].copy_from_slice(&scratch[y * nz..][..nz]);
    }
}

fn scan(samples: &impl Samples, level: f32, beyond: f32, x: usize) -> Layer {
    let [_, ny, nz] = samples.size();
    let (width, mut scratch) = (nz + 2, vec![0.0; ny * nz]);
    let [mut near, mut far] = [0, 1].map(|_| vec![0.0_f32; (ny + 2) * width]);
    padded(samples, x, beyond, &mut scratch, &mut near);
    padded(samples, x + 1, beyond, &mut scratch, &mut far);
    let mut layer = Layer::default();
    for y in 0..=ny {
        layer.rows.push(layer.cells.len() as u32);
        let rows = [
            &near[y * width..][..width],
            &far[y * width..][..width],
            &near[(y + 1) * width..][..width],
            &far[(y + 1) * width..][..width],
        ];
        scan_row(rows, level, &mut layer.cells);
    }
    layer.rows.push(layer.cells.len() as u32);
    layer
}

fn scan_row(rows: [&[f32]; 4], level: f32, cells: &mut Vec<Active>) {
    let bits = |z: usize| {
        let below = |n: usize| u8::from(rows[n][z] < level) << n;
        below(0) | below(1) | below(2) | below(3)
    };
    let mut lower = bits(0);
    for z in 0..rows[0].len() - 1 {
        let upper = bits(z + 1);
        let case = lower | upper << 4;
        lower = upper;
        if case == 0 || case == 255 {
            continue;
        }
        let values: [f32; 8] = std::array::from_fn(|corner| rows[corner & 3][z + (corner >> 2)]);
        if values.iter().any(|value| value.is_nan()) {
            continue;
        }
        cells.push(Active {
            z: z as u32,
            first: 0,
            case,
            flips: 0,
            values,
        });
    }
}

/// The layers of cells; cell (x, y, z) lies between the samples (x - 1, y - 1, z - 1) and (x, y, z).
pub fn layers(samples: &impl Samples, level: f32, beyond: f32, cases: &Cases) -> Vec<Layer> {
    let [nx, _, _] = samples.size();
    let found = (0..=nx).into_par_iter();
    let mut found: Vec<Layer> = found.map(|x| scan(samples, level, beyond, x)).collect();
    let twice: Vec<u8> = (0..=255).map(doubled).collect();
    let flips: Vec<Vec<(usize, u8)>> = (0..found.len())
        .into_par_iter()
        .map(|x| flipped(&found, x, &twice))
        .collect();
    found
        .par_iter_mut()
        .zip(flips)
        .for_each(|(layer, flips)| number(layer, &flips, cases));
    found
}

/// The cells of a layer that join a face twice as their neighbours across it do.
fn flipped(layers: &[Layer], x: usize, twice: &[u8]) -> Vec<(usize, u8)> {
    let mut found = Vec::new();
    let layer = &layers[x];
    for y in 0..layer.rows.len() - 1 {
        for (at, cell) in layer.row(y).iter().enumerate() {
            let faces = twice[cell.case as usize];
            if faces == 0 {
                continue;
            }
            let face = faces.trailing_zeros() as usize;
            let mut place = [x, y, cell.z as usize];
            // Samples on the border are all on one side: a face with both has cells on both sides.
            place[face / 2] =
                place[face / 2].wrapping_add_signed(if face & 1 == 1 { 1 } else { -1 });
            let other = layers
                .get(place[0])
                .and_then(|one| one.find(place[1], place[2]));
            if other.is_some_and(|one| twice[one.case as usize] == 1 << (face ^ 1)) {
                found.push((layer.rows[y] as usize + at, faces));
            }
        }
    }
    found
}

fn number(layer: &mut Layer, flips: &[(usize, u8)], cases: &Cases) {
    for &(at, faces) in flips {
        layer.cells[at].flips = faces;
    }
    let mut next = 0;
    for cell in &mut layer.cells {
        cell.first = next;
        next += u32::from(cases.of(cell).count);
    }
    layer.vertices = next;
}
