use std::ops::{ControlFlow, Range};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use super::effects::Filmed;
use super::encoding::{Encoder, Shown, Sink};
use super::form::Form;
use super::keeping::{Finished, Keeping};
use super::making::{FrameMaker, Made};
use super::report::{FilmProgress, FilmReport};
use super::settings::FilmSettings;
use super::watch::QualityWatch;
use crate::pipeline::error::PipelineError;
use crate::pipeline::job::{Access, Job};
use cinesplat_files::Existing;
use cinesplat_lens::EffectPlan;
use cinesplat_render::Renderer;
use cinesplat_trajectory::Shot;
use cinesplat_video::{ContactSheet, VideoFormat, VideoWriter, remove_frames_from};

/// Capacity of the queue between renderer and encoder, in frames. It absorbs frames that are slow to encode and costs
/// little memory.
pub(in crate::pipeline) const QUEUE_FRAMES: usize = 4;

/// Renders the frames of a shot in order while another thread encodes them.
///
/// `watch` is called after every frame and may stop the film. With a job folder the finished frames are kept then, and the
/// same call goes on from them.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path, [`PipelineError::NoSuchFrames`], [`PipelineError::Render`],
/// [`PipelineError::Video`] and [`PipelineError::Job`]. No incomplete file is left under the output's name.
pub fn film(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    settings: &FilmSettings,
    watch: &mut dyn FnMut(FilmProgress) -> ControlFlow<()>,
) -> Result<FilmReport, PipelineError> {
    film_planned(renderer, shot, output, (settings, None), watch)
}

/// As [`film`], with the effects of the frames where they are planned already ([`super::plan_effects`]). The effects of a film
/// that an earlier run finished are not planned.
///
/// # Errors
/// As [`film`].
pub fn film_planned(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    (settings, planned): (&FilmSettings, Option<EffectPlan>),
    watch: &mut dyn FnMut(FilmProgress) -> ControlFlow<()>,
) -> Result<FilmReport, PipelineError> {
    let start = Instant::now();
    let filmed = Filmed::new(shot, &settings.effects, &settings.render)?;
    let frames = settings.frames.of_film(shot.num_frames())?;
    let mut job = settings.open_job(output, shot, &frames, Access::Alone)?;
    let has_sheet = settings.sheet.as_ref().is_none_or(|sheet| sheet.exists());
    let mut effects = planned.clone().unwrap_or_default();
    let is_whole = has_sheet && job.as_ref().is_some_and(|job| job.finished_film().is_some());
    let mut report = if is_whole {
        FilmReport { num_frames: frames.len(), num_kept: frames.len(), ..FilmReport::new(output, frames.len()) }
    } else {
        if planned.is_none() {
            effects = filmed.plan(frames.clone(), (renderer, &settings.render))?;
        }
        render_and_encode((renderer, &filmed, &effects), (shot, output), (settings, &frames), job.as_mut(), watch)?
    };
    if let VideoFormat::Sequence(pattern) = VideoFormat::from_path(output)?
        && settings.video.existing == Existing::Replace
        && frames == (0..shot.num_frames())
        && !report.is_partial()
    {
        report.num_removed = remove_frames_from(&pattern, frames.end)?;
    }
    match job {
        Some(mut job) if report.is_partial() => job.flush()?,
        Some(mut job) => {
            let keeps_frames = settings.job.as_ref().is_some_and(|settings| settings.keeps_frames);
            if job.is_sequence() {
                // Its frames are the output: they are on the disk before the log that proves them goes.
                job.flush()?;
            } else {
                if !keeps_frames {
                    job.abandon_frames();
                }
                job.place_film(output, settings.video.existing, keeps_frames)?;
            }
            if !keeps_frames {
                job.remove();
            }
        }
        None => {}
    }
    report.total_time = start.elapsed();
    report.effects = effects;
    Ok(report)
}

