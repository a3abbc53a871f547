//! Against all labellings of small grids; on chains the solver is exact.

#![allow(clippy::unwrap_used)] // tests

use proptest::prelude::*;
use veduta_texture::{label, Grid, LabelError, Seam};

const SEAM: Seam = Seam {
    base: 0.2,
    slope: 1.5,
    most: 1.2,
};

fn least_of_all(grid: &Grid<'_>) -> f64 {
    let (cells, labels) = (grid.cells() as u32, grid.labels);
    let mut least = f64::INFINITY;
    for number in 0..labels.pow(cells) {
        let labelling: Vec<u32> = (0..cells)
            .map(|cell| (number / labels.pow(cell) % labels) as u32)
            .collect();
        least = least.min(grid.energy(&labelling));
    }
    least
}

fn drawn(size: (usize, usize, usize)) -> impl Strategy<Value = (Vec<f32>, Vec<f32>)> {
    let count = size.0 * size.1 * size.2;
    (
        prop::collection::vec(0.0f32..1.0, count),
        prop::collection::vec(
            prop_oneof![9 => 0.0f32..1.0, 1 => Just(f32::NAN)],
            3 * count,
        ),
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_chain_is_solved_exactly((costs, colours) in drawn((1, 8, 3))) {
        let grid = Grid::new((1, 8, 3), &costs, &colours, SEAM).unwrap();
        let found = grid.energy(&label(&grid, 3));
        prop_assert!(found <= least_of_all(&grid) + 1e-4);
    }

    #[test]
    fn a_small_grid_comes_near_the_best((costs, colours) in drawn((3, 3, 3))) {
        let grid = Grid::new((3, 3, 3), &costs, &colours, SEAM).unwrap();
        let found = grid.energy(&label(&grid, 20));
        prop_assert!(found <= 1.1 * least_of_all(&grid) + 1e-4);
    }
}

#[test]
fn one_label_leaves_no_choice() {
    let grid = Grid::new((2, 2, 1), &[1.0; 4], &[0.0; 12], SEAM).unwrap();
    assert_eq!(label(&grid, 5), vec![0; 4]);
}

#[test]
fn wrong_columns_are_refused() {
    let short = Grid::new((2, 2, 2), &[1.0; 4], &[0.0; 24], SEAM);
    assert!(matches!(short.err(), Some(LabelError::Costs { .. })));
    let grey = Grid::new((2, 2, 1), &[1.0; 4], &[0.0; 4], SEAM);
    assert!(matches!(grey.err(), Some(LabelError::Colours { .. })));
    let nan = Grid::new((1, 1, 1), &[f32::NAN], &[0.0; 3], SEAM);
    assert_eq!(nan.err(), Some(LabelError::NotANumber));
}
