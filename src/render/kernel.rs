//! The innermost loop: one block of pixels, many splats. Color and transmittance stay in registers.
//!
//! Opacity is 2^(8 e) with e = level - u^2 - v^2. Wherever it counts e lies in -1..=0 (a cut below 1/256 goes a little
//! beyond), so 2^e is a polynomial of degree 4 and three squarings: seven operations, no rounding to integers, relative
//! error below 2.5e-5 (degree 3 would leave 6e-4, degree 5 reach 1e-6 for one operation more).

use pulp::Simd;

use super::payload::Sink;
use super::spec;

/// 2^x on -1..=0, least relative error (Remez), lowest power first.
const EXP2: [f32; 5] = [0.999_997_4, 0.693_030_2, 0.239_341_08, 0.053_074_066, 0.006_767_084];

/// A splat relative to a tile's corner: u = `ux` x + `uy` y + `u0`, v = `vy` y + `v0` at pixel (x, y) of the tile.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Record {
    pub(super) ux: f32,
    pub(super) uy: f32,
    pub(super) u0: f32,
    pub(super) vy: f32,
    pub(super) v0: f32,
    pub(super) level: f32,
    pub(super) color: [f32; 3],
    pub(super) depth: f32,
    pub(super) gaussian_idx: u32,
}

/// Splats that a tile looks at together; a power of two, so that an index is in range once masked. On the kitchen 512
/// and 1024 were 3 and 10 % slower: their lists do not stay in the cache.
pub(super) const RECORDS_LEN: usize = 256;

/// Splats blended between two looks at the transmittance; 8 and 24 took as long.
const LOOK_LEN: usize = 16;

/// Where no pixel that still takes splats has less transmittance than this many times the least allowed, the next
/// [`LOOK_LEN`] splats are blended without testing for it, and again with the test if one fell below after all.
const HEADROOM: f32 = 16.0;

/// The two cutoffs as the kernel needs them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cutoffs {
    /// Least exponent that counts.
    pub(super) level: f32,
    /// Least transmittance that blending may leave.
    pub(super) transmittance: f32,
}

/// Pixels blended together: red, green, blue and transmittance, which is negative where blending has stopped.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixels<S: Simd> {
    pub(super) red: S::f32s,
    pub(super) green: S::f32s,
    pub(super) blue: S::f32s,
    pub(super) transmittance: S::f32s,
    /// Where they are in the tile's planes.
    pub(super) first: usize,
}

/// Constants of the kernel in registers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants<S: Simd> {
    exp2: [S::f32s; 5],
    zero: S::f32s,
    one: S::f32s,
    sign: S::u32s,
    alpha_max: S::f32s,
    cut: S::f32s,
    stop: S::f32s,
    least: f32,
}

impl<S: Simd> Constants<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, cutoffs: Cutoffs) -> Self {
        let [c0, c1, c2, c3, c4] = EXP2;
        let (c0, c1, c2) = (simd.splat_f32s(c0), simd.splat_f32s(c1), simd.splat_f32s(c2));
        Self {
            exp2: [c0, c1, c2, simd.splat_f32s(c3), simd.splat_f32s(c4)],
            zero: simd.splat_f32s(0.0),
            one: simd.splat_f32s(1.0),
            sign: simd.splat_u32s(1 << 31),
            alpha_max: simd.splat_f32s(spec::ALPHA_MAX as f32),
            cut: simd.splat_f32s(cutoffs.level),
            stop: simd.splat_f32s(cutoffs.transmittance),
            least: cutoffs.transmittance,
        }
    }
}

/// Blends splats into two groups of pixels side by side, at (`x`[0], `y`) and (`x`[1], `y`) of the tile. Two at once
/// share what depends on y alone.
pub(super) struct Blender<'a, S: Simd, K> {
    pub(super) simd: S,
    pub(super) records: &'a [Record; RECORDS_LEN],
    pub(super) x: [S::f32s; 2],
    pub(super) y: S::f32s,
    pub(super) constants: &'a Constants<S>,
    pub(super) sink: &'a mut K,
}

