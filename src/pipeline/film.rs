use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use super::error::PipelineError;
use super::frames::FrameRange;
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{RenderSettings, Renderer, Rgb8Frame};
use cinesplat_scene::Scene;
use cinesplat_trajectory::{CameraPath, Shot};
use cinesplat_video::{ContactSheet, VideoError, VideoSettings, VideoWriter};

/// Capacity of the queue between renderer and encoder, in frames. It absorbs frames that are slow to encode and costs
/// little memory.
pub(super) const QUEUE_FRAMES: usize = 4;

/// How a shot becomes a film.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FilmSettings {
    /// How frames are rendered.
    pub render: RenderSettings,
    /// How frames are encoded. Size, rate and frame numbers come from the shot instead.
    pub video: VideoSettings,
    /// The frames to render.
    pub frames: FrameRange,
    /// Path of a contact sheet; `None` = no contact sheet.
    pub sheet: Option<PathBuf>,
}

impl FilmSettings {
    /// The settings that suit a scene: all frames at `standard` quality, H.264 that is hard to tell from the frames, no
    /// contact sheet.
    pub fn for_scene(scene: &Scene) -> Self {
        Self { render: RenderSettings::for_scene(scene), ..Self::default() }
    }
}

/// Progress of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FilmProgress {
    /// Frames rendered.
    pub done: usize,
    /// Frames to render.
    pub total: usize,
}

/// Result of a film.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmReport {
    /// The film, or the folder of its pictures.
    pub path: PathBuf,
    /// Frames written.
    pub num_frames: usize,
    /// Frames requested.
    pub num_wanted: usize,
    /// Time spent rendering.
    pub render_time: Duration,
    /// Time spent converting, encoding and writing, most of it parallel to rendering.
    pub encode_time: Duration,
    /// Wall time of the whole film.
    pub total_time: Duration,
}

impl FilmReport {
    /// Whether the film was stopped before its last frame.
    pub fn is_partial(&self) -> bool {
        self.num_frames < self.num_wanted
    }
}

/// Renders the frames of a shot in order while another thread encodes them.
///
/// `watch` is called after every frame and may stop the film. The finished frames are kept then; a film file gets the name
/// `NAME.partial.EXT`.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path, [`PipelineError::NoSuchFrames`], [`PipelineError::Render`]
/// and [`PipelineError::Video`]. No incomplete file is left under the output's name.
pub fn film(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    settings: &FilmSettings,
    watch: &mut dyn FnMut(FilmProgress) -> ControlFlow<()>,
) -> Result<FilmReport, PipelineError> {
    let start = Instant::now();
    let path = CameraPath::new(shot)?;
    let frames = settings.frames.of_film(shot.num_frames())?;
    let num_wanted = frames.len();
    let writer = VideoWriter::create(output, &video_of(shot, &frames, &settings.video))?;
    let sheet = settings.sheet.as_ref().map(|_| ContactSheet::new(shot.width, shot.height, num_wanted));
    let (sender, receiver) = sync_channel(QUEUE_FRAMES);
    let (give_back, used) = channel();
    let encoder = Encoder { writer, sheet, busy: Duration::ZERO, give_back };
    let (mut shown, mut last_camera): (Arc<Rgb8Frame>, _) = (Arc::default(), None);
    let mut render_time = Duration::ZERO;

    let (rendered, encoded) = thread::scope(|scope| {
        let encoding = scope.spawn(move || encoder.run(&receiver));
        let mut report = |done| watch(FilmProgress { done, total: num_wanted });
        let rendered = frames.enumerate().try_for_each(|(done, frame_idx)| {
            let start = Instant::now();
            let camera = camera_at(&path, shot, frame_idx);
            // The same camera gives the same picture.
            if last_camera != Some(camera) {
                // Drop this reference first: a frame that is written already has no owner then, and its memory is reused.
                shown = Arc::default();
                let mut frame = used.try_iter().find_map(Arc::into_inner).unwrap_or_default();
                renderer.render_rgb8_into(&camera, &settings.render, &mut frame)?;
                (shown, last_camera) = (Arc::new(frame), Some(camera));
            }
            render_time += start.elapsed();
            send(Arc::clone(&shown), &sender, done, &mut report)
        });
        drop(sender);
        (rendered, encoding.join())
    });
    let encoder = match encoded {
        Ok(encoder) => encoder?,
        Err(panic) => std::panic::resume_unwind(panic),
    };
    match rendered {
        Ok(()) | Err(Interruption::Stopped) => {}
        Err(Interruption::Failed(error)) => return Err(error),
    }
    encoder.finish(output, settings, num_wanted).map(|(path, num_frames, encode_time)| FilmReport {
        path,
        num_frames,
        num_wanted,
        render_time,
        encode_time,
        total_time: start.elapsed(),
    })
}

