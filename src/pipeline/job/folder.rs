use std::path::{Path, PathBuf};
use std::sync::Arc;

use cinesplat_files::{Existing, create_folder, free_bytes, move_file};
use cinesplat_video::{VideoFormat, VideoSettings};

use super::access::Access;
use super::claims::{Claim, claim};
use super::cleanup::{FRAMES, film_path, note_placed, remove_contents, remove_empty, remove_temporary};
use super::done_log::DoneLog;
use super::error::JobError;
use super::fingerprint::Fingerprint;
use super::frame_files::{FrameFiles, Kept};
use super::keeper::Keeper;
use super::lock::{Lock, locked, make_folder};
use super::outside::{job_folder, picture_folder};
use super::settings::{JobSettings, JobStart};

/// An open job folder. Dropping it removes the folder if it keeps no frame.
pub(crate) struct Job {
    folder: PathBuf,
    format: VideoFormat,
    keeper: Keeper,
    is_last: bool,
    lock: Lock,
}

impl Job {
    /// Opens the job folder of `output` for a film with this fingerprint; makes it where there is none.
    ///
    /// # Errors
    /// [`JobError::Locked`] while another program works on it, [`JobError::Mismatch`] for frames of another film,
    /// [`JobError::Unreadable`], [`JobError::NoSpace`], [`JobError::File`].
    pub(crate) fn open(
        output: &Path,
        video: &VideoSettings,
        fingerprint: &Fingerprint,
        settings: &JobSettings,
        access: Access,
    ) -> Result<Self, JobError> {
        let folder = job_folder(output);
        let format = VideoFormat::from_path(output).map_err(JobError::video)?;
        picture_folder(output)?.as_deref().map(create_folder).transpose()?;
        make_folder(&folder)?;
        let lock = locked(&folder, access)?;
        let files = FrameFiles::new(&folder, &format, video);
        if access == Access::Alone {
            remove_temporary(&folder);
            remove_temporary(&folder.join(FRAMES));
            if settings.start == JobStart::Fresh {
                DoneLog::open(&folder)?.kept(&files).remove_all();
                remove_contents(&folder, &format);
            }
        }
        fingerprint.write_or_compare(&folder)?;
        create_folder(&folder.join(FRAMES))?;
        let keeper = Keeper::open(&folder, files, Arc::clone(lock.sign()))?;
        keeper.check_names(video.first_frame..video.first_frame + video.num_frames)?;
        let job = Self { folder, format, keeper, is_last: access == Access::Alone, lock };
        job.check_space(video)?;
        Ok(job)
    }

    /// Frames that an earlier run finished, and the keeper of further ones.
    pub(crate) fn parts(&mut self) -> (Kept, &mut Keeper) {
        (self.keeper.kept(), &mut self.keeper)
    }

    /// Where the film is written.
    pub(crate) fn film_path(&self) -> PathBuf {
        film_path(&self.folder, &self.format)
    }

    /// The film, if an earlier run finished it and could not give it its name.
    pub(crate) fn finished_film(&self) -> Option<PathBuf> {
        Some(self.film_path()).filter(|path| !self.is_sequence() && path.is_file())
    }

    /// Whether the output is a picture sequence.
    pub(crate) fn is_sequence(&self) -> bool {
        matches!(self.format, VideoFormat::Sequence(_))
    }

    /// Gives the finished film its name. Where no frames are kept after that, the folder says so first: this program may be
    /// killed before it has removed it.
    ///
    /// # Errors
    /// [`JobError::NotPlaced`]; the film stays in the folder. [`JobError::Lost`].
    pub(crate) fn place_film(&self, output: &Path, existing: Existing, keeps_frames: bool) -> Result<(), JobError> {
        self.lock.sign().check_now()?;
        let kept = self.film_path();
        if !keeps_frames {
            note_placed(&self.folder, &kept);
        }
        move_file(&kept, output, existing).map_err(|error| JobError::NotPlaced { kept, error })
    }

    /// The claim of one of several programs on a frame; `None` if another has it, or the frame is finished.
    ///
    /// # Errors
    /// [`JobError::File`]
    pub(crate) fn claim(&mut self, frame_idx: usize) -> Result<Option<Claim>, JobError> {
        if self.keeper.has(frame_idx) {
            return Ok(None);
        }
        let Some(claim) = claim(&self.folder, frame_idx)? else { return Ok(None) };
        // The frame may have been finished while this program rendered another one.
        self.keeper.refresh()?;
        Ok((!self.keeper.has(frame_idx)).then_some(claim))
    }

    /// Writes what is not on the disk yet.
    ///
    /// # Errors
    /// [`JobError::File`]
    pub(crate) fn flush(&mut self) -> Result<(), JobError> {
        self.keeper.flush()
    }

    /// Flushes no frame any more: the film is whole, and its frames are about to go.
    pub(crate) fn abandon_frames(&mut self) {
        self.keeper.abandon();
    }

    /// Removes the folder of a film that is whole.
    pub(crate) fn remove(mut self) {
        self.remove_folder();
        // Nothing is left for the destructor.
        self.is_last = false;
    }

    fn remove_folder(&mut self) {
        self.keeper.abandon();
        // What another program took over is its own.
        if self.lock.sign().check_now().is_ok() {
            remove_contents(&self.folder, &self.format);
            remove_empty(&self.folder, &mut self.lock);
        }
    }

    /// Refuses a film whose frames do not fit on the disk.
    fn check_space(&self, video: &VideoSettings) -> Result<(), JobError> {
        let num_missing = video.num_frames.saturating_sub(self.keeper.num_kept()) as u64;
        let needed = num_missing * self.keeper.files().frame_bytes();
        match free_bytes(&self.folder) {
            Some(free) if free < needed => Err(JobError::NoSpace { path: self.folder.clone(), needed, free }),
            _ => Ok(()),
        }
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        if self.is_last && self.keeper.num_kept() == 0 && self.finished_film().is_none() {
            self.remove_folder();
        }
    }
}