impl<S: Simd, K: Sink> Blender<'_, S, K> {
    /// Blends the listed splats; true when no pixel takes any more.
    #[inline(always)]
    pub(super) fn blend(&mut self, list: &[u16], pixels: &mut [Pixels<S>; 2]) -> bool {
        let (simd, constants) = (self.simd, *self.constants);
        let mut least = self.least_open(pixels, pixels);
        for some in list.chunks(LOOK_LEN) {
            // A sink must not see a weight twice.
            if !K::IS_ACTIVE && least >= HEADROOM * constants.least {
                let before = *pixels;
                for half in pixels.iter_mut() {
                    half.transmittance = simd.max_f32s(half.transmittance, constants.zero);
                }
                self.add_all::<Freely>(some, pixels);
                least = self.least_open(&before, pixels);
                if least >= constants.least {
                    for (half, before) in pixels.iter_mut().zip(&before) {
                        let is_open = simd.greater_than_f32s(before.transmittance, constants.zero);
                        half.transmittance = simd.select_f32s(is_open, half.transmittance, before.transmittance);
                    }
                    continue;
                }
                *pixels = before;
            }
            self.add_all::<Carefully>(some, pixels);
            let open = simd.max_f32s(pixels[0].transmittance, pixels[1].transmittance);
            if simd.reduce_max_f32s(open) <= 0.0 {
                return true;
            }
            least = self.least_open(pixels, pixels);
        }
        false
    }

    /// Least transmittance over the pixels that were still open `before`; 1 where none was.
    #[inline(always)]
    fn least_open(&self, before: &[Pixels<S>; 2], now: &[Pixels<S>; 2]) -> f32 {
        let (simd, zero, one) = (self.simd, self.constants.zero, self.constants.one);
        let left_is_open = simd.greater_than_f32s(before[0].transmittance, zero);
        let right_is_open = simd.greater_than_f32s(before[1].transmittance, zero);
        let left = simd.select_f32s(left_is_open, now[0].transmittance, one);
        let right = simd.select_f32s(right_is_open, now[1].transmittance, one);
        simd.reduce_min_f32s(simd.min_f32s(left, right))
    }

    /// Adds the listed splats, nearest first.
    ///
    /// Opacities are computed for two splats and both halves side by side: each is a chain of twenty operations that
    /// wait for one another, and the processor looks ahead only so far.
    #[inline(always)]
    fn add_all<A: Addition>(&mut self, list: &[u16], pixels: &mut [Pixels<S>; 2]) {
        let (pairs, last) = list.as_chunks::<2>();
        for &[first, second] in pairs {
            let (first, second) = (usize::from(first) % RECORDS_LEN, usize::from(second) % RECORDS_LEN);
            let [a, b] = self.exponents(first);
            let [c, d] = self.exponents(second);
            let [a, b, c, d] = self.alphas([a, b, c, d]);
            A::add(self, first, a, &mut pixels[0]);
            A::add(self, first, b, &mut pixels[1]);
            A::add(self, second, c, &mut pixels[0]);
            A::add(self, second, d, &mut pixels[1]);
        }
        for &position in last {
            let position = usize::from(position) % RECORDS_LEN;
            let [a, b] = self.alphas(self.exponents(position));
            A::add(self, position, a, &mut pixels[0]);
            A::add(self, position, b, &mut pixels[1]);
        }
    }

    /// Exponents of a splat in both halves.
    #[inline(always)]
    fn exponents(&self, position: usize) -> [S::f32s; 2] {
        let (simd, record) = (self.simd, &self.records[position]);
        let ux = simd.splat_f32s(record.ux);
        let along = simd.mul_add_f32s(simd.splat_f32s(record.uy), self.y, simd.splat_f32s(record.u0));
        let v = simd.mul_add_f32s(simd.splat_f32s(record.vy), self.y, simd.splat_f32s(record.v0));
        let level = simd.negate_mul_add_f32s(v, v, simd.splat_f32s(record.level));
        let (left, right) = (simd.mul_add_f32s(ux, self.x[0], along), simd.mul_add_f32s(ux, self.x[1], along));
        [simd.negate_mul_add_f32s(left, left, level), simd.negate_mul_add_f32s(right, right, level)]
    }

    /// Opacities of exponents, 0 where they are below the cut.
    #[inline(always)]
    fn alphas<const N: usize>(&self, e: [S::f32s; N]) -> [S::f32s; N] {
        let (simd, constants) = (self.simd, self.constants);
        let [c0, c1, c2, c3, c4] = constants.exp2;
        let mut power = [c4; N];
        for coefficient in [c3, c2, c1, c0] {
            for lane in 0..N {
                power[lane] = simd.mul_add_f32s(power[lane], e[lane], coefficient);
            }
        }
        for _ in 0..3 {
            for power in &mut power {
                *power = simd.mul_f32s(*power, *power);
            }
        }
        for lane in 0..N {
            let alpha = simd.min_f32s(power[lane], constants.alpha_max);
            let counts = simd.greater_than_or_equal_f32s(e[lane], constants.cut);
            power[lane] = simd.select_f32s(counts, alpha, constants.zero);
        }
        power
    }

    #[inline(always)]
    fn add_weight(&mut self, position: usize, weight: S::f32s, pixels: &mut Pixels<S>) {
        let (simd, [red, green, blue]) = (self.simd, self.records[position].color);
        pixels.red = simd.mul_add_f32s(weight, simd.splat_f32s(red), pixels.red);
        pixels.green = simd.mul_add_f32s(weight, simd.splat_f32s(green), pixels.green);
        pixels.blue = simd.mul_add_f32s(weight, simd.splat_f32s(blue), pixels.blue);
        if K::IS_ACTIVE {
            self.sink.take(position, pixels.first, bytemuck::cast_slice(std::slice::from_ref(&weight)));
        }
    }
}