/// Why rendering ends early.
enum Interruption {
    /// The caller stopped the film.
    Stopped,
    /// A stage failed.
    Failed(PipelineError),
}

impl<E: Into<PipelineError>> From<E> for Interruption {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

/// Sends a frame to the encoder, then asks the caller whether to continue.
fn send(
    frame: Arc<Rgb8Frame>,
    sender: &SyncSender<Arc<Rgb8Frame>>,
    num_before: usize,
    report: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<(), Interruption> {
    // The encoder closes the channel when it fails; it returns its error itself.
    sender.send(frame).map_err(|_| Interruption::Stopped)?;
    match report(num_before + 1) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Interruption::Stopped),
    }
}

/// The camera of one frame, counted from 0.
pub fn camera_at(path: &CameraPath, shot: &Shot, frame_idx: usize) -> Camera {
    let state = path.sample(shot.frame_time_secs(frame_idx));
    Camera { pose: state.pose, intrinsics: Intrinsics::from_fov_y(shot.width, shot.height, state.fov_y_rad) }
}

/// Cameras of the frames that a film renders. Frames with the camera of the frame before are not rendered again.
pub(super) fn moving_cameras(path: &CameraPath, shot: &Shot, frames: Range<usize>) -> Vec<Camera> {
    let mut cameras: Vec<Camera> = frames.map(|frame_idx| camera_at(path, shot, frame_idx)).collect();
    cameras.dedup();
    cameras
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

/// Encodes frames on its own thread.
struct Encoder {
    writer: VideoWriter,
    sheet: Option<ContactSheet>,
    busy: Duration,
    /// Returns written frames to the renderer, which reuses their memory.
    give_back: Sender<Arc<Rgb8Frame>>,
}

impl Encoder {
    fn run(mut self, frames: &Receiver<Arc<Rgb8Frame>>) -> Result<Self, VideoError> {
        for (frame_idx, frame) in frames.iter().enumerate() {
            let start = Instant::now();
            if let Some(sheet) = &mut self.sheet {
                sheet.add_frame(frame_idx, &frame.rgb8);
            }
            self.writer.write_frame(&frame.rgb8)?;
            self.busy += start.elapsed();
            // The renderer closes this channel after its last frame.
            let _ = self.give_back.send(frame);
        }
        Ok(self)
    }

    /// Finishes film and contact sheet. Returns the path of the film, its number of frames and the time spent encoding.
    fn finish(
        self,
        output: &Path,
        settings: &FilmSettings,
        num_wanted: usize,
    ) -> Result<(PathBuf, usize, Duration), PipelineError> {
        let start = Instant::now();
        let num_frames = self.writer.num_written();
        if let (Some(sheet), Some(path)) = (&self.sheet, &settings.sheet) {
            sheet.write(path, settings.video.existing)?;
        }
        let path = if num_frames < num_wanted { self.writer.finish_partial(output)? } else { self.writer.finish()? };
        Ok((path, num_frames, self.busy + start.elapsed()))
    }
}
