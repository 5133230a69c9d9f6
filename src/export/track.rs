use glam::{DMat3, DVec3};

use super::ExportError;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraPath, Easing, Keyframe, SceneRef, Shot, TrajectoryError};

/// Vertical field of view that a shot gets when its file holds none, in degrees.
pub const DEFAULT_FOV_Y_DEG: f64 = 50.0;
/// Frame rate that gives times to poses of files without times.
pub const DEFAULT_FPS: f64 = 30.0;
/// Image size of a shot whose file holds none, pixels.
pub const DEFAULT_SIZE_PX: (u32, u32) = (1280, 720);

/// Timed camera poses as files of other programs hold them: every frame of a film, or its keyframes.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseTrack {
    /// Image width and height in pixels; `None` where the file does not say.
    pub size_px: Option<(u32, u32)>,
    /// Frames a second; `None` where the file does not say and times are not even.
    pub fps: Option<f64>,
    /// World up; `None` where the file does not say.
    pub up: Option<DVec3>,
    /// Whether the file holds times. Without them `time_secs` counts frames at [`DEFAULT_FPS`].
    pub timed: bool,
    /// The poses in order of time (in file order without times), at least one.
    pub frames: Vec<PoseFrame>,
    /// The keyframes behind sampled `frames`, for formats that hold both; empty where `frames` are the keys or unknown.
    pub keys: Vec<PoseFrame>,
}

/// The camera at one moment of a [`PoseTrack`].
#[derive(Debug, Clone, PartialEq)]
pub struct PoseFrame {
    /// When, on the file's own clock (which may count from 1970).
    pub time_secs: f64,
    /// Where, `world_from_camera`.
    pub pose: Pose,
    /// Vertical field of view; `None` where the file does not say.
    pub fov_y_rad: Option<f64>,
    /// Distance of sharpest focus, scene units.
    pub focus_distance: Option<f64>,
    /// Shape of the way to the next frame; linear between sampled frames.
    pub easing: Easing,
    /// Whether the camera jumps from the frame before to this one.
    pub cut: bool,
    /// The rotation matrix as it stands in the file, where the file holds matrices: its rounding is off orthonormal by
    /// what the file's digits lose, and error measures that are to agree with other programs see that.
    pub matrix: Option<DMat3>,
}

impl PoseFrame {
    /// A pose at a time, nothing else known.
    pub fn new(time_secs: f64, pose: Pose) -> Self {
        let easing = Easing::Linear;
        Self { time_secs, pose, fov_y_rad: None, focus_distance: None, easing, cut: false, matrix: None }
    }
}

impl From<&Keyframe> for PoseFrame {
    fn from(key: &Keyframe) -> Self {
        Self {
            time_secs: key.time_secs,
            pose: key.pose,
            fov_y_rad: Some(key.fov_y_rad),
            focus_distance: key.focus_distance,
            easing: key.easing,
            cut: key.cut,
            matrix: None,
        }
    }
}

impl PoseTrack {
    /// A track of which nothing but its frames is known.
    pub fn untimed(frames: Vec<PoseFrame>) -> Self {
        Self { size_px: None, fps: None, up: None, timed: false, frames, keys: Vec::new() }
    }

    /// The film's frames: the path of `shot` at `k / fps`, with the shot's own rate unless another is given.
    ///
    /// # Errors
    /// [`TrajectoryError`] when the shot or the rate is not usable.
    pub fn sampled(shot: &Shot, fps: Option<f64>) -> Result<Self, TrajectoryError> {
        let at_rate = Shot { fps: fps.unwrap_or(shot.fps), ..shot.clone() };
        let path = CameraPath::new(&at_rate)?;
        let mut frames: Vec<PoseFrame> = Vec::with_capacity(at_rate.num_frames());
        for frame_idx in 0..at_rate.num_frames() {
            let time_secs = at_rate.frame_time_secs(frame_idx);
            let state = path.sample(time_secs);
            let since = frames.last().map_or(f64::INFINITY, |last| last.time_secs);
            let cut_between = |key: &Keyframe| key.cut && since < key.time_secs && key.time_secs <= time_secs;
            frames.push(PoseFrame {
                fov_y_rad: Some(state.fov_y_rad),
                focus_distance: state.focus_distance,
                cut: at_rate.keyframes.iter().any(cut_between),
                ..PoseFrame::new(time_secs, state.pose)
            });
        }
        Ok(Self { frames, keys: Self::keyframes(shot).frames, ..Self::keyframes(&at_rate) })
    }

