//! Converts R'G'B' to the `Y'CbCr` that HD players expect: ITU-R BT.709-6, 8 bits, limited range, 4:2:0.
//!
//! Equations of BT.709-6 section 3: Y' = 0.2126 R' + 0.7152 G' + 0.0722 B', Cb = (B' - Y') / 1.8556,
//! Cr = (R' - Y') / 1.5748; 8-bit codes Y = 16 + 219 Y', C = 128 + 224 C. The colors of a scene are display-referred
//! (trained against photos as they are), so no transfer curve is applied.
//!
//! Chroma samples lie at the default position of MPEG-2, H.264 and VP9: on the left of two columns, halfway between
//! two rows. Therefore chroma is filtered with weights 1 2 1 horizontally and averaged vertically.

#![allow(
    clippy::inline_always,
    reason = "code for an instruction set that is detected at run time must be inlined into the function that enables it"
)]

/// Fraction bits of the fixed-point weights. With 16 every code is within 0.51 of the exact value.
const FRACTION_BITS: u32 = 16;

/// Planes of one 4:2:0 picture, rows packed: `y` has width x height codes, `cb` and `cr` a quarter of that each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Planes420 {
    /// Luma columns, even.
    pub width: usize,
    /// Luma rows, even.
    pub height: usize,
    /// Luma, 16..=235.
    pub y: Vec<u8>,
    /// Blue difference, 16..=240, 128 = none.
    pub cb: Vec<u8>,
    /// Red difference, 16..=240, 128 = none.
    pub cr: Vec<u8>,
}

impl Planes420 {
    /// Planes of `width` x `height` codes, both even, from their bytes one after the other: luma, blue, red. `None` for
    /// another number of bytes.
    pub fn from_bytes(bytes: &[u8], width: usize, height: usize) -> Option<Self> {
        let (luma, quarter) = (width * height, width * height / 4);
        if bytes.len() != luma + 2 * quarter {
            return None;
        }
        let (y, chroma) = bytes.split_at(luma);
        let (cb, cr) = chroma.split_at(quarter);
        Some(Self { width, height, y: y.to_owned(), cb: cb.to_owned(), cr: cr.to_owned() })
    }

    /// The planes, in the order in which [`Planes420::from_bytes`] reads them.
    pub fn parts(&self) -> [&[u8]; 3] {
        [&self.y, &self.cb, &self.cr]
    }

    /// Bytes of all planes.
    pub fn num_bytes(&self) -> usize {
        self.parts().iter().map(|part| part.len()).sum()
    }

    /// The picture as `width` x `height` pixels of r, g, b; every chroma sample colors the four pixels it was made for.
    pub fn to_rgb8(&self) -> Vec<u8> {
        let mut rgb8 = Vec::with_capacity(self.width * self.height * 3);
        for row in 0..self.height {
            for column in 0..self.width {
                let chroma_at = row / 2 * (self.width / 2) + column / 2;
                let luma = (f32::from(self.y[row * self.width + column]) - 16.0) / 219.0;
                let [blue, red] = [&self.cb, &self.cr].map(|plane| (f32::from(plane[chroma_at]) - 128.0) / 224.0);
                let (r, b) = (luma + 1.5748 * red, luma + 1.8556 * blue);
                let g = (luma - 0.2126 * r - 0.0722 * b) / 0.7152;
                // The cast saturates at 0 and 255.
                rgb8.extend([r, g, b].map(|value| (value * 255.0).round() as u8));
            }
        }
        rgb8
    }
}

/// Weights of one output plane on r, g, b in fixed point, for sums of `1 << scale_bits` pixels.
struct Weights {
    rgb: [i32; 3],
    offset: i32,
    shift: u32,
}

impl Weights {
    /// Weights for `rgb` (of the equation), the range `span` of the code, and the code `base` that stands for zero.
    fn new(rgb: [f64; 3], span: f64, base: i32, scale_bits: u32) -> Self {
        let shift = FRACTION_BITS + scale_bits;
        let fixed = |weight: f64| (weight * span / 255.0 * f64::from(1 << FRACTION_BITS)).round() as i32;
        let mut rgb = rgb.map(fixed);
        // Rounding must not tint gray: the largest weight absorbs the rounding error of the sum.
        let wanted = if base == 16 { fixed(1.0) } else { 0 };
        let largest = (0..3).max_by_key(|&i| rgb[i].abs()).unwrap_or(1);
        rgb[largest] += wanted - rgb.iter().sum::<i32>();
        Self { rgb, offset: (base << shift) + (1 << (shift - 1)), shift }
    }

    #[inline(always)]
    fn code(&self, rgb_sum: [i32; 3]) -> u8 {
        let dot = self.rgb[0] * rgb_sum[0] + self.rgb[1] * rgb_sum[1] + self.rgb[2] * rgb_sum[2];
        ((dot + self.offset) >> self.shift) as u8
    }
}

