use std::fs::File;
use std::path::Path;

use cinesplat_files::FileError;
use ffmpeg_next::format::context::StreamIo;
use ffmpeg_next::{codec, format, frame, media};

use crate::{Planes420, VideoError};

/// Calls `visit` with every picture of a film in order, as the decoder gives it.
pub(crate) fn read_film(path: &Path, visit: &mut dyn FnMut(Planes420)) -> Result<(), VideoError> {
    let fault = |error: ffmpeg_next::Error| VideoError::Ffmpeg {
        action: "decoding",
        message: error.to_string(),
        path: path.to_owned(),
    };
    let file = File::open(path).map_err(|source| FileError::Read { path: path.to_owned(), source })?;
    let io = StreamIo::from_read_seek(file).map_err(fault)?;
    let mut input = format::input_from_stream(io, None, None).map_err(fault)?;
    let stream = input.streams().best(media::Type::Video).ok_or_else(|| fault(ffmpeg_next::Error::StreamNotFound))?;
    let (index, parameters) = (stream.index(), stream.parameters());
    let context = codec::Context::from_parameters(parameters).map_err(fault)?;
    let mut decoder = context.decoder().video().map_err(fault)?;
    let mut picture = frame::Video::empty();
    for (stream, packet) in input.packets() {
        if stream.index() == index {
            decoder.send_packet(&packet).map_err(fault)?;
            while decoder.receive_frame(&mut picture).is_ok() {
                visit(planes_of(&picture));
            }
        }
    }
    decoder.send_eof().map_err(fault)?;
    while decoder.receive_frame(&mut picture).is_ok() {
        visit(planes_of(&picture));
    }
    Ok(())
}

/// The picture without the padding of its rows.
fn planes_of(picture: &frame::Video) -> Planes420 {
    let packed = |plane: usize| {
        let (width, height) = (picture.plane_width(plane) as usize, picture.plane_height(plane) as usize);
        let rows = picture.data(plane).chunks(picture.stride(plane)).take(height);
        rows.flat_map(|row| &row[..width]).copied().collect()
    };
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    Planes420 { width, height, y: packed(0), cb: packed(1), cr: packed(2) }
}
