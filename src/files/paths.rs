use std::fs;
use std::path::{Path, PathBuf};

/// Resolves `name`, as written in the file `base`. A relative name is relative to the folder of `base`.
pub fn beside(base: &Path, name: &str) -> PathBuf {
    base.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name))
}

/// `target` relative to the folder of the file `base`, or `target` unchanged if either path does not exist.
pub fn relative_to(base: &Path, target: &Path) -> String {
    let folder = folder_of(base).canonicalize().ok();
    let relative = folder.and_then(|folder| pathdiff::diff_paths(target.canonicalize().ok()?, folder));
    relative.unwrap_or_else(|| target.to_owned()).to_string_lossy().into_owned()
}

/// Whether two paths lead to one regular file, by links or not.
pub fn is_same_file(first: &Path, second: &Path) -> bool {
    let file = |path: &Path| fs::metadata(path).ok().filter(fs::Metadata::is_file);
    let (Some(first_file), Some(second_file)) = (file(first), file(second)) else { return false };
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let identity = |file: &fs::Metadata| (file.dev(), file.ino());
        identity(&first_file) == identity(&second_file)
    }
    #[cfg(not(unix))]
    {
        let _ = (first_file, second_file);
        fs::canonicalize(first).ok() == fs::canonicalize(second).ok()
    }
}

/// The folder that holds a file; `.` for a bare name.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
