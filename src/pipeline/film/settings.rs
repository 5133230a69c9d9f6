use std::ops::Range;
use std::path::{Path, PathBuf};

use super::effects::{Filmed, called_effects};
use crate::pipeline::error::PipelineError;
use crate::pipeline::frames::FrameRange;
use crate::pipeline::job::{Access, Fingerprint, Job, JobSettings};
use cinesplat_lens::EffectChoice;
use cinesplat_render::RenderSettings;
use cinesplat_scene::Scene;
use cinesplat_trajectory::Shot;
use cinesplat_video::VideoSettings;

/// How a shot becomes a film.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FilmSettings {
    /// How frames are rendered.
    pub render: RenderSettings,
    /// Which effects the film gets.
    pub effects: EffectChoice,
    /// How frames are encoded. Size, rate and frame numbers come from the shot instead.
    pub video: VideoSettings,
    /// The frames to render.
    pub frames: FrameRange,
    /// Path of a contact sheet; `None` = no contact sheet.
    pub sheet: Option<PathBuf>,
    /// How finished frames are kept until the film is whole; `None` = not at all: a film that is stopped is lost.
    pub job: Option<JobSettings>,
}

impl FilmSettings {
    /// The settings that suit a scene: all frames at `standard` quality, H.264 that is hard to tell from the frames, no
    /// contact sheet, no job folder.
    pub fn for_scene(scene: &Scene) -> Self {
        Self { render: RenderSettings::for_scene(scene), ..Self::default() }
    }

    /// The fingerprint of a film of these frames of a shot.
    fn fingerprint(&self, shot: &Shot, frames: &Range<usize>) -> Fingerprint {
        let inputs = self.job.as_ref().map(|job| job.inputs.as_slice()).unwrap_or_default();
        let effects = Filmed::requests(&called_effects(shot, &self.effects, 0.0));
        let shot = Shot { effects, ..shot.clone() };
        Fingerprint::of(&shot, &self.render, &video_of(&shot, frames, &self.video), inputs)
    }

    /// The job folder of a film of these frames, if there is to be one.
    pub(super) fn open_job(
        &self,
        output: &Path,
        shot: &Shot,
        frames: &Range<usize>,
        access: Access,
    ) -> Result<Option<Job>, PipelineError> {
        let Some(settings) = &self.job else { return Ok(None) };
        let video = video_of(shot, frames, &self.video);
        Ok(Some(Job::open(output, &video, &self.fingerprint(shot, frames), settings, access)?))
    }
}

/// Encoder settings for these frames of a shot.
pub fn video_of(shot: &Shot, frames: &Range<usize>, video: &VideoSettings) -> VideoSettings {
    VideoSettings {
        width: shot.width,
        height: shot.height,
        rate_fps: shot.fps,
        first_frame: frames.start,
        num_frames: frames.len(),
        ..video.clone()
    }
}
