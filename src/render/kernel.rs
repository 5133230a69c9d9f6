//! The innermost loop: one block of pixels, many splats. Color and transmittance stay in registers.
//!
//! Opacity is 2^(8 e) with e = level - u^2 - v^2. How that power is found, from e or from numbers made for it, and who
//! decides when blending stops, each pixel or the whole block, is the [`Arithmetic`].

use pulp::Simd;

use super::payload::Sink;
use super::pixels::{HALF_LEN, Pixels, TilePixels, centers};
use super::record::{RECORDS_LEN, Record};
use super::spec;

/// Splats blended between two looks at the transmittance; 8 and 24 took as long.
const CHECK_INTERVAL: usize = 16;

/// The two cutoffs as the kernel needs them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cutoffs {
    /// Least exponent that counts, as [`Arithmetic::level`] makes it.
    pub(super) level: f32,
    /// Least transmittance that blending may leave.
    pub(super) transmittance: f32,
}

/// Constants of the kernel in registers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants<S: Simd> {
    zero: S::f32s,
    alpha_max: S::f32s,
    cut: S::f32s,
    pub(super) stop: S::f32s,
}

impl<S: Simd> Constants<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, cutoffs: Cutoffs) -> Self {
        Self {
            zero: simd.splat_f32s(0.0),
            alpha_max: simd.splat_f32s(spec::ALPHA_MAX as f32),
            cut: simd.splat_f32s(cutoffs.level),
            stop: simd.splat_f32s(cutoffs.transmittance),
        }
    }
}

/// How opacities are computed and added. A trait and no closure: code in closures is not compiled for the instruction set.
pub(super) trait Arithmetic {
    /// Whether each pixel stops on its own, as in the spec image.
    const STOPS_EACH_PIXEL: bool;
    /// What u and v of a [`Record`] are multiplied by.
    const OFFSET_UNIT: f32;

    /// What an exponent e becomes in a [`Record`]; the square of [`Arithmetic::OFFSET_UNIT`] is its slope.
    fn level(exponent: f32) -> f32;

    /// Opacities of exponents as [`Arithmetic::level`] makes them, right where they are not below the cut.
    fn powers<S: Simd, const N: usize>(simd: S, levels: [S::f32s; N]) -> [S::f32s; N];
}

/// As the spec image: each pixel stops before its transmittance would fall below the least allowed; relative error of
/// opacities below 2.5e-5.
pub(super) struct Exact;

/// A block stops once all its pixels are below the least transmittance, which takes three operations a splat less than
/// asking each pixel; until then its pixels are nearer to the spec image than if they had stopped. Opacities are off by
/// 0.8 % of themselves, and not held to 0.99.
pub(super) struct Quick;

impl Arithmetic for Exact {
    const STOPS_EACH_PIXEL: bool = true;
    const OFFSET_UNIT: f32 = 1.0;

    #[inline(always)]
    fn level(exponent: f32) -> f32 {
        exponent
    }

    /// Wherever an opacity counts, e lies in -1..=0 (a cut below 1/256 goes a little beyond): a polynomial for 2^e, that
    /// of least relative error (Remez), and three squarings.
    #[inline(always)]
    fn powers<S: Simd, const N: usize>(simd: S, levels: [S::f32s; N]) -> [S::f32s; N] {
        const TERMS: [f32; 5] = [0.006_767_084, 0.053_074_066, 0.239_341_08, 0.693_030_2, 0.999_997_4];
        let mut power = [simd.splat_f32s(TERMS[0]); N];
        for term in &TERMS[1..] {
            for lane in 0..N {
                power[lane] = simd.mul_add_f32s(power[lane], levels[lane], simd.splat_f32s(*term));
            }
        }
        for _ in 0..3 {
            for power in &mut power {
                *power = simd.mul_f32s(*power, *power);
            }
        }
        power
    }
}

impl Quick {
    /// Bits behind the point of a binary logarithm in the mantissa of its level.
    const FRACTION_BITS: u32 = 15;
    /// From where on a number's last bit counts 1.
    const FIRST: f32 = 8_388_608.0;
    /// Exponent of 1 in the bits of a number, less what makes the mean of the two interpolations below right.
    const BIAS: f32 = 127.0 - 1.053_8;
}

impl Arithmetic for Quick {
    const STOPS_EACH_PIXEL: bool = false;
    /// The root of 8 exponents to a logarithm times 2^15 levels to the unit.
    const OFFSET_UNIT: f32 = 512.0;

