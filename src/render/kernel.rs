//! The innermost loop: blends many splats into one block of pixels. Color and transmittance stay in registers.
//!
//! Enters: the records of a chunk of splats and the list of those that cover the block, nearest first. Leaves: the
//! block's pixels: either their colors or, for a [`Sink`], the weights of the splats. The opacity is 2^(8 e) with e = level - u^2 - v^2. An [`Arithmetic`]
//! decides how that power is computed, and whether each pixel or the whole block stops.

use pulp::Simd;

use super::payload::Sink;
use super::pixels::{BlockValues, HALF_LEN, Pixels, TilePixels, centers};
use super::record::{RECORDS_LEN, Record};
use super::spec;

/// Splats blended between two checks of the transmittance; 8 and 24 took as long.
pub(super) const CHECK_INTERVAL: usize = 16;

/// The alpha cut and the transmittance stop in the units of the kernel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cutoffs {
    /// Exponent of the alpha cut, converted by [`Arithmetic::level`].
    pub(super) level: f32,
    /// Transmittance below which blending stops.
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

/// How opacities are computed and blended. A trait, because closures are not compiled for the instruction set.
pub(super) trait Arithmetic {
    /// Whether each pixel stops on its own, as in the spec image.
    const STOPS_EACH_PIXEL: bool;
    /// Factor of u and v in a [`Record`].
    const OFFSET_UNIT: f32;

    /// Converts an exponent e to the units of a [`Record`]: linear, with the square of [`Arithmetic::OFFSET_UNIT`] as
    /// slope.
    fn level(exponent: f32) -> f32;

    /// Opacities from exponents in the units of [`Arithmetic::level`]; unspecified below the alpha cut.
    fn powers<S: Simd, const N: usize>(simd: S, levels: [S::f32s; N]) -> [S::f32s; N];
}

/// As in the spec image: each pixel stops before its transmittance would fall below the stop. Relative error of
/// opacities below 2.5e-5.
pub(super) struct Exact;

/// A block stops when all of its pixels are below the stop, which saves three operations per splat. Pixels that blend
/// on until then are closer to the spec image than pixels that stop. Opacities have a relative error up to 0.8 % and
/// are not clamped to 0.99.
pub(super) struct Quick;

impl Arithmetic for Exact {
    const STOPS_EACH_PIXEL: bool = true;
    const OFFSET_UNIT: f32 = 1.0;

    #[inline(always)]
    fn level(exponent: f32) -> f32 {
        exponent
    }

    /// Above the alpha cut e is in -1..=0 (slightly below -1 for a cut below 1/256). Evaluates the polynomial for 2^e
    /// with the smallest maximal relative error (Remez) and squares it three times.
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
    /// Fraction bits of the binary logarithm, in fixed point in the mantissa of a level.
    const FRACTION_BITS: u32 = 15;
    /// 2^23: from here on, neighboring `f32` numbers differ by 1.
    const FIRST: f32 = 8_388_608.0;
    /// Exponent bits of 1.0, minus a correction that centers the error of the two interpolations in `powers`.
    const BIAS: f32 = 127.0 - 1.053_8;
}

impl Arithmetic for Quick {
    const STOPS_EACH_PIXEL: bool = false;
    /// sqrt(8 * 2^15): the logarithm is 8 times the exponent e and has 2^15 levels per unit.
    const OFFSET_UNIT: f32 = 512.0;

    #[inline(always)]
    fn level(exponent: f32) -> f32 {
        let ones = (1 << Self::FRACTION_BITS) as f32;
        exponent * (Self::OFFSET_UNIT * Self::OFFSET_UNIT) + (Self::FIRST + Self::BIAS * ones)
    }

