//! `transforms.json` of NeRF, instant-ngp and nerfstudio: images with poses and intrinsics.
//!
//! `transform_matrix` is `world_from_camera` with OpenGL camera axes. `fl_x fl_y cx cy w h` in pixels are at the top
//! level or in each frame; `camera_angle_x` (rad) may replace the focal length, in the files of NeRF without an image
//! size. `k1`.. and `p1 p2` are OpenCV's, of a fisheye with `camera_model` `OPENCV_FISHEYE` or `is_fisheye`. The format has no times: this program
//! adds `time_secs` to frames and `fps`, which other readers ignore.

use glam::DMat3;

use super::ExportError;
use super::json_read::{self, Node};
use super::json_write::{Json, matrix_rows, object};
use super::lens_losses::LensLosses;
use super::name_order::out_of_order;
use super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, ImageLens, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::Intrinsics;
use cinesplat_geometry::frames::{from_opengl, to_opengl};
use cinesplat_trajectory::LensModel;

pub(super) fn write(track: &PoseTrack) -> String {
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let frames = track.frames.iter().enumerate().map(|(idx, frame)| {
        let focal_px = f64::from(height) / 2.0 / (fov_y_or_default(frame) / 2.0).tan();
        object([
            ("file_path", format!("images/{idx:05}.png").as_str().into()),
            ("fl_x", focal_px.into()),
            ("fl_y", focal_px.into()),
            ("cx", (f64::from(width) / 2.0).into()),
            ("cy", (f64::from(height) / 2.0).into()),
            ("w", width.into()),
            ("h", height.into()),
            ("time_secs", frame.time_secs.into()),
            ("transform_matrix", matrix_rows(to_opengl(&frame.pose))),
        ])
    });
    let fps = track.fps.unwrap_or(DEFAULT_FPS);
    object([("camera_model", "OPENCV".into()), ("fps", fps.into()), ("frames", Json::list(frames))]).pretty()
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    let nodes = root.field("frames", "a list of frames")?.items()?;
    let fps = root.optional("fps").map(|node| node.number()).transpose()?.filter(|fps| *fps > 0.0);
    let mut frames = Vec::with_capacity(nodes.len());
    let mut timed = !nodes.is_empty();
    let mut size_px = None;
    let mut lenses = Vec::with_capacity(nodes.len());
    let mut losses = LensLosses::default();
    let model = root.optional("camera_model").and_then(|node| node.text().ok()).unwrap_or_default();
    losses.model(model);
    let kind = LensKind::of(&root, model);
    for (idx, node) in nodes.iter().enumerate() {
        let time_secs = node.optional("time_secs").map(|time| time.number()).transpose()?;
        timed &= time_secs.is_some();
        let matrix_node = node.field("transform_matrix", "a 4 x 4 matrix, row-major")?;
        let matrix = matrix_node.matrix()?;
        let pose = from_opengl(matrix).map_err(|error| matrix_node.error(format!("a rigid pose ({error})")))?;
        let intrinsics = FrameIntrinsics::read(node, &root)?;
        intrinsics.note_losses(&mut losses);
        let coefficients = note_distortion(node, &root, &mut losses)?;
        losses.lens(kind.lens(&coefficients, &intrinsics));
        size_px = size_px.or(intrinsics.size_px());
        let fov_y_rad = intrinsics.fov_y_rad();
        lenses.push(intrinsics.lens());
        let opencv_axes = DMat3::from_mat4(matrix) * DMat3::from_diagonal(glam::DVec3::new(1.0, -1.0, -1.0));
        frames.push(PoseFrame {
            fov_y_rad,
            fov_x_rad: intrinsics.angle_x.filter(|_| fov_y_rad.is_none()),
            matrix: Some(opencv_axes),
            ..PoseFrame::new(time_secs.unwrap_or(idx as f64 / fps.unwrap_or(DEFAULT_FPS)), pose)
        });
    }
    let (is_distorted, lens_model) = (losses.is_distorted(), losses.lens_model());
    let mut unread = losses.into_lines();
    let names: Option<Vec<String>> =
        nodes.iter().map(|node| node.optional("file_path")?.text().ok().map(str::to_owned)).collect();
    if !timed {
        let names = nodes.iter().filter_map(|node| node.optional("file_path")?.text().ok());
        unread.extend(out_of_order(names));
    }
    let images = names.unwrap_or_default();
    let size = PoseTrack { size_px, fps, timed, ..PoseTrack::untimed(frames) };
    Ok(PoseTrack { images, lenses, is_distorted, lens_model, unread, ..size })
}

/// The coefficients of a frame, which are noted as losses, too.
fn note_distortion(
    frame: &Node,
    root: &Node,
    losses: &mut LensLosses,
) -> Result<Vec<(&'static str, f64)>, ExportError> {
    let mut coefficients = Vec::new();
    for name in ["k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"] {
        if let Some(node) = frame.optional(name).or_else(|| root.optional(name)) {
            let value = node.number()?;
            losses.distortion(name, value);
            coefficients.push((name, value));
        }
    }
    Ok(coefficients)
}

/// What the coefficients of a file mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LensKind {
    /// A pinhole with k1 to k3, p1 and p2; what k4 is differs between programs.
    Perspective,
    /// The same with k4 to k6.
    Rational,
    /// A fisheye with k1 to k4.
    Fisheye,
    /// None that is known.
    Other,
}