    #[inline(always)]
    fn level(exponent: f32) -> f32 {
        let ones = (1 << Self::FRACTION_BITS) as f32;
        exponent * (Self::OFFSET_UNIT * Self::OFFSET_UNIT) + (Self::FIRST + Self::BIAS * ones)
    }

    /// The last bits of a level are the logarithm in fixed point. Moved to where a number has its exponent they are a
    /// number: 2^x at whole x and on straight lines between them, as much as 6.2 % too high (Schraudolph 1999). The mean
    /// of that and the same with knots half a step aside is too high by 3.0 to 4.6 %, of which the bias takes 3.8 off.
    #[inline(always)]
    fn powers<S: Simd, const N: usize>(simd: S, levels: [S::f32s; N]) -> [S::f32s; N] {
        let places = simd.splat_u32s(23 - Self::FRACTION_BITS);
        let half_root = simd.splat_f32s(std::f32::consts::FRAC_1_SQRT_2);
        let mut powers = levels;
        for power in &mut powers {
            let bits = simd.wrapping_dyn_shl_u32s(simd.transmute_u32s_f32s(*power), places);
            let aside = simd.add_u32s(bits, simd.splat_u32s(1 << 22));
            *power = simd.mul_add_f32s(simd.transmute_f32s_u32s(aside), half_root, simd.transmute_f32s_u32s(bits));
        }
        powers
    }
}

/// A block of pixels of a tile on its way through a list of splats.
pub(super) struct Blender<'a, S: Simd, K> {
    pub(super) simd: S,
    pub(super) records: &'a [Record; RECORDS_LEN],
    pub(super) constants: &'a Constants<S>,
    pub(super) pixels: &'a mut TilePixels,
    pub(super) sink: &'a mut K,
}

