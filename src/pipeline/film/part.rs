use std::ops::ControlFlow;
use std::path::Path;
use std::sync::mpsc::channel;
use std::time::Instant;

use super::effects::Filmed;
use super::form::Form;
use super::keeping::{Finished, Keeping};
use super::making::FrameMaker;
use super::report::{FilmProgress, FilmReport};
use super::settings::FilmSettings;
use crate::pipeline::error::PipelineError;
use crate::pipeline::frames::{FrameRange, Piece};
use crate::pipeline::job::Access;
use cinesplat_render::Renderer;
use cinesplat_trajectory::Shot;
use cinesplat_video::VideoFormat;

/// Renders frames of a film into its job folder, next to other programs that do the same; makes no film. [`super::film`]
/// makes it from the folder.
///
/// `settings.frames` are the frames of the film, `part` those that this program looks after, in the order of `piece`. A frame
/// that is finished, or that another program is rendering, is left out.
///
/// # Errors
/// As [`super::film`].
pub fn film_part(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    (settings, part, piece): (&FilmSettings, FrameRange, Piece),
    watch: &mut dyn FnMut(FilmProgress) -> ControlFlow<()>,
) -> Result<FilmReport, PipelineError> {
    let start = Instant::now();
    let filmed = Filmed::new(shot, &settings.effects, &settings.render)?;
    let frames = settings.frames.of_film(shot.num_frames())?;
    let effects = filmed.plan(frames.clone(), (renderer, &settings.render))?;
    let part = part.of_film(frames.end)?;
    let settings = FilmSettings { job: Some(settings.job.clone().unwrap_or_default()), ..settings.clone() };
    let Some(mut job) = settings.open_job(output, shot, &frames, Access::Shared)? else {
        return Ok(FilmReport::new(output, part.len()));
    };
    let (_, used) = channel();
    let mut maker = FrameMaker::new(
        (renderer, &filmed, &effects),
        &settings.render,
        (Form::of(&VideoFormat::from_path(output)?, &settings.video_for(shot, &frames)), used),
        None,
    );
    let mut report = FilmReport::new(output, part.len());
    let num_kept = job.parts().0.num_listed(&part);
    for (idx, frame_idx) in piece.order(part.clone()).enumerate() {
        if let Some(_claim) = job.claim(frame_idx)? {
            let made = maker.make(frame_idx, idx)?;
            if let Some(picture) = made.picture {
                let mut keeping = Keeping { keeper: job.parts().1, busy: report.keep_time };
                // The frame before may be of another program.
                keeping.keep(&Finished { frame_idx, picture, is_repeated: false })?;
                report.keep_time = keeping.busy;
            }
        }
        report.num_frames += 1;
        if watch(FilmProgress { done: idx + 1, total: part.len(), num_kept }).is_break() {
            break;
        }
    }
    maker.report_to(&mut report);
    job.flush()?;
    report.total_time = start.elapsed();
    report.effects = effects;
    Ok(report)
}