/// Converts a picture of `width` x `height` pixels (row-major, r g b, 8 bits, full range) to 4:2:0. An odd width or
/// height grows by one: the last column or row is repeated.
///
/// `rgb8` must hold `width * height * 3` bytes; width and height must be above 0.
pub fn planes_from_rgb8(rgb8: &[u8], width: usize, height: usize) -> Planes420 {
    // Integer arithmetic gives the same planes on every instruction set.
    pulp::Arch::new().dispatch(Conversion { rgb8, width, height })
}

/// The conversion as a value: of a closure of this size only the call would be compiled for the vector instructions.
struct Conversion<'a> {
    rgb8: &'a [u8],
    width: usize,
    height: usize,
}

impl pulp::NullaryFnOnce for Conversion<'_> {
    type Output = Planes420;

    #[inline(always)]
    fn call(self) -> Planes420 {
        convert(self.rgb8, self.width, self.height)
    }
}

#[inline(always)]
fn convert(rgb8: &[u8], width: usize, height: usize) -> Planes420 {
    let (even_width, even_height) = (width.next_multiple_of(2), height.next_multiple_of(2));
    let row = |y: usize| &rgb8[y.min(height - 1) * width * 3..][..width * 3];
    let luma = Weights::new([0.2126, 0.7152, 0.0722], 219.0, 16, 0);
    let blue = Weights::new([-0.2126 / 1.8556, -0.7152 / 1.8556, 0.5], 224.0, 128, 3);
    let red = Weights::new([0.5, -0.7152 / 1.5748, -0.0722 / 1.5748], 224.0, 128, 3);
    let mut y = vec![0; even_width * even_height];
    let mut cb = vec![0; even_width * even_height / 4];
    let mut cr = vec![0; even_width * even_height / 4];
    let mut channels: [Channels; 2] = Default::default();
    let mut sums: Sums = Default::default();
    let chroma_rows = cb.chunks_exact_mut(even_width / 2).zip(cr.chunks_exact_mut(even_width / 2));
    for (pair, (luma_rows, (cb, cr))) in y.chunks_exact_mut(2 * even_width).zip(chroma_rows).enumerate() {
        for (idx, codes) in luma_rows.chunks_exact_mut(even_width).enumerate() {
            split(row(2 * pair + idx), even_width, &mut channels[idx]);
            write_luma(codes, &channels[idx], &luma);
        }
        for ((sums, upper), lower) in sums.iter_mut().zip(&channels[0]).zip(&channels[1]) {
            sum_pixels(sums, upper, lower, even_width / 2);
        }
        write_chroma(cb, &sums, &blue);
        write_chroma(cr, &sums, &red);
    }
    Planes420 { width: even_width, height: even_height, y, cb, cr }
}

/// Red, green and blue of one row, each with its first value repeated before it and its last value after it. Bytes, in
/// loops without steps: then the compiler uses vectors, which makes the conversion ten times faster.
type Channels = [Vec<u8>; 3];

/// Red, green and blue of the pixels of each chroma sample of one row, each a sum with weights that sum to 8.
type Sums = [Vec<i32>; 3];

#[inline(always)]
fn split(row: &[u8], even_width: usize, channels: &mut Channels) {
    let width = row.len() / 3;
    channels.iter_mut().for_each(|values| values.resize(even_width + 2, 0));
    let [red, green, blue] = channels;
    let values = red[1..].iter_mut().zip(&mut green[1..]).zip(&mut blue[1..]);
    for (pixel, ((red, green), blue)) in row.chunks_exact(3).zip(values) {
        (*red, *green, *blue) = (pixel[0], pixel[1], pixel[2]);
    }
    for values in channels {
        values[0] = values[1];
        let last = values[width];
        values[width + 1..].fill(last);
    }
}

#[inline(always)]
fn write_luma(codes: &mut [u8], [r, g, b]: &Channels, weights: &Weights) {
    for (((code, &r), &g), &b) in codes.iter_mut().zip(&r[1..]).zip(&g[1..]).zip(&b[1..]) {
        *code = weights.code([r.into(), g.into(), b.into()]);
    }
}

/// Sums of one channel over two rows of pixels, with weights 1 2 1 horizontally.
#[inline(always)]
fn sum_pixels(sums: &mut Vec<i32>, upper: &[u8], lower: &[u8], num_sums: usize) {
    sums.resize(num_sums, 0);
    // Of this length, so that no index below is checked.
    let (upper, lower) = (&upper[..2 * num_sums + 2], &lower[..2 * num_sums + 2]);
    for (idx, sum) in sums.iter_mut().enumerate() {
        let column = |at: usize| i32::from(upper[at]) + i32::from(lower[at]);
        *sum = column(2 * idx) + 2 * column(2 * idx + 1) + column(2 * idx + 2);
    }
}

#[inline(always)]
fn write_chroma(codes: &mut [u8], [r, g, b]: &Sums, weights: &Weights) {
    for (((code, &r), &g), &b) in codes.iter_mut().zip(r).zip(g).zip(b) {
        *code = weights.code([r, g, b]);
    }
}
