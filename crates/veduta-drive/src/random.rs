//! Random numbers that depend on a place in the run and not on the order of threads.

/// A stream for one particle at one step (SplitMix64, Steele et al. 2014).
#[derive(Debug, Clone, Copy)]
pub struct Stream(u64);

impl Stream {
    /// The stream of a seed, a step and a particle.
    pub fn new(seed: u64, step: u64, particle: u64) -> Self {
        let mut start = Self(seed);
        let mixed = start.bits() ^ step.wrapping_mul(0xD6E8_FEB8_6659_FD93);
        let mut next = Self(mixed);
        let mixed = next.bits() ^ particle.wrapping_mul(0xA076_1D64_78BD_642F);
        Self(mixed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// From 0 up to 1, without 1.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Of mean 0 and deviation 1 (Box and Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
