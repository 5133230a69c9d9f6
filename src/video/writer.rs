use std::path::{Path, PathBuf};

use cinesplat_files::check_free;

use super::film::{self, FilmEncoder};
use super::sequence::SequenceWriter;
use super::{VideoError, VideoFormat, VideoSettings};

/// Frames on their way into one film file or a numbered sequence of pictures.
///
/// A film lies under a passing name until [`VideoWriter::finish`] has read it back; dropped before that, it is removed.
/// Paths are opened by this program itself and never handed to FFmpeg, so no name is ever taken for a protocol.
pub struct VideoWriter {
    sink: Sink,
    settings: VideoSettings,
    num_written: usize,
}

enum Sink {
    Film(Box<FilmEncoder>),
    Sequence(SequenceWriter),
}

impl VideoWriter {
    /// Starts an output; its format follows from the name ([`VideoFormat::from_path`]).
    ///
    /// # Errors
    /// [`VideoError`]: an unknown format, a setting out of range, a missing encoder, a file that is already there, or
    /// one that cannot be created. Nothing is left behind.
    pub fn create(path: &Path, settings: &VideoSettings) -> Result<Self, VideoError> {
        let format = check_output(path, settings)?;
        let sink = match &format {
            VideoFormat::Sequence(pattern) => Sink::Sequence(SequenceWriter::create(pattern, settings)?),
            _ => Sink::Film(Box::new(FilmEncoder::create(path, &format, settings)?)),
        };
        Ok(Self { sink, settings: settings.clone(), num_written: 0 })
    }

    /// Adds one frame: `width * height * 3` bytes, row-major, r g b.
    ///
    /// # Errors
    /// [`VideoError::FrameSize`] for another number of bytes; else what encoder, disk or system refused.
    pub fn write_frame(&mut self, rgb8: &[u8]) -> Result<(), VideoError> {
        let expected = self.settings.frame_bytes();
        if rgb8.len() != expected {
            return Err(VideoError::FrameSize { found: rgb8.len(), expected });
        }
        match &mut self.sink {
            Sink::Film(film) => film.write_frame(rgb8)?,
            Sink::Sequence(sequence) => sequence.write_frame(rgb8)?,
        }
        self.num_written += 1;
        Ok(())
    }

    /// Frames written so far.
    pub fn num_written(&self) -> usize {
        self.num_written
    }

    /// Ends the output and reads a film back. Returns what was made: the film, or the folder of the pictures.
    ///
    /// # Errors
    /// [`VideoError::ReadBack`] when the file does not hold every frame; else what encoder, disk or system refused.
    pub fn finish(self) -> Result<PathBuf, VideoError> {
        match self.sink {
            Sink::Film(film) => film.finish(None),
            Sink::Sequence(sequence) => Ok(sequence.finish()),
        }
    }

    /// As [`VideoWriter::finish`] for a film that stopped early: it is named `NAME.partial.EXT`, so that nobody takes
    /// it for the whole.
    ///
    /// # Errors
    /// As [`VideoWriter::finish`].
    pub fn finish_partial(self, path: &Path) -> Result<PathBuf, VideoError> {
        match self.sink {
            Sink::Film(film) => film.finish(Some(partial_name(path))),
            Sink::Sequence(sequence) => Ok(sequence.finish()),
        }
    }
}

/// Checks all that can be checked before the first frame, and returns the format.
///
/// # Errors
/// As [`VideoWriter::create`], except for what shows only on creating the file.
pub fn check_output(path: &Path, settings: &VideoSettings) -> Result<VideoFormat, VideoError> {
    let format = VideoFormat::from_path(path)?;
    settings.clone().validated(&format)?;
    if let Some((_, codec_name)) = format.ffmpeg_names()
        && !film::has_encoder(codec_name)
    {
        return Err(VideoError::Missing { missing: codec_name.to_owned(), path: path.to_owned() });
    }
    match &format {
        VideoFormat::Sequence(pattern) if !pattern.folder().exists() => {}
        VideoFormat::Sequence(pattern) => {
            let frames = settings.first_frame..settings.first_frame + settings.num_frames.max(1);
            frames
                .map(|frame_idx| pattern.path(frame_idx))
                .try_for_each(|path| check_free(&path, settings.existing))?;
        }
        _ => check_free(path, settings.existing)?,
    }
    Ok(format)
}

fn partial_name(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(".partial.");
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
}

/// What an odd size means for a format, for a person to read.
pub fn size_note(format: &VideoFormat, width: u32, height: u32) -> Option<String> {
    let even = (width.next_multiple_of(2), height.next_multiple_of(2));
    let padded = even != (width, height) && !matches!(format, VideoFormat::Sequence(_));
    padded
        .then(|| format!("{width}x{height} is odd: the film is {}x{}, its last column or row repeated", even.0, even.1))
}
