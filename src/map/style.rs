//! Colors and sizes of the map.

use cinesplat_plot::drawing::Ink;

/// Lines and text.
pub(crate) const INK: Ink = Ink::new([24, 24, 28]);
/// Text of less weight.
pub(crate) const GRAY: Ink = Ink::new([96, 96, 104]);
/// Frames and rules.
pub(crate) const PALE: Ink = Ink::new([176, 176, 184]);
pub(crate) const WHITE: Ink = Ink::new([255, 255, 255]);
/// Outlines of subjects.
pub(crate) const SUBJECT: Ink = Ink::new([176, 16, 48]);
/// View cones.
pub(crate) const CONE: Ink = Ink::new([20, 70, 160]);
/// Clearance.
pub(crate) const CLEARANCE: Ink = Ink::new([150, 60, 0]);

/// The color of the path at a share of the greatest speed, 0..=1: dark when slow, bright when fast, so that it also
/// reads in gray.
pub(crate) fn speed_ink(share: f64) -> Ink {
    const STOPS: [[f64; 3]; 5] =
        [[40.0, 16.0, 90.0], [30.0, 80.0, 160.0], [20.0, 150.0, 140.0], [130.0, 205.0, 80.0], [253.0, 231.0, 60.0]];
    let at = share.clamp(0.0, 1.0) * 4.0;
    let stop = (at as usize).min(3);
    let mix =
        |channel: usize| STOPS[stop][channel] + (STOPS[stop + 1][channel] - STOPS[stop][channel]) * (at - stop as f64);
    Ink::new([mix(0), mix(1), mix(2)].map(|value| value.round() as u8))
}

/// A number in about three digits.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        return "unbounded".to_owned();
    }
    if size > 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.2e}");
    }
    let decimals = if size >= 100.0 || size == 0.0 {
        0
    } else if size >= 10.0 {
        1
    } else if size >= 0.1 {
        2
    } else {
        4
    };
    format!("{value:.decimals$}")
}
