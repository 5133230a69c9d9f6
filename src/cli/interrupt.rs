use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::console;
use super::failure::Failure;
use cinesplat::files::remove_open_files;

/// Makes a write beyond the limit on file sizes (`ulimit -f`) an error instead of the end of the program. Call it before
/// any thread is started.
pub(super) fn survive_file_limit() {
    #[cfg(unix)]
    {
        use nix::sys::signal::{SigSet, Signal};
        // Where this fails, such a write ends the program, as it does without this call.
        let _ = SigSet::from(Signal::SIGXFSZ).thread_block();
    }
}

/// Counts Ctrl-C: the first requests a stop after the current step, the second ends the program at once.
#[derive(Debug, Clone, Default)]
pub(super) struct Interrupt {
    count: Arc<AtomicUsize>,
    is_listening: bool,
}

impl Interrupt {
    /// Handles Ctrl-C, SIGTERM and SIGHUP for the rest of the program.
    pub(super) fn listen() -> Result<Self, Failure> {
        let interrupt = Self { is_listening: true, ..Self::default() };
        let count = Arc::clone(&interrupt.count);
        let listening = ctrlc::set_handler(move || {
            if count.fetch_add(1, Ordering::SeqCst) == 0 {
                console::note("stopping after the current step; Ctrl-C again stops at once");
            } else {
                remove_open_files();
                std::process::exit(130);
            }
        });
        // It listens on a thread of its own.
        listening.map_err(|_| Failure::no_threads())?;
        Ok(interrupt)
    }

    /// This one if it listens already, else a new one that does.
    pub(super) fn listening(self) -> Result<Self, Failure> {
        if self.is_listening { Ok(self) } else { Self::listen() }
    }

    /// Whether a stop was requested.
    pub(super) fn is_asked(&self) -> bool {
        self.count.load(Ordering::SeqCst) > 0
    }
}
