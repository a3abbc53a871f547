//! The skyline: one label (a row) per image column, smooth from column to column.

use crate::error::{expect_len, ChainError};

/// Finds the labels `y_x` that minimise
/// `sum_x unary[y_x, x] + sum_x min(slope * |y_x - y_{x+1}|, jump)`, exactly.
///
/// `unary` is row major, `rows` by `columns`. The lower envelope of the pairwise term takes linear
/// time per column (Felzenszwalb and Huttenlocher 2012, section 3.3).
pub fn solve(
    unary: &[f32],
    rows: usize,
    columns: usize,
    slope: f32,
    jump: f32,
) -> Result<Vec<usize>, ChainError> {
    expect_len("unary", unary.len(), rows * columns)?;
    if rows == 0 || columns == 0 {
        return Err(ChainError::Labels { name: "unary" });
    }
    let mut cost: Vec<f64> = (0..rows).map(|y| f64::from(unary[y * columns])).collect();
    let mut from = vec![0u32; rows * columns];
    for x in 1..columns {
        let (message, argument) = envelope(&cost, f64::from(slope), f64::from(jump));
        for y in 0..rows {
            cost[y] = message[y] + f64::from(unary[y * columns + x]);
            from[y * columns + x] = argument[y];
        }
    }
    let mut labels = vec![0usize; columns];
    labels[columns - 1] = smallest(&cost);
    for x in (1..columns).rev() {
        labels[x - 1] = from[labels[x] * columns + x] as usize;
    }
    Ok(labels)
}

fn smallest(values: &[f64]) -> usize {
    let mut best = 0;
    for (i, v) in values.iter().enumerate() {
        if *v < values[best] {
            best = i;
        }
    }
    best
}

/// Distance transform under a truncated linear distance, with its arguments.
fn envelope(cost: &[f64], slope: f64, jump: f64) -> (Vec<f64>, Vec<u32>) {
    let mut message = cost.to_vec();
    let mut argument: Vec<u32> = (0..cost.len() as u32).collect();
    for y in 1..cost.len() {
        if message[y - 1] + slope < message[y] {
            message[y] = message[y - 1] + slope;
            argument[y] = argument[y - 1];
        }
    }
    for y in (0..cost.len().saturating_sub(1)).rev() {
        if message[y + 1] + slope < message[y] {
            message[y] = message[y + 1] + slope;
            argument[y] = argument[y + 1];
        }
    }
    let best = smallest(cost);
    let far = cost[best] + jump;
    for y in 0..cost.len() {
        if far < message[y] {
            message[y] = far;
            argument[y] = best as u32;
        }
    }
    (message, argument)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn energy(unary: &[f32], columns: usize, slope: f32, jump: f32, labels: &[usize]) -> f64 {
        let mut total = 0.0;
        for (x, y) in labels.iter().enumerate() {
            total += f64::from(unary[y * columns + x]);
            if x > 0 {
                let step = (*y as f64 - labels[x - 1] as f64).abs();
                total += (f64::from(slope) * step).min(f64::from(jump));
            }
        }
        total
    }

    proptest! {
        #[test]
        fn equals_exhaustive_search(unary in proptest::collection::vec(-4.0f32..4.0, 4 * 5),
                                    slope in 0.0f32..2.0, jump in 0.0f32..4.0) {
            let (rows, columns) = (4, 5);
            let got = solve(&unary, rows, columns, slope, jump).unwrap();
            let mut best = f64::INFINITY;
            for code in 0..rows.pow(columns as u32) {
                let labels: Vec<usize> =
                    (0..columns).map(|x| code / rows.pow(x as u32) % rows).collect();
                best = best.min(energy(&unary, columns, slope, jump, &labels));
            }
            prop_assert!((energy(&unary, columns, slope, jump, &got) - best).abs() < 1e-5);
        }
    }

    #[test]
    fn refuses_a_wrong_size() {
        let refused = solve(&[0.0; 5], 2, 3, 1.0, 1.0);
        assert_eq!(
            refused,
            Err(ChainError::Size {
                name: "unary",
                got: 5,
                expected: 6
            })
        );
    }
}
