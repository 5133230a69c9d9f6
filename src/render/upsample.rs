use rayon::prelude::*;

use super::Frame;

/// Source pixels that a pixel is made of along one axis.
const NUM_TAPS: usize = 4;

/// Writes a smaller picture into a larger frame by cubic convolution between pixel centers (Keys, Cubic Convolution
/// Interpolation for Digital Image Processing, 1981, a = -1/2), borders repeated. Overshoot is cut off: color below 0,
/// transmittance outside 0..=1. On pictures of splats a decibel or two nearer than bilinear, for little time.
pub(super) fn upsample(from: &Frame, to: &mut Frame) {
    let (columns, rows) = (taps(from.width, to.width), taps(from.height, to.height));
    let (narrow, wide) = (from.width as usize, to.width as usize);
    let output = to.rgb.par_chunks_mut(wide * 3).zip(to.transmittance.par_chunks_mut(wide)).zip(rows);
    output.for_each_init(
        || vec![[0.0; 4]; narrow],
        |mixed, ((rgb, transmittance), row)| {
            // Down the columns first: red, green, blue, transmittance of one row of source pixels.
            for (x, mixed) in mixed.iter_mut().enumerate() {
                *mixed = row.mix(|y| {
                    let at = y * narrow + x;
                    [from.rgb[at * 3], from.rgb[at * 3 + 1], from.rgb[at * 3 + 2], from.transmittance[at]]
                });
            }
            for ((rgb, rest), column) in rgb.chunks_exact_mut(3).zip(transmittance).zip(&columns) {
                let [r, g, b, t] = column.mix(|x| mixed[x]);
                rgb.copy_from_slice(&[r.max(0.0), g.max(0.0), b.max(0.0)]);
                *rest = t.clamp(0.0, 1.0);
            }
        },
    );
}

/// The source pixels that one pixel is made of along one axis, and how much of each.
#[derive(Debug, Clone, Copy)]
struct Taps {
    places: [usize; NUM_TAPS],
    weights: [f32; NUM_TAPS],
}

impl Taps {
    /// The weighted sum of four numbers at each place: the nearest before, and parts of what the others differ from it by,
    /// so that an even surface stays as it is to the bit.
    #[inline]
    fn mix(&self, at: impl Fn(usize) -> [f32; 4]) -> [f32; 4] {
        let base = at(self.places[1]);
        let mut sums = base;
        for tap in [0, 2, 3] {
            let (values, weight) = (at(self.places[tap]), self.weights[tap]);
            for ((sum, value), base) in sums.iter_mut().zip(values).zip(base) {
                *sum += weight * (value - base);
            }
        }
        sums
    }
}

fn taps(from: u32, to: u32) -> Vec<Taps> {
    let last = i64::from(from.saturating_sub(1));
    let scale = f64::from(from) / f64::from(to);
    let at = |position: u32| {
        let center = (f64::from(position) + 0.5) * scale - 0.5;
        let before = center.floor();
        let place = |tap: i64| (before as i64 + tap - 1).clamp(0, last) as usize;
        let weight = |tap: f64| kernel(center - before - (tap - 1.0)) as f32;
        Taps { places: [0, 1, 2, 3].map(place), weights: [0.0, 1.0, 2.0, 3.0].map(weight) }
    };
    (0..to).map(at).collect()
}

/// Keys' kernel with a = -1/2; its values at distances of one apart sum to 1.
fn kernel(distance: f64) -> f64 {
    let x = distance.abs();
    if x < 1.0 {
        (1.5 * x - 2.5) * x * x + 1.0
    } else if x < 2.0 {
        ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0
    } else {
        0.0
    }
}
