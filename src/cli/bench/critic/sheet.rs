use std::path::Path;

use crate::cli::failure::Failure;
use cinesplat::files::Existing;
use cinesplat::geometry::{Camera, Intrinsics};
use cinesplat::render::{RenderSettings, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, Shot};
use cinesplat::video::ContactSheet;

/// Width of a frame of the sheet, pixels, and the number of frames.
const WIDTH_PX: u32 = 320;
const NUM_FRAMES: usize = 12;

/// Writes a contact sheet of a film.
pub(super) fn write(scene: &Scene, shot: &Shot, path: &Path, existing: Existing) -> Result<(), Failure> {
    let height = (f64::from(WIDTH_PX) * f64::from(shot.height) / f64::from(shot.width)).round() as u32;
    let mut sheet = ContactSheet::new(WIDTH_PX, height.max(1), NUM_FRAMES);
    let (camera_path, settings) = (CameraPath::new(shot)?, RenderSettings::for_scene(scene));
    let renderer = Renderer::new(&scene.gaussians);
    for idx in 0..NUM_FRAMES {
        let state = camera_path.sample(shot.duration_secs * idx as f64 / (NUM_FRAMES - 1) as f64);
        let intrinsics = Intrinsics::from_fov_y(WIDTH_PX, height.max(1), state.fov_y_rad);
        let frame = renderer.render(&Camera { pose: state.pose, intrinsics }, &settings)?;
        sheet.add_frame(idx, &frame.to_rgb8());
    }
    Ok(sheet.write(path, existing)?)
}
