//! The innermost loop: one block of pixels, many splats. Color and transmittance stay in registers.
//!
//! Opacity is 2^(8 e) with e = level - u^2 - v^2. Wherever it counts e lies in -1..=0 (a cut below 1/256 goes a little
//! beyond), so 2^e is a polynomial and three squarings, without rounding to integers. How many terms the polynomial has
//! and who decides when blending stops, each pixel or the whole block, is the [`Arithmetic`].

use pulp::Simd;

use super::payload::Sink;
use super::pixels::{HALF_LEN, HALF_WIDTH, TilePixels, half_block_centers, load};
use super::spec;

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

/// Splats that a tile looks at together: as many as a byte can number.
pub(super) const RECORDS_LEN: usize = 256;

/// Splats blended between two looks at the transmittance; 8 and 24 took as long.
const LOOK_LEN: usize = 16;

/// The two cutoffs as the kernel needs them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cutoffs {
    /// Least exponent that counts.
    pub(super) level: f32,
    /// Least transmittance that blending may leave.
    pub(super) transmittance: f32,
}

/// Pixels blended together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixels<S: Simd> {
    pub(super) red: S::f32s,
    pub(super) green: S::f32s,
    pub(super) blue: S::f32s,
    /// Of all splats so far; below the least allowed where a pixel takes no more.
    pub(super) transmittance: S::f32s,
    /// Of the splats that the pixel took; kept only where each pixel stops on its own.
    pub(super) rest: S::f32s,
    /// The first one's number in the tile.
    pub(super) first: usize,
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

    /// 2^x on -1..=0.
    fn exp2<S: Simd, const N: usize>(simd: S, x: [S::f32s; N]) -> [S::f32s; N];
}

/// As the spec image: each pixel stops before its transmittance would fall below the least allowed; relative error of
/// opacities below 2.5e-5.
pub(super) struct Exact;

/// A block stops once all its pixels are below the least transmittance, which takes three operations a splat less than
/// asking each pixel; until then its pixels are nearer to the spec image than if they had stopped. Opacities are off by
/// 0.0071 at most and by 2.9 % of themselves, and not held to 0.99; a polynomial of degree 3 would leave 6.0e-4 and took
/// 5 % longer on the kitchen. Only for cuts of 1/256 and above.
pub(super) struct Quick;

impl Arithmetic for Exact {
    const STOPS_EACH_PIXEL: bool = true;

    #[inline(always)]
    fn exp2<S: Simd, const N: usize>(simd: S, x: [S::f32s; N]) -> [S::f32s; N] {
        polynomial(simd, [0.999_997_4, 0.693_030_2, 0.239_341_08, 0.053_074_066, 0.006_767_084], x)
    }
}

impl Arithmetic for Quick {
    const STOPS_EACH_PIXEL: bool = false;

    #[inline(always)]
    fn exp2<S: Simd, const N: usize>(simd: S, x: [S::f32s; N]) -> [S::f32s; N] {
        polynomial(simd, [0.999_111_4, 0.672_792_5, 0.175_458_31], x)
    }
}

/// A polynomial for 2^x, lowest power first: of degree 4 that of least relative error on -1..=0, of degree 2 that of least
/// relative error times 4^x, since faint splats may be off by more (Remez).
#[inline(always)]
fn polynomial<S: Simd, const T: usize, const N: usize>(simd: S, terms: [f32; T], x: [S::f32s; N]) -> [S::f32s; N] {
    let mut sum = [simd.splat_f32s(terms[T - 1]); N];
    for term in terms[..T - 1].iter().rev() {
        for lane in 0..N {
            sum[lane] = simd.mul_add_f32s(sum[lane], x[lane], simd.splat_f32s(*term));
        }
    }
    sum
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
        let (xs, ys) = half_block_centers(block);
        if S::F32_LANES == HALF_LEN {
            let mut run = self.run::<A>(block, 0, (&xs, &ys));
            let is_done = list.chunks(LOOK_LEN).any(|some| !self.add_all::<A>(some, &mut run));
            self.keep::<A>(&run);
            return is_done;
        }
        for some in list.chunks(LOOK_LEN) {
            let mut is_open = false;
            for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
                let mut run = self.run::<A>(block, first_lane, (&xs, &ys));
                is_open |= self.add_all::<A>(some, &mut run);
                self.keep::<A>(&run);
            }
            if !is_open {
                return true;
            }
        }
        false
    }

    /// Pixels of both halves of a block.
    #[inline(always)]
    fn run<A: Arithmetic>(&self, block: usize, first_lane: usize, (xs, ys): Centers<'_>) -> Run<S> {
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
        let (x, y) = (load(simd, xs, first_lane), load(simd, ys, first_lane));
        Run { x: [x, simd.add_f32s(x, simd.splat_f32s(HALF_WIDTH as f32))], y, pixels }
    }

    /// Writes pixels back.
    #[inline(always)]
    fn keep<A: Arithmetic>(&mut self, run: &Run<S>) {
        let simd = self.simd;
        for pixels in &run.pixels {
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
    fn add_all<A: Arithmetic>(&mut self, list: &[u8], run: &mut Run<S>) -> bool {
        let simd = self.simd;
        let (pairs, last) = if S::REGISTER_COUNT < 32 { (&[][..], list) } else { list.as_chunks::<2>() };
        for &[first, second] in pairs {
            let (first, second) = (usize::from(first) % RECORDS_LEN, usize::from(second) % RECORDS_LEN);
            let [a, b] = self.exponents(first, run);
            let [c, d] = self.exponents(second, run);
            let [a, b, c, d] = self.alphas::<A, 4>([a, b, c, d]);
            self.add::<A>(first, a, &mut run.pixels[0]);
            self.add::<A>(first, b, &mut run.pixels[1]);
            self.add::<A>(second, c, &mut run.pixels[0]);
            self.add::<A>(second, d, &mut run.pixels[1]);
        }
        for &position in last {
            let position = usize::from(position) % RECORDS_LEN;
            let [a, b] = self.alphas::<A, 2>(self.exponents(position, run));
            self.add::<A>(position, a, &mut run.pixels[0]);
            self.add::<A>(position, b, &mut run.pixels[1]);
        }
        let most = simd.max_f32s(run.pixels[0].transmittance, run.pixels[1].transmittance);
        any::<S>(simd.greater_than_or_equal_f32s(most, self.constants.stop))
    }

    /// Exponents of a splat in both halves.
    #[inline(always)]
    fn exponents(&self, position: usize, Run { x, y, .. }: &Run<S>) -> [S::f32s; 2] {
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
        let mut power = A::exp2(simd, e);
        for _ in 0..3 {
            for power in &mut power {
                *power = simd.mul_f32s(*power, *power);
            }
        }
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
            self.sink.take(position, pixels.first, bytemuck::cast_slice(std::slice::from_ref(&weight)));
        }
    }
}

/// Columns and rows of the pixels of the left half of a block.
type Centers<'a> = (&'a [f32; HALF_LEN], &'a [f32; HALF_LEN]);

/// Registers of pixels of the left and right half of a block, which share what depends on y alone.
struct Run<S: Simd> {
    x: [S::f32s; 2],
    y: S::f32s,
    pixels: [Pixels<S>; 2],
}

/// Whether a mask has a lane set.
#[inline(always)]
fn any<S: Simd>(mask: S::m32s) -> bool {
    bytemuck::bytes_of(&mask).iter().fold(0, |all, byte| all | byte) != 0
}
