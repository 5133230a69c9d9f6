//! COLMAP sparse models: `cameras`, `images` and an empty `points3D`, as text or binary.
//!
//! Poses in the files are `camera_from_world`, OpenCV camera axes, quaternions w x y z. Images are taken in order of
//! their names. Reference: COLMAP's output format documentation.

mod binary;
mod text;

use glam::{DQuat, DVec3};

use super::ExportError;
use super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::Pose;

pub(super) use binary::{read as read_binary, write as write_binary};
pub(super) use text::{read as read_text, write as write_text};

/// Camera models by COLMAP's number: name, number of parameters, and whether the two focal lengths are separate.
const MODELS: [(&str, usize, bool); 11] = [
    ("SIMPLE_PINHOLE", 3, false),
    ("PINHOLE", 4, true),
    ("SIMPLE_RADIAL", 4, false),
    ("RADIAL", 5, false),
    ("OPENCV", 8, true),
    ("OPENCV_FISHEYE", 8, true),
    ("FULL_OPENCV", 12, true),
    ("FOV", 5, true),
    ("SIMPLE_RADIAL_FISHEYE", 4, false),
    ("RADIAL_FISHEYE", 5, false),
    ("THIN_PRISM_FISHEYE", 12, true),
];
/// Index of `PINHOLE` in [`MODELS`].
const PINHOLE: usize = 1;

/// A camera of the model: image size and vertical focal length.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lens {
    id: u32,
    width: u32,
    height: u32,
    focal_y_px: f64,
}

impl Lens {
    /// The lens of a model by number with its parameters; `None` for a model or a count that does not exist.
    fn new(id: u32, model: usize, size: (u32, u32), params: &[f64]) -> Option<Self> {
        let (_, num_params, two_focals) = MODELS.get(model)?;
        let focal_y_px = *params.get(usize::from(*two_focals))?;
        let usable = params.len() == *num_params && focal_y_px > 0.0 && size.0 > 0 && size.1 > 0;
        usable.then_some(Self { id, width: size.0, height: size.1, focal_y_px })
    }

    fn params(&self) -> [f64; 4] {
        [self.focal_y_px, self.focal_y_px, f64::from(self.width) / 2.0, f64::from(self.height) / 2.0]
    }
}

/// An image of the model.
#[derive(Debug, Clone, PartialEq)]
struct Image {
    name: String,
    lens_id: u32,
    /// `camera_from_world`.
    rotation: DQuat,
    translation: DVec3,
}

/// The track of a model's images.
fn track(mut images: Vec<Image>, lenses: &[Lens]) -> PoseTrack {
    images.sort_by(|a, b| a.name.cmp(&b.name));
    let lens_of = |image: &Image| lenses.iter().find(|lens| lens.id == image.lens_id);
    let size_px = images.first().and_then(lens_of).map(|lens| (lens.width, lens.height));
    let frame = |(idx, image): (usize, &Image)| {
        let pose = Pose::new(image.translation, image.rotation).inverse();
        let fov_y_rad = lens_of(image).map(|lens| 2.0 * (f64::from(lens.height) / 2.0 / lens.focal_y_px).atan());
        PoseFrame { fov_y_rad, ..PoseFrame::new(idx as f64 / DEFAULT_FPS, pose) }
    };
    let frames = images.iter().enumerate().map(frame).collect();
    PoseTrack { size_px, fps: Some(DEFAULT_FPS), ..PoseTrack::untimed(frames) }
}

/// Lenses and images of a track: one lens where the field of view stays, else one an image. Ids count from 1.
fn model(track: &PoseTrack) -> (Vec<Lens>, Vec<Image>) {
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let mut lenses: Vec<Lens> = Vec::new();
    let mut images = Vec::with_capacity(track.frames.len());
    for (idx, frame) in track.frames.iter().enumerate() {
        let focal_y_px = f64::from(height) / 2.0 / (fov_y_or_default(frame) / 2.0).tan();
        if lenses.last().is_none_or(|last| last.focal_y_px.to_bits() != focal_y_px.to_bits()) {
            lenses.push(Lens { id: lenses.len() as u32 + 1, width, height, focal_y_px });
        }
        let back = frame.pose.inverse();
        let (rotation, translation, lens_id) = (back.rotation, back.position, lenses.len() as u32);
        images.push(Image { name: format!("{idx:05}.png"), lens_id, rotation, translation });
    }
    (lenses, images)
}

/// Number of a model by name.
fn model_number(name: &str) -> Option<usize> {
    MODELS.iter().position(|(known, _, _)| *known == name)
}

/// Files of a model by name, to be written into one folder.
pub(super) type ModelFiles = Vec<(&'static str, Vec<u8>)>;

/// Fails where a model has no images.
fn non_empty(images: Vec<Image>) -> Result<Vec<Image>, ExportError> {
    if images.is_empty() { Err(ExportError::NoPoses) } else { Ok(images) }
}
