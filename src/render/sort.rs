//! Splats to depth order: a stable radix sort over the bits of the depth, ties by Gaussian.

/// Bits of a key looked at in one pass.
const DIGIT_BITS: u32 = 11;
const NUM_DIGITS: usize = 1 << DIGIT_BITS;

/// A splat's depth and where it is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct DepthKey {
    /// Bits of the depth, which is positive: they order as the numbers do.
    pub(super) depth_bits: u32,
    /// Where the splat is kept.
    pub(super) place: u32,
}

/// Sorts by depth, nearest first. Keys of equal depth end up in the order of `tie_break`, which tells places apart.
/// `spare` is memory to work in; it may be exchanged with `keys`.
pub(super) fn sort(keys: &mut Vec<DepthKey>, spare: &mut Vec<DepthKey>, tie_break: impl Fn(u32) -> u32) {
    spare.resize(keys.len(), DepthKey::default());
    for shift in [0, DIGIT_BITS, 2 * DIGIT_BITS] {
        if scatter(keys, spare, shift) {
            std::mem::swap(keys, spare);
        }
    }
    for ties in keys.chunk_by_mut(|a, b| a.depth_bits == b.depth_bits).filter(|ties| ties.len() > 1) {
        ties.sort_unstable_by_key(|key| tie_break(key.place));
    }
}

/// One pass: `to` is `from` in the order of one digit. False where all digits are equal and nothing was written.
fn scatter(from: &[DepthKey], to: &mut [DepthKey], shift: u32) -> bool {
    let digit = |key: &DepthKey| (key.depth_bits >> shift) as usize & (NUM_DIGITS - 1);
    let mut starts = [0_u32; NUM_DIGITS];
    for key in from {
        starts[digit(key)] += 1;
    }
    if starts.iter().any(|&count| count as usize == from.len()) {
        return false;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    for key in from {
        let start = &mut starts[digit(key)];
        to[*start as usize] = *key;
        *start += 1;
    }
    true
}
