//! The silhouettes' test on a graphics card, as an engine for the octree of `veduta_carve`.

use std::cell::RefCell;

use bytemuck::{Pod, Zeroable};
use veduta_carve::hull::{carve_on, check, Cube, Engine, Verdict};
use veduta_carve::{CarveError, Root, View, Volume, IN_BLOCK};

use crate::card::{Card, Kernel};
use crate::error::GpuError;
use crate::views::GivenView;

const SOURCE: &str = concat!(include_str!("views.wgsl"), include_str!("carve.wgsl"));
/// Blocks whose voxels are measured at once: 32 MB.
const AT_ONCE: usize = 16_384;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Grid {
    side: f32,
    voxel: f32,
    far: f32,
    cubes: u32,
    views: u32,
    words: u32,
    spare: [u32; 2],
}

/// The compiled kernels, once for all objects.
pub struct Carver {
    judge: Kernel,
    measure: Kernel,
}

impl Carver {
    pub fn new(card: &Card) -> Self {
        Self {
            judge: card.kernel(SOURCE, "judge"),
            measure: card.kernel(SOURCE, "measure"),
        }
    }

    /// What the silhouettes leave of the root, as `veduta_carve::hull::carve` finds it.
    pub fn carve(&self, card: &Card, views: &[View<'_>], root: Root) -> Result<Volume, GpuError> {
        check(views, root).map_err(|why| GpuError::Given(why.to_string()))?;
        let engine = OnCard::new(self, card, views, root)?;
        carve_on(&engine, views.len(), root).map_err(|why| {
            let fault = engine.fault.borrow_mut().take();
            fault.unwrap_or_else(|| GpuError::Given(why.to_string()))
        })
    }
}

struct OnCard<'a> {
    kernels: &'a Carver,
    card: &'a Card,
    root: Root,
    count: usize,
    views: wgpu::Buffer,
    distances: wgpu::Buffer,
    /// What went wrong: the octree knows only that something did.
    fault: RefCell<Option<GpuError>>,
}

impl<'a> OnCard<'a> {
    fn new(
        kernels: &'a Carver,
        card: &'a Card,
        views: &[View<'_>],
        root: Root,
    ) -> Result<Self, GpuError> {
        card.check()?;
        let mut distances: Vec<f32> = Vec::new();
        let mut given = Vec::with_capacity(views.len());
        for view in views {
            given.push(GivenView::of_outline(view, &root, distances.len()));
            distances.extend_from_slice(view.distances_px);
        }
        Ok(Self {
            kernels,
            card,
            root,
            count: views.len(),
            views: card.given(&given)?,
            distances: card.given(&distances)?,
            fault: RefCell::new(None),
        })
    }

    fn words(&self) -> usize {
        self.count.div_ceil(32)
    }

    fn grid(&self, side: f64, cubes: usize, far_m: f32) -> Result<wgpu::Buffer, GpuError> {
        self.card.given(&[Grid {
            side: side as f32,
            voxel: self.root.voxel_m() as f32,
            far: far_m,
            cubes: cubes as u32,
            views: self.count as u32,
            words: self.words() as u32,
            spare: [0; 2],
        }])
    }

    fn open(&self, cubes: &[Cube]) -> Vec<u32> {
        let words = self.words();
        let mut bits = vec![0; words * cubes.len()];
        for (place, cube) in cubes.iter().enumerate() {
            for view in cube.open.iter().copied().map(usize::from) {
                bits[place * words + view / 32] |= 1 << (view % 32);
            }
        }
        bits
    }

    fn judged(&self, mut cubes: Vec<Cube>, level: u32) -> Result<Vec<(Verdict, Cube)>, GpuError> {
        let side = self.root.side_m / f64::from(1_u32 << level);
        let grid = self.grid(side, cubes.len(), 0.0)?;
        let places = self.card.given(&corners(&cubes))?;
        let open = self.card.given(&self.open(&cubes))?;
        let found = self.card.empty(cubes.len())?;
        let bound = [&grid, &self.views, &self.distances, &places, &open, &found];
        self.card
            .run(&self.kernels.judge, &bound, cubes.len().div_ceil(64));
        let words = self.words();
        let verdicts: Vec<u32> = self.card.read(&found, cubes.len())?;
        let kept: Vec<u32> = self.card.read(&open, words * cubes.len())?;
        for (cube, kept) in cubes.iter_mut().zip(kept.chunks_exact(words)) {
            cube.open
                .retain(|view| kept[usize::from(*view) / 32] >> (view % 32) & 1 == 1);
        }
        let verdict = |code: u32| match code {
            0 => Verdict::Outside,
            1 => Verdict::Inside,
            _ => Verdict::Boundary,
        };
        Ok(verdicts.into_iter().map(verdict).zip(cubes).collect())
    }

    fn measured(&self, cubes: &[Cube], far_m: f32) -> Result<Vec<f32>, GpuError> {
        let mut found = Vec::with_capacity(cubes.len() * IN_BLOCK);
        for cubes in cubes.chunks(AT_ONCE) {
            let grid = self.grid(0.0, cubes.len(), far_m)?;
            let places = self.card.given(&corners(cubes))?;
            let open = self.card.given(&self.open(cubes))?;
            let values = self.card.empty(cubes.len() * IN_BLOCK)?;
            let bound = [&grid, &self.views, &self.distances, &places, &open, &values];
            self.card.run(&self.kernels.measure, &bound, cubes.len());
            found.extend(self.card.read::<f32>(&values, cubes.len() * IN_BLOCK)?);
        }
        Ok(found)
    }

    fn told<T>(&self, found: Result<T, GpuError>) -> Result<T, CarveError> {
        found.map_err(|why| {
            self.fault.replace(Some(why));
            CarveError::Engine
        })
    }
}

impl Engine for OnCard<'_> {
    fn judge(&self, cubes: Vec<Cube>, level: u32) -> Result<Vec<(Verdict, Cube)>, CarveError> {
        self.told(self.judged(cubes, level))
    }

    fn measure(&self, cubes: &[Cube], far_m: f32) -> Result<Vec<f32>, CarveError> {
        self.told(self.measured(cubes, far_m))
    }
}

fn corners(cubes: &[Cube]) -> Vec<[u32; 4]> {
    let of = |cube: &Cube| {
        let [x, y, z] = cube.at.map(u32::from);
        [x, y, z, 0]
    };
    cubes.iter().map(of).collect()
}
