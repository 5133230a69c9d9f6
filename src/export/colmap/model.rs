//! Cameras and images of a model in memory, independent of the text and binary forms.

use glam::{DQuat, DVec3};
use strum::VariantArray;

use super::super::ExportError;
use super::super::lens_losses::LensLosses;
use super::super::name_order::by_name;
use super::super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, ImageLens, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::{Intrinsics, Pose};
use cinesplat_trajectory::LensModel;

/// Relative difference of focal lengths that are rounding of one lens.
const SAME_FOCAL: f64 = 1e-9;

/// Files of a model as names and bytes, to be written into one folder.
pub(crate) type ModelFiles = Vec<(&'static str, Vec<u8>)>;

/// COLMAP's camera models, in the order of their numbers in binary files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray)]
#[strum(serialize_all = "SCREAMING_SNAKE_CASE")]
pub(super) enum CameraModel {
    SimplePinhole,
    Pinhole,
    SimpleRadial,
    Radial,
    Opencv,
    OpencvFisheye,
    FullOpencv,
    Fov,
    SimpleRadialFisheye,
    RadialFisheye,
    ThinPrismFisheye,
}

impl CameraModel {
    /// The model with a number; `None` for an unknown one.
    pub(super) fn from_number(number: u32) -> Option<Self> {
        Self::VARIANTS.get(number as usize).copied()
    }

    /// Number of parameters of a camera, focal lengths first.
    pub(super) fn num_params(self) -> usize {
        match self {
            Self::SimplePinhole => 3,
            Self::Pinhole | Self::SimpleRadial | Self::SimpleRadialFisheye => 4,
            Self::Radial | Self::Fov | Self::RadialFisheye => 5,
            Self::Opencv | Self::OpencvFisheye => 8,
            Self::FullOpencv | Self::ThinPrismFisheye => 12,
        }
    }

    /// Names of the parameters behind the principal point, as those of a [`LensModel`]; `None` for a model that it does not
    /// show.
    fn coefficients(self) -> Option<(f64, &'static [&'static str])> {
        match self {
            Self::SimplePinhole | Self::Pinhole => Some((0.0, &[])),
            Self::SimpleRadial => Some((0.0, &["k1"])),
            Self::Radial => Some((0.0, &["k1", "k2"])),
            Self::Opencv => Some((0.0, &["k1", "k2", "p1", "p2"])),
            Self::FullOpencv => Some((0.0, &["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"])),
            Self::SimpleRadialFisheye => Some((1.0, &["k1"])),
            Self::RadialFisheye => Some((1.0, &["k1", "k2"])),
            Self::OpencvFisheye => Some((1.0, &["k1", "k2", "k3", "k4"])),
            Self::Fov | Self::ThinPrismFisheye => None,
        }
    }

    /// The lens with these parameters, of an image of this height.
    fn lens_model(
        self,
        params: &[f64],
        [off_x_px, off_y_px]: [f64; 2],
        (stretch, height_px): (f64, f64),
    ) -> Option<LensModel> {
        let (fisheye, names) = self.coefficients()?;
        let coefficients = params.get(self.focal_y_idx() + 3..)?;
        let value = |name: &str| match name {
            "fisheye" => Some(fisheye),
            "center_x" => Some(off_x_px / height_px),
            "center_y" => Some(off_y_px / height_px),
            "stretch" => Some(stretch),
            _ => coefficients.get(names.iter().position(|known| *known == name)?).copied(),
        };
        Some(LensModel::of_values(value))
    }

    /// Index of the vertical focal length: 0 where both directions share one parameter.
    fn focal_y_idx(self) -> usize {
        match self {
            Self::SimplePinhole
            | Self::SimpleRadial
            | Self::Radial
            | Self::SimpleRadialFisheye
            | Self::RadialFisheye => 0,
            Self::Pinhole
            | Self::Opencv
            | Self::OpencvFisheye
            | Self::FullOpencv
            | Self::Fov
            | Self::ThinPrismFisheye => 1,
        }
    }
}

/// A camera of a model: image size and vertical focal length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ModelCamera {
    pub(super) id: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) focal_y_px: f64,
    /// Horizontal over vertical focal length.
    pub(super) stretch: f64,
    /// Offset of the principal point from the image's center, px.
    pub(super) off_center_px: [f64; 2],
    /// The parameter of the lens distortion with the largest magnitude.
    pub(super) distortion: f64,
    pub(super) model: CameraModel,
    /// The lens; `None` for one that no [`LensModel`] shows.
    lens_model: Option<LensModel>,
}

impl ModelCamera {
    /// A pinhole camera with a centered principal point.
    pub(super) fn pinhole(id: u32, width: u32, height: u32, focal_y_px: f64) -> Self {
        Self {
            id,
            width,
            height,
            focal_y_px,
            stretch: 1.0,
            off_center_px: [0.0; 2],
            distortion: 0.0,
            model: CameraModel::Pinhole,
            lens_model: Some(LensModel::default()),
        }
    }

