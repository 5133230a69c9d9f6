use ffmpeg_next::Rational;

/// A rate within this relative distance of a broadcast rate n * 1000 / 1001 becomes that broadcast rate.
const BROADCAST_TOLERANCE: f64 = 2e-5;
/// Largest denominator of any other rate.
const MAX_DENOMINATOR: i32 = 1001;

/// Frames per second as the fraction that a file stores: whole numbers, the broadcast rates (23.976 = 24000/1001,
/// 29.97, 59.94), else the nearest fraction with a denominator up to 1001.
///
/// `rate_fps` must be in 0.01..=1000. The file's clock follows the fraction, the camera follows `rate_fps`: at 29.97
/// they drift apart by one millisecond in a quarter of an hour.
pub(crate) fn as_fraction(rate_fps: f64) -> Rational {
    let nearest = |denominator: i32| (rate_fps * f64::from(denominator)).round().max(1.0) as i32;
    if rate_fps.fract() == 0.0 {
        return Rational::new(nearest(1), 1);
    }
    let broadcast = (rate_fps * 1.001).round();
    if broadcast > 0.0 && (broadcast / 1.001 / rate_fps - 1.0).abs() < BROADCAST_TOLERANCE {
        return Rational::new(broadcast as i32 * 1000, 1001);
    }
    let error = |denominator: i32| (f64::from(nearest(denominator)) / f64::from(denominator) - rate_fps).abs();
    let best = (1..=MAX_DENOMINATOR).min_by(|&a, &b| error(a).total_cmp(&error(b))).unwrap_or(1);
    Rational::new(nearest(best), best)
}
