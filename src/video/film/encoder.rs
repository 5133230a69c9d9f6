use std::path::{Path, PathBuf};

use cinesplat_files::{FileError, NewFile};
use ffmpeg_next::error::EAGAIN;
use ffmpeg_next::format::context::{Output, StreamIo};
use ffmpeg_next::{Dictionary, Packet, Rational, codec, color, encoder, format, frame};

use super::watched_file::{FirstError, WatchedFile};
use super::{marks, rate, read_back};
use crate::bt709::{self, Planes420};
use crate::settings::NUM_THREADS;
use crate::{AlphaPlanes, EyePacking, VideoError, VideoFormat, VideoSettings};

/// Bytes reserved at the front of an MP4 for its index: a fixed part, and a part per frame (8 bytes of sizes and times
/// plus 16 of chunk tables, with a margin).
const INDEX_BYTES: (usize, usize) = (8192, 48);
/// FFmpeg's name of the encoder of `ProRes`, which is used for films with opacity.
const PRORES: &str = "prores_ks";

/// An encoder whose packets go into a container file with one video stream.
pub(crate) struct FilmEncoder {
    encoder: encoder::Video,
    muxer: Output,
    first_error: FirstError,
    file: NewFile,
    tick: Rational,
    stream_tick: Rational,
    num_sent: usize,
    /// What MP4 and MOV say about their pictures.
    is_panorama: bool,
    eyes: Option<EyePacking>,
    path: PathBuf,
}

impl FilmEncoder {
    /// Opens the encoder first, then the file, then the container, so that a missing encoder leaves no file behind.
    pub(crate) fn create(path: &Path, format: &VideoFormat, settings: &VideoSettings) -> Result<Self, VideoError> {
        let missing = |name: &str| VideoError::Missing { missing: name.to_owned(), path: path.to_owned() };
        let (container, codec_name) =
            format.ffmpeg_names(settings.has_alpha).ok_or(missing("container of that name"))?;
        // FFmpeg returns its errors; its log lines on stderr would break a progress bar.
        ffmpeg_next::log::set_level(ffmpeg_next::log::Level::Quiet);
        let codec = encoder::find_by_name(codec_name).ok_or_else(|| missing(codec_name))?;
        let rate = rate::as_fraction(settings.rate_fps);
        let encoder = open_encoder(codec, settings, rate).map_err(|e| failed("opening the encoder", e, path))?;

        let file = NewFile::create(path, settings.existing)?;
        let first_error = FirstError::default();
        let handle = file.file().try_clone().map_err(|source| FileError::Create { path: path.to_owned(), source })?;
        let watched = WatchedFile { file: handle, first_error: first_error.clone() };
        let io = StreamIo::from_write_seek(watched).map_err(|e| failed("opening the file", e, path))?;
        let mut muxer = format::output_to_stream(io, None, Some(container)).map_err(|_| missing(container))?;
        let stream_tick = write_header(&mut muxer, &encoder, (rate, settings.eyes), header_options(format, settings))
            .map_err(|e| fault_of(&first_error, "starting the file", e, path))?;
        let is_marked = format.marks_panoramas();
        let (is_panorama, eyes) = (settings.is_panorama && is_marked, settings.eyes.filter(|_| is_marked));
        let (tick, path) = (rate.invert(), path.to_owned());
        Ok(Self { encoder, muxer, first_error, file, tick, stream_tick, num_sent: 0, is_panorama, eyes, path })
    }

    pub(crate) fn write_planes(&mut self, planes: &Planes420) -> Result<(), VideoError> {
        self.write(picture_of(planes))
    }

    pub(crate) fn write_alpha_planes(&mut self, planes: &AlphaPlanes) -> Result<(), VideoError> {
        self.write(picture_with_alpha(planes))
    }

    fn write(&mut self, mut picture: frame::Video) -> Result<(), VideoError> {
        picture.set_pts(Some(self.num_sent as i64));
        self.encoder.send_frame(&picture).map_err(|e| self.fault("encoding", e))?;
        self.num_sent += 1;
        self.drain()
    }

