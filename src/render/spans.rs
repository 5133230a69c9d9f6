//! Which 8 x 4 pixel blocks of a tile an ellipse touches, found for all strips of blocks at once.

use super::bin::TILE_PX;
use super::splat::Splat;

/// Width of a block in pixels.
pub(super) const BLOCK_WIDTH: usize = 8;
/// Height of a block in pixels.
pub(super) const BLOCK_HEIGHT: usize = 4;
/// Blocks side by side in a tile; as many as there are bits in an entry of [`StripMasks`].
pub(super) const BLOCKS_ACROSS: usize = TILE_PX / BLOCK_WIDTH;
/// Strips of blocks on top of each other in a tile.
pub(super) const NUM_STRIPS: usize = TILE_PX / BLOCK_HEIGHT;

/// One bit a block: `[strip]` counts block rows from the top, bit 0 is the leftmost block.
pub(super) type StripMasks = [u8; NUM_STRIPS];

/// Slack in pixels for rounding; a block too many costs a little time, one too few a wrong pixel.
const SLACK_PX: f32 = 0.02;

/// The blocks that hold a pixel center inside the region where the splat counts, or a few more.
///
/// At dy below the center the region reaches from `shift dy - w` to `shift dy + w`, w = sqrt(reach - (vy dy)^2) / ux.
/// Both ends are monotone on either side of the outermost point, which lies `lean_px` below (right end) or above (left
/// end) the center, so within a strip the extreme is at the dy nearest to that point.
#[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch, and the loop would not vectorize")]
#[inline(always)]
pub(super) fn touched_blocks(splat: &Splat, origin_px: [f32; 2]) -> StripMasks {
    let (x, y) = (splat.mean_px[0] - origin_px[0], splat.mean_px[1] - origin_px[1]);
    let [ux, uy, vy] = splat.whiten;
    let (shift, width) = (-uy / ux, 1.0 / ux);
    let half_y = splat.half_px[1] + SLACK_PX;
    let mut masks = [0; NUM_STRIPS];
    for (strip, mask) in masks.iter_mut().enumerate() {
        let top = (strip * BLOCK_HEIGHT) as f32 + 0.5 - y;
        let bottom = top + (BLOCK_HEIGHT - 1) as f32;
        let (dy_right, dy_left) = (splat.lean_px.max(top).min(bottom), (-splat.lean_px).max(top).min(bottom));
        let (v_right, v_left) = (vy * dy_right, vy * dy_left);
        let right = x + shift * dy_right + (splat.reach - v_right * v_right).max(0.0).sqrt() * width;
        let left = x + shift * dy_left - (splat.reach - v_left * v_left).max(0.0).sqrt() * width;
        // Pixel i has its center at i + 0.5. Blocks `first..end`, both 0..=BLOCKS_ACROSS.
        let first_px = (left - (0.5 + SLACK_PX)).ceil();
        let end_px = right + (0.5 + SLACK_PX - 1.0 + BLOCK_WIDTH as f32);
        let first = (first_px * (1.0 / BLOCK_WIDTH as f32)).max(0.0).min(BLOCKS_ACROSS as f32);
        let end = (end_px * (1.0 / BLOCK_WIDTH as f32)).max(0.0).min(BLOCKS_ACROSS as f32);
        let is_touched = (top <= half_y) & (bottom >= -half_y);
        let bits = (0xff_u32 << whole(first)) & !(0xff_u32 << whole(end));
        *mask = if is_touched { bits as u8 } else { 0 };
    }
    masks
}

/// A number in 0..=8, rounded down. The sum has its whole part in the lowest bits; a cast would not vectorize.
#[inline(always)]
fn whole(number: f32) -> u32 {
    const SHIFT: f32 = 8_388_608.0;
    (number.floor() + SHIFT).to_bits() & 31
}
