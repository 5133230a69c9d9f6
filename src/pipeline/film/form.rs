use cinesplat_lens::Picture;
use cinesplat_video::{VideoError, VideoFormat, VideoSettings, encode_exr, encode_png_with_alpha};

/// The form in which a film's pictures are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Planes of 4:2:0, for films.
    Planes,
    /// Planes of 4:4:4 with opacity, for films.
    AlphaPlanes,
    /// Colors in 8 bits, for pictures.
    Rgb8,
    /// Colors and opacity in 8 bits, for pictures.
    Alpha,
    /// Light in half floats, for pictures.
    Exr,
}

impl Form {
    /// The form for an output.
    pub(super) fn of(format: &VideoFormat, video: &VideoSettings) -> Self {
        match format {
            VideoFormat::Sequence(pattern) if pattern.is_exr() => Self::Exr,
            VideoFormat::Sequence(_) if video.has_alpha => Self::Alpha,
            VideoFormat::Sequence(_) => Self::Rgb8,
            VideoFormat::Mov if video.has_alpha => Self::AlphaPlanes,
            _ => Self::Planes,
        }
    }

    /// The file of a picture.
    pub(super) fn file_of(self, picture: &Picture, is_transparent: bool) -> Result<Vec<u8>, VideoError> {
        let size_px = [picture.frame().width, picture.frame().height];
        if self == Self::Alpha {
            return encode_png_with_alpha(&picture.to_rgba8(), size_px);
        }
        let [red, green, blue, alpha] = picture.to_light(is_transparent);
        let colors: [(&str, &[f32]); 3] = [("B", &blue), ("G", &green), ("R", &red)];
        if is_transparent {
            return encode_exr(&[&[("A", alpha.as_slice())], colors.as_slice()].concat(), size_px);
        }
        encode_exr(&colors, size_px)
    }
}
