//! Rendered pictures for sheets.

use image::RgbImage;

use super::error::ObjectsError;
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderSettings, Renderer};
use cinesplat_scene::{Scene, SplatFilter};

/// Vertical field of view of the tiles of a sheet: a normal lens.
pub(crate) const TILE_FOV_RAD: f64 = 0.7;

/// Color behind what a tile shows.
pub(crate) const TILE_BACKGROUND: [f32; 3] = [0.24, 0.24, 0.26];

/// A picture of Gaussians with the filter of their scene. `look`: near plane, background, quality.
pub(crate) fn photo(
    scene: &Scene,
    renderer: &Renderer,
    camera: &Camera,
    look: (f64, [f32; 3], Quality),
) -> Result<RgbImage, ObjectsError> {
    let filter = scene.filter.unwrap_or(SplatFilter::Classic);
    let (near, background, quality) = look;
    let settings = RenderSettings { quality, filter, near, background: background.into(), ..RenderSettings::default() };
    let failed = |reason: String| ObjectsError::Picture { reason };
    let frame = renderer.render(camera, &settings).map_err(|error| failed(error.to_string()))?;
    let image = RgbImage::from_raw(frame.width, frame.height, frame.to_rgb8());
    image.ok_or_else(|| failed("the frame has another size than its pixels".to_owned()))
}