    /// The low bits of a level are the logarithm x in fixed point. Shifted to the exponent of an `f32` they give 2^x at
    /// integer x and linear interpolation in between, up to 6.2 % too high (Schraudolph 1999). The mean of this and of
    /// the same with knots shifted by half a step is 3.0 to 4.6 % too high; the bias removes 3.8 %.
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

/// Blends lists of splats into blocks of a tile.
pub(super) struct Blender<'a, S: Simd, K> {
    pub(super) simd: S,
    pub(super) records: &'a [Record; RECORDS_LEN],
    pub(super) constants: &'a Constants<S>,
    pub(super) pixels: &'a mut TilePixels,
    pub(super) sink: &'a mut K,
    /// Weights of the splats since the last check of the transmittance, for the sink.
    pub(super) weights: &'a mut [BlockValues; CHECK_INTERVAL],
}

impl<S: Simd, K: Sink> Blender<'_, S, K> {
    /// Blends the listed splats into a block; returns true if no pixel of the block takes more splats.
    ///
    /// If a register holds less than half a block, the list is processed in chunks of [`CHECK_INTERVAL`], so that the
    /// block stops after the same splat for any register width.
    #[inline(always)]
    pub(super) fn blend<A: Arithmetic>(&mut self, block: usize, list: &[u8]) -> bool {
        if S::F32_LANES == HALF_LEN {
            let mut registers = self.load::<A>(block, 0);
            let mut is_open = true;
            for chunk in list.chunks(CHECK_INTERVAL) {
                is_open = self.blend_all::<A>(chunk, 0, &mut registers);
                self.pass_on(block, chunk);
                if !is_open {
                    break;
                }
            }
            self.store::<A>(&registers);
            return !is_open;
        }
        for chunk in list.chunks(CHECK_INTERVAL) {
            let mut is_open = false;
            for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
                let mut registers = self.load::<A>(block, first_lane);
                is_open |= self.blend_all::<A>(chunk, first_lane, &mut registers);
                self.store::<A>(&registers);
            }
            self.pass_on(block, chunk);
            if !is_open {
                return true;
            }
        }
        false
    }

    /// Passes the weights of the listed splats, which were just blended, to the sink.
    #[inline(always)]
    fn pass_on(&mut self, block: usize, list: &[u8]) {
        if K::TAKES_WEIGHTS {
            self.sink.add_block(self.simd, block, list, &self.weights[..list.len().min(CHECK_INTERVAL)]);
        }
    }

    /// Loads the pixels of both halves of a block.
    #[inline(always)]
    fn load<A: Arithmetic>(&self, block: usize, first_lane: usize) -> BlockRegisters<S> {
        let simd = self.simd;
        let pixels = [0, 1].map(|half| {
            let pixels = self.pixels.load(simd, 2 * block + half, first_lane);
            if !A::STOPS_EACH_PIXEL {
                return pixels;
            }
            // A negative transmittance marks a pixel that has stopped.
            let transmittance = simd.max_f32s(pixels.transmittance, self.constants.zero);
            Pixels { rest: simd.abs_f32s(pixels.transmittance), transmittance, ..pixels }
        });
        let (x, y) = centers(simd, block, first_lane);
        BlockRegisters { x, y, pixels }
    }

    /// Stores the pixels of both halves of a block.
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
            if K::TAKES_WEIGHTS {
                self.pixels.store_transmittance(simd, &pixels);
            } else {
                self.pixels.store(simd, &pixels);
            }
        }
    }

    /// Blends the listed splats, nearest first; returns whether any pixel takes more. `first_lane` is where the registers
    /// begin in their half blocks.
    ///
    /// Opacities are computed for two splats and both halves together: each is a chain of twenty dependent operations,
    /// too long for out-of-order execution to overlap. With only 16 registers, values would spill to memory.
    #[inline(always)]
    fn blend_all<A: Arithmetic>(&mut self, list: &[u8], first_lane: usize, registers: &mut BlockRegisters<S>) -> bool {
        let simd = self.simd;
        let (pairs, last) = if S::REGISTER_COUNT < 32 { (&[][..], list) } else { list.as_chunks::<2>() };
        for (pair, &[first, second]) in pairs.iter().enumerate() {
            let (first, second) = (usize::from(first) % RECORDS_LEN, usize::from(second) % RECORDS_LEN);
            let [a, b] = self.exponents(first, registers);
            let [c, d] = self.exponents(second, registers);
            let [a, b, c, d] = self.alphas::<A, 4>([a, b, c, d]);
            self.add::<A>(first, [a, b], registers, (2 * pair, first_lane));
            self.add::<A>(second, [c, d], registers, (2 * pair + 1, first_lane));
        }
        for (place, &position) in (list.len() - last.len()..).zip(last) {
            let position = usize::from(position) % RECORDS_LEN;
            let alphas = self.alphas::<A, 2>(self.exponents(position, registers));
            self.add::<A>(position, alphas, registers, (place, first_lane));
        }
        let most = simd.max_f32s(registers.pixels[0].transmittance, registers.pixels[1].transmittance);
        any::<S>(simd.greater_than_or_equal_f32s(most, self.constants.stop))
    }

    /// Exponents of a splat at the pixels of both halves.
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

    /// Opacities from exponents; 0 below the alpha cut.
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

    /// Blends one splat into the pixels of both halves. `place` and `first_lane` are where its weights go.
    #[inline(always)]
    fn add<A: Arithmetic>(
        &mut self,
        position: usize,
        alphas: [S::f32s; 2],
        registers: &mut BlockRegisters<S>,
        (place, first_lane): (usize, usize),
    ) {
        let [left, right] = &mut registers.pixels;
        let weights = [self.weight::<A>(alphas[0], left), self.weight::<A>(alphas[1], right)];
        if K::TAKES_WEIGHTS {
            self.weights[place % CHECK_INTERVAL].store(self.simd, first_lane, weights);
        } else {
            self.add_color(position, weights[0], left);
            self.add_color(position, weights[1], right);
        }
    }

    /// The weight of a splat in pixels, whose transmittance it reduces.
    #[inline(always)]
    fn weight<A: Arithmetic>(&self, alpha: S::f32s, pixels: &mut Pixels<S>) -> S::f32s {
        let (simd, before) = (self.simd, pixels.transmittance);
        let weight = simd.mul_f32s(alpha, before);
        pixels.transmittance = simd.negate_mul_add_f32s(alpha, before, before);
        if !A::STOPS_EACH_PIXEL {
            return weight;
        }
        // Once below the stop, the transmittance stays below it: a stopped pixel does not resume.
        let goes_on = simd.greater_than_or_equal_f32s(pixels.transmittance, self.constants.stop);
        pixels.rest = simd.select_f32s(goes_on, pixels.transmittance, pixels.rest);
        simd.select_f32s(goes_on, weight, self.constants.zero)
    }

    /// Adds the color of a splat to pixels.
    #[inline(always)]
    fn add_color(&self, position: usize, weight: S::f32s, pixels: &mut Pixels<S>) {
        let (simd, [red, green, blue]) = (self.simd, self.records[position].color);
        pixels.red = simd.mul_add_f32s(weight, simd.splat_f32s(red), pixels.red);
        pixels.green = simd.mul_add_f32s(weight, simd.splat_f32s(green), pixels.green);
        pixels.blue = simd.mul_add_f32s(weight, simd.splat_f32s(blue), pixels.blue);
    }
}

/// Pixels of the left and right half of a block, which share their y positions.
struct BlockRegisters<S: Simd> {
    x: [S::f32s; 2],
    y: S::f32s,
    pixels: [Pixels<S>; 2],
}

/// Whether any lane of a mask is set.
#[inline(always)]
fn any<S: Simd>(mask: S::m32s) -> bool {
    bytemuck::bytes_of(&mask).iter().fold(0, |all, byte| all | byte) != 0
}
