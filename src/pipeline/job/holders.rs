//! Who works on a job folder, also on a disk without locks: one file per program, in the folder `holders`.
//!
//! A program writes its file first and looks for others then. So of two that start at once both see the other one: one of
//! them or both are refused, and never none. The file is written again every few seconds. A program of this machine counts as
//! gone when it has ended, one of another machine when its file is a minute old by the clock of that disk. One that was
//! halted for longer and finds on waking that its file was removed, or that another one is at work, has lost the folder:
//! it writes nothing any more.

use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, SystemTime};

use cinesplat_files::{Existing, FileError, create_folder, folder_of};

use super::access::Access;
use super::error::JobError;
use super::process::{has_ended, own_name};

/// Name of the folder.
const HOLDERS: &str = "holders";
/// Time between two signs of life.
const INTERVAL: Duration = Duration::from_secs(10);
/// Age of the last sign of life of a program that is gone.
const MAX_AGE: Duration = Duration::from_mins(1);

/// The file of this program. It goes when this value is dropped.
pub(super) struct Holder {
    sign: Arc<Sign>,
    /// Its end stops the signs of life.
    alive: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// What a program shows of itself.
pub(super) struct Sign {
    path: PathBuf,
    access: Access,
    is_lost: AtomicBool,
}

impl Holder {
    /// Writes the file of this program into a job folder, and refuses where another program is in the way.
    ///
    /// # Errors
    /// [`JobError::Locked`], [`JobError::File`].
    pub(super) fn announce(folder: &Path, access: Access) -> Result<Self, JobError> {
        static NUM_ANNOUNCED: AtomicUsize = AtomicUsize::new(0);
        let number = NUM_ANNOUNCED.fetch_add(1, Ordering::Relaxed);
        let path = folder.join(HOLDERS).join(format!("{}-{number}", own_name()));
        create_folder(folder_of(&path))?;
        cinesplat_files::write(&path, word(access).as_bytes(), Existing::Replace)?;
        let sign = Arc::new(Sign { path, access, is_lost: AtomicBool::new(false) });
        let (sender, receiver) = channel::<()>();
        let shown = Arc::clone(&sign);
        let thread = thread::spawn(move || {
            while receiver.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
                shown.show();
            }
        });
        let holder = Self { sign, alive: Some(sender), thread: Some(thread) };
        let now = written(&holder.sign.path).ok_or_else(|| JobError::Lost { path: folder.to_owned() })?;
        if has_rival(folder, access, now, Some(&holder.sign.path))? {
            return Err(JobError::Locked { path: folder.to_owned() });
        }
        Ok(holder)
    }

    pub(super) fn sign(&self) -> &Arc<Sign> {
        &self.sign
    }

    /// Removes the files of programs that are gone.
    pub(super) fn remove_gone(&self) {
        let Some(now) = written(&self.sign.path) else { return };
        for entry in fs::read_dir(folder_of(&self.sign.path)).into_iter().flatten().flatten() {
            if entry.path() != self.sign.path && is_gone(&entry.path(), now) {
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

impl Drop for Holder {
    fn drop(&mut self) {
        self.alive = None;
        // Before the file goes, so that its last sign of life does not miss it.
        let _ = self.thread.take().map(JoinHandle::join);
        // A file that stays counts as that of a program that is gone.
        let _ = fs::remove_file(&self.sign.path);
    }
}

impl Sign {
    /// Refuses to go on where the folder was lost before the last sign of life.
    ///
    /// # Errors
    /// [`JobError::Lost`]
    pub(super) fn check(&self) -> Result<(), JobError> {
        if self.is_lost.load(Ordering::Relaxed) {
            return Err(JobError::Lost { path: self.folder().to_owned() });
        }
        Ok(())
    }

    /// As [`Sign::check`], after another sign of life.
    ///
    /// # Errors
    /// [`JobError::Lost`]
    pub(super) fn check_now(&self) -> Result<(), JobError> {
        self.show();
        self.check()
    }

    /// Writes the file again, and looks whether the folder was lost.
    fn show(&self) {
        let before = written(&self.path);
        let shown = File::options().write(true).open(&self.path);
        let shown =
            shown.and_then(|mut file| file.write_all(word(self.access).as_bytes()).and_then(|()| file.sync_data()));
        // Where a sign of life fails otherwise, the next one may not.
        let is_removed = shown.is_err_and(|error| error.kind() == ErrorKind::NotFound);
        let was_late = || {
            let (before, now) = (before?, written(&self.path)?);
            let rival = || has_rival(self.folder(), self.access, now, Some(&self.path)).unwrap_or(true);
            Some(is_late(before, now) && rival())
        };
        if is_removed || was_late().unwrap_or(false) {
            self.is_lost.store(true, Ordering::Relaxed);
        }
    }

    /// The job folder.
    fn folder(&self) -> &Path {
        folder_of(folder_of(&self.path))
    }
}

/// Whether a program works on a job folder that one with this access may not work beside. `now` is the clock of its disk,
/// `own` the file of the program that asks.
///
/// # Errors
/// [`FileError::Read`]
pub(super) fn has_rival(folder: &Path, access: Access, now: SystemTime, own: Option<&Path>) -> Result<bool, FileError> {
    let folder = folder.join(HOLDERS);
    let failed = |source| FileError::Read { path: folder.clone(), source };
    let entries = match fs::read_dir(&folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
        entries => entries.map_err(failed)?,
    };
    for entry in entries {
        let path = entry.map_err(failed)?.path();
        // A file that is gone now is no rival.
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let is_in_the_way = access == Access::Alone || text == word(Access::Alone);
        if own != Some(&path) && is_in_the_way && !is_gone(&path, now) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Removes the folder of these files, if none is left.
pub(super) fn remove_folder(folder: &Path) {
    let _ = fs::remove_dir(folder.join(HOLDERS));
}

/// Whether the program of a file does not work any more.
fn is_gone(path: &Path, now: SystemTime) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    // A program of this machine that is halted goes on later.
    has_ended(&name).unwrap_or_else(|| written(path).is_none_or(|shown| is_late(shown, now)))
}

fn is_late(shown: SystemTime, now: SystemTime) -> bool {
    now.duration_since(shown).is_ok_and(|age| age > MAX_AGE)
}

fn word(access: Access) -> &'static str {
    match access {
        Access::Alone => "alone",
        Access::Shared => "shared",
    }
}

/// When a file was written, by the clock of its disk.
fn written(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).and_then(|found| found.modified()).ok()
}
