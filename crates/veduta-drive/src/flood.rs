//! Pixels of an image that belong to the foreground: each projected scan point floods a window.
//!
//! Frueh, Jain and Zakhor 2005, section 7.1: from a projected foreground point on, pixels are taken
//! that have its colour and do not fit the background better than it does (correspondence error).

use rayon::prelude::*;

use crate::error::DriveError;

/// An image with what is known of each pixel, by rows. colours: three values a pixel, 0 to 255.
/// misfit: how far the best match in the next images lies from where the background would be (px);
/// NaN where no background is: such pixels are of no object.
pub struct Picture<'a> {
    pub width: usize,
    pub height: usize,
    pub colours: &'a [u8],
    pub misfit: &'a [f32],
}

/// A projected foreground point: its pixel, and how far from the camera it is (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seed {
    pub column: usize,
    pub row: usize,
    pub depth: f32,
}

/// reach: half of the window (px). colour: no channel differs more from the seed's. slack: a pixel may
/// fit the background by so much better than the seed (px). least: but none that fits it so well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloodRules {
    pub reach: usize,
    pub colour: u8,
    pub slack: f32,
    pub least: f32,
}

const AT_ONCE: usize = 256;

/// The depth of the nearest seed whose flood reaches each pixel, infinity where none does.
/// A seed outside of the image, or a table of another size, is an error.
pub fn flood(
    picture: &Picture<'_>,
    seeds: &[Seed],
    rules: FloodRules,
) -> Result<Vec<f32>, DriveError> {
    let cells = picture.width * picture.height;
    for given in [picture.colours.len() / 3, picture.misfit.len()] {
        if given != cells || picture.colours.len() != 3 * cells {
            let (width, height) = (picture.width, picture.height);
            return Err(DriveError::Size {
                width,
                height,
                given,
            });
        }
    }
    if let Some(seed) = seeds
        .iter()
        .find(|seed| seed.column >= picture.width || seed.row >= picture.height)
    {
        return Err(DriveError::Seed {
            column: seed.column,
            row: seed.row,
        });
    }
    let nothing = || vec![f32::INFINITY; cells];
    // Parts of equal size on any number of threads; the least of depths does not depend on order.
    Ok(seeds
        .par_chunks(AT_ONCE.max(seeds.len() / 8 + 1))
        .map(|part| {
            let mut found = nothing();
            let mut window = Window::new(rules.reach);
            for seed in part {
                window.flood(picture, *seed, rules, &mut found);
            }
            found
        })
        .reduce(nothing, |mut one, other| {
            for (own, its) in one.iter_mut().zip(other) {
                *own = own.min(its);
            }
            one
        }))
}

/// Which pixels around a seed were looked at; used again for the next seed.
struct Window {
    side: usize,
    looked: Vec<bool>,
    open: Vec<(usize, usize)>,
}

impl Window {
    fn new(reach: usize) -> Self {
        let side = 2 * reach + 1;
        Self {
            side,
            looked: vec![false; side * side],
            open: Vec::new(),
        }
    }

    fn flood(&mut self, picture: &Picture<'_>, seed: Seed, rules: FloodRules, found: &mut [f32]) {
        self.looked.fill(false);
        self.open.clear();
        let start = seed.row * picture.width + seed.column;
        let own = &picture.colours[3 * start..3 * start + 3];
        let limit = if picture.misfit[start].is_nan() {
            rules.least
        } else {
            (picture.misfit[start] - rules.slack).max(rules.least)
        };
        found[start] = found[start].min(seed.depth);
        self.visit(seed, seed.column, seed.row, rules.reach);
        while let Some((column, row)) = self.open.pop() {
            let sides = [
                (column.wrapping_sub(1), row),
                (column + 1, row),
                (column, row.wrapping_sub(1)),
                (column, row + 1),
            ];
            for (x, y) in sides {
                if x >= picture.width || y >= picture.height || self.known(seed, x, y, rules.reach)
                {
                    continue;
                }
                let at = y * picture.width + x;
                let colour = &picture.colours[3 * at..3 * at + 3];
                let alike = own
                    .iter()
                    .zip(colour)
                    .all(|(one, two)| one.abs_diff(*two) <= rules.colour);
                if alike && picture.misfit[at] >= limit {
                    found[at] = found[at].min(seed.depth);
                    self.visit(seed, x, y, rules.reach);
                }
            }
        }
    }

    /// Whether a pixel was looked at or is outside of the window; from now on it was.
    fn known(&mut self, seed: Seed, x: usize, y: usize, reach: usize) -> bool {
        if x.abs_diff(seed.column) > reach || y.abs_diff(seed.row) > reach {
            return true;
        }
        let at = (y + reach - seed.row) * self.side + x + reach - seed.column;
        std::mem::replace(&mut self.looked[at], true)
    }

    fn visit(&mut self, seed: Seed, x: usize, y: usize, reach: usize) {
        self.known(seed, x, y, reach);
        self.open.push((x, y));
    }
}
