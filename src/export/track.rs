use glam::{DMat3, DVec3};

use cinesplat_geometry::{Intrinsics, Pose};
use cinesplat_trajectory::{CameraPath, Easing, Keyframe, LensModel, Shot, TrajectoryError};

/// Vertical field of view of a shot whose file states none, degrees.
pub(super) const DEFAULT_FOV_Y_DEG: f64 = 50.0;
/// Frame rate of the poses of a file without times, frames per second.
pub(super) const DEFAULT_FPS: f64 = 30.0;
/// Image width and height of a shot whose file states none, pixels.
pub(super) const DEFAULT_SIZE_PX: (u32, u32) = (1280, 720);

/// Timed camera poses of a file: every frame of a film, or its keyframes.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseTrack {
    /// Image width and height in pixels; `None` if the file does not state them.
    pub size_px: Option<(u32, u32)>,
    /// Width over height of the image, of a file that states it without a size.
    pub stated_aspect: Option<f64>,
    /// Frames per second; `None` if the file states no rate.
    pub fps: Option<f64>,
    /// World up; `None` if the file does not state it.
    pub up: Option<DVec3>,
    /// The side of the image along which the file states fields of view.
    pub lens_side: LensSide,
    /// Whether the file holds times. If not, `time_secs` counts frames at 30 per second.
    pub timed: bool,
    /// Whether the frames of a track without times are numbered: frames that are missing leave gaps in `time_secs`.
    pub is_numbered: bool,
    /// The poses in order of time (in file order without times), at least one.
    pub frames: Vec<PoseFrame>,
    /// The keyframes of sampled `frames`, for formats that hold both; empty if `frames` are the keyframes or they are
    /// unknown.
    pub keys: Vec<PoseFrame>,
    /// Name of the image of each of the `frames` in a capture; empty if the file names none.
    pub images: Vec<String>,
    /// The lens of each of the `images`; empty if the format has none.
    pub lenses: Vec<ImageLens>,
    /// Whether the file states a lens distortion that a pinhole leaves out.
    pub is_distorted: bool,
    /// The lens of all images, of a file that states one with a distortion.
    pub lens_model: Option<LensModel>,
    /// One line per thing in the file that was not read.
    pub unread: Vec<String>,
}

/// What a file states of the lens of an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImageLens {
    /// Size, focal lengths and principal point.
    Pixels(Intrinsics),
    /// The horizontal field of view alone, rad.
    AcrossRad(f64),
    /// At most the vertical field of view, which the frame has.
    Unknown,
}

/// The side of the image along which a file states fields of view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LensSide {
    /// Upward.
    #[default]
    Vertical,
    /// The larger side, of an image whose size the file does not state. The vertical fields of view in memory are those of
    /// the default size.
    Larger,
}

/// The camera at one moment of a [`PoseTrack`].
#[derive(Debug, Clone, PartialEq)]
pub struct PoseFrame {
    /// Time on the file's clock, which may start in 1970.
    pub time_secs: f64,
    /// `world_from_camera`.
    pub pose: Pose,
    /// Vertical field of view; `None` if the file does not state it.
    pub fov_y_rad: Option<f64>,
    /// Horizontal field of view, of a file that states it without the image size that makes a vertical one of it.
    pub fov_x_rad: Option<f64>,
    /// Distance of sharpest focus, scene units; `None` if the file does not state it.
    pub focus_distance: Option<f64>,
    /// Speed profile up to the next frame; linear between sampled frames.
    pub easing: Easing,
    /// Whether the camera jumps from the previous frame to this one.
    pub cut: bool,
    /// The file's own rotation matrix, with OpenCV camera axes; `None` if the file holds quaternions. A rounded matrix
    /// is not exactly orthonormal, and error measures that agree with other programs need it unchanged.
    pub matrix: Option<DMat3>,
}

impl PoseFrame {
    /// A pose at a time, without lens or cut.
    pub fn new(time_secs: f64, pose: Pose) -> Self {
        let easing = Easing::Linear;
        Self {
            time_secs,
            pose,
            fov_y_rad: None,
            fov_x_rad: None,
            focus_distance: None,
            easing,
            cut: false,
            matrix: None,
        }
    }
}

