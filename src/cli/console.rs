use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::Failure;

/// Writes a text for people to stdout, with its control characters replaced.
pub(super) fn text(text: &str) -> Result<(), Failure> {
    data(&without_escapes(text))
}

/// The text with every control character but line feeds and tabs replaced by U+FFFD: a name or prompt from a file cannot
/// control the terminal.
fn without_escapes(text: &str) -> String {
    let is_harmful = |c: char| c.is_control() && c != '\n' && c != '\t';
    text.replace(is_harmful, "\u{FFFD}")
}

/// A text from a file as part of one line: line feeds and tabs are replaced as well.
pub(super) fn one_line(text: &str) -> String {
    text.replace(char::is_control, "\u{FFFD}")
}

/// Writes data for programs to stdout. A closed pipe (`| head`) is no error.
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

/// Writes a line to stderr, unless the program is quiet. Its control characters are replaced.
pub(super) fn note(line: &str) {
    if !IS_QUIET.load(Ordering::Relaxed) {
        line_to_stderr(line);
    }
}

/// Writes one `warning: ` line per entry to stderr, unless the program is quiet.
pub(super) fn warnings(lines: impl IntoIterator<Item = impl Display>) {
    lines.into_iter().for_each(|line| note(&format!("warning: {line}")));
}

/// As [`warnings`], about a file.
pub(super) fn file_warnings(path: &Path, lines: &[String]) {
    warnings(lines.iter().map(|line| format!("{}: {line}", path.display())));
}

/// A failed write is ignored: there is no other place to report it.
fn line_to_stderr(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", without_escapes(line));
}

/// Writes an error and its help to stderr.
pub(super) fn error(failure: &Failure) {
    line_to_stderr(&failure.to_string());
}

/// Whether progress bars are shown: stderr is a terminal and the program is not quiet.
pub(super) fn is_watched() -> bool {
    io::stderr().is_terminal() && !IS_QUIET.load(Ordering::Relaxed)
}
