use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use cinesplat_files::{Existing, checksum};
use cinesplat_render::Rgb8Frame;
use cinesplat_video::{AlphaPlanes, FramePattern, Planes420, VideoFormat, VideoSettings, decode_png};

use super::picture::Picture;

/// Where the frames of a job lie, and in which form.
#[derive(Debug, Clone)]
pub(crate) enum FrameFiles {
    /// Planes as the encoders take them, in the folder `frames`.
    Planes {
        /// The folder.
        folder: PathBuf,
        /// Columns and rows of luma.
        size: [usize; 2],
    },
    /// Planes with opacity, in the folder `frames`.
    AlphaPlanes {
        /// The folder.
        folder: PathBuf,
        /// Columns and rows.
        size: [usize; 2],
    },
    /// The pictures of a sequence, under their own names.
    Pictures {
        /// Their names.
        pattern: FramePattern,
        /// Width and height in pixels.
        size_px: [u32; 2],
        /// Whether pictures that are not of this job are replaced.
        existing: Existing,
    },
}

impl FrameFiles {
    pub(super) fn new(folder: &Path, format: &VideoFormat, video: &VideoSettings) -> Self {
        match format {
            VideoFormat::Sequence(pattern) => Self::Pictures {
                pattern: pattern.clone(),
                size_px: [video.width, video.height],
                existing: video.existing,
            },
            VideoFormat::Mov if video.has_alpha => {
                Self::AlphaPlanes { folder: folder.join("frames"), size: [video.width as usize, video.height as usize] }
            }
            _ => Self::Planes {
                folder: folder.join("frames"),
                size: [video.width, video.height].map(|length| length.next_multiple_of(2) as usize),
            },
        }
    }

    /// The file of a frame.
    pub(super) fn path(&self, frame_idx: usize) -> PathBuf {
        match self {
            Self::Planes { folder, .. } | Self::AlphaPlanes { folder, .. } => {
                folder.join(format!("{frame_idx:06}.yuv"))
            }
            Self::Pictures { pattern, .. } => pattern.path(frame_idx),
        }
    }

    /// Whether a file of the right length is there. It may be damaged.
    pub(super) fn is_there(&self, frame_idx: usize) -> bool {
        let is_right = |num_bytes: u64| match self {
            Self::Planes { .. } | Self::AlphaPlanes { .. } => num_bytes == self.frame_bytes(),
            Self::Pictures { .. } => num_bytes > 0,
        };
        fs::metadata(self.path(frame_idx)).is_ok_and(|found| found.is_file() && is_right(found.len()))
    }

    /// The bytes of a frame's file, if they have this checksum.
    pub(super) fn bytes(&self, frame_idx: usize, listed: u64) -> Option<Vec<u8>> {
        let bytes = fs::read(self.path(frame_idx)).ok()?;
        (checksum(&[&bytes]) == listed).then_some(bytes)
    }

    /// Bytes of one frame that nothing else takes: 0 for pictures, which are the output itself.
    pub(super) fn frame_bytes(&self) -> u64 {
        match self {
            Self::Planes { size: [width, height], .. } => (width * height * 3 / 2) as u64,
            Self::AlphaPlanes { size: [width, height], .. } => (width * height * 8) as u64,
            Self::Pictures { .. } => 0,
        }
    }
}

/// The frames that earlier runs finished.
#[derive(Debug, Clone)]
pub(crate) struct Kept {
    checksums: BTreeMap<usize, u64>,
    files: FrameFiles,
}

impl Kept {
    pub(super) fn new(checksums: BTreeMap<usize, u64>, files: FrameFiles) -> Self {
        Self { checksums, files }
    }

    /// Number of frames of a range that the log lists.
    pub(crate) fn num_listed(&self, frames: &Range<usize>) -> usize {
        self.checksums.range(frames.clone()).count()
    }

    /// Whether the log lists a frame.
    pub(crate) fn is_listed(&self, frame_idx: usize) -> bool {
        self.checksums.contains_key(&frame_idx)
    }

    /// Whether a frame is finished and undamaged.
    pub(crate) fn is_whole(&self, frame_idx: usize) -> bool {
        self.bytes(frame_idx).is_some()
    }

    /// A finished frame; `None` if it is damaged or was not finished.
    pub(crate) fn picture(&self, frame_idx: usize) -> Option<Picture> {
        let bytes = self.bytes(frame_idx)?;
        match &self.files {
            FrameFiles::Planes { size: [width, height], .. } => {
                Planes420::from_bytes(&bytes, *width, *height).map(Picture::Planes)
            }
            FrameFiles::AlphaPlanes { size: [width, height], .. } => {
                AlphaPlanes::from_bytes(&bytes, *width, *height).map(Picture::AlphaPlanes)
            }
            FrameFiles::Pictures { size_px: [width, height], .. } => {
                let rgb8 = decode_png(&bytes)?;
                let is_whole = rgb8.len() == *width as usize * *height as usize * 3;
                is_whole
                    .then(|| Picture::Rgb8(Rgb8Frame { width: *width, height: *height, rgb8, ..Rgb8Frame::default() }))
            }
        }
    }

    /// Removes the files of all finished, undamaged frames. A failed removal leaves a file that no log lists.
    pub(super) fn remove_all(&self) {
        for &frame_idx in self.checksums.keys().filter(|&&frame_idx| self.is_whole(frame_idx)) {
            let _ = fs::remove_file(self.files.path(frame_idx));
        }
    }

    fn bytes(&self, frame_idx: usize) -> Option<Vec<u8>> {
        self.files.bytes(frame_idx, *self.checksums.get(&frame_idx)?)
    }
}
