use rayon::prelude::*;

use super::Frame;

/// Writes a smaller picture into a larger frame, bilinear between pixel centers, borders repeated.
pub(super) fn upsample(from: &Frame, to: &mut Frame) {
    let (columns, rows) = (taps(from.width, to.width), taps(from.height, to.height));
    let (narrow, wide) = (from.width as usize, to.width as usize);
    let output = to.rgb.par_chunks_mut(wide * 3).zip(to.transmittance.par_chunks_mut(wide)).zip(rows);
    output.for_each(|((rgb, transmittance), row)| {
        let mix = |values: &[f32], stride: usize, column: Tap, channel: usize| {
            let at = |y: usize, x: usize| values[(y * narrow + x) * stride + channel];
            let along = |y: usize| at(y, column.low) + (at(y, column.high) - at(y, column.low)) * column.frac;
            along(row.low) + (along(row.high) - along(row.low)) * row.frac
        };
        for ((rgb, rest), &column) in rgb.chunks_exact_mut(3).zip(transmittance).zip(&columns) {
            for (channel, value) in rgb.iter_mut().enumerate() {
                *value = mix(&from.rgb, 3, column, channel);
            }
            *rest = mix(&from.transmittance, 1, column, 0);
        }
    });
}

/// The two source pixels that one pixel lies between along one axis, and how far it is from the first to the second.
#[derive(Debug, Clone, Copy)]
struct Tap {
    low: usize,
    high: usize,
    frac: f32,
}

fn taps(from: u32, to: u32) -> Vec<Tap> {
    let last = from.saturating_sub(1) as usize;
    let scale = f64::from(from) / f64::from(to);
    let tap = |position: u32| {
        let center = ((f64::from(position) + 0.5) * scale - 0.5).max(0.0);
        let low = (center as usize).min(last);
        Tap { low, high: (low + 1).min(last), frac: (center - low as f64) as f32 }
    };
    (0..to).map(tap).collect()
}
