//! A scene with fewer Gaussians, for small pictures.

use cinesplat_scene::Gaussians;

/// Gaussians of a thinned scene besides those of its subjects. A picture of 128 by 72 pixels shows no more.
pub(super) const MAX_BACKGROUND: usize = 120_000;

/// Indices of the Gaussians that stand for a scene, at most about `most` without a label, and the factor on the lengths of
/// these.
///
/// All Gaussians with a label stay. Of the others a share does, chosen by their size, color and opacity, so that neither their
/// order nor the frame of the scene matters. They grow by the root of the share that stays, so that they cover as much.
pub(super) fn thinned(gaussians: &Gaussians, labels: &[u16], most: usize) -> (Vec<usize>, f32) {
    let num_background = labels.iter().filter(|label| **label == 0).count();
    if num_background <= most {
        return ((0..gaussians.len()).collect(), 1.0);
    }
    let share = most as f64 / num_background as f64;
    let limit = (share * f64::from(u32::MAX)) as u32;
    let stays = |i: &usize| labels[*i] > 0 || mixed(gaussians, *i) <= limit;
    let kept: Vec<usize> = (0..gaussians.len()).filter(stays).collect();
    let num_labeled = labels.len() - num_background;
    let num_kept = kept.len() - num_labeled;
    if num_kept == 0 {
        return ((0..gaussians.len()).collect(), 1.0);
    }
    (kept, (num_background as f64 / num_kept as f64).sqrt() as f32)
}

/// Pseudo-random bits that depend on size, color and opacity of a Gaussian.
fn mixed(gaussians: &Gaussians, i: usize) -> u32 {
    let (color, size) = (gaussians.sh_dc[i], gaussians.scales[i]);
    let values = [gaussians.opacities[i], color.x, color.y, color.z, size.x, size.y, size.z];
    let hash = values.into_iter().fold(0x9e37_79b9_7f4a_7c15_u64, |hash, value| {
        let mixed = (hash ^ u64::from(value.to_bits())).wrapping_mul(0xff51_afd7_ed55_8ccd);
        mixed ^ (mixed >> 32)
    });
    (hash.wrapping_mul(0xc4ce_b9fe_1a85_ec53) >> 32) as u32
}