/// How a splat is added to pixels. A trait and no closure: code in closures is not compiled for the instruction set.
trait Addition {
    fn add<S: Simd, K: Sink>(blender: &mut Blender<'_, S, K>, position: usize, alpha: S::f32s, pixels: &mut Pixels<S>);
}

/// To pixels that take splats or have transmittance 0.
struct Freely;

impl Addition for Freely {
    #[inline(always)]
    fn add<S: Simd, K: Sink>(blender: &mut Blender<'_, S, K>, position: usize, alpha: S::f32s, pixels: &mut Pixels<S>) {
        let weight = blender.simd.mul_f32s(alpha, pixels.transmittance);
        let rest = blender.simd.negate_mul_add_f32s(alpha, pixels.transmittance, pixels.transmittance);
        pixels.transmittance = rest;
        blender.add_weight(position, weight, pixels);
    }
}

/// Unless it would take the transmittance below what is allowed: there blending stops.
struct Carefully;

impl Addition for Carefully {
    #[inline(always)]
    fn add<S: Simd, K: Sink>(blender: &mut Blender<'_, S, K>, position: usize, alpha: S::f32s, pixels: &mut Pixels<S>) {
        let (simd, constants, before) = (blender.simd, blender.constants, pixels.transmittance);
        // Where blending has stopped the transmittance is negative, and so is the rest: it stays stopped.
        let rest = simd.negate_mul_add_f32s(alpha, before, before);
        let goes_on = simd.greater_than_or_equal_f32s(rest, constants.stop);
        let weight = simd.select_f32s(goes_on, simd.mul_f32s(alpha, before), constants.zero);
        let stopped = simd.or_u32s(simd.transmute_u32s_f32s(before), constants.sign);
        pixels.transmittance = simd.select_f32s(goes_on, rest, simd.transmute_f32s_u32s(stopped));
        blender.add_weight(position, weight, pixels);
    }
}
