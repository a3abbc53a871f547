//! PatchMatch on a graphics card, as `veduta_stereo::search` looks for planes.
//!
//! It draws the same numbers and takes the same steps. Sines, exponentials and roots of a card are not
//! those of a processor, so that planes agree within a tolerance, and where two are nearly as good one
//! may be chosen here and the other there.

use std::fmt::Write;

use bytemuck::{Pod, Zeroable};
use veduta_stereo::camera::Transfer;
use veduta_stereo::patch::{SAMPLES, SIDE, WORST};
use veduta_stereo::planes::{Plane, Planes};
use veduta_stereo::search::{begun, Neighbour, Search, GROUPS, MOST_VIEWS};
use veduta_stereo::{Camera, Grey};

use crate::card::{Card, Kernel};
use crate::error::GpuError;

const SOURCE: &str = include_str!("search.wgsl");

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Rule {
    width: u32,
    height: u32,
    views: u32,
    best: u32,
    sweep: u32,
    colour: u32,
    seed: [u32; 2],
    step_px: f32,
    gamma_grey: f32,
    gamma_px: f32,
    noise_grey: f32,
    low: f32,
    high: f32,
    consistency: f32,
    most_px: f32,
    vary_depth: f32,
    vary_normal: f32,
    focal: [f32; 2],
    centre: [f32; 2],
    same_inverse: f32,
    same_slope: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct GivenView {
    there: [[f32; 4]; 3],
    back: [[f32; 4]; 3],
    width: u32,
    height: u32,
    image: u32,
    depths: u32,
    known: u32,
    spare: [u32; 3],
}

/// The compiled kernels: views are many.
pub struct Searcher {
    judge: Kernel,
    improve: Kernel,
}

impl Searcher {
    pub fn new(card: &Card) -> Self {
        let source = format!("{}{SOURCE}", constants());
        Self {
            judge: card.kernel(&source, "judge"),
            improve: card.kernel(&source, "improve"),
        }
    }

    /// Planes for every pixel of the reference. start: those to go on from, else random ones.
    pub fn search(
        &self,
        card: &Card,
        image: &Grey,
        camera: Camera,
        neighbours: &[Neighbour<'_>],
        start: Option<Planes>,
        search: Search,
    ) -> Result<Planes, GpuError> {
        let found = begun(image, camera, neighbours, start, search);
        let mut found = found.map_err(|why| GpuError::Given(why.to_string()))?;
        let neighbours = &neighbours[..neighbours.len().min(MOST_VIEWS)];
        let (pixels, depths, views) = gathered(image, camera, neighbours);
        let rows = found.planes.iter();
        let rows: Vec<[f32; 4]> = rows
            .map(|one| [one.inverse, one.slope[0], one.slope[1], 0.0])
            .collect();
        let (pixels, views) = (card.given(&pixels)?, card.given(&views)?);
        let (depths, planes) = (card.given(&depths)?, card.given(&rows)?);
        let rule = rule_of(image, camera, neighbours, &search);
        let told = card.given(&[rule])?;
        let bound = [&told, &pixels, &views, &depths, &planes];
        card.run(&self.judge, &bound, rows.len().div_ceil(64));
        let half = image.width.div_ceil(2) * image.height;
        for sweep in 0..search.sweeps {
            let scale = 0.5f32.powi(sweep as i32);
            for colour in 0..2 {
                let told = card.given(&[Rule {
                    sweep: sweep as u32,
                    colour,
                    vary_depth: search.vary_depth * scale,
                    vary_normal: search.vary_normal * scale,
                    ..rule
                }])?;
                let bound = [&told, &pixels, &views, &depths, &planes];
                card.run(&self.improve, &bound, half.div_ceil(64));
            }
        }
        let rows: Vec<[f32; 4]> = card.read(&planes, rows.len())?;
        let plane = |row: &[f32; 4]| Plane {
            inverse: row[0],
            slope: [row[1], row[2]],
        };
        found.planes = rows.iter().map(plane).collect();
        found.costs = rows.iter().map(|row| row[3]).collect();
        Ok(found)
    }
}

/// What `veduta_stereo` says once, for the shader.
fn constants() -> String {
    let count: usize = GROUPS.iter().map(|group| group.len()).sum();
    let mut starts = vec![0];
    let mut offsets = String::new();
    for group in GROUPS {
        starts.push(starts[starts.len() - 1] + group.len());
        for (x, y) in group {
            // Writing to a string does not fail.
            let _ = write!(offsets, "vec2<i32>({x}, {y}), ");
        }
    }
    let starts: Vec<String> = starts.iter().map(|one| format!("{one}u")).collect();
    format!(
        "const SIDE = {SIDE}u; const SAMPLES = {SAMPLES}u; const WORST = {WORST:?};\n\
         const MOST_VIEWS = {MOST_VIEWS}u; const GROUPS = {groups}u;\n\
         var<private> STARTS: array<u32, {more}> = array<u32, {more}>({starts});\n\
         var<private> OFFSETS: array<vec2<i32>, {count}> = array<vec2<i32>, {count}>({offsets});\n",
        groups = GROUPS.len(),
        more = GROUPS.len() + 1,
        starts = starts.join(", "),
    )
}

fn rule_of(image: &Grey, camera: Camera, neighbours: &[Neighbour<'_>], search: &Search) -> Rule {
    let views = neighbours.len();
    let there = neighbours.iter();
    let there = there.map(|one| Transfer::new(&camera, &one.camera));
    let [same_inverse, same_slope] = search.same(there);
    Rule {
        width: image.width as u32,
        height: image.height as u32,
        views: views as u32,
        best: search.views.clamp(1, views) as u32,
        sweep: 0,
        colour: 0,
        seed: [search.seed as u32, (search.seed >> 32) as u32],
        step_px: search.window.step_px,
        gamma_grey: search.window.gamma_grey,
        gamma_px: search.window.gamma_px,
        noise_grey: search.window.noise_grey,
        low: 1.0 / search.far,
        high: 1.0 / search.near,
        consistency: search.consistency,
        most_px: search.most_px,
        vary_depth: search.vary_depth,
        vary_normal: search.vary_normal,
        focal: camera.focal.map(|one| one as f32),
        centre: camera.centre.map(|one| one as f32),
        same_inverse,
        same_slope,
    }
}

/// All pictures in words of four pixels, all depths, and where each view's begin.
fn gathered(
    image: &Grey,
    camera: Camera,
    neighbours: &[Neighbour<'_>],
) -> (Vec<u32>, Vec<f32>, Vec<GivenView>) {
    let mut bytes: Vec<u8> = image.values().collect();
    let mut depths: Vec<f32> = Vec::new();
    let mut views = Vec::with_capacity(neighbours.len());
    for one in neighbours {
        views.push(GivenView {
            there: rows(&Transfer::new(&camera, &one.camera)),
            back: rows(&Transfer::new(&one.camera, &camera)),
            width: one.image.width as u32,
            height: one.image.height as u32,
            image: bytes.len() as u32,
            depths: depths.len() as u32,
            known: one.depths.is_some().into(),
            spare: [0; 3],
        });
        bytes.extend(one.image.values());
        let known = |depth: &f32| if depth.is_nan() { -1.0 } else { *depth };
        depths.extend(one.depths.unwrap_or_default().iter().map(known));
    }
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let words = bytes.chunks_exact(4);
    let words = words.map(|four| u32::from_le_bytes([four[0], four[1], four[2], four[3]]));
    (words.collect(), depths, views)
}

fn rows(transfer: &Transfer) -> [[f32; 4]; 3] {
    std::array::from_fn(|i| {
        let [x, y, z] = transfer.far[i];
        [x, y, z, transfer.near[i]]
    })
}
