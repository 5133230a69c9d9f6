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

/// The folder that holds a file; `.` for a bare name.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
