use std::ops::Range;
use std::path::{Path, PathBuf};

use super::effects::{Filmed, called_effects};
use crate::pipeline::error::PipelineError;
use crate::pipeline::frames::FrameRange;
use crate::pipeline::job::{Access, Fingerprint, Job, JobSettings};
use crate::pipeline::promise::Promise;
use cinesplat_lens::{EffectChoice, EyeLayout};
use cinesplat_render::{Quality, RenderSettings};
use cinesplat_scene::Scene;
use cinesplat_trajectory::Shot;
use cinesplat_video::{EyePacking, VideoSettings, X264Preset};

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
    /// What is watched while the film is made, and may change the quality of frames; `None` = nothing.
    pub promise: Option<Promise>,
}

impl FilmSettings {
    /// The settings that suit a scene: all frames at `standard` quality, H.264 that is hard to tell from the frames, no
    /// contact sheet, no job folder.
    pub fn for_scene(scene: &Scene) -> Self {
        Self { render: RenderSettings::for_scene(scene), ..Self::default() }
    }

    /// The fingerprint of a film of these frames of a shot.
    fn fingerprint(&self, shot: &Shot, frames: &Range<usize>) -> Fingerprint {
        let mut inputs = self.job.as_ref().map(|job| job.inputs.clone()).unwrap_or_default();
        // The quality of a frame may be another one than that of the settings.
        if let Some(promise) = &self.promise {
            let least = promise.min_psnr_db.map_or_else(String::new, |least| least.to_string());
            inputs.push(("min-psnr", least));
            inputs.push(("budget", if promise.deadline.is_some() { "kept" } else { "" }.to_owned()));
        }
        let effects = Filmed::requests(&called_effects(shot, &self.effects, 0.0));
        let shot = Shot { effects, ..shot.clone() };
        Fingerprint::of(&shot, &self.render, &self.video_for(&shot, frames), &inputs)
    }

    /// Encoder settings for these frames of a shot, with what its effects say about the pictures and with the effort that
    /// suits the quality where none is asked for.
    pub fn video_for(&self, shot: &Shot, frames: &Range<usize>) -> VideoSettings {
        let called = called_effects(shot, &self.effects, 1.0).effects;
        let packing = |layout: EyeLayout| match layout {
            EyeLayout::SideBySide => EyePacking::SideBySide,
            EyeLayout::OverUnder => EyePacking::OverUnder,
        };
        VideoSettings {
            preset: self.video.preset.or(Some(suited_preset(self.render.quality))),
            is_panorama: called.iter().any(|called| called.effect.is_panorama()),
            eyes: called.iter().find_map(|called| called.effect.eyes()).map(packing),
            has_alpha: called.iter().any(|called| called.effect.is_transparent()),
            ..video_of(shot, frames, &self.video)
        }
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
        let video = self.video_for(shot, frames);
        Ok(Some(Job::open(output, &video, &self.fingerprint(shot, frames), settings, access)?))
    }
}

/// The effort of the H.264 encoder that suits a quality. `cinesplat bench encoder` draws the curves behind it.
///
/// On the demo at 720p and rate factor 18, `medium` takes 42 ms of one core per frame. For the same SSIM `faster` takes 28 ms
/// and 94 % of the bits, `veryfast` 17 ms and 107 %, `ultrafast` 6 ms and six times the bits, which a draft may have.
pub fn suited_preset(quality: Quality) -> X264Preset {
    match quality {
        Quality::Draft => X264Preset::Ultrafast,
        Quality::Standard => X264Preset::Veryfast,
        Quality::Final => X264Preset::Medium,
        Quality::Reference => X264Preset::Slow,
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
