use std::io::{self, IsTerminal, Write};

use super::failure::Failure;

/// Writes data to stdout. A reader that stops early (`| head`) is no error.
pub(super) fn data(text: &str) -> Result<(), Failure> {
    data_bytes(text.as_bytes())
}

/// As [`data`], for bytes of any kind.
pub(super) fn data_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::io("stdout", &error)),
        _ => Ok(()),
    }
}

/// Writes a line to stderr. There is nobody left to tell when that fails.
pub(super) fn note(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Writes an error and what to do about it to stderr.
pub(super) fn error(failure: &Failure) {
    note(&failure.to_string());
}

/// Whether a person watches stderr.
pub(super) fn is_watched() -> bool {
    io::stderr().is_terminal()
}
