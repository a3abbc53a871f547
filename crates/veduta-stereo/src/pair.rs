//! Disparities of a rectified pair: chapter 3.2 of Moslah's thesis.
//!
//! Absolute differences of colour (3.1) are gathered up and down a column with the weights of (3.2),
//! and each pixel takes the disparity of least cost, or that of the best path along its row. All of
//! it but the last fraction of a pixel is counted in whole numbers, so that another back end finds
//! the same.

use rayon::prelude::*;

use crate::error::StereoError;
use crate::path::{best_path, Path};

/// Weights of a column sum to it.
pub const WHOLE: u32 = 256;
/// Weights before they are made to sum to a whole.
const UNIT: f64 = 1024.0;
/// Rows that are matched together: the differences of those above and below are shared.
const BAND: usize = 32;
pub const MOST_ROWS: usize = 63;
pub const MOST_DISPARITIES: usize = 1024;
/// A difference that is cut here leaves room for a column's weighted sum in 16 bits.
pub const MOST_DIFFERENCE: u8 = 127;

/// A rectified picture. shown: where it has pixels.
#[derive(Clone, Copy, Debug)]
pub struct Rectified<'a> {
    pub width: usize,
    pub height: usize,
    /// Three bytes for each pixel, row by row.
    pub pixels: &'a [u8],
    pub shown: &'a [bool],
}

/// How a pair is matched.
#[derive(Clone, Copy, Debug)]
pub struct PairRule {
    /// The least disparity, x there less x here (px), and how many are tried.
    pub low: i32,
    pub count: usize,
    /// Of a column, odd.
    pub rows: usize,
    /// (3.2)'s constants: of 255, and px.
    pub gamma_colour: f64,
    pub gamma_px: f64,
    /// Differences of colour above count as this.
    pub most: u8,
    /// The best path along each row instead of the least cost: what a step of one disparity costs,
    /// and one of more.
    pub path: Option<Path>,
}

impl PairRule {
    pub fn check(&self) -> Result<(), StereoError> {
        let good = self.rows % 2 == 1
            && self.rows <= MOST_ROWS
            && (1..=MOST_DISPARITIES).contains(&self.count)
            && (1..=MOST_DIFFERENCE).contains(&self.most)
            && self.gamma_colour > 0.0
            && self.gamma_px > 0.0
            && self
                .path
                .is_none_or(|path| path.step <= path.jump && path.jump < 1 << 14);
        good.then_some(()).ok_or(StereoError::Pair)
    }

    /// Of each row of a column, top to bottom, and each difference of colour, a weight (3.2).
    pub fn weights(&self) -> Vec<u32> {
        let half = (self.rows / 2) as f64;
        (0..self.rows * 256)
            .map(|at| {
                let (away, colour) = ((at / 256) as f64 - half, (at % 256) as f64);
                let power = colour / self.gamma_colour + away.abs() / self.gamma_px;
                (UNIT * (-power).exp()).round() as u32
            })
            .collect()
    }
}

/// Of 255: the mean over the channels, as all back ends round it.
#[inline]
fn difference(a: [u8; 3], b: [u8; 3]) -> usize {
    let sum: u32 = (0..3).map(|c| u32::from(a[c].abs_diff(b[c]))).sum();
    ((sum * 85) >> 8) as usize
}

impl Rectified<'_> {
    pub fn check(&self) -> Result<(), StereoError> {
        let pixels = self.width * self.height;
        if pixels == 0 || self.pixels.len() != 3 * pixels || self.shown.len() != pixels {
            return Err(StereoError::Size {
                width: self.width,
                height: self.height,
                given: self.pixels.len(),
            });
        }
        Ok(())
    }

    #[inline]
    fn colour(&self, x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * self.width + x);
        [self.pixels[at], self.pixels[at + 1], self.pixels[at + 2]]
    }
}

/// The disparity of each pixel here, NaN where none of those tried is in the other picture.
pub fn disparities(
    here: Rectified<'_>,
    there: Rectified<'_>,
    rule: &PairRule,
) -> Result<Vec<f32>, StereoError> {
    rule.check()?;
    here.check()?;
    there.check()?;
    if here.height != there.height {
        return Err(StereoError::Pair);
    }
    let weights = rule.weights();
    let mut found = vec![f32::NAN; here.width * here.height];
    found
        .par_chunks_mut(BAND * here.width)
        .enumerate()
        .for_each(|(band, into)| {
            let matcher = Matcher {
                here,
                there,
                rule,
                weights: &weights,
            };
            matcher.band(band * BAND, into);
        });
    Ok(found)
}

struct Matcher<'a> {
    here: Rectified<'a>,
    there: Rectified<'a>,
    rule: &'a PairRule,
    weights: &'a [u32],
}

