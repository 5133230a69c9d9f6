//! Writes frames to a film file or to a numbered sequence of pictures.
//!
//! Enters: 8-bit RGB frames, in order. Leaves: H.264 (MP4, Matroska, QuickTime), VP9 (WebM) or, with opacity, `ProRes` 4444
//! (QuickTime) with exact timestamps and BT.709 color tags, or one PNG or `OpenEXR` file per frame. The invariant: a film file appears under its own name only when it is
//! complete and has been read back.
//!
//! [`VideoWriter`] writes either kind; the extension of the path decides ([`VideoFormat::from_path`]). Films need the
//! feature `ffmpeg`, which is on by default. Without it only picture sequences are written.

mod alpha_planes;
mod bt709;
mod contact_sheet;
mod dry_run;
mod error;
mod exr;
#[cfg(feature = "ffmpeg")]
mod film;
#[cfg(not(feature = "ffmpeg"))]
#[path = "no_film.rs"]
mod film;
mod pattern;
mod sequence;
mod settings;
mod takes_sheet;
mod writer;

pub use alpha_planes::AlphaPlanes;
pub use bt709::{Planes420, planes_from_rgb8};
pub use contact_sheet::ContactSheet;
pub use dry_run::{encode_and_discard, encoder_delay_frames};
pub use error::VideoError;
pub use exr::encode_exr;
pub use pattern::FramePattern;
pub use sequence::{decode_png, encode_png, encode_png_with_alpha, remove_frames_from, write_png};
pub use settings::{EyePacking, VideoFormat, VideoSettings, X264Preset};
pub use takes_sheet::TakesSheet;
pub use writer::{VideoWriter, check_format, check_output, odd_size_note, panorama_warning, read_film};
