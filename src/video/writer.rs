use std::path::{Path, PathBuf};

use cinesplat_files::check_free;

use super::film::{self, FilmEncoder};
use super::sequence::SequenceWriter;
use super::{AlphaPlanes, Planes420, VideoError, VideoFormat, VideoSettings};

/// Writes frames to one film file or to a numbered sequence of pictures.
///
/// A film has a temporary name until [`VideoWriter::finish`] has read it back; if the writer is dropped before, the
/// file is removed. This crate opens all paths itself and never passes them to FFmpeg, so FFmpeg cannot take a file
/// name for a protocol.
pub struct VideoWriter {
    sink: Sink,
    settings: VideoSettings,
    /// Whether the film's frames have opacity.
    has_alpha: bool,
    num_written: usize,
}

enum Sink {
    Film(Box<FilmEncoder>),
    Sequence(SequenceWriter),
}

impl VideoWriter {
    /// Starts an output; the extension of `path` decides its format ([`VideoFormat::from_path`]).
    ///
    /// # Errors
    /// Those of [`check_output`]; [`VideoError::File`] if the file cannot be created, [`VideoError::Ffmpeg`] if the
    /// encoder or the container rejects the settings. No file is left behind.
    pub fn create(path: &Path, settings: &VideoSettings) -> Result<Self, VideoError> {
        let format = check_output(path, settings)?;
        let sink = match &format {
            VideoFormat::Sequence(pattern) => Sink::Sequence(SequenceWriter::create(pattern, settings)?),
            _ => Sink::Film(Box::new(FilmEncoder::create(path, &format, settings)?)),
        };
        let has_alpha = settings.has_alpha && format.holds_alpha();
        Ok(Self { sink, settings: settings.clone(), has_alpha, num_written: 0 })
    }

    /// Adds one frame: `width * height * 3` bytes, row-major, r g b.
    ///
    /// # Errors
    /// [`VideoError::FrameSize`] for another number of bytes, [`VideoError::Ffmpeg`] if the encoder fails,
    /// [`VideoError::File`] if the file cannot be written.
    pub fn write_frame(&mut self, rgb8: &[u8]) -> Result<(), VideoError> {
        let expected = self.settings.frame_bytes();
        if rgb8.len() != expected {
            return Err(VideoError::FrameSize { found: rgb8.len(), expected });
        }
        match &mut self.sink {
            Sink::Film(film) if self.has_alpha => {
                let (width, height) = (self.settings.width as usize, self.settings.height as usize);
                film.write_alpha_planes(&AlphaPlanes::opaque(rgb8, width, height))?;
            }
            Sink::Film(film) => film.write_planes(&self.settings.planes_of(rgb8))?,
            Sink::Sequence(sequence) => sequence.write_frame(rgb8)?,
        }
        self.num_written += 1;
        Ok(())
    }

    /// Adds one frame of a film as [`VideoSettings::planes_of`] converts it.
    ///
    /// # Errors
    /// As [`VideoWriter::write_frame`]; [`VideoError::FrameSize`] also for a picture sequence, which has no such frames.
    pub fn write_planes(&mut self, planes: &Planes420) -> Result<(), VideoError> {
        let (found, expected) = (planes.num_bytes(), self.settings.planes_bytes());
        match &mut self.sink {
            Sink::Film(film) if found == expected && !self.has_alpha => film.write_planes(planes)?,
            _ => return Err(VideoError::FrameSize { found, expected }),
        }
        self.num_written += 1;
        Ok(())
    }

    /// Adds one frame of a film with opacity ([`VideoSettings::has_alpha`]).
    ///
    /// # Errors
    /// As [`VideoWriter::write_frame`]; [`VideoError::FrameSize`] also for a format without opacity.
    pub fn write_alpha_planes(&mut self, planes: &AlphaPlanes) -> Result<(), VideoError> {
        let (found, expected) = (planes.width * planes.height * 3, self.settings.frame_bytes());
        match &mut self.sink {
            Sink::Film(film) if found == expected && self.has_alpha => film.write_alpha_planes(planes)?,
            _ => return Err(VideoError::FrameSize { found, expected }),
        }
        self.num_written += 1;
        Ok(())
    }