impl LensKind {
    fn of(root: &Node, model: &str) -> Self {
        let is_fisheye = root.optional("is_fisheye").is_some_and(|flag| flag.flag().unwrap_or(false));
        match model.to_ascii_uppercase().as_str() {
            "FULL_OPENCV" => Self::Rational,
            "OPENCV_FISHEYE" => Self::Fisheye,
            "" | "OPENCV" if is_fisheye => Self::Fisheye,
            "" | "OPENCV" | "PINHOLE" | "SIMPLE_PINHOLE" | "RADIAL" | "SIMPLE_RADIAL" | "PERSPECTIVE" => {
                Self::Perspective
            }
            _ => Self::Other,
        }
    }

    /// The lens with these coefficients; `None` if it has one that is not known.
    fn lens(self, coefficients: &[(&str, f64)], intrinsics: &FrameIntrinsics) -> Option<LensModel> {
        let known: &[&str] = match self {
            Self::Perspective => &["k1", "k2", "k3", "p1", "p2"],
            Self::Rational => &["k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"],
            Self::Fisheye => &["k1", "k2", "k3", "k4"],
            Self::Other => return None,
        };
        if coefficients.iter().any(|(name, value)| value.abs() > 0.0 && !known.contains(name)) {
            return None;
        }
        let ([off_x, off_y], stretch) = (intrinsics.off_center_px(), intrinsics.stretch());
        let height_px = intrinsics.height.unwrap_or(f64::INFINITY);
        let value = |name: &str| match name {
            "fisheye" => Some(f64::from(u8::from(self == Self::Fisheye))),
            "center_x" => Some(off_x / height_px),
            "center_y" => Some(off_y / height_px),
            "stretch" => Some(stretch),
            _ => coefficients.iter().find(|(known, _)| *known == name).map(|(_, value)| *value),
        };
        Some(LensModel::of_values(value))
    }
}

/// Intrinsics of a frame, from its own keys or from those at the top level.
struct FrameIntrinsics {
    width: Option<f64>,
    height: Option<f64>,
    fl_x: Option<f64>,
    fl_y: Option<f64>,
    angle_x: Option<f64>,
    angle_y: Option<f64>,
    cx: Option<f64>,
    cy: Option<f64>,
}

impl FrameIntrinsics {
    fn read(frame: &Node, root: &Node) -> Result<Self, ExportError> {
        let get = |name: &str| -> Result<Option<f64>, ExportError> {
            let node = frame.optional(name).or_else(|| root.optional(name));
            Ok(node.map(|node| node.number()).transpose()?.filter(|v| *v > 0.0))
        };
        Ok(Self {
            width: get("w")?,
            height: get("h")?,
            fl_x: get("fl_x")?,
            fl_y: get("fl_y")?,
            angle_x: get("camera_angle_x")?,
            angle_y: get("camera_angle_y")?,
            cx: get("cx")?,
            cy: get("cy")?,
        })
    }

    fn note_losses(&self, losses: &mut LensLosses) {
        losses.principal_point_px(self.off_center_px());
        if let (Some(fl_x), Some(fl_y)) = (self.fl_x, self.fl_y) {
            losses.focal_px(fl_x, fl_y);
        }
    }

    /// Offset of the principal point from the image's center, px.
    fn off_center_px(&self) -> [f64; 2] {
        let off = |center: Option<f64>, size: Option<f64>| center.zip(size).map_or(0.0, |(at, size)| at - size / 2.0);
        [off(self.cx, self.width), off(self.cy, self.height)]
    }

    /// Horizontal over vertical focal length.
    fn stretch(&self) -> f64 {
        self.fl_x.zip(self.fl_y).map_or(1.0, |(fl_x, fl_y)| fl_x / fl_y)
    }

    fn size_px(&self) -> Option<(u32, u32)> {
        self.width.zip(self.height).map(|(width, height)| (width as u32, height as u32))
    }

    fn lens(&self) -> ImageLens {
        let focal = |size: f64, angle: f64| size / 2.0 / (angle / 2.0).tan();
        let from_angle = self.width.zip(self.angle_x).map(|(width, angle)| focal(width, angle));
        let fx_px = self.fl_x.or(self.fl_y).or(from_angle);
        if let (Some((width, height)), Some(fx_px)) = (self.size_px(), fx_px) {
            let [cx, cy] = [f64::from(width) / 2.0, f64::from(height) / 2.0];
            return ImageLens::Pixels(Intrinsics {
                width,
                height,
                fx_px,
                fy_px: self.fl_y.unwrap_or(fx_px),
                cx_px: self.cx.unwrap_or(cx),
                cy_px: self.cy.unwrap_or(cy),
            });
        }
        self.angle_x.map_or(ImageLens::Unknown, ImageLens::AcrossRad)
    }

    fn fov_y_rad(&self) -> Option<f64> {
        let from_x = || self.width.zip(self.angle_x).map(|(width, angle)| width / 2.0 / (angle / 2.0).tan());
        let focal_px = self.fl_y.or(self.fl_x).or_else(from_x);
        let from_focal = self.height.zip(focal_px).map(|(height, focal)| 2.0 * (height / 2.0 / focal).atan());
        from_focal.or(self.angle_y)
    }
}
