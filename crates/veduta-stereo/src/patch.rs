//! The window around a pixel, weighted by (3.2), and how well a plane carries it into other views.

use crate::camera::Transfer;
use crate::grey::Grey;

/// Samples along one side of a window.
pub const SIDE: usize = 5;
pub const SAMPLES: usize = SIDE * SIDE;
/// The worst cost: a view that does not see the window, or sees another thing there.
pub const WORST: f32 = 2.0;

/// How windows are weighed and compared.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// Pixels between two samples.
    pub step_px: f32,
    /// gamma_c of (3.2): a difference in grey (of 255) that takes the weight to 1/e.
    pub gamma_grey: f32,
    /// gamma_g of (3.2): the same for the distance (px).
    pub gamma_px: f32,
    /// Noise of a pixel (grey of 255): a window that varies less says nothing.
    pub noise_grey: f32,
}

/// Samples, and as many more without a weight as make whole groups of four.
const LANES: usize = SAMPLES.next_multiple_of(4);

/// Of each sample from the middle, in steps; (x, y).
const OFFSETS: [(f32, f32); LANES] = {
    let mut made = [(0.0, 0.0); LANES];
    let mut i = 0;
    while i < SAMPLES {
        made[i] = offset(i);
        i += 1;
    }
    made
};

/// The samples of a reference window.
pub struct Patch {
    /// Weights, whose sum is 1.
    weights: [f32; LANES],
    /// Weight times what the sample differs from the mean.
    centred: [f32; LANES],
    variance: f32,
}

const fn offset(sample: usize) -> (f32, f32) {
    let half = (SIDE / 2) as f32;
    ((sample % SIDE) as f32 - half, (sample / SIDE) as f32 - half)
}

impl Patch {
    pub fn new(image: &Grey, x: usize, y: usize, window: &Window) -> Self {
        let (cx, cy) = (x as f32 + 0.5, y as f32 + 0.5);
        let own = image.at(x, y);
        let values: [f32; SAMPLES] = std::array::from_fn(|i| {
            let (dx, dy) = offset(i);
            image.sample(cx + dx * window.step_px, cy + dy * window.step_px)
        });
        let mut weights = [0.0; LANES];
        for i in 0..SAMPLES {
            let (dx, dy) = offset(i);
            let away = (dx * dx + dy * dy).sqrt() * window.step_px;
            weights[i] =
                (-((values[i] - own).abs() / window.gamma_grey + away / window.gamma_px)).exp();
        }
        let whole: f32 = weights.iter().sum();
        weights.iter_mut().for_each(|one| *one /= whole);
        let mean: f32 = weights.iter().zip(&values).map(|(w, v)| w * v).sum();
        let mut centred = [0.0; LANES];
        for i in 0..SAMPLES {
            centred[i] = weights[i] * (values[i] - mean);
        }
        let variance = (0..SAMPLES)
            .map(|i| centred[i] * (values[i] - mean))
            .sum::<f32>();
        Self {
            weights,
            centred,
            variance,
        }
    }

    /// 1 - NCC between the window and where a plane takes it in another view; WORST outside.
    ///
    /// slope: change of the inverse depth along x and y (1 / depth / px) by which the plane goes on
    /// from the inverse depth at the centre.
    pub fn cost(
        &self,
        other: &Grey,
        transfer: &Transfer,
        at: [f32; 2],
        inverse: f32,
        slope: [f32; 2],
        window: &Window,
    ) -> f32 {
        let middle = transfer.apply(at, inverse);
        if middle[2] <= 1e-6 {
            return WORST;
        }
        let (x, y) = (middle[0] / middle[2], middle[1] / middle[2]);
        if !(x >= 0.0 && y >= 0.0 && x < other.width as f32 && y < other.height as f32) {
            return WORST;
        }
        let step = window.step_px;
        let along: [[f32; 3]; 2] = std::array::from_fn(|axis| {
            std::array::from_fn(|i| step * (transfer.far[i][axis] + transfer.near[i] * slope[axis]))
        });
        let (mut us, mut vs) = ([0.0f32; LANES], [0.0f32; LANES]);
        for i in 0..LANES {
            let (dx, dy) = OFFSETS[i];
            let z = 1.0 / (middle[2] + dx * along[0][2] + dy * along[1][2]);
            us[i] = (middle[0] + dx * along[0][0] + dy * along[1][0]) * z;
            vs[i] = (middle[1] + dx * along[0][1] + dy * along[1][1]) * z;
        }
        let seen = other.samples(&us, &vs);
        let (mut means, mut squares, mut both) = ([0.0f32; 4], [0.0f32; 4], [0.0f32; 4]);
        for i in (0..LANES).step_by(4) {
            for lane in 0..4 {
                let weighted = self.weights[i + lane] * seen[i + lane];
                means[lane] += weighted;
                squares[lane] += weighted * seen[i + lane];
                both[lane] += self.centred[i + lane] * seen[i + lane];
            }
        }
        let sum = |lanes: [f32; 4]| (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
        let (mean, square, shared) = (sum(means), sum(squares), sum(both));
        let floor = window.noise_grey * window.noise_grey;
        let variance = (square - mean * mean).max(0.0) + floor;
        1.0 - shared / ((self.variance + floor) * variance).sqrt()
    }
}
