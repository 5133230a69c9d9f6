use std::path::{Path, PathBuf};
use std::time::Duration;

use cinesplat_lens::EffectPlan;
use cinesplat_render::Quality;
use cinesplat_video::VideoFormat;

/// Progress of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FilmProgress {
    /// Frames that are finished; the last of them may be on its way to the job folder.
    pub done: usize,
    /// Frames of the film.
    pub total: usize,
    /// Frames that an earlier run left in the job folder.
    pub num_kept: usize,
}

/// Result of a film.
#[derive(Debug, Clone)]
pub struct FilmReport {
    /// The film, or the folder of its pictures. A film that was stopped is not there yet.
    pub path: PathBuf,
    /// Frames that are finished.
    pub num_frames: usize,
    /// Frames requested.
    pub num_wanted: usize,
    /// Frames that were taken from the job folder.
    pub num_kept: usize,
    /// Frames of the job folder that were damaged and are rendered again.
    pub num_damaged: usize,
    /// Pictures of a longer film that this sequence replaced: they were removed from behind its end.
    pub num_removed: usize,
    /// Time spent rendering.
    pub render_time: Duration,
    /// Time spent keeping frames in the job folder, most of it parallel to rendering.
    pub keep_time: Duration,
    /// Time spent encoding and writing, most of it parallel to rendering.
    pub encode_time: Duration,
    /// Wall time of the whole film.
    pub total_time: Duration,
    /// Each frame that was rendered, with its quality. A frame with the camera of the one before is not rendered again.
    pub qualities: Vec<(usize, Quality)>,
    /// Frames whose effects took the samples of `reference` at another quality, to keep a least PSNR.
    pub num_finest: usize,
    /// The effects, and the frames that they ran on.
    pub effects: EffectPlan,
}

impl FilmReport {
    /// Whether the film was stopped before its last frame.
    pub fn is_partial(&self) -> bool {
        self.num_frames < self.num_wanted
    }

    /// The report of a film of which nothing is done yet.
    pub(super) fn new(output: &Path, num_wanted: usize) -> Self {
        let path = match VideoFormat::from_path(output) {
            Ok(VideoFormat::Sequence(pattern)) => pattern.folder().to_owned(),
            _ => output.to_owned(),
        };
        Self {
            path,
            num_frames: 0,
            num_wanted,
            num_kept: 0,
            num_damaged: 0,
            num_removed: 0,
            render_time: Duration::ZERO,
            keep_time: Duration::ZERO,
            encode_time: Duration::ZERO,
            total_time: Duration::ZERO,
            qualities: Vec::new(),
            num_finest: 0,
            effects: EffectPlan::default(),
        }
    }
}
