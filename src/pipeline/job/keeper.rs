use std::fs;
use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cinesplat_files::{Existing, FileError, NewFile, PastCache, check_free, checksum};
use cinesplat_video::encode_png;

use super::cleanup::FRAMES;
use super::done_log::DoneLog;
use super::error::JobError;
use super::flusher::Flusher;
use super::frame_files::{FrameFiles, Kept};
use super::holders::Sign;
use super::picture::Picture;

/// Keeps finished frames.
pub(crate) struct Keeper {
    /// Where temporary files go.
    temporary: PathBuf,
    files: FrameFiles,
    log: DoneLog,
    past_cache: PastCache,
    flusher: Flusher,
    /// Of the right to write.
    sign: Arc<Sign>,
}

impl Keeper {
    pub(super) fn open(folder: &Path, files: FrameFiles, sign: Arc<Sign>) -> Result<Self, JobError> {
        let log = DoneLog::open(folder)?;
        let flusher = Flusher::start(log.path().to_owned());
        Ok(Self { temporary: folder.join(FRAMES), files, log, past_cache: PastCache::default(), flusher, sign })
    }

    /// Refuses a sequence that would replace pictures of somebody else.
    ///
    /// # Errors
    /// [`FileError::Exists`], [`FileError::Create`].
    pub(super) fn check_names(&self, frames: Range<usize>) -> Result<(), FileError> {
        let FrameFiles::Pictures { pattern, existing, .. } = &self.files else { return Ok(()) };
        let mut unlisted = frames.filter(|frame_idx| !self.log.lists(*frame_idx));
        unlisted.try_for_each(|frame_idx| check_free(&pattern.path(frame_idx), *existing))
    }

    /// Keeps a picture as frame `frame_idx`.
    ///
    /// # Errors
    /// [`JobError::File`], [`JobError::Lost`].
    pub(crate) fn keep(&mut self, frame_idx: usize, picture: &Picture) -> Result<(), JobError> {
        self.sign.check()?;
        match picture {
            Picture::Planes(planes) => self.write(frame_idx, &planes.parts()),
            Picture::AlphaPlanes(planes) => self.write(frame_idx, &[&planes.to_bytes()]),
            Picture::Rgb8(frame) => {
                let bytes = encode_png(&frame.rgb8, [frame.width, frame.height]).map_err(JobError::video)?;
                self.write(frame_idx, &[&bytes])
            }
            Picture::File(bytes, _) => self.write(frame_idx, &[bytes]),
        }
    }

    /// Keeps the picture of frame `frame_idx - 1` once more, as frame `frame_idx`, without another copy on the disk
    /// where that is possible.
    ///
    /// # Errors
    /// [`JobError::File`], [`JobError::Lost`].
    pub(crate) fn keep_again(&mut self, frame_idx: usize, picture: &Picture) -> Result<(), JobError> {
        self.sign.check()?;
        let (path, earlier) = (self.files.path(frame_idx), self.files.path(frame_idx - 1));
        let is_own = !matches!(self.files, FrameFiles::Pictures { .. });
        if let Some(listed) = self.log.checksum(frame_idx - 1).filter(|_| is_own)
            && fs::hard_link(earlier, path).is_ok()
        {
            return Ok(self.log.append(frame_idx, listed)?);
        }
        self.keep(frame_idx, picture)
    }

    /// The frames that are finished now.
    pub(super) fn kept(&self) -> Kept {
        self.log.kept(&self.files)
    }

    /// Whether a frame is finished. It may have been damaged since: the film is made of frames that are checked again.
    pub(super) fn has(&self, frame_idx: usize) -> bool {
        self.log.lists(frame_idx) && self.files.is_there(frame_idx)
    }

    pub(super) fn num_kept(&self) -> usize {
        self.log.num_listed()
    }

    pub(super) fn files(&self) -> &FrameFiles {
        &self.files
    }

    /// Adds the frames that other programs finished.
    pub(super) fn refresh(&mut self) -> Result<(), JobError> {
        self.log.refresh()?;
        Ok(())
    }

    /// Writes what is not on the disk yet.
    pub(super) fn flush(&mut self) -> Result<(), JobError> {
        self.flusher.finish()
    }

    /// Flushes nothing any more.
    pub(super) fn abandon(&mut self) {
        self.flusher.abandon();
    }

    fn write(&mut self, frame_idx: usize, parts: &[&[u8]]) -> Result<(), JobError> {
        let path = self.files.path(frame_idx);
        // A frame that the log lists is this job's own, whatever has become of it.
        let existing = match &self.files {
            FrameFiles::Pictures { existing, .. } if !self.log.lists(frame_idx) => *existing,
            _ => Existing::Replace,
        };
        let new = NewFile::create_in(&self.temporary, &path, existing)?;
        // The frames of a film are read once, if ever; pictures of a sequence are looked at.
        let written = match &self.files {
            FrameFiles::Pictures { .. } => parts.iter().try_for_each(|part| new.file().write_all(part)),
            _ => self.past_cache.write(new.file(), parts),
        };
        written.map_err(|source| FileError::Write { path: path.clone(), source })?;
        self.log.append(frame_idx, checksum(parts))?;
        new.commit_unflushed()?;
        self.flusher.add(path)
    }
}
