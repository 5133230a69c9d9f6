use std::fmt;
use std::io::{self, ErrorKind};
use std::path::Path;

use cinesplat::trajectory::ReportLine;

use super::exit::Exit;

/// A failed command: the two lines that a person reads and the exit code that a script sees.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Failure {
    code: String,
    message: String,
    help: String,
    exit: Exit,
}

/// Code of work that the user stopped.
const STOPPED: &str = "STOPPED";

/// What to do where memory is short.
pub(super) const MORE_MEMORY: &str = "raise --max-memory, and the limit of the shell (ulimit -v) where that is lower, or take smaller pictures and fewer threads";

impl Failure {
    /// A failure with a stable `code`. `message` is `FILE: found, expected`, without `FILE` where no file is at fault;
    /// `help` says what to do about it.
    pub(crate) fn new(code: &str, message: impl Into<String>, help: impl Into<String>, exit: Exit) -> Self {
        Self { code: code.to_owned(), message: message.into(), help: help.into(), exit }
    }

    /// Arguments that contradict each other or the input.
    pub(crate) fn usage(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new("USAGE", message, help, Exit::Usage)
    }

    /// A fault of this program at `place`, which is for its developers.
    pub(crate) fn fault(place: &str) -> Self {
        let help = "this is a fault of cinesplat, not yours: please report it with the command and the file";
        Self::new("FAULT", format!("cinesplat itself failed: {place}"), help, Exit::Fault)
    }

    /// More memory than there is: `needed` bytes where `left` are left.
    pub(crate) fn over_memory(what: &str, needed: u64, left: u64) -> Self {
        let found = format!("{what} takes about {} MB of memory, expected at most {} MB", needed >> 20, left >> 20);
        Self::new("MEM-CAP", found, MORE_MEMORY, Exit::OverCap)
    }

    /// Threads that the system refuses: their stacks take memory.
    pub(crate) fn no_threads() -> Self {
        let found = "the system refuses more threads, expected one per core";
        Self::new(
            "THREADS",
            found,
            format!("take fewer with --threads or RAYON_NUM_THREADS, or {MORE_MEMORY}"),
            Exit::OverCap,
        )
    }

    /// A fault with the file that tells its developers more.
    pub(crate) fn with_report(self, report: &Path) -> Self {
        let help =
            format!("this is a fault of cinesplat, not yours: please report it with the file {}", report.display());
        Self { help, ..self }
    }

    /// Work that the user stopped: `found` says how far it came, `help` how it goes on.
    pub(crate) fn stopped(found: impl Into<String>, help: impl Into<String>) -> Self {
        Self::new(STOPPED, found, help, Exit::Stopped)
    }

    /// A line of a shot's report that is not met, where the user wants all of them met.
    pub(crate) fn not_met(line: &ReportLine) -> Self {
        let found = if line.note.is_empty() { format!("got {:.3}", line.got) } else { line.note.clone() };
        let message = format!("\"{}\": {found}, expected {}", line.clause, line.wanted);
        Self::new("PROMPT-NOT-MET", message, "reword the clause, or plan without --strict", Exit::BadData)
    }

    /// An error of the file system on `file`.
    pub(crate) fn io(file: &str, error: &io::Error) -> Self {
        let (code, help) = match error.kind() {
            ErrorKind::NotFound => ("NOT-FOUND", "check the path"),
            ErrorKind::PermissionDenied => ("PERMISSION", "change the permissions, or choose another place"),
            _ => ("IO", "check free space and the disk, then try again"),
        };
        Self::new(code, format!("{file}: {error}"), help, Exit::of_read(error))
    }

    /// The same failure with `path` at the front of the message, unless the message names it already.
    pub(crate) fn in_file(mut self, path: &Path) -> Self {
        let file = path.display().to_string();
        if !self.message.contains(&file) {
            self.message = format!("{file}: {}", self.message);
        }
        self
    }

    /// The same failure with more help.
    pub(crate) fn with_further_help(mut self, further: &str) -> Self {
        self.help = format!("{}; {further}", self.help);
        self
    }

    /// Whether the user stopped the work.
    pub(crate) fn is_stop(&self) -> bool {
        self.code == STOPPED
    }

    /// The kind of failure.
    pub(crate) fn exit(&self) -> Exit {
        self.exit
    }

    /// Exit code of the program.
    pub(crate) fn exit_code(&self) -> u8 {
        self.exit as u8
    }
}

impl fmt::Display for Failure {
    /// Exactly two lines: line ends inside the texts become spaces.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let one_line = |text: &str| text.split('\n').map(str::trim).collect::<Vec<_>>().join(" ");
        write!(f, "error[{}]: {}\nhelp: {}", self.code, one_line(&self.message), one_line(&self.help))
    }
}
