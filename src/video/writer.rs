use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::encoder::FilmEncoder;
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
        && ffmpeg_next::encoder::find_by_name(codec_name).is_none()
    {
        return Err(VideoError::Missing { missing: codec_name.to_owned(), path: path.to_owned() });
    }
    if !settings.overwrite {
        let frames = settings.first_frame..settings.first_frame + settings.num_frames.max(1);
        let found = match &format {
            VideoFormat::Sequence(pattern) => frames.map(|frame_idx| pattern.path(frame_idx)).find(|p| p.exists()),
            _ => path.exists().then(|| path.to_owned()),
        };
        if let Some(path) = found {
            return Err(VideoError::Exists { path });
        }
    }
    check_folder(path, &format)?;
    Ok(format)
}

/// A film's folder has to be there; a sequence's may still be created.
fn check_folder(path: &Path, format: &VideoFormat) -> Result<(), VideoError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let refuse = |kind: ErrorKind, reason: &str| {
        Err(VideoError::Create { path: path.to_owned(), source: std::io::Error::new(kind, reason) })
    };
    if path.is_dir() {
        return refuse(ErrorKind::IsADirectory, "it is a folder");
    }
    match (folder.is_dir(), format) {
        (true, _) => Ok(()),
        (false, VideoFormat::Sequence(_)) if !folder.exists() => Ok(()),
        (false, _) if folder.exists() => refuse(ErrorKind::NotADirectory, "its folder is a file"),
        (false, _) => refuse(ErrorKind::NotFound, "its folder does not exist"),
    }
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