    /// Completes the file, reads it back and gives it its name.
    pub(crate) fn finish(mut self) -> Result<PathBuf, VideoError> {
        self.encoder.send_eof().map_err(|e| self.fault("encoding", e))?;
        self.drain()?;
        self.muxer.write_trailer().map_err(|e| self.fault("ending the file", e))?;
        // Dropping the muxer flushes and closes the file.
        drop(self.muxer);
        if let Some(source) = self.first_error.lock().ok().and_then(|mut first| first.take()) {
            return Err(FileError::Write { path: self.path, source }.into());
        }
        if self.is_panorama {
            marks::mark_panorama(self.file.file())
                .map_err(|source| FileError::Write { path: self.path.clone(), source })?;
        }
        if let Some(packing) = self.eyes {
            let codec = if self.encoder.format() == format::Pixel::YUV420P { *b"avc1" } else { *b"ap4h" };
            marks::mark_eyes(self.file.file(), packing, codec)
                .map_err(|source| FileError::Write { path: self.path.clone(), source })?;
        }
        read_back::check(self.file.path(), &self.path, self.num_sent, self.tick)?;
        self.file.commit()?;
        Ok(self.path)
    }

    /// Writes all packets that the encoder has ready.
    fn drain(&mut self) -> Result<(), VideoError> {
        let mut packet = Packet::empty();
        while receive(&mut self.encoder, &mut packet).map_err(|e| self.fault("encoding", e))? {
            packet.set_stream(0);
            // Without this, the last frame of the file has no duration.
            packet.set_duration(1);
            packet.rescale_ts(self.tick, self.stream_tick);
            packet.write_interleaved(&mut self.muxer).map_err(|e| self.fault("writing", e))?;
        }
        Ok(())
    }

    /// The first system error of the file if there was one, else FFmpeg's error.
    fn fault(&self, action: &'static str, error: ffmpeg_next::Error) -> VideoError {
        fault_of(&self.first_error, action, error, &self.path)
    }
}

fn fault_of(first_error: &FirstError, action: &'static str, error: ffmpeg_next::Error, path: &Path) -> VideoError {
    match first_error.lock().ok().and_then(|mut first| first.take()) {
        Some(source) => FileError::Write { path: path.to_owned(), source }.into(),
        None => failed(action, error, path),
    }
}

/// Encodes frames and discards the packets.
pub(crate) fn encode_and_discard(
    path: &Path,
    format: &VideoFormat,
    settings: &VideoSettings,
    frames: &[&[u8]],
) -> Result<(), VideoError> {
    let missing = || VideoError::Missing { missing: "encoder".to_owned(), path: path.to_owned() };
    ffmpeg_next::log::set_level(ffmpeg_next::log::Level::Quiet);
    let codec = format
        .ffmpeg_names(settings.has_alpha)
        .and_then(|(_, name)| encoder::find_by_name(name))
        .ok_or_else(missing)?;
    let opened = open_encoder(codec, settings, rate::as_fraction(settings.rate_fps));
    let mut encoder = opened.map_err(|e| failed("opening the encoder", e, path))?;
    let mut packet = Packet::empty();
    for (frame_idx, rgb8) in frames.iter().enumerate() {
        let (width, height) = (settings.width as usize, settings.height as usize);
        let mut picture = if codec.name() == PRORES {
            picture_with_alpha(&AlphaPlanes::opaque(rgb8, width, height))
        } else {
            picture_of(&bt709::planes_from_rgb8(rgb8, width, height))
        };
        picture.set_pts(Some(frame_idx as i64));
        encoder.send_frame(&picture).map_err(|e| failed("encoding", e, path))?;
        while receive(&mut encoder, &mut packet).map_err(|e| failed("encoding", e, path))? {}
    }
    encoder.send_eof().map_err(|e| failed("encoding", e, path))?;
    while receive(&mut encoder, &mut packet).map_err(|e| failed("encoding", e, path))? {}
    Ok(())
}

/// Takes the next packet from an encoder; false if it has none before the next frame (`EAGAIN`), or no more (`EOF`).
///
/// # Errors
/// Every other error of the encoder.
fn receive(encoder: &mut encoder::Video, packet: &mut Packet) -> Result<bool, ffmpeg_next::Error> {
    match encoder.receive_packet(packet) {
        Ok(()) => Ok(true),
        Err(ffmpeg_next::Error::Eof | ffmpeg_next::Error::Other { errno: EAGAIN }) => Ok(false),
        Err(error) => Err(error),
    }
}

fn failed(action: &'static str, error: ffmpeg_next::Error, path: &Path) -> VideoError {
    VideoError::Ffmpeg { action, message: error.to_string(), path: path.to_owned() }
}

