use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Seeded random numbers for layouts and shapes: equal seed and stream give equal draws on every machine.
pub(super) struct SceneRng(Pcg64);

impl SceneRng {
    /// The generator of a seed and a stream; streams of one seed are independent.
    pub(super) fn new(seed: u64, stream: u64) -> Self {
        Self(Pcg64::seed_from_u64(
            seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ stream.wrapping_mul(0xD1B5_4A32_D192_ED03),
        ))
    }

    /// Uniform in 0..1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in `low..high`.
    pub(super) fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// True with the given probability.
    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// Uniform index in 0..count; 0 if `count` is 0.
    pub(super) fn index(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// A uniformly drawn element of a slice, which must not be empty.
    pub(super) fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.index(items.len())]
    }

    /// A seed for the noise of a material.
    pub(super) fn seed(&mut self) -> u32 {
        (self.0.next_u64() >> 32) as u32
    }
}
