//! Colour consistency with visibility on a graphics card, as an engine for the sweeps of `veduta_carve`.

use std::cell::RefCell;

use bytemuck::{Pod, Zeroable};
use veduta_carve::judging::{COVER_VOXELS, SLACK_VOXELS, STEP_VOXELS};
use veduta_carve::sweep::{check, sweep_on, Judge, SweepRule, Swept};
use veduta_carve::{CarveError, Photo, Root, View};

use crate::card::{Card, Kernel};
use crate::error::GpuError;
use crate::views::GivenView;

const SOURCE: &str = concat!(include_str!("views.wgsl"), include_str!("sweep.wgsl"));
/// Threads of a workgroup.
const GROUP: usize = 64;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct GivenRule {
    voxel: f32,
    cover: f32,
    slack: f32,
    least_cosine: f32,
    rim: f32,
    step: f32,
    along: u32,
    views: u32,
    voxels: u32,
    least_views: u32,
    most_views: u32,
    pixels: u32,
    first: u32,
    spare: [u32; 3],
}

/// The compiled kernels, once for all objects.
pub struct Sweeper {
    clear: Kernel,
    cover: Kernel,
    look: Kernel,
    spread: Kernel,
    hold: Kernel,
    /// Values of a buffer at most.
    most: usize,
}

impl Sweeper {
    pub fn new(card: &Card) -> Self {
        Self::holding(card, (card.most_bytes() / 4) as usize)
    }

    /// With buffers of so many values at most, each of four bytes.
    pub fn holding(card: &Card, values: usize) -> Self {
        let kernel = |entry| card.kernel(SOURCE, entry);
        Self {
            most: values,
            clear: kernel("clear"),
            cover: kernel("cover"),
            look: kernel("look"),
            spread: kernel("spread"),
            hold: kernel("hold"),
        }
    }

