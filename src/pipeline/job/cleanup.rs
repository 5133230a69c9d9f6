use std::fs;
use std::path::{Path, PathBuf};

use cinesplat_video::VideoFormat;

use super::holders::remove_folder;
use super::lock::Lock;

/// Folder of the frames in a job folder.
pub(super) const FRAMES: &str = "frames";

/// Folder of the scripts and logs of the tasks of a farm.
pub(super) const TASKS: &str = "tasks";

/// Where the film of a job folder lies until it gets its name.
pub(super) fn film_path(folder: &Path, format: &VideoFormat) -> PathBuf {
    folder.join("film").with_extension(format.extension())
}

/// Removes everything that a film puts into its folder but the lock; leaves files of anybody else. A failed removal shows
/// as a folder that stays.
pub(super) fn remove_contents(folder: &Path, format: &VideoFormat) {
    // The log goes first: without it no frame is trusted.
    for name in ["done.log", "job.json"] {
        let _ = fs::remove_file(folder.join(name));
    }
    let _ = fs::remove_file(film_path(folder, format));
    remove_temporary(folder);
    remove_temporary(&folder.join(FRAMES));
    let tasks = folder.join(TASKS);
    let is_of_tasks = |name: &str| Path::new(name).extension().is_some_and(|ending| ending == "log" || ending == "sh");
    remove_files(&tasks, is_of_tasks);
    let _ = fs::remove_dir(tasks);
    for inner in [FRAMES, "claims"] {
        let inner = folder.join(inner);
        remove_files(&inner, |name| name.trim_end_matches(".yuv").bytes().all(|byte| byte.is_ascii_digit()));
        let _ = fs::remove_dir(inner);
    }
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
