use std::path::Path;

use crate::cli::failure::Failure;
use cinesplat::files::Existing;
use cinesplat::pipeline;
use cinesplat::render::{RenderSettings, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::Shot;
use cinesplat::video::ContactSheet;

/// Width of a frame of the sheet, pixels, and the number of frames.
const WIDTH_PX: u32 = 320;
const NUM_FRAMES: usize = 12;

/// Writes a contact sheet of a film, with its effects.
pub(super) fn write(scene: &Scene, shot: &Shot, path: &Path, existing: Existing) -> Result<(), Failure> {
    let height = (f64::from(WIDTH_PX) * f64::from(shot.height) / f64::from(shot.width)).round() as u32;
    let size_px = [WIDTH_PX, height.max(1)];
    let mut sheet = ContactSheet::new(size_px[0], size_px[1], NUM_FRAMES);
    let (renderer, settings) = (Renderer::new(&scene.gaussians), RenderSettings::for_scene(scene));
    let pictures = pipeline::film_pictures((&renderer, &settings), shot, size_px, NUM_FRAMES)?;
    pictures.iter().enumerate().for_each(|(idx, picture)| sheet.add_frame(idx, picture));
    Ok(sheet.write(path, existing)?)
}