impl From<&Keyframe> for PoseFrame {
    fn from(key: &Keyframe) -> Self {
        Self {
            time_secs: key.time_secs,
            pose: key.pose,
            fov_y_rad: Some(key.fov_y_rad),
            fov_x_rad: None,
            focus_distance: key.focus_distance,
            easing: key.easing,
            cut: key.cut,
            matrix: None,
        }
    }
}

impl PoseTrack {
    /// A track of frames without times, image size, rate or up.
    pub(super) fn untimed(frames: Vec<PoseFrame>) -> Self {
        Self {
            size_px: None,
            stated_aspect: None,
            fps: None,
            up: None,
            lens_side: LensSide::Vertical,
            timed: false,
            is_numbered: false,
            frames,
            keys: Vec::new(),
            images: Vec::new(),
            lenses: Vec::new(),
            is_distorted: false,
            lens_model: None,
            unread: Vec::new(),
        }
    }

    /// The frames of a shot's film: its path at the times `k / fps`. `None` takes the shot's rate.
    ///
    /// # Errors
    /// [`TrajectoryError`] if the shot or the rate is out of range.
    pub fn sampled(shot: &Shot, fps: Option<f64>) -> Result<Self, TrajectoryError> {
        let at_rate = Shot { fps: fps.unwrap_or(shot.fps), ..shot.clone() };
        let path = CameraPath::new(&at_rate)?;
        let mut frames: Vec<PoseFrame> = Vec::with_capacity(at_rate.num_frames());
        for frame_idx in 0..at_rate.num_frames() {
            let time_secs = at_rate.frame_time_secs(frame_idx);
            let state = path.sample(time_secs);
            let since = frames.last().map_or(f64::INFINITY, |last| last.time_secs);
            // The keys are in order of time.
            let first = at_rate.keyframes.partition_point(|key| key.time_secs <= since);
            let mut keys_between = at_rate.keyframes[first..].iter().take_while(|key| key.time_secs <= time_secs);
            frames.push(PoseFrame {
                fov_y_rad: Some(state.fov_y_rad),
                focus_distance: state.focus_distance,
                cut: keys_between.any(|key| key.cut),
                ..PoseFrame::new(time_secs, state.pose)
            });
        }
        Ok(Self { frames, keys: Self::keyframes(shot).frames, ..Self::keyframes(&at_rate) })
    }

    /// The keyframes of a shot.
    pub fn keyframes(shot: &Shot) -> Self {
        Self {
            size_px: Some((shot.width, shot.height)),
            fps: Some(shot.fps),
            up: shot.scene.up,
            timed: true,
            ..Self::untimed(shot.keyframes.iter().map(PoseFrame::from).collect())
        }
    }

    /// Whether the times are even at the frame rate, as for the frames of a film.
    pub(super) fn is_sampled(&self) -> bool {
        let Some(fps) = self.fps else { return false };
        let even = |pair: &[PoseFrame]| ((pair[1].time_secs - pair[0].time_secs) * fps - 1.0).abs() < 1e-3;
        self.frames.windows(2).all(even)
    }

    /// Width over height of the image, or of the default size.
    pub(super) fn aspect(&self) -> f64 {
        let (width, height) = self.size_px.unwrap_or(DEFAULT_SIZE_PX);
        f64::from(width) / f64::from(height)
    }

    /// Seconds from the first frame to the end of the last.
    pub(super) fn duration_secs(&self) -> f64 {
        let span = self.frames.first().zip(self.frames.last()).map_or(0.0, |(a, b)| b.time_secs - a.time_secs);
        span + if self.is_sampled() { self.fps.map_or(0.0, |fps| 1.0 / fps) } else { 0.0 }
    }

    /// Each frame with its time since the first, seconds.
    pub(super) fn since_start(&self) -> impl Iterator<Item = (f64, &PoseFrame)> {
        let start = self.frames.first().map_or(0.0, |first| first.time_secs);
        self.frames.iter().map(move |frame| (frame.time_secs - start, frame))
    }
}

/// Vertical field of view of a frame, or the default, rad.
pub(super) fn fov_y_or_default(frame: &PoseFrame) -> f64 {
    frame.fov_y_rad.unwrap_or(DEFAULT_FOV_Y_DEG.to_radians())
}