    /// The camera with these parameters; `None` for a wrong number of parameters, an empty image or a focal length that
    /// is not above 0.
    pub(super) fn new(id: u32, model: CameraModel, size: (u32, u32), params: &[f64]) -> Option<Self> {
        let focal_y_px = *params.get(model.focal_y_idx())?;
        let usable = params.len() == model.num_params() && focal_y_px > 0.0 && size.0 > 0 && size.1 > 0;
        let num_focal = model.focal_y_idx() + 1;
        let [cx, cy] = [params.get(num_focal)?, params.get(num_focal + 1)?];
        let distortion = params[num_focal + 2..].iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let stretch = params[0] / focal_y_px;
        let off_center_px = [cx - f64::from(size.0) / 2.0, cy - f64::from(size.1) / 2.0];
        usable.then_some(Self {
            stretch,
            off_center_px,
            distortion: distortion.unwrap_or(0.0),
            model,
            lens_model: model.lens_model(params, off_center_px, (stretch, f64::from(size.1))),
            ..Self::pinhole(id, size.0, size.1, focal_y_px)
        })
    }

    fn lens(&self) -> ImageLens {
        ImageLens::Pixels(Intrinsics {
            width: self.width,
            height: self.height,
            fx_px: self.stretch * self.focal_y_px,
            fy_px: self.focal_y_px,
            cx_px: f64::from(self.width) / 2.0 + self.off_center_px[0],
            cy_px: f64::from(self.height) / 2.0 + self.off_center_px[1],
        })
    }

    /// The parameters of a [`CameraModel::Pinhole`]: focal lengths and principal point, px.
    pub(super) fn pinhole_params(&self) -> [f64; 4] {
        [self.focal_y_px, self.focal_y_px, f64::from(self.width) / 2.0, f64::from(self.height) / 2.0]
    }
}

/// An image of a model: a name, a camera and the pose `camera_from_world`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModelImage {
    pub(super) name: String,
    pub(super) camera_id: u32,
    pub(super) rotation: DQuat,
    pub(super) translation: DVec3,
}

/// The track of a model's images, in order of their names.
///
/// # Errors
/// [`ExportError::NoPoses`] without images.
pub(super) fn track(mut images: Vec<ModelImage>, cameras: &[ModelCamera]) -> Result<PoseTrack, ExportError> {
    if images.is_empty() {
        return Err(ExportError::NoPoses);
    }
    images.sort_by(|a, b| by_name(&a.name, &b.name));
    let camera_of = |image: &ModelImage| cameras.iter().find(|camera| camera.id == image.camera_id);
    let size_px = images.first().and_then(camera_of).map(|camera| (camera.width, camera.height));
    let frame = |(idx, image): (usize, &ModelImage)| {
        let pose = Pose::new(image.translation, image.rotation).inverse();
        let fov_y_rad =
            camera_of(image).map(|camera| 2.0 * (f64::from(camera.height) / 2.0 / camera.focal_y_px).atan());
        PoseFrame { fov_y_rad, ..PoseFrame::new(idx as f64 / DEFAULT_FPS, pose) }
    };
    let lens = |image: &ModelImage| camera_of(image).map_or(ImageLens::Unknown, ModelCamera::lens);
    let lenses = images.iter().map(lens).collect();
    let frames = images.iter().enumerate().map(frame).collect();
    let mut losses = LensLosses::default();
    for camera in images.iter().filter_map(camera_of) {
        losses.principal_point_px(camera.off_center_px);
        losses.focal_px(camera.stretch, 1.0);
        losses.distortion("a parameter", camera.distortion);
        losses.model(camera.model.into());
        losses.lens(camera.lens_model);
    }
    let (is_distorted, lens_model) = (losses.is_distorted(), losses.lens_model());
    let images = images.into_iter().map(|image| image.name).collect();
    let unread = losses.into_lines();
    Ok(PoseTrack { size_px, images, lenses, is_distorted, lens_model, unread, ..PoseTrack::untimed(frames) })
}

/// Cameras and images of a track. A new camera starts wherever the field of view changes; ids count from 1.
pub(super) fn model(track: &PoseTrack) -> (Vec<ModelCamera>, Vec<ModelImage>) {
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let mut cameras: Vec<ModelCamera> = Vec::new();
    let mut images = Vec::with_capacity(track.frames.len());
    for (idx, frame) in track.frames.iter().enumerate() {
        let focal_y_px = f64::from(height) / 2.0 / (fov_y_or_default(frame) / 2.0).tan();
        let is_same = |last: &ModelCamera| (last.focal_y_px / focal_y_px - 1.0).abs() < SAME_FOCAL;
        if !cameras.last().is_some_and(is_same) {
            cameras.push(ModelCamera::pinhole(cameras.len() as u32 + 1, width, height, focal_y_px));
        }
        let camera_from_world = frame.pose.inverse();
        images.push(ModelImage {
            name: format!("{idx:05}.png"),
            camera_id: cameras.len() as u32,
            rotation: camera_from_world.rotation,
            translation: camera_from_world.position,
        });
    }
    (cameras, images)
}