    /// Adds one frame of a picture sequence as the bytes of its file.
    ///
    /// # Errors
    /// [`VideoError::FrameSize`] for a film, [`VideoError::File`] if the file cannot be written.
    pub fn write_file(&mut self, bytes: &[u8]) -> Result<(), VideoError> {
        match &mut self.sink {
            Sink::Sequence(sequence) => sequence.write_file(bytes)?,
            Sink::Film(_) => {
                let expected = self.settings.planes_bytes();
                return Err(VideoError::FrameSize { found: bytes.len(), expected });
            }
        }
        self.num_written += 1;
        Ok(())
    }

    /// Number of frames written so far.
    pub fn num_written(&self) -> usize {
        self.num_written
    }

    /// Completes the output and reads a film back. Returns the path of the film, or the folder of the pictures.
    ///
    /// # Errors
    /// [`VideoError::ReadBack`] if the file does not hold every frame, [`VideoError::Ffmpeg`] if encoder or container
    /// fails, [`VideoError::File`] if the file cannot be written or named.
    pub fn finish(self) -> Result<PathBuf, VideoError> {
        match self.sink {
            Sink::Film(film) => film.finish(),
            Sink::Sequence(sequence) => Ok(sequence.finish()),
        }
    }
}

/// Checks an output without creating it, and returns its format.
///
/// # Errors
/// Those of [`check_format`]; [`VideoError::File`] for an existing output that must not be replaced.
pub fn check_output(path: &Path, settings: &VideoSettings) -> Result<VideoFormat, VideoError> {
    let format = check_format(path, settings)?;
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

/// Checks name, settings and encoder of an output, and returns its format.
///
/// # Errors
/// [`VideoError::UnknownFormat`] or [`VideoError::BadPattern`] for the name, [`VideoError::BadSetting`] for a setting
/// out of range, [`VideoError::Missing`] without the encoder.
pub fn check_format(path: &Path, settings: &VideoSettings) -> Result<VideoFormat, VideoError> {
    let format = VideoFormat::from_path(path)?;
    settings.clone().validated(&format)?;
    if let Some((_, codec_name)) = format.ffmpeg_names(settings.has_alpha)
        && !film::has_encoder(codec_name)
    {
        return Err(VideoError::Missing { missing: codec_name.to_owned(), path: path.to_owned() });
    }
    Ok(format)
}

/// Calls `visit` with every picture of a film file in order, as it is after the loss of its encoder.
///
/// # Errors
/// [`VideoError::File`], [`VideoError::Ffmpeg`]; [`VideoError::Missing`] without FFmpeg.
pub fn read_film(path: &Path, visit: &mut dyn FnMut(Planes420)) -> Result<(), VideoError> {
    film::read_film(path, visit)
}

/// A note for the user if the format cannot hold this odd size: the film is one pixel wider or higher.
pub fn odd_size_note(format: &VideoFormat, settings: &VideoSettings) -> Option<String> {
    let VideoSettings { width, height, has_alpha, .. } = *settings;
    if has_alpha && format.holds_alpha() {
        return None;
    }
    let even = (width.next_multiple_of(2), height.next_multiple_of(2));
    let padded = even != (width, height) && !matches!(format, VideoFormat::Sequence(_));
    padded.then(|| format!("{width}x{height} is odd: the film is {}x{}, last column or row repeated", even.0, even.1))
}

/// A warning for the user if players will not recognize a film of all directions, because its container does not say so.
pub fn panorama_warning(format: &VideoFormat, settings: &VideoSettings) -> Option<String> {
    let is_film = !matches!(format, VideoFormat::Sequence(_));
    let is_unmarked = settings.is_panorama && is_film && !format.marks_panoramas();
    let extension = format.extension();
    is_unmarked.then(|| format!("players do not recognize a 360 video in a .{extension}: write a .mp4 or a .mov"))
}
