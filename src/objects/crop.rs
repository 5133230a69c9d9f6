//! A camera that shows the mask of an object as large as its square frame allows.

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::Renderer;
use cinesplat_scene::SplatFilter;

use super::error::ObjectsError;
use super::mask::Mask;

/// Side of the mask that the crop follows.
const MASK_PX: u32 = 96;

/// Room around the mask, over its larger side.
const MARGIN: f64 = 0.05;

/// The camera of the smallest square around the mask of the renderer's Gaussians, with room about it, at the size of `camera`,
/// whose frame is a square; `None` where the mask is empty.
pub(crate) fn cropped(
    renderer: &Renderer,
    camera: &Camera,
    filter: SplatFilter,
) -> Result<Option<Camera>, ObjectsError> {
    let whole = camera.intrinsics;
    let small = Camera { intrinsics: whole.resized(MASK_PX, MASK_PX), ..*camera };
    let Some(bounds) = Mask::render(renderer, &small, filter)?.bounds() else { return Ok(None) };
    let scale = f64::from(whole.width) / f64::from(MASK_PX);
    let [left, top, right, bottom] = bounds.map(|side| side as f64 * scale);
    let side = (right - left).max(bottom - top) * (1.0 + 2.0 * MARGIN);
    let zoom = f64::from(whole.width) / side;
    let intrinsics = Intrinsics {
        fx_px: whole.fx_px * zoom,
        fy_px: whole.fy_px * zoom,
        cx_px: (whole.cx_px - (left + right - side) / 2.0) * zoom,
        cy_px: (whole.cy_px - (top + bottom - side) / 2.0) * zoom,
        ..whole
    };
    Ok(Some(Camera { intrinsics, ..*camera }))
}
