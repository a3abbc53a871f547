//! Random numbers that belong to a place in the tree.
//!
//! The stream of a shape depends on the seed, and on the way from the start shape to it, and on
//! nothing else: editing one branch of a tree does not change another, and neither the order of
//! the work nor the number of cores is seen in the result.

/// A stream of numbers; copies go on alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stream {
    state: u64,
}

impl Stream {
    pub fn new(seed: u64) -> Self {
        Self { state: mixed(seed) }
    }

    /// The stream of the child with this number.
    pub fn child(self, index: u32) -> Self {
        Self {
            state: mixed(self.state ^ mixed(u64::from(index) + 1)),
        }
    }

    /// The next number, from 0 up to, not including, 1.
    pub fn draw(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (mixed(self.state) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014): each bit of the input moves half of those
/// of the output.
fn mixed(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