fn open_encoder(
    codec: ffmpeg_next::Codec,
    settings: &VideoSettings,
    rate: Rational,
) -> Result<encoder::Video, ffmpeg_next::Error> {
    let mut video = codec::Context::new_with_codec(codec).encoder().video()?;
    let has_alpha = codec.name() == PRORES;
    let side = |len: u32| if has_alpha { len } else { len.next_multiple_of(2) };
    video.set_width(side(settings.width));
    video.set_height(side(settings.height));
    video.set_format(if has_alpha { format::Pixel::YUVA444P10LE } else { format::Pixel::YUV420P });
    video.set_aspect_ratio(Rational::new(1, 1));
    video.set_time_base(rate.invert());
    video.set_frame_rate(Some(rate));
    video.set_colorspace(color::Space::BT709);
    video.set_color_range(color::Range::MPEG);
    video.set_color_primaries(color::Primaries::BT709);
    video.set_color_transfer_characteristic(color::TransferCharacteristic::BT709);
    // All four containers expect the parameter sets in their header.
    video.set_flags(codec::Flags::GLOBAL_HEADER);
    video.open_with(encoder_options(codec.name(), settings))
}

fn encoder_options(codec_name: &str, settings: &VideoSettings) -> Dictionary<'static> {
    let mut options = Dictionary::new();
    options.set("threads", &NUM_THREADS.to_string());
    if codec_name == PRORES {
        options.set("profile", "4444");
        options.set("vendor", "apl0");
        return options;
    }
    options.set("chroma_sample_location", "left");
    options.set("crf", &settings.crf.to_string());
    if codec_name == "libx264" {
        options.set("preset", settings.preset.unwrap_or_default().as_ref());
        // The number is that of the frame packing SEI message of H.264.
        let packing = match settings.eyes {
            Some(EyePacking::SideBySide) => ":frame-packing=3",
            Some(EyePacking::OverUnder) => ":frame-packing=4",
            None => "",
        };
        // Without the first, the lookahead of x264 (r3095 with AVX-512) makes the bytes differ from run to run.
        options.set("x264-params", &format!("cpu-independent=1{packing}"));
    } else {
        // VP9 uses crf as its target quality only if the bit rate is 0.
        for (key, value) in [("b", "0"), ("row-mt", "1"), ("deadline", "good"), ("cpu-used", "3"), ("g", "240")] {
            options.set(key, value);
        }
    }
    options
}

/// Adds the stream and writes the header. Returns the time base of the stream, which the container may change.
fn write_header(
    muxer: &mut Output,
    encoder: &encoder::Video,
    (rate, eyes): (Rational, Option<EyePacking>),
    options: Dictionary,
) -> Result<Rational, ffmpeg_next::Error> {
    let mut stream = muxer.add_stream_with(encoder)?;
    if let Some(packing) = eyes {
        // Matroska and WebM write it into their header.
        let mut tags = Dictionary::new();
        tags.set("stereo_mode", if packing == EyePacking::SideBySide { "left_right" } else { "top_bottom" });
        stream.set_metadata(tags);
    }
    stream.set_time_base(rate.invert());
    stream.set_rate(rate);
    stream.set_avg_frame_rate(rate);
    muxer.write_header_with(options)?;
    Ok(muxer.stream(0).ok_or(ffmpeg_next::Error::StreamNotFound)?.time_base())
}

fn header_options(format: &VideoFormat, settings: &VideoSettings) -> Dictionary<'static> {
    let mut options = Dictionary::new();
    // No random identifiers, dates or versions: the same frames give the same bytes.
    options.set("fflags", "+bitexact");
    if matches!(format, VideoFormat::Mp4 | VideoFormat::Mov) && settings.num_frames > 0 {
        let (fixed, each) = INDEX_BYTES;
        options.set("moov_size", &(fixed + each * settings.num_frames).to_string());
    }
    options
}

/// The planes copied into an FFmpeg picture, whose rows are padded.
fn picture_of(planes: &Planes420) -> frame::Video {
    let mut picture = frame::Video::new(format::Pixel::YUV420P, planes.width as u32, planes.height as u32);
    for (plane, codes) in [&planes.y, &planes.cb, &planes.cr].into_iter().enumerate() {
        let width = if plane == 0 { planes.width } else { planes.width / 2 };
        let stride = picture.stride(plane);
        for (to, from) in picture.data_mut(plane).chunks_mut(stride).zip(codes.chunks_exact(width)) {
            to[..width].copy_from_slice(from);
        }
    }
    picture
}

/// The planes with opacity copied into an FFmpeg picture.
fn picture_with_alpha(planes: &AlphaPlanes) -> frame::Video {
    let mut picture = frame::Video::new(format::Pixel::YUVA444P10LE, planes.width as u32, planes.height as u32);
    for (plane, codes) in planes.codes.iter().enumerate() {
        let stride = picture.stride(plane);
        for (to, from) in picture.data_mut(plane).chunks_mut(stride).zip(codes.chunks_exact(planes.width)) {
            to.chunks_exact_mut(2).zip(from).for_each(|(to, code)| to.copy_from_slice(&code.to_le_bytes()));
        }
    }
    picture
}
