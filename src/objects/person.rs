//! Whether an upright thing is a person, by its proportions and the color of its skin.
//!
//! Enters: a thing in level slices. Leaves: whether its upper end is a head. The head of a standing person is 1/8 to 1/7 of
//! his height (Bammes, *Die Gestalt des Menschen*), and that of a bust a quarter or more; with its neck a little more.

use glam::Vec3;

use super::slices::Slice;

/// Least and largest share of a head with its neck of the height of a thing.
const HEAD_FRAC: [f32; 2] = [0.09, 0.48];
/// Least and largest height of a head with its neck over its width (root mean square).
const HEAD_RATIO: [f32; 2] = [1.6, 6.0];
/// Largest width of a head over that of the shoulders.
const SHOULDERS: f32 = 0.75;
/// Largest width of a neck over that of the head.
const NECK: f32 = 0.92;
/// Least share of skin in a head, where hair and a beard hide most of it.
const SKIN_FRAC: f32 = 0.12;

/// Whether a color (CIE Lab) is one of human skin: of light, brown or dark skin in light and shade.
pub(crate) fn is_skin(color_lab: Vec3) -> bool {
    let chroma = color_lab.y.hypot(color_lab.z);
    let hue_deg = color_lab.z.atan2(color_lab.y).to_degrees();
    (20.0..90.0).contains(&color_lab.x) && (9.0..45.0).contains(&chroma) && (20.0..75.0).contains(&hue_deg)
}

/// Whether the slices from `start` to `end`, the upper ones of a thing, are a person's head with its neck.
/// `step`: the thickness of a slice, scene units.
pub(crate) fn has_head(step: f32, slices: &[Slice], (start, end): (usize, usize)) -> bool {
    let (body, head) = (&slices[..start], &slices[start..end]);
    if body.is_empty() || head.len() < 3 {
        return false;
    }
    let widest = |slices: &[Slice]| slices.iter().map(|slice| slice.width).fold(0.0, f32::max);
    let width = head.iter().map(|slice| slice.width).sum::<f32>() / head.len() as f32;
    let height = head.len() as f32 * step;
    let within = |[low, high]: [f32; 2], value: f32| (low..=high).contains(&value);
    // Shoulders and arms are right below the head.
    let shoulders = widest(&body[start.saturating_sub(2 * head.len())..]);
    let low = &slices[start.saturating_sub(1)..start + head.len().div_ceil(2)];
    let neck = low.iter().map(|slice| slice.width).fold(f32::INFINITY, f32::min);
    let upper = widest(&head[head.len() / 3..]);
    let skin = |slices: &[Slice]| slices.iter().map(|slice| slice.skin_frac).sum::<f32>() / slices.len() as f32;
    within(HEAD_FRAC, head.len() as f32 / slices.len() as f32)
        && within(HEAD_RATIO, height / width)
        && width < SHOULDERS * shoulders
        && neck < NECK * upper
        && skin(head) > SKIN_FRAC
        // A wooden figure is of one color.
        && skin(head) > skin(body)
}