impl Matcher<'_> {
    fn band(&self, first: usize, into: &mut [f32]) {
        let (width, count, half) = (self.here.width, self.rule.count, self.rule.rows / 2);
        let mut ring = vec![vec![0_u8; width * count]; self.rule.rows];
        let mut costs = vec![0_u16; width * count];
        let rows = into.len() / width;
        let top = first.saturating_sub(half);
        let mut next = top;
        for row in 0..rows {
            let y = first + row;
            while next <= (y + half).min(self.here.height - 1) {
                self.differences(next, &mut ring[next % self.rule.rows]);
                next += 1;
            }
            self.gather(y, &ring, &mut costs);
            self.choose(y, &costs, &mut into[row * width..][..width]);
        }
    }

    /// (3.1) of a row: for each pixel, each disparity.
    fn differences(&self, y: usize, into: &mut [u8]) {
        let (width, count, most) = (self.here.width, self.rule.count, self.rule.most);
        // The other row with room to both sides, where nothing is.
        let pad = width + count + self.rule.low.unsigned_abs() as usize;
        let length = self.there.width + 2 * pad;
        let mut planes = [(); 3].map(|()| vec![0_u8; length]);
        let mut none = vec![most; length];
        for x in 0..self.there.width {
            let colour = self.there.colour(x, y);
            (0..3).for_each(|c| planes[c][pad + x] = colour[c]);
            if self.there.shown[y * self.there.width + x] {
                none[pad + x] = 0;
            }
        }
        for x in 0..width {
            let costs = &mut into[x * count..][..count];
            if !self.here.shown[y * width + x] {
                costs.fill(most);
                continue;
            }
            let from = (pad as i64 + x as i64 + i64::from(self.rule.low)) as usize;
            let own = self.here.colour(x, y);
            let [red, green, blue] = [0, 1, 2].map(|c| &planes[c][from..][..count]);
            let none = &none[from..][..count];
            for d in 0..count {
                let sum = u16::from(own[0].abs_diff(red[d]))
                    + u16::from(own[1].abs_diff(green[d]))
                    + u16::from(own[2].abs_diff(blue[d]));
                costs[d] = (((sum * 85) >> 8) as u8).max(none[d]).min(most);
            }
        }
    }

    /// The weighted differences of a column, for each pixel of a row and each disparity.
    fn gather(&self, y: usize, ring: &[Vec<u8>], costs: &mut [u16]) {
        let (width, count, rows) = (self.here.width, self.rule.count, self.rule.rows);
        let mut column = [0_u32; MOST_ROWS];
        for x in 0..width {
            let into = &mut costs[x * count..][..count];
            into.fill(0);
            self.column(x, y, &mut column);
            for (tap, weight) in column[..rows].iter().enumerate() {
                if *weight == 0 {
                    continue;
                }
                let from = y + tap - rows / 2;
                let given = &ring[from % rows][x * count..][..count];
                let weight = *weight as u16;
                for (sum, one) in into.iter_mut().zip(given) {
                    *sum = sum.wrapping_add(weight.wrapping_mul(u16::from(*one)));
                }
            }
        }
    }

    /// The weights around a pixel, which sum to a whole.
    fn column(&self, x: usize, y: usize, into: &mut [u32; MOST_ROWS]) {
        let (rows, height) = (self.rule.rows, self.here.height);
        let own = self.here.colour(x, y);
        let mut sum = 0;
        for tap in 0..rows {
            let row = y + tap;
            into[tap] = if row < rows / 2 || row - rows / 2 >= height {
                0
            } else {
                let other = self.here.colour(x, row - rows / 2);
                self.weights[tap * 256 + difference(own, other)]
            };
            sum += into[tap];
        }
        let mut left = WHOLE;
        for one in into[..rows].iter_mut() {
            *one = *one * WHOLE / sum.max(1);
            left -= *one;
        }
        into[rows / 2] += left;
    }

    fn choose(&self, y: usize, costs: &[u16], into: &mut [f32]) {
        let (width, count) = (self.here.width, self.rule.count);
        let chosen = match self.rule.path {
            Some(path) => best_path(costs, count, path),
            None => costs.chunks_exact(count).map(least).collect(),
        };
        let nothing = u16::from(self.rule.most) * WHOLE as u16;
        for x in 0..width {
            let (own, at) = (&costs[x * count..][..count], chosen[x]);
            if self.here.shown[y * width + x] && own[at] < nothing {
                into[x] = self.rule.low as f32 + at as f32 + fraction(own, at);
            }
        }
    }
}

fn least(costs: &[u16]) -> usize {
    let mut best = 0;
    for (at, cost) in costs.iter().enumerate() {
        if *cost < costs[best] {
            best = at;
        }
    }
    best
}

/// Where between the neighbours the least of a parabola is, at most half a disparity away.
fn fraction(costs: &[u16], at: usize) -> f32 {
    if at == 0 || at + 1 == costs.len() {
        return 0.0;
    }
    let [before, own, after] = [at - 1, at, at + 1].map(|d| f32::from(costs[d]));
    let bend = before - 2.0 * own + after;
    if bend <= 0.0 {
        return 0.0;
    }
    (0.5 * (before - after) / bend).clamp(-0.5, 0.5)
}

/// Without those that do not lead back from the other picture within so many pixels.
pub fn confirmed(here: &mut [f32], there: &[f32], widths: [usize; 2], most_px: f32) {
    let rows = here.par_chunks_mut(widths[0]);
    let others = there.par_chunks(widths[1]);
    rows.zip(others).for_each(|(row, other)| {
        for (x, one) in row.iter_mut().enumerate() {
            let to = x as f32 + 0.5 + *one;
            let back = if to >= 0.0 && to < other.len() as f32 {
                other[to as usize]
            } else {
                f32::NAN
            };
            let off = (*one + back).abs();
            if off.is_nan() || off > most_px {
                *one = f32::NAN;
            }
        }
    });
}
