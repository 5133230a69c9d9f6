//! Rendered pictures for sheets.

use image::RgbImage;

use super::error::ObjectsError;
use cinesplat_geometry::Camera;
use cinesplat_render::{Frame, Quality, RenderSettings, Renderer};
use cinesplat_scene::{Scene, SplatFilter};

/// Vertical field of view of the tiles of a sheet: a normal lens.
pub(crate) const TILE_FOV_RAD: f64 = 0.7;

/// Color behind what a tile shows.
pub(crate) const TILE_BACKGROUND: [f32; 3] = [0.24, 0.24, 0.26];

/// Brightness and gray level of what surrounds the object of a tile.
const CONTEXT_GAIN: f32 = 0.2;
const CONTEXT_BASE: f32 = 0.12;

/// A picture of Gaussians with the filter of their scene. `look`: near plane, background, quality.
pub(crate) fn photo(
    scene: &Scene,
    renderer: &Renderer,
    camera: &Camera,
    look: (f64, [f32; 3], Quality),
) -> Result<RgbImage, ObjectsError> {
    image_of(&frame_of(scene, renderer, camera, look)?)
}

/// A picture of some Gaussians of a scene before the rest of it, which is gray and dim.
///
/// `near`: distance from which the rest is drawn.
pub(crate) fn photo_before(
    scene: &Scene,
    (rest, own): (&Renderer, &Renderer),
    camera: &Camera,
    (near, quality): (f64, Quality),
) -> Result<RgbImage, ObjectsError> {
    let around = frame_of(scene, rest, camera, (near, TILE_BACKGROUND, quality))?;
    let mut frame = frame_of(scene, own, camera, (0.0, [0.0; 3], quality))?;
    for ((color, around), transmittance) in
        frame.rgb.chunks_exact_mut(3).zip(around.rgb.chunks_exact(3)).zip(&frame.transmittance)
    {
        let gray = CONTEXT_BASE + CONTEXT_GAIN * around.iter().sum::<f32>().clamp(0.0, 3.0) / 3.0;
        color.iter_mut().for_each(|channel| *channel += transmittance * gray);
    }
    image_of(&frame)
}

fn frame_of(
    scene: &Scene,
    renderer: &Renderer,
    camera: &Camera,
    (near, background, quality): (f64, [f32; 3], Quality),
) -> Result<Frame, ObjectsError> {
    let filter = scene.filter.unwrap_or(SplatFilter::Classic);
    let settings = RenderSettings { quality, filter, near, background: background.into(), ..RenderSettings::default() };
    renderer.render(camera, &settings).map_err(|error| ObjectsError::Picture { reason: error.to_string() })
}

fn image_of(frame: &Frame) -> Result<RgbImage, ObjectsError> {
    let image = RgbImage::from_raw(frame.width, frame.height, frame.to_rgb8());
    image.ok_or_else(|| ObjectsError::Picture { reason: "the frame has another size than its pixels".to_owned() })
}
