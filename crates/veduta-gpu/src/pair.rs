//! Rectified pairs on a graphics card, as `veduta_stereo::pair` matches them.

use bytemuck::{Pod, Zeroable};
use veduta_stereo::pair::{PairRule, Rectified};

use crate::card::{Card, Kernel};
use crate::error::GpuError;

const SOURCE: &str = include_str!("pair.wgsl");
/// Bytes of the costs of a band of rows, at most.
const MOST_BYTES: u64 = 512 << 20;
const IN_GROUP: usize = 16;
const UNKNOWN: f32 = -1e9;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Rule {
    width: u32,
    there: u32,
    height: u32,
    first: u32,
    band: u32,
    low: i32,
    count: u32,
    groups: u32,
    rows: u32,
    most: u32,
    step: u32,
    jump: u32,
}

/// The compiled kernels: pairs are many.
pub struct Matcher {
    gather: Kernel,
    least: Kernel,
    path: Kernel,
    refine: Kernel,
}

impl Matcher {
    pub fn new(card: &Card) -> Self {
        Self {
            gather: card.kernel(SOURCE, "gather"),
            least: card.kernel(SOURCE, "least"),
            path: card.kernel(SOURCE, "path"),
            refine: card.kernel(SOURCE, "refine"),
        }
    }

    /// The disparity of each pixel here, NaN where there is none.
    pub fn disparities(
        &self,
        card: &Card,
        here: Rectified<'_>,
        there: Rectified<'_>,
        rule: &PairRule,
    ) -> Result<Vec<f32>, GpuError> {
        let given = |why: veduta_stereo::StereoError| GpuError::Given(why.to_string());
        rule.check().map_err(given)?;
        here.check().map_err(given)?;
        there.check().map_err(given)?;
        if here.height != there.height {
            return Err(given(veduta_stereo::StereoError::Pair));
        }
        let groups = rule.count.div_ceil(IN_GROUP);
        let row_bytes = (here.width * groups * IN_GROUP * 2) as u64;
        let most = MOST_BYTES.min(card.most_bytes());
        let rows = ((most / row_bytes) as usize).clamp(1, here.height);
        let (own, other) = (card.given(&words(&here))?, card.given(&words(&there))?);
        let weights = card.given(&rule.weights())?;
        let costs = card.empty(rows * here.width * groups * IN_GROUP / 2)?;
        let chosen = card.empty(rows * here.width)?;
        let came = card.empty(rows * here.width * groups)?;
        let jumps = card.empty(rows * here.width)?;
        let found = card.empty(here.width * here.height)?;
        for first in (0..here.height).step_by(rows) {
            let band = rows.min(here.height - first);
            let pixels = band * here.width;
            let told = card.given(&[Rule {
                width: here.width as u32,
                there: there.width as u32,
                height: here.height as u32,
                first: first as u32,
                band: band as u32,
                low: rule.low,
                count: rule.count as u32,
                groups: groups as u32,
                rows: rule.rows as u32,
                most: u32::from(rule.most),
                step: rule.path.map_or(0, |path| u32::from(path.step)),
                jump: rule.path.map_or(0, |path| u32::from(path.jump)),
            }])?;
            let bound = [&told, &own, &other, &weights, &costs];
            card.run(&self.gather, &bound, (pixels * groups).div_ceil(64));
            if rule.path.is_some() {
                let bound = [&told, &costs, &chosen, &came, &jumps];
                card.run(&self.path, &bound, band);
            } else {
                let bound = [&told, &costs, &chosen];
                card.run(&self.least, &bound, pixels.div_ceil(64));
            }
            let bound = [&told, &costs, &chosen, &own, &found];
            card.run(&self.refine, &bound, pixels.div_ceil(64));
        }
        let mut disparities: Vec<f32> = card.read(&found, here.width * here.height)?;
        for one in &mut disparities {
            if *one <= UNKNOWN {
                *one = f32::NAN;
            }
        }
        Ok(disparities)
    }
}

fn words(picture: &Rectified<'_>) -> Vec<u32> {
    let each = picture.pixels.chunks_exact(3).zip(picture.shown);
    let word = |(c, shown): (&[u8], &bool)| u32::from_le_bytes([c[0], c[1], c[2], (*shown).into()]);
    each.map(word).collect()
}
