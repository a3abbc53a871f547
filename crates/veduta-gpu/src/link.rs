//! Chains of correspondences on a graphics card, as `veduta_stereo::link` follows them.

use bytemuck::{Pod, Zeroable};
use veduta_stereo::camera::{Camera, Transfer};
use veduta_stereo::link::{check, Homography, LinkRule, Linked, Step};

use crate::card::{Card, Kernel};
use crate::error::GpuError;

const SOURCE: &str = include_str!("link.wgsl");
const UNKNOWN: f32 = -1e9;

/// Columns, each filled up to four.
type Columns = [[f32; 4]; 3];

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct GivenStep {
    rectified: Columns,
    back: Columns,
    far: Columns,
    near: [f32; 3],
    width: u32,
    height: u32,
    offset: u32,
    spare: [u32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Rule {
    width: u32,
    height: u32,
    up: u32,
    steps: u32,
    deviation: f32,
    most_deviations: f32,
    most_across: f32,
    near: f32,
    far: f32,
}

/// The compiled kernel: views are many.
pub struct Linker(Kernel);

impl Linker {
    pub fn new(card: &Card) -> Self {
        Self(card.kernel(SOURCE, "link"))
    }

    /// The depths of a view. up, down: the sequence from the next view on.
    pub fn link(
        &self,
        card: &Card,
        camera: Camera,
        size: [usize; 2],
        chains: [&[Step<'_>]; 2],
        rule: &LinkRule,
    ) -> Result<Linked, GpuError> {
        check(&chains, rule).map_err(|why| GpuError::Given(why.to_string()))?;
        let mut disparities: Vec<f32> = Vec::new();
        let mut given = Vec::new();
        for step in chains.iter().copied().flatten() {
            given.push(given_step(&camera, step, disparities.len()));
            let known = |one: &f32| if one.is_nan() { UNKNOWN } else { *one };
            disparities.extend(step.disparities.iter().map(known));
        }
        let told = card.given(&[Rule {
            width: size[0] as u32,
            height: size[1] as u32,
            up: chains[0].len() as u32,
            steps: given.len() as u32,
            deviation: rule.deviation_px,
            most_deviations: rule.most_deviations,
            most_across: rule.most_across_px,
            near: rule.near,
            far: rule.far,
        }])?;
        if given.is_empty() {
            given.push(GivenStep::zeroed());
        }
        let (steps, maps) = (card.given(&given)?, card.given(&disparities)?);
        let pixels = size[0] * size[1];
        let found = card.empty(4 * pixels)?;
        card.run(
            &self.0,
            &[&told, &steps, &maps, &found],
            pixels.div_ceil(64),
        );
        let rows: Vec<[f32; 4]> = card.read(&found, pixels)?;
        let nothing = |one: &[f32; 4]| one[2] == 0.0;
        let depth = |one: &[f32; 4]| if nothing(one) { f32::NAN } else { 1.0 / one[0] };
        Ok(Linked {
            depths: rows.iter().map(depth).collect(),
            deviations: rows.iter().map(|one| one[1].sqrt()).collect(),
            estimates: rows.iter().map(|one| one[2] as u8).collect(),
        })
    }
}

fn columns(rows: &Homography) -> Columns {
    std::array::from_fn(|c| [rows[0][c], rows[1][c], rows[2][c], 0.0])
}

fn given_step(camera: &Camera, step: &Step<'_>, offset: usize) -> GivenStep {
    let transfer = Transfer::new(camera, &step.camera);
    GivenStep {
        rectified: columns(&step.rectified),
        back: columns(&step.back),
        far: columns(&transfer.far),
        near: transfer.near,
        width: step.width as u32,
        height: step.height as u32,
        offset: offset as u32,
        spare: [0; 2],
    }
}
