use std::path::Path;

use cinesplat_files::Existing;

use super::bt709::{Planes420, planes_from_rgb8};
use super::{FramePattern, VideoError};

/// Encoder threads. x264 writes their number into the file; a constant keeps the bytes the same on every machine.
pub(super) const NUM_THREADS: usize = 4;

/// Settings of a film or of a picture sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct VideoSettings {
    /// Frame width in pixels.
    pub width: u32,
    /// Frame height in pixels.
    pub height: u32,
    /// Frames per second, 0.01..=1000.
    pub rate_fps: f64,
    /// Constant rate factor: 0 (best) to 51 for H.264, 0 to 63 for VP9. At about 18 the loss is hard to see. Lowering
    /// it by 4 makes an H.264 file at 720p about 1.5 times as large.
    pub crf: u8,
    /// Effort of the H.264 encoder: a slower preset gives a smaller file at the same quality. `None` = `medium`.
    pub preset: Option<X264Preset>,
    /// Number of the first picture of a sequence. Films always start at time zero.
    pub first_frame: usize,
    /// Expected number of frames, 0 = unknown. If it is known, an MP4 or MOV reserves room for its index at the front,
    /// so that it plays while it loads.
    pub num_frames: usize,
    /// Whether the frames show all directions, by longitude and latitude: MP4 and MOV then say so to players.
    pub is_panorama: bool,
    /// How the frames hold one view per eye, which all four containers then say to players; `None` for a single view.
    pub eyes: Option<EyePacking>,
    /// Whether the frames have opacity: a MOV is `ProRes` 4444 then, and takes [`crate::AlphaPlanes`]. The other films are over
    /// black.
    pub has_alpha: bool,
    /// Whether files that already have the output's name are kept or replaced.
    pub existing: Existing,
}

impl Default for VideoSettings {
    fn default() -> Self {
        Self {
            width: 1280,
            height: 720,
            rate_fps: 30.0,
            crf: 18,
            preset: None,
            first_frame: 0,
            num_frames: 0,
            is_panorama: false,
            eyes: None,
            has_alpha: false,
            existing: Existing::Keep,
        }
    }
}

impl VideoSettings {
    /// Bytes of one frame: width x height x 3.
    pub fn frame_bytes(&self) -> usize {
        self.width as usize * self.height as usize * 3
    }

    /// A frame (`width * height * 3` bytes, row-major, r g b) as the encoders take it.
    pub fn planes_of(&self, rgb8: &[u8]) -> Planes420 {
        planes_from_rgb8(rgb8, self.width as usize, self.height as usize)
    }

    /// Bytes of one frame as the encoders take it.
    pub fn planes_bytes(&self) -> usize {
        self.width.next_multiple_of(2) as usize * self.height.next_multiple_of(2) as usize * 3 / 2
    }

    /// The settings, checked for `format`.
    ///
    /// # Errors
    /// [`VideoError::BadSetting`] names the first setting that is out of range.
    pub(super) fn validated(self, format: &VideoFormat) -> Result<Self, VideoError> {
        let bad = |what, found: String, expected| Err(VideoError::BadSetting { what, found, expected });
        if !(1..=16384).contains(&self.width) || !(1..=16384).contains(&self.height) {
            return bad("frame size", format!("{}x{}", self.width, self.height), "1 to 16384 pixels per side");
        }
        if !(self.rate_fps >= 0.01 && self.rate_fps <= 1000.0) {
            return bad("frame rate", self.rate_fps.to_string(), "0.01 to 1000 frames per second");
        }
        match format {
            VideoFormat::WebM if self.crf > 63 => bad("crf", self.crf.to_string(), "0 to 63 for VP9"),
            VideoFormat::Mp4 | VideoFormat::Mkv | VideoFormat::Mov if self.crf > 51 => {
                bad("crf", self.crf.to_string(), "0 to 51 for H.264")
            }
            _ => Ok(self),
        }
    }
}

/// How a frame holds one view per eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EyePacking {
    /// The left eye's view on the left.
    SideBySide,
    /// The left eye's view above.
    OverUnder,
}

/// Effort of the H.264 encoder, by the names of x264's presets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum X264Preset {
    /// The least effort.
    Ultrafast,
    /// Between ultrafast and veryfast.
    Superfast,
    /// Little effort.
    Veryfast,
    /// Between veryfast and fast.
    Faster,
    /// Some effort.
    Fast,
    /// x264's own default.
    #[default]
    Medium,
    /// More effort.
    Slow,
    /// Much effort.
    Veryslow,
}

/// Container and codec of an output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum VideoFormat {
    /// H.264 in MP4.
    Mp4,
    /// H.264 in Matroska.
    Mkv,
    /// H.264 in QuickTime; `ProRes` 4444 for frames with opacity.
    Mov,
    /// VP9 in WebM.
    WebM,
    /// One PNG or `OpenEXR` file per frame.
    Sequence(FramePattern),
}

impl VideoFormat {
    /// The format of a path, by its extension: `.mp4`, `.m4v`, `.mkv`, `.mov`, `.webm`, or `.png` and `.exr`
    /// for a sequence.
    ///
    /// # Errors
    /// [`VideoError::UnknownFormat`] for another extension, [`VideoError::BadPattern`] for a `.png` name that is not a
    /// [`FramePattern`].
    pub fn from_path(path: &Path) -> Result<Self, VideoError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        match extension.as_str() {
            "mp4" | "m4v" => Ok(Self::Mp4),
            "mkv" => Ok(Self::Mkv),
            "mov" => Ok(Self::Mov),
            "webm" => Ok(Self::WebM),
            "png" | "exr" => FramePattern::parse(path).map(Self::Sequence),
            _ => Err(VideoError::UnknownFormat { found: extension, path: path.to_owned() }),
        }
    }

    /// The extension of its files, without a dot.
    pub fn extension(&self) -> &'static str {
        match self {
            Self::Mp4 => "mp4",
            Self::Mkv => "mkv",
            Self::Mov => "mov",
            Self::WebM => "webm",
            Self::Sequence(pattern) if pattern.is_exr() => "exr",
            Self::Sequence(_) => "png",
        }
    }

    /// Whether its files hold opacity.
    pub fn holds_alpha(&self) -> bool {
        matches!(self, Self::Mov | Self::Sequence(_))
    }

    /// Whether its files say to players that a film shows all directions.
    pub fn marks_panoramas(&self) -> bool {
        matches!(self, Self::Mp4 | Self::Mov)
    }

    /// FFmpeg's names of the container and the encoder; `None` for a sequence.
    pub(super) fn ffmpeg_names(&self, has_alpha: bool) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Mov if has_alpha => Some(("mov", "prores_ks")),
            Self::Mp4 => Some(("mp4", "libx264")),
            Self::Mkv => Some(("matroska", "libx264")),
            Self::Mov => Some(("mov", "libx264")),
            Self::WebM => Some(("webm", "libvpx-vp9")),
            Self::Sequence(_) => None,
        }
    }
}
