//! Values between the pixels of a picture.

use cinesplat_render::Frame;

/// Color and transmittance at a position in pixels (centers at +0.5), by a cubic curve through the four nearest pixels in
/// each direction; beyond the borders the nearest pixel.
///
/// Catmull-Rom (Keys 1981, a = -1/2): exact for straight slopes, and sharper than a linear one.
pub(super) fn sampled(frame: &Frame, [x, y]: [f64; 2]) -> [f32; 4] {
    let (left, across) = cell(x);
    let (top, down) = cell(y);
    let (weights_x, weights_y) = (weights(across), weights(down));
    let column = |k: i64| (left + k).clamp(0, i64::from(frame.width) - 1) as usize;
    let row = |k: i64| (top + k).clamp(0, i64::from(frame.height) - 1) as usize;
    let mut sum = [0.0; 4];
    for (k_y, weight_y) in (-1..3).zip(weights_y) {
        let first = row(k_y) * frame.width as usize;
        for (k_x, weight_x) in (-1..3).zip(weights_x) {
            let (at, weight) = (first + column(k_x), weight_x * weight_y);
            (0..3).for_each(|channel| sum[channel] += weight * frame.rgb[3 * at + channel]);
            sum[3] += weight * frame.transmittance[at];
        }
    }
    // The curve overshoots beside edges.
    [sum[0].max(0.0), sum[1].max(0.0), sum[2].max(0.0), sum[3].clamp(0.0, 1.0)]
}

/// The pixel whose center is at or before a position, and the way to the next one.
fn cell(position: f64) -> (i64, f32) {
    let at = position - 0.5;
    (at.floor() as i64, (at - at.floor()) as f32)
}

fn weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [0.5 * (-t + 2.0 * t2 - t3), 0.5 * (2.0 - 5.0 * t2 + 3.0 * t3), 0.5 * (t + 4.0 * t2 - 3.0 * t3), 0.5 * (t3 - t2)]
}
