use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::Failure;

/// Writes data to stdout. A closed pipe (`| head`) is no error.
pub(super) fn data(text: &str) -> Result<(), Failure> {
    data_bytes(text.as_bytes())
}

/// As [`data`], for bytes.
pub(super) fn data_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::io("stdout", &error)),
        _ => Ok(()),
    }
}

/// Whether notes and progress are suppressed, for the whole process.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// Suppresses notes and progress, but not data and errors.
pub(super) fn set_quiet(is_quiet: bool) {
    IS_QUIET.store(is_quiet, Ordering::Relaxed);
}

/// Writes a line to stderr, unless the program is quiet.
pub(super) fn note(line: &str) {
    if !IS_QUIET.load(Ordering::Relaxed) {
        line_to_stderr(line);
    }
}

/// A failed write is ignored: there is no other place to report it.
fn line_to_stderr(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Writes an error and its help to stderr.
pub(super) fn error(failure: &Failure) {
    line_to_stderr(&failure.to_string());
}

/// Whether progress bars are shown: stderr is a terminal and the program is not quiet.
pub(super) fn is_watched() -> bool {
    io::stderr().is_terminal() && !IS_QUIET.load(Ordering::Relaxed)
}