    /// What colours that disagree leave of the solid, as `veduta_carve::sweep::sweep` finds it.
    pub fn sweep(
        &self,
        card: &Card,
        photos: &[Photo<'_>],
        views: &[View<'_>],
        root: &Root,
        solid: Vec<bool>,
        rule: &SweepRule,
    ) -> Result<Swept, GpuError> {
        let given = |why: CarveError| GpuError::Given(why.to_string());
        check(photos, views).map_err(given)?;
        let engine = OnCard::new(self, card, photos, views, root, rule)?;
        sweep_on(&engine, root, solid, rule).map_err(|why| {
            let fault = engine.fault.borrow_mut().take();
            fault.unwrap_or_else(|| given(why))
        })
    }
}

/// Views whose values fit into one buffer.
struct Batch {
    views: wgpu::Buffer,
    values: wgpu::Buffer,
    count: usize,
    /// Values of all of them together.
    size: usize,
}

struct OnCard<'a> {
    kernels: &'a Sweeper,
    card: &'a Card,
    root: &'a Root,
    rule: &'a SweepRule,
    photos: Vec<Batch>,
    outlines: Vec<Batch>,
    /// What went wrong: the sweeps know only that something did.
    fault: RefCell<Option<GpuError>>,
}

impl<'a> OnCard<'a> {
    fn new(
        kernels: &'a Sweeper,
        card: &'a Card,
        photos: &[Photo<'_>],
        views: &[View<'_>],
        root: &'a Root,
        rule: &'a SweepRule,
    ) -> Result<Self, GpuError> {
        card.check()?;
        let pixels = |one: &Photo<'_>| one.width * one.height;
        let packed = |one: &Photo<'_>| -> Vec<u32> {
            let each = one.pixels.chunks_exact(3);
            each.map(|p| u32::from_le_bytes([p[0], p[1], p[2], 0]))
                .collect()
        };
        let distances = |one: &View<'_>| one.distances_px.len();
        let kept = |one: &View<'_>| -> Vec<f32> { one.distances_px.to_vec() };
        let photo = |one: &Photo<'_>, offset: usize| GivenView::of_photo(one, root, offset);
        let outline = |one: &View<'_>, offset: usize| GivenView::of_outline(one, root, offset);
        Ok(Self {
            kernels,
            card,
            root,
            rule,
            photos: batches((card, kernels.most), photos, pixels, packed, photo)?,
            outlines: batches((card, kernels.most), views, distances, kept, outline)?,
            fault: RefCell::new(None),
        })
    }

    fn given(&self, views: usize, voxels: usize, pixels: usize) -> GivenRule {
        let voxel = self.root.voxel_m();
        GivenRule {
            voxel: voxel as f32,
            cover: (COVER_VOXELS * voxel) as f32,
            slack: (SLACK_VOXELS * voxel) as f32,
            least_cosine: self.rule.least_cosine as f32,
            rim: self.rule.rim_voxels as f32,
            step: STEP_VOXELS as f32,
            along: self.root.voxels() as u32,
            views: views as u32,
            voxels: voxels as u32,
            least_views: self.rule.least_views as u32,
            most_views: self.rule.most_views.max(1) as u32,
            pixels: pixels as u32,
            first: 0,
            spare: [0; 3],
        }
    }

    fn run(&self, kernel: &Kernel, buffers: &[&wgpu::Buffer], threads: usize) {
        self.card.run(kernel, buffers, threads.div_ceil(GROUP));
    }

    fn judged(
        &self,
        solid: &[bool],
        shell: &[usize],
        asked: &[usize],
    ) -> Result<Vec<Option<f32>>, GpuError> {
        if asked.is_empty() {
            return Ok(Vec::new());
        }
        let solid = self.card.given(&bits(solid))?;
        let hiding = self.card.given(&orders(shell))?;
        let voxels = self.card.given(&orders(asked))?;
        let seen = 4 * self.rule.most_views.max(1) * asked.len();
        let seen = self.card.empty(seen)?;
        for (number, batch) in self.photos.iter().enumerate() {
            let depths = self.card.empty(batch.size)?;
            let rule = self.given(batch.count, shell.len(), batch.size);
            let rule = self.card.given(&[rule])?;
            self.run(&self.kernels.clear, &[&rule, &depths], batch.size);
            let bound = [&rule, &batch.views, &depths, &hiding];
            self.run(&self.kernels.cover, &bound, shell.len() * batch.count);
            let mut rule = self.given(batch.count, asked.len(), batch.size);
            rule.first = u32::from(number == 0);
            let rule = self.card.given(&[rule])?;
            let views = &batch.views;
            let bound = [&rule, views, &depths, &voxels, &batch.values, &solid, &seen];
            self.run(&self.kernels.look, &bound, asked.len());
        }
        let rule = self.card.given(&[self.given(0, asked.len(), 0)])?;
        let spreads = self.card.empty(asked.len())?;
        self.run(&self.kernels.spread, &[&rule, &seen, &spreads], asked.len());
        let found: Vec<f32> = self.card.read(&spreads, asked.len())?;
        let told = |one: f32| (one >= 0.0).then_some(one);
        Ok(found.into_iter().map(told).collect())
    }

    fn holding(&self, left: &[bool], wanted: &[usize]) -> Result<Vec<bool>, GpuError> {
        let mut holds = vec![false; wanted.len()];
        if wanted.is_empty() {
            return Ok(holds);
        }
        let left = self.card.given(&bits(left))?;
        let voxels = self.card.given(&orders(wanted))?;
        for batch in &self.outlines {
            let rule = self
                .card
                .given(&[self.given(batch.count, wanted.len(), 0)])?;
            let held = self.card.empty(wanted.len())?;
            let bound = [&rule, &batch.views, &batch.values, &voxels, &left, &held];
            self.run(&self.kernels.hold, &bound, wanted.len());
            let found: Vec<u32> = self.card.read(&held, wanted.len())?;
            holds
                .iter_mut()
                .zip(found)
                .for_each(|(one, found)| *one |= found == 1);
        }
        Ok(holds)
    }

    fn told<T>(&self, found: Result<T, GpuError>) -> Result<T, CarveError> {
        found.map_err(|why| {
            self.fault.replace(Some(why));
            CarveError::Engine
        })
    }
}

impl Judge for OnCard<'_> {
    fn spreads(
        &self,
        solid: &[bool],
        shell: &[usize],
        asked: &[usize],
    ) -> Result<Vec<Option<f32>>, CarveError> {
        self.told(self.judged(solid, shell, asked))
    }

    fn held(&self, left: &[bool], wanted: &[usize]) -> Result<Vec<bool>, CarveError> {
        self.told(self.holding(left, wanted))
    }
}

/// Of views in their order, as many at a time as a buffer takes: photos of a whole ring may not fit.
fn batches<V, T: bytemuck::NoUninit>(
    (card, most): (&Card, usize),
    views: &[V],
    size: impl Fn(&V) -> usize,
    values: impl Fn(&V) -> Vec<T>,
    given: impl Fn(&V, usize) -> GivenView,
) -> Result<Vec<Batch>, GpuError> {
    let mut made = Vec::new();
    let mut rest = views;
    while !rest.is_empty() {
        let (mut count, mut together) = (0, 0);
        while let Some(view) = rest.get(count) {
            if count > 0 && together + size(view) > most {
                break;
            }
            together += size(view);
            count += 1;
        }
        let (taken, after) = rest.split_at(count);
        let (mut all, mut places) = (Vec::with_capacity(together), Vec::with_capacity(count));
        for view in taken {
            places.push(given(view, all.len()));
            all.extend(values(view));
        }
        made.push(Batch {
            views: card.given(&places)?,
            values: card.given(&all)?,
            count,
            size: together,
        });
        rest = after;
    }
    Ok(made)
}

fn orders(voxels: &[usize]) -> Vec<u32> {
    voxels.iter().map(|voxel| *voxel as u32).collect()
}

/// 32 of them in a word.
fn bits(solid: &[bool]) -> Vec<u32> {
    let word = |some: &[bool]| {
        let each = some.iter().enumerate();
        each.fold(0, |word, (at, one)| word | u32::from(*one) << at)
    };
    solid.chunks(32).map(word).collect()
}
