use cinesplat_render::Rgb8Frame;
use cinesplat_video::{AlphaPlanes, ContactSheet, Planes420};

/// A finished picture, in the form that its output takes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Picture {
    /// Of a film.
    Planes(Planes420),
    /// Of a film with opacity.
    AlphaPlanes(AlphaPlanes),
    /// Of a picture sequence.
    Rgb8(Rgb8Frame),
    /// Of a picture sequence whose files hold more than 8-bit colors: the bytes of its file, and how it looks.
    File(Vec<u8>, Rgb8Frame),
}

impl Picture {
    /// Adds the picture to a contact sheet that shows it.
    pub(crate) fn add_to(&self, sheet: &mut ContactSheet, cell_idx: usize) {
        match self {
            Self::Planes(planes) => sheet.add_planes(cell_idx, planes),
            Self::AlphaPlanes(planes) => sheet.add_frame(cell_idx, &planes.to_rgb8()),
            Self::Rgb8(frame) | Self::File(_, frame) => sheet.add_frame(cell_idx, &frame.rgb8),
        }
    }
}