    /// The keyframes of `shot`.
    pub fn keyframes(shot: &Shot) -> Self {
        Self {
            size_px: Some((shot.width, shot.height)),
            fps: Some(shot.fps),
            up: shot.scene.up,
            timed: true,
            frames: shot.keyframes.iter().map(PoseFrame::from).collect(),
            keys: Vec::new(),
        }
    }

    /// A shot with one key a frame, its clock starting at 0. What the file did not say gets the defaults above, each
    /// with a line in the second value.
    ///
    /// # Errors
    /// [`ExportError::NoPoses`]; [`ExportError::BadShot`] where times do not increase or a number is out of range.
    pub fn to_shot(&self) -> Result<(Shot, Vec<String>), ExportError> {
        let (Some(first), Some(last)) = (self.frames.first(), self.frames.last()) else {
            return Err(ExportError::NoPoses);
        };
        let start = first.time_secs;
        let fps = self.fps.unwrap_or(DEFAULT_FPS);
        let (width, height) = self.size_px.unwrap_or(DEFAULT_SIZE_PX);
        let keyframe = |frame: &PoseFrame| Keyframe {
            time_secs: frame.time_secs - start,
            pose: frame.pose,
            fov_y_rad: frame.fov_y_rad.unwrap_or(DEFAULT_FOV_Y_DEG.to_radians()),
            focus_distance: frame.focus_distance,
            easing: frame.easing,
            cut: frame.cut,
            intent: None,
        };
        // The last frame is shown for a frame's time too.
        let duration_secs = last.time_secs - start + if self.is_sampled() { 1.0 / fps } else { 0.0 };
        let keyframes = self.frames.iter().map(keyframe).collect();
        let scene = SceneRef { up: self.up, ..SceneRef::default() };
        let shot = Shot { scene, ..Shot::from_keyframes([width, height], fps, duration_secs, keyframes) };
        Ok((shot.validated()?, self.assumptions()))
    }

    /// Whether the frames are evenly spaced at the rate: frames of a film and not keys.
    pub fn is_sampled(&self) -> bool {
        let Some(fps) = self.fps else { return false };
        let even = |pair: &[PoseFrame]| ((pair[1].time_secs - pair[0].time_secs) * fps - 1.0).abs() < 1e-3;
        self.frames.windows(2).all(even)
    }

    fn assumptions(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if !self.timed {
            lines.push(format!("the file has no times: frames are {DEFAULT_FPS} to the second"));
        }
        if self.size_px.is_none() {
            lines.push(format!("the file has no image size: {} x {} is assumed", DEFAULT_SIZE_PX.0, DEFAULT_SIZE_PX.1));
        }
        if self.frames.iter().any(|frame| frame.fov_y_rad.is_none()) {
            lines.push(format!("the file has no field of view: {DEFAULT_FOV_Y_DEG} degrees is assumed"));
        }
        lines
    }

    /// Width over height, of the default size where the file does not say.
    pub(super) fn aspect(&self) -> f64 {
        let (width, height) = self.size_px.unwrap_or(DEFAULT_SIZE_PX);
        f64::from(width) / f64::from(height)
    }

    /// Seconds from the first frame to the end of the last.
    pub(super) fn duration_secs(&self) -> f64 {
        let span = self.frames.first().zip(self.frames.last()).map_or(0.0, |(a, b)| b.time_secs - a.time_secs);
        span + if self.is_sampled() { self.fps.map_or(0.0, |fps| 1.0 / fps) } else { 0.0 }
    }

    /// Frames and the seconds of each since the first one.
    pub(super) fn since_start(&self) -> impl Iterator<Item = (f64, &PoseFrame)> {
        let start = self.frames.first().map_or(0.0, |first| first.time_secs);
        self.frames.iter().map(move |frame| (frame.time_secs - start, frame))
    }
}

/// Vertical field of view of a frame or its default.
pub(super) fn fov_y_or_default(frame: &PoseFrame) -> f64 {
    frame.fov_y_rad.unwrap_or(DEFAULT_FOV_Y_DEG.to_radians())
}
