//! Numbers drawn from a seed, the pixel and the sweep: the same on any number of threads.

pub struct Chance(u64);

impl Chance {
    pub fn new(seed: u64, pixel: u64, sweep: u64) -> Self {
        let mut made = Self(
            seed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
                ^ pixel.wrapping_mul(0xBF58_476D_1CE4_E5B9)
                ^ sweep.wrapping_mul(0x94D0_49BB_1331_11EB),
        );
        made.next();
        made
    }

    fn next(&mut self) -> u64 {
        // splitmix64 (Steele, Lea and Flood 2014)
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From 0 up to 1.
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1u64 << 24) as f32
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
