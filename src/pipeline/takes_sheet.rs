use cinesplat_render::{RenderSettings, Renderer};
use cinesplat_scene::Scene;
use cinesplat_trajectory::Shot;
use cinesplat_video::TakesSheet;

use super::error::PipelineError;
use super::film_pictures::film_pictures;

/// Frames per take.
const NUM_FRAMES: usize = 5;
/// Pixels per thumbnail: 320 x 180, in the film's aspect.
const THUMB_PIXELS: f64 = 57_600.0;

/// One sheet of several takes of a scene, side by side: five frames of each at even times, the first and the last included.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path, [`PipelineError::Render`].
pub fn takes_sheet(scene: &Scene, renderer: &Renderer<'_>, takes: &[Shot]) -> Result<TakesSheet, PipelineError> {
    let settings = RenderSettings::for_scene(scene);
    let [width, height] = takes.first().map_or([16, 9], |shot| [shot.width, shot.height]).map(f64::from);
    let shrink = (THUMB_PIXELS / (width * height)).sqrt();
    let size_px = [width, height].map(|side| ((side * shrink).round() as u32).max(1));
    let mut sheet = TakesSheet::new(size_px, takes.len(), NUM_FRAMES);
    for (film, shot) in takes.iter().enumerate() {
        let pictures = film_pictures((renderer, &settings), shot, size_px, NUM_FRAMES)?;
        pictures.iter().enumerate().for_each(|(idx, picture)| sheet.put(film, idx, picture));
    }
    Ok(sheet)
}
