//! Running sums along the diagonals of a distance matrix: the similarity of two stretches of rows
//! (or columns) in constant time, whatever their length.

use crate::error::{expect_len, ChainError};

/// Sums of `distance[i, i + k]` along diagonals: compares a stretch with one `k` further on.
pub struct DiagonalSums {
    size: usize,
    sums: Vec<f64>,
}

impl DiagonalSums {
    /// From a symmetric `size` by `size` row major matrix, for offsets `0..=max_offset`.
    pub fn new(distance: &[f32], size: usize, max_offset: usize) -> Result<Self, ChainError> {
        expect_len("distance", distance.len(), size * size)?;
        let width = size + 1;
        let mut sums = vec![0.0; (max_offset + 1) * width];
        for k in 0..=max_offset {
            let line = &mut sums[k * width..(k + 1) * width];
            for i in 0..size {
                let value = if i + k < size {
                    f64::from(distance[i * size + i + k])
                } else {
                    0.0
                };
                line[i + 1] = line[i] + value;
            }
        }
        Ok(Self { size, sums })
    }

    /// Mean of `distance[start + j, start + offset + j]` over `0 <= j < length`.
    pub fn mean(&self, start: usize, offset: usize, length: usize) -> f64 {
        let line = offset * (self.size + 1);
        (self.sums[line + start + length] - self.sums[line + start]) / length as f64
    }
}

/// Sums along the other diagonals: compares a stretch with its mirror image.
pub struct MirrorSums {
    size: usize,
    sums: Vec<f64>,
}

impl MirrorSums {
    /// From a symmetric `size` by `size` row major matrix.
    pub fn new(distance: &[f32], size: usize) -> Result<Self, ChainError> {
        expect_len("distance", distance.len(), size * size)?;
        let width = size + 1;
        let mut sums = vec![0.0; 2 * size * width];
        for total in 0..(2 * size).saturating_sub(1) {
            for i in 0..size {
                let value = match total.checked_sub(i) {
                    Some(j) if j < size => f64::from(distance[i * size + j]),
                    _ => 0.0,
                };
                sums[total * width + i + 1] = sums[total * width + i] + value;
            }
        }
        Ok(Self { size, sums })
    }

    /// Mean of `distance[start + i, end - 1 - i]` over the first half of `start..end`.
    pub fn mean(&self, start: usize, end: usize) -> f64 {
        let half = (end - start) / 2;
        if half == 0 {
            return 0.0;
        }
        let line = (start + end - 1) * (self.size + 1);
        (self.sums[line + start + half] - self.sums[line + start]) / half as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(size: usize) -> Vec<f32> {
        (0..size * size)
            .map(|v| ((v % size) * (v / size)) as f32 * 0.25 + 1.0)
            .collect()
    }

    #[test]
    fn diagonal_mean_equals_the_plain_sum() {
        let (size, d) = (9, matrix(9));
        let sums = DiagonalSums::new(&d, size, 4).unwrap();
        for (start, offset, length) in [(0, 1, 3), (2, 4, 3), (5, 0, 4), (1, 3, 1)] {
            let plain: f64 = (0..length)
                .map(|j| f64::from(d[(start + j) * size + start + offset + j]))
                .sum();
            assert!((sums.mean(start, offset, length) - plain / length as f64).abs() < 1e-9);
        }
    }

    #[test]
    fn mirror_mean_equals_the_plain_sum() {
        let (size, d) = (9, matrix(9));
        let sums = MirrorSums::new(&d, size).unwrap();
        for (start, end) in [(0, 9), (2, 6), (3, 8), (7, 9)] {
            let half = (end - start) / 2;
            let plain: f64 = (0..half)
                .map(|i| f64::from(d[(start + i) * size + end - 1 - i]))
                .sum();
            assert!((sums.mean(start, end) - plain / half as f64).abs() < 1e-9);
        }
        assert_eq!(sums.mean(4, 5), 0.0);
    }
}
