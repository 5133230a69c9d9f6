//! What may be asked and done about a job folder without opening it.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use cinesplat_files::{Existing, FileError, NewFile, create_folder, probe};
use cinesplat_video::{VideoFormat, VideoSettings};

use super::access::Access;
use super::cleanup::{TASKS, is_leftover, remove_contents, remove_empty, remove_tasks};
use super::done_log::DoneLog;
use super::error::JobError;
use super::fingerprint::Fingerprint;
use super::frame_files::FrameFiles;
use super::lock::{check_lock, locked, make_folder};
use crate::pipeline::frames::FrameRange;

/// The job folder of an output: its path with `.job` at the end.
pub fn job_folder(output: &Path) -> PathBuf {
    let mut path = OsString::from(output);
    path.push(".job");
    PathBuf::from(path)
}

/// The folder in the job folder of an output for scripts and logs of the tasks that a cluster runs. It is made where it is
/// missing, and goes with the job folder.
///
/// # Errors
/// [`JobError::File`]
pub fn tasks_folder(output: &Path) -> Result<PathBuf, JobError> {
    let folder = job_folder(output).join(TASKS);
    create_folder(&folder)?;
    Ok(folder)
}

/// Whether an earlier run left a job folder for this output.
pub fn has_job(output: &Path) -> bool {
    job_folder(output).join("job.json").is_file()
}

/// The value of one field of the fingerprint in the job folder of an output, such as `quality`; `None` without one.
pub fn job_field(output: &Path, name: &str) -> Option<String> {
    Fingerprint::read(&job_folder(output)).ok().flatten()?.value(name).map(str::to_owned)
}

/// Number of frames that the job folder of an output lists, and number of frames of that film; `None` without one.
pub fn job_progress(output: &Path) -> Option<(usize, usize)> {
    let frames: FrameRange = job_field(output, "frames")?.parse().ok()?;
    let frames = frames.start..frames.end?;
    let listed = DoneLog::listed(&job_folder(output));
    Some((listed.range(frames.clone()).count(), frames.len()))
}

/// Throws away the frames that an earlier run left for this output.
///
/// # Errors
/// [`JobError::Locked`], [`JobError::File`].
pub fn clear_job(output: &Path) -> Result<(), JobError> {
    let folder = job_folder(output);
    if !folder.is_dir() {
        return Ok(());
    }
    let format = VideoFormat::from_path(output).map_err(JobError::video)?;
    let mut lock = locked(&folder, Access::Alone)?;
    let files = FrameFiles::new(&folder, &format, &VideoSettings::default());
    DoneLog::open(&folder)?.kept(&files).remove_all();
    remove_contents(&folder, &format);
    remove_empty(&folder, &mut lock);
    Ok(())
}

/// Removes the job folder of an output if it is what a program left that was killed while it removed it. One that another
/// program works on stays.
///
/// # Errors
/// [`JobError::File`]
pub fn remove_leftover(output: &Path) -> Result<(), JobError> {
    let folder = job_folder(output);
    if !folder.is_dir() || !is_leftover(&folder, output) {
        return Ok(());
    }
    let format = VideoFormat::from_path(output).map_err(JobError::video)?;
    let mut lock = match locked(&folder, Access::Alone) {
        Err(JobError::Locked { .. }) => return Ok(()),
        lock => lock?,
    };
    // Another program may have begun the film since.
    if is_leftover(&folder, output) {
        remove_contents(&folder, &format);
        remove_empty(&folder, &mut lock);
    }
    Ok(())
}

/// Removes the scripts of tasks that no cluster took, and the job folder of an output if nothing else is in it.
pub fn remove_tasks_folder(output: &Path) {
    let folder = job_folder(output);
    remove_tasks(&folder);
    // Whoever put something else into it still needs it.
    let _ = fs::remove_dir(folder);
}

/// Checks before any work that the job folder of an output can be made and written to, and that no other program works on
/// it. Leaves no new file.
///
/// # Errors
/// [`JobError::Locked`], [`JobError::File`].
pub fn check_job(output: &Path) -> Result<(), JobError> {
    probe(|| check(output, Access::Alone))
}

/// As [`check_job`], for a program that shares the work: others that do so too may be at it.
///
/// # Errors
/// As [`check_job`].
pub fn check_shared_job(output: &Path) -> Result<(), JobError> {
    probe(|| check(output, Access::Shared))
}

fn check(output: &Path, access: Access) -> Result<(), JobError> {
    let folder = job_folder(output);
    let pictures = picture_folder(output)?.filter(|pictures| !pictures.exists());
    pictures.as_deref().map(create_folder).transpose()?;
    let is_new = !folder.exists();
    let probe = make_folder(&folder).and_then(|()| {
        let probe = NewFile::create(&folder.join("lock"), Existing::Replace)?;
        let now = probe.file().metadata().and_then(|found| found.modified());
        let now = now.map_err(|source| FileError::Read { path: folder.clone(), source })?;
        if folder.join("lock").exists() { check_lock(&folder, access, now) } else { Ok(()) }
    });
    // A failed removal leaves empty folders, which the film takes.
    if is_new {
        let _ = fs::remove_dir(&folder);
    }
    let _ = pictures.map(fs::remove_dir);
    probe
}

/// The folder of the pictures of a sequence, if it is not the working folder.
pub(super) fn picture_folder(output: &Path) -> Result<Option<PathBuf>, JobError> {
    match VideoFormat::from_path(output).map_err(JobError::video)? {
        VideoFormat::Sequence(pattern) if !pattern.folder().as_os_str().is_empty() => {
            Ok(Some(pattern.folder().to_owned()))
        }
        _ => Ok(None),
    }
}
