//! Position embeddings for pictures of other sizes than those that a network was trained with.
//!
//! Bicubic interpolation (Keys 1981) with the constants of PyTorch's `interpolate(mode="bicubic", align_corners=False)`, which
//! `transformers` calls: no smoothing where the grid gets coarser, and the border repeated beyond itself.

/// Keys' parameter.
const A: f32 = -0.75;

/// The rows of a square grid (`[side * side, width]`) at another size (rows, columns): `[rows * columns, width]`.
pub(crate) fn resized(rows: &[f32], side: usize, width: usize, to: [usize; 2]) -> Vec<f32> {
    let [down, along] = to.map(|count| taps(side, count));
    let mut resized = Vec::with_capacity(to[0] * to[1] * width);
    for (ys, y_weights) in &down {
        for (xs, x_weights) in &along {
            let start = resized.len();
            resized.resize(start + width, 0.0);
            for (y, y_weight) in ys.iter().zip(y_weights) {
                for (x, x_weight) in xs.iter().zip(x_weights) {
                    let row = &rows[(y * side + x) * width..][..width];
                    let sums = resized[start..].iter_mut().zip(row);
                    sums.for_each(|(sum, value)| *sum += y_weight * x_weight * value);
                }
            }
        }
    }
    resized
}

/// The four samples, and their weights, of each of `count` positions along a line of `side` samples.
fn taps(side: usize, count: usize) -> Vec<([usize; 4], [f32; 4])> {
    let scale = side as f32 / count as f32;
    let of = |position: usize| {
        let at = scale * (position as f32 + 0.5) - 0.5;
        let before = at.floor();
        let frac = at - before;
        let sample = |tap: usize| (before as i64 + tap as i64 - 1).clamp(0, side as i64 - 1) as usize;
        let weights = [outer(frac + 1.0), inner(frac), inner(1.0 - frac), outer(2.0 - frac)];
        (std::array::from_fn(sample), weights)
    };
    (0..count).map(of).collect()
}

/// Weight of a sample at most one step away.
fn inner(distance: f32) -> f32 {
    ((A + 2.0) * distance - (A + 3.0)) * distance * distance + 1.0
}

/// Weight of a sample one to two steps away.
fn outer(distance: f32) -> f32 {
    ((A * distance - 5.0 * A) * distance + 8.0 * A) * distance - 4.0 * A
}
