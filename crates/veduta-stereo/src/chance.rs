//! Numbers drawn from a seed, the pixel and the sweep: the same on any number of threads, and in whole
//! numbers of 32 bits, so that graphics cards draw the same.

pub struct Chance(u32);

/// Mixes all bits (Wellons 2018, hash-prospector's lowbias32).
fn mixed(given: u32) -> u32 {
    let first = (given ^ (given >> 16)).wrapping_mul(0x7feb_352d);
    let second = (first ^ (first >> 15)).wrapping_mul(0x846c_a68b);
    second ^ (second >> 16)
}

impl Chance {
    pub fn new(seed: u64, pixel: u32, sweep: u32) -> Self {
        let seeds = mixed((seed >> 32) as u32 ^ mixed(seed as u32));
        Self(mixed(pixel ^ mixed(sweep ^ seeds)))
    }

    fn next(&mut self) -> u32 {
        // The steps of splitmix (Steele, Lea and Flood 2014).
        self.0 = self.0.wrapping_add(0x9e37_79b9);
        mixed(self.0)
    }

    /// From 0 up to 1.
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 8) as f32 / (1u32 << 24) as f32
    }

    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// A direction that faces the ray, even over the half sphere.
    pub fn facing(&mut self, ray: [f32; 3]) -> [f32; 3] {
        let z = self.between(-1.0, 1.0);
        let turn = self.between(0.0, std::f32::consts::TAU);
        let r = (1.0 - z * z).max(0.0).sqrt();
        let drawn = [r * turn.cos(), r * turn.sin(), z];
        let along: f32 = (0..3).map(|i| drawn[i] * ray[i]).sum();
        if along > 0.0 {
            drawn.map(|one| -one)
        } else {
            drawn
        }
    }
}