/// Renders and encodes the frames that the job folder lacks, and encodes those that it holds.
fn render_and_encode(
    (renderer, filmed, effects): (&Renderer<'_>, &Filmed<'_>, &EffectPlan),
    (shot, output): (&Shot, &Path),
    (settings, frames): (&FilmSettings, &Range<usize>),
    mut job: Option<&mut Job>,
    watch: &mut dyn FnMut(FilmProgress) -> ControlFlow<()>,
) -> Result<FilmReport, PipelineError> {
    let video = settings.video_for(shot, frames);
    let is_film = !matches!(VideoFormat::from_path(output)?, VideoFormat::Sequence(_));
    let sheet = settings.sheet.as_ref().map(|_| ContactSheet::new(shot.width, shot.height, frames.len()));
    let target = job.as_ref().map_or_else(|| output.to_owned(), |job| job.film_path());
    let writer = if is_film || job.is_none() { Some(VideoWriter::create(&target, &video)?) } else { None };
    let (kept, keeper) = job.as_mut().map(|job| job.parts()).unzip();
    // A picture of a sequence is final when it is encoded: the encoder keeps it.
    let (own_keeper, sink) = match (writer, keeper) {
        (Some(writer), keeper) => (keeper, Sink::Writer(Box::new(writer))),
        (None, keeper) => (None, Sink::Keeper(keeper)),
    };
    let (sender, receiver) = sync_channel::<Shown>(QUEUE_FRAMES);
    let (give_back, used) = channel();
    let encoder = Encoder { sink, sheet, busy: Duration::ZERO, give_back };
    let mut report = FilmReport::new(output, frames.len());
    let mut maker = FrameMaker::new(
        (renderer, filmed, effects),
        &settings.render,
        (Form::of(&VideoFormat::from_path(output)?, &video), used),
        kept,
    )
    .watched_by(
        settings
            .promise
            .as_ref()
            .map(|promise| QualityWatch::new((renderer, filmed), &settings.render, (shot, frames.clone()), promise)),
    );
    if let Some(sheet) = &encoder.sheet {
        maker.show_on(sheet);
    }
    let num_kept = maker.num_listed(frames);

    let (rendered, encoded, kept) = thread::scope(|scope| {
        let encoding = scope.spawn(move || encoder.run(&receiver));
        // No frame waits here: a program that is killed loses the frame that it renders and the one that it keeps.
        let (keep_sender, finished) = sync_channel::<Finished>(0);
        let keeping =
            own_keeper.map(|keeper| scope.spawn(move || Keeping { keeper, busy: Duration::ZERO }.run(&finished)));
        let rendered = frames.clone().enumerate().try_for_each(|(idx, frame_idx)| {
            let Made { picture, is_kept, is_repeated } = maker.make(frame_idx, idx)?;
            if let Some(picture) = picture {
                // The threads close their channels when they fail; they return their errors themselves.
                if keeping.is_some() && !is_kept {
                    let finished = Finished { frame_idx, picture: Arc::clone(&picture), is_repeated };
                    keep_sender.send(finished).map_err(|_| Interruption::Stopped)?;
                }
                sender.send(Shown { idx, frame_idx, picture, is_kept }).map_err(|_| Interruption::Stopped)?;
            }
            report.num_frames += 1;
            match watch(FilmProgress { done: idx + 1, total: frames.len(), num_kept }) {
                ControlFlow::Continue(()) => Ok(()),
                ControlFlow::Break(()) => Err(Interruption::Stopped),
            }
        });
        drop((sender, keep_sender));
        (rendered, encoding.join(), keeping.map(thread::ScopedJoinHandle::join))
    });
    let encoded = encoded.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    report.keep_time =
        kept.transpose().unwrap_or_else(|panic| std::panic::resume_unwind(panic)).transpose()?.unwrap_or_default();
    let encoder = encoded?;
    if let Err(Interruption::Failed(error)) = rendered {
        return Err(*error);
    }
    maker.report_to(&mut report);
    report.encode_time = encoder.finish(settings, report.is_partial())?;
    Ok(report)
}

/// Why rendering ends early.
enum Interruption {
    /// The caller stopped the film, or the encoder failed.
    Stopped,
    /// A stage failed.
    Failed(Box<PipelineError>),
}

impl<E: Into<PipelineError>> From<E> for Interruption {
    fn from(error: E) -> Self {
        Self::Failed(Box::new(error.into()))
    }
}