impl<S: Simd, K: Sink> Blender<'_, S, K> {
    /// Blends the listed splats into a block; true when no pixel of it takes any more.
    ///
    /// Where registers hold less than half a block, the list is gone through a few splats at a time, so that the block
    /// stops after the same splat whatever their width.
    #[inline(always)]
    pub(super) fn blend<A: Arithmetic>(&mut self, block: usize, list: &[u8]) -> bool {
        if S::F32_LANES == HALF_LEN {
            let mut registers = self.load::<A>(block, 0);
            let is_done = list.chunks(CHECK_INTERVAL).any(|chunk| !self.blend_all::<A>(chunk, &mut registers));
            self.store::<A>(&registers);
            return is_done;
        }
        for chunk in list.chunks(CHECK_INTERVAL) {
            let mut is_open = false;
            for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
                let mut registers = self.load::<A>(block, first_lane);
                is_open |= self.blend_all::<A>(chunk, &mut registers);
                self.store::<A>(&registers);
            }
            if !is_open {
                return true;
            }
        }
        false
    }

    /// Pixels of both halves of a block.
    #[inline(always)]
    fn load<A: Arithmetic>(&self, block: usize, first_lane: usize) -> BlockRegisters<S> {
        let simd = self.simd;
        let pixels = [0, 1].map(|half| {
            let pixels = self.pixels.load(simd, 2 * block + half, first_lane);
            if !A::STOPS_EACH_PIXEL {
                return pixels;
            }
            // A negative number is the rest of a pixel that takes no more.
            let transmittance = simd.max_f32s(pixels.transmittance, self.constants.zero);
            Pixels { rest: simd.abs_f32s(pixels.transmittance), transmittance, ..pixels }
        });
        let (x, y) = centers(simd, block, first_lane);
        BlockRegisters { x, y, pixels }
    }

    /// Writes pixels back.
    #[inline(always)]
    fn store<A: Arithmetic>(&mut self, registers: &BlockRegisters<S>) {
        let simd = self.simd;
        for pixels in &registers.pixels {
            let mut pixels = *pixels;
            if A::STOPS_EACH_PIXEL {
                let is_open = simd.greater_than_or_equal_f32s(pixels.transmittance, self.constants.stop);
                let stopped = simd.neg_f32s(pixels.rest);
                pixels.transmittance = simd.select_f32s(is_open, pixels.transmittance, stopped);
            }
            self.pixels.store(simd, &pixels);
        }
    }

    /// Adds the listed splats, nearest first; whether a pixel takes more.
    ///
    /// Opacities are computed for two splats and both halves side by side: each is a chain of twenty operations that
    /// wait for one another, and the processor looks ahead only so far. Sixteen registers are too few for that.
    #[inline(always)]
    fn blend_all<A: Arithmetic>(&mut self, list: &[u8], registers: &mut BlockRegisters<S>) -> bool {
        let simd = self.simd;
        let (pairs, last) = if S::REGISTER_COUNT < 32 { (&[][..], list) } else { list.as_chunks::<2>() };
        for &[first, second] in pairs {
            let (first, second) = (usize::from(first) % RECORDS_LEN, usize::from(second) % RECORDS_LEN);
            let [a, b] = self.exponents(first, registers);
            let [c, d] = self.exponents(second, registers);
            let [a, b, c, d] = self.alphas::<A, 4>([a, b, c, d]);
            self.add::<A>(first, a, &mut registers.pixels[0]);
            self.add::<A>(first, b, &mut registers.pixels[1]);
            self.add::<A>(second, c, &mut registers.pixels[0]);
            self.add::<A>(second, d, &mut registers.pixels[1]);
        }
        for &position in last {
            let position = usize::from(position) % RECORDS_LEN;
            let [a, b] = self.alphas::<A, 2>(self.exponents(position, registers));
            self.add::<A>(position, a, &mut registers.pixels[0]);
            self.add::<A>(position, b, &mut registers.pixels[1]);
        }
        let most = simd.max_f32s(registers.pixels[0].transmittance, registers.pixels[1].transmittance);
        any::<S>(simd.greater_than_or_equal_f32s(most, self.constants.stop))
    }

    /// Exponents of a splat in both halves.
    #[inline(always)]
    fn exponents(&self, position: usize, BlockRegisters { x, y, .. }: &BlockRegisters<S>) -> [S::f32s; 2] {
        let (simd, record) = (self.simd, &self.records[position]);
        let ux = simd.splat_f32s(record.ux);
        let along = simd.mul_add_f32s(simd.splat_f32s(record.uy), *y, simd.splat_f32s(record.u0));
        let v = simd.mul_add_f32s(simd.splat_f32s(record.vy), *y, simd.splat_f32s(record.v0));
        let level = simd.negate_mul_add_f32s(v, v, simd.splat_f32s(record.level));
        let (left, right) = (simd.mul_add_f32s(ux, x[0], along), simd.mul_add_f32s(ux, x[1], along));
        [simd.negate_mul_add_f32s(left, left, level), simd.negate_mul_add_f32s(right, right, level)]
    }

    /// Opacities of exponents, 0 where they are below the cut.
    #[inline(always)]
    fn alphas<A: Arithmetic, const N: usize>(&self, e: [S::f32s; N]) -> [S::f32s; N] {
        let (simd, constants) = (self.simd, self.constants);
        let mut power = A::powers(simd, e);
        for lane in 0..N {
            let alpha = if A::STOPS_EACH_PIXEL { simd.min_f32s(power[lane], constants.alpha_max) } else { power[lane] };
            let counts = simd.greater_than_or_equal_f32s(e[lane], constants.cut);
            power[lane] = simd.select_f32s(counts, alpha, constants.zero);
        }
        power
    }

    /// Adds one splat to pixels.
    #[inline(always)]
    fn add<A: Arithmetic>(&mut self, position: usize, alpha: S::f32s, pixels: &mut Pixels<S>) {
        let (simd, before) = (self.simd, pixels.transmittance);
        let mut weight = simd.mul_f32s(alpha, before);
        pixels.transmittance = simd.negate_mul_add_f32s(alpha, before, before);
        if A::STOPS_EACH_PIXEL {
            // Once below, the transmittance stays below: what has stopped does not go on.
            let goes_on = simd.greater_than_or_equal_f32s(pixels.transmittance, self.constants.stop);
            weight = simd.select_f32s(goes_on, weight, self.constants.zero);
            pixels.rest = simd.select_f32s(goes_on, pixels.transmittance, pixels.rest);
        }
        let [red, green, blue] = self.records[position].color;
        pixels.red = simd.mul_add_f32s(weight, simd.splat_f32s(red), pixels.red);
        pixels.green = simd.mul_add_f32s(weight, simd.splat_f32s(green), pixels.green);
        pixels.blue = simd.mul_add_f32s(weight, simd.splat_f32s(blue), pixels.blue);
        if K::IS_ACTIVE {
            self.sink.add(position, pixels.first, bytemuck::cast_slice(std::slice::from_ref(&weight)));
        }
    }
}

/// Registers of pixels of the left and right half of a block, which share what depends on y alone.
struct BlockRegisters<S: Simd> {
    x: [S::f32s; 2],
    y: S::f32s,
    pixels: [Pixels<S>; 2],
}

/// Whether a mask has a lane set.
#[inline(always)]
fn any<S: Simd>(mask: S::m32s) -> bool {
    bytemuck::bytes_of(&mask).iter().fold(0, |all, byte| all | byte) != 0
}
