use std::path::PathBuf;

/// Path of a film in the system's temporary folder. The file is removed on drop.
pub(super) struct TemporaryFilm(pub(super) PathBuf);

impl TemporaryFilm {
    pub(super) fn new() -> Self {
        Self(std::env::temp_dir().join(format!("cinesplat-bench-{}.mp4", std::process::id())))
    }
}

impl Drop for TemporaryFilm {
    fn drop(&mut self) {
        // A failed removal cannot be reported here.
        let _ = std::fs::remove_file(&self.0);
    }
}
