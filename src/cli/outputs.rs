use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// Checks before any work that a file can be made: its folder is there, its name is free or may be overwritten.
pub(super) fn check_new(path: &Path, overwrite: bool) -> Result<(), Failure> {
    let refuse = |found: &str, help: &str| {
        let code = if found.starts_with("already") { "OUTPUT-EXISTS" } else { "OUTPUT-CREATE" };
        Err(Failure::new(code, format!("{}: {found}", path.display()), help, 73))
    };
    if path.is_dir() {
        return refuse("is a folder, expected a file name", "name a file in it");
    }
    if path.exists() && !overwrite {
        return refuse("already there, expected a new name", "choose another name, or pass --overwrite");
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return refuse("its folder does not exist", &format!("mkdir -p {}", folder.display()));
    }
    if fs::metadata(folder).is_ok_and(|metadata| metadata.permissions().readonly()) {
        return Err(Failure::io(&path.display().to_string(), &io::ErrorKind::PermissionDenied.into()));
    }
    Ok(())
}

/// Makes a folder where it is missing, with those above it.
pub(super) fn create_folder(folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| Failure::io(&folder.display().to_string(), &error))
}

/// Writes a whole file under a passing name, then renames it.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let written = fs::write(&part, bytes).and_then(|()| fs::rename(&part, path));
    written.map_err(|error| {
        // The first error is the one to tell.
        let _ = fs::remove_file(&part);
        Failure::io(&path.display().to_string(), &error)
    })
}

/// All of a text file.
pub(super) fn read_text(path: &Path) -> Result<String, Failure> {
    let bytes = fs::read(path).map_err(|error| Failure::io(&path.display().to_string(), &error))?;
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let found = format!("{}: byte {at} is not UTF-8, expected text", path.display());
        Failure::new("NOT-TEXT", found, "is this the right file?", 65)
    })
}

/// `target` as it is named inside the file at `base`: relative to its folder where both can be found, else as it is.
pub(super) fn relative_to(base: &Path, target: &Path) -> String {
    let folder = base.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (Ok(folder), Ok(target)) = (folder.canonicalize(), target.canonicalize()) else {
        return target.to_string_lossy().into_owned();
    };
    let shared = folder.components().zip(target.components()).take_while(|(a, b)| a == b).count();
    let climb = folder.components().skip(shared).map(|_| "..".into());
    let descend = target.components().skip(shared).map(|part| part.as_os_str().to_owned());
    climb.chain(descend).collect::<PathBuf>().to_string_lossy().into_owned()
}
