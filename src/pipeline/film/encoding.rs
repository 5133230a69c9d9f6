use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};
use std::time::{Duration, Instant};

use super::settings::FilmSettings;
use crate::pipeline::error::PipelineError;
use crate::pipeline::job::{Keeper, Picture};
use crate::pipeline::panic_point::panic_point;
use cinesplat_video::{ContactSheet, VideoWriter};

/// A frame on its way to the encoder.
pub(super) struct Shown {
    /// Its place in the output.
    pub(super) idx: usize,
    /// Its number in the shot.
    pub(super) frame_idx: usize,
    pub(super) picture: Arc<Picture>,
    /// Whether the job folder holds it.
    pub(super) is_kept: bool,
}

/// Where frames go.
pub(super) enum Sink<'a> {
    /// A film, or a sequence without a job folder.
    Writer(Box<VideoWriter>),
    /// The pictures of a sequence, which its job folder keeps.
    Keeper(Option<&'a mut Keeper>),
}

/// Encodes frames on its own thread.
pub(super) struct Encoder<'a> {
    pub(super) sink: Sink<'a>,
    pub(super) sheet: Option<ContactSheet>,
    pub(super) busy: Duration,
    /// Returns written frames to the renderer, which reuses their memory.
    pub(super) give_back: Sender<Arc<Picture>>,
}

impl Encoder<'_> {
    pub(super) fn run(mut self, frames: &Receiver<Shown>) -> Result<Self, PipelineError> {
        for shown in frames {
            let start = Instant::now();
            if let Some(sheet) = &mut self.sheet {
                shown.picture.add_to(sheet, shown.idx);
            }
            self.write(&shown)?;
            self.busy += start.elapsed();
            // The renderer closes this channel after its last frame.
            let _ = self.give_back.send(shown.picture);
        }
        Ok(self)
    }

    fn write(&mut self, shown: &Shown) -> Result<(), PipelineError> {
        panic_point("encode", shown.frame_idx);
        match (&mut self.sink, shown.picture.as_ref()) {
            (Sink::Writer(writer), Picture::Planes(planes)) => writer.write_planes(planes)?,
            (Sink::Writer(writer), Picture::AlphaPlanes(planes)) => writer.write_alpha_planes(planes)?,
            (Sink::Writer(writer), Picture::Rgb8(frame)) => writer.write_frame(&frame.rgb8)?,
            (Sink::Writer(writer), Picture::File(bytes, _)) => writer.write_file(bytes)?,
            (Sink::Keeper(Some(keeper)), picture) if !shown.is_kept => keeper.keep(shown.frame_idx, picture)?,
            (Sink::Keeper(_), _) => {}
        }
        Ok(())
    }

    /// Writes the contact sheet and ends the film, unless it was stopped. Returns the time spent encoding.
    pub(super) fn finish(self, settings: &FilmSettings, is_partial: bool) -> Result<Duration, PipelineError> {
        let start = Instant::now();
        if !is_partial {
            if let (Some(sheet), Some(path)) = (&self.sheet, &settings.sheet) {
                sheet.write(path, settings.video.existing)?;
            }
            if let Sink::Writer(writer) = self.sink {
                writer.finish()?;
            }
        }
        Ok(self.busy + start.elapsed())
    }
}
