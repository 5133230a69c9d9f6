use std::fs;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use cinesplat_files::Existing;
use cinesplat_video::VideoFormat;

use super::holders::remove_folder;
use super::lock::Lock;

/// Folder of the frames in a job folder.
pub(super) const FRAMES: &str = "frames";

/// File that names the film which got its name ([`note_placed`]).
const PLACED: &str = "placed";

/// Folder of the scripts and logs of the tasks of a farm.
pub(super) const TASKS: &str = "tasks";

/// Where the film of a job folder lies until it gets its name.
pub(super) fn film_path(folder: &Path, format: &VideoFormat) -> PathBuf {
    folder.join("film").with_extension(format.extension())
}

/// Removes everything that a film puts into its folder but the lock; leaves files of anybody else. A failed removal shows
/// as a folder that stays.
///
/// The order counts, for the program may be killed at any of these steps ([`is_leftover`]): the description goes first, for
/// without it nothing in the folder is used again, and the frames last.
pub(super) fn remove_contents(folder: &Path, format: &VideoFormat) {
    for name in ["job.json", "done.log", PLACED] {
        let _ = fs::remove_file(folder.join(name));
    }
    let _ = fs::remove_file(film_path(folder, format));
    remove_temporary(folder);
    remove_temporary(&folder.join(FRAMES));
    remove_tasks(folder);
    for inner in ["claims", FRAMES] {
        let inner = folder.join(inner);
        remove_files(&inner, |name| name.trim_end_matches(".yuv").bytes().all(|byte| byte.is_ascii_digit()));
        let _ = fs::remove_dir(inner);
    }
}

/// Removes scripts and logs of tasks.
pub(super) fn remove_tasks(folder: &Path) {
    let tasks = folder.join(TASKS);
    let is_of_tasks = |name: &str| Path::new(name).extension().is_some_and(|ending| ending == "log" || ending == "sh");
    remove_files(&tasks, is_of_tasks);
    let _ = fs::remove_dir(tasks);
}

/// Notes in a job folder which file the finished film is, right before it gets its name.
pub(super) fn note_placed(folder: &Path, film: &Path) {
    // Without the note a folder whose removal is cut off stays; the film is more important, and there may be no space.
    let _ = cinesplat_files::write(&folder.join(PLACED), identity(film).as_bytes(), Existing::Replace);
}

/// Whether a job folder is what a program left that was killed while it removed it: the film has its name, or the folder
/// has no description any more. A folder with tasks that no program has begun has none yet.
pub(super) fn is_leftover(folder: &Path, output: &Path) -> bool {
    let is_described = folder.join("job.json").exists();
    let is_begun = folder.join(FRAMES).exists() || !folder.join(TASKS).exists();
    let placed = || fs::read_to_string(folder.join(PLACED)).is_ok_and(|film| film == identity(output));
    if is_described { placed() } else { is_begun }
}

/// What stays the same where a file gets another name, and differs from other files; empty without such a file.
fn identity(path: &Path) -> String {
    let Ok(found) = fs::metadata(path) else { return String::new() };
    let secs = found.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
    #[cfg(unix)]
    let number = std::os::unix::fs::MetadataExt::ino(&found);
    #[cfg(not(unix))]
    let number = 0;
    format!("{number} {} {}", found.len(), secs.as_nanos())
}

/// Removes temporary files that a killed program left.
pub(super) fn remove_temporary(folder: &Path) {
    remove_files(folder, |name| name.starts_with('.') && name.strip_suffix(".part").is_some());
}

fn remove_files(folder: &Path, is_removed: impl Fn(&str) -> bool) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_str().is_some_and(&is_removed) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Removes a job folder that holds nothing but its lock.
pub(super) fn remove_empty(folder: &Path, lock: &mut Lock) {
    lock.withdraw();
    remove_folder(folder);
    let _ = fs::remove_file(folder.join("lock"));
    let _ = fs::remove_dir(folder);
}
