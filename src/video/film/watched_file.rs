use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::sync::{Arc, Mutex};

/// The first system error of a file that FFmpeg writes to. FFmpeg itself reports every one of them as `EIO`.
pub(crate) type FirstError = Arc<Mutex<Option<io::Error>>>;

/// A file that records its first error.
pub(crate) struct WatchedFile {
    pub(crate) file: File,
    pub(crate) first_error: FirstError,
}

impl WatchedFile {
    fn watch<T>(&mut self, action: impl FnOnce(&mut File) -> io::Result<T>) -> io::Result<T> {
        action(&mut self.file).inspect_err(|error| {
            if let Ok(mut first) = self.first_error.lock() {
                let copy = error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error);
                first.get_or_insert(copy);
            }
        })
    }
}

impl Write for WatchedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // FFmpeg takes a short write for a whole one, and an interrupted one for an error.
        self.watch(|file| file.write_all(bytes)).map(|()| bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.watch(File::flush)
    }
}

impl Seek for WatchedFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.watch(|file| file.seek(to))
    }
}
