use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::failure::Failure;
use super::{console, member, reproduce};
use crate::allocator;
use cinesplat::files::{end_probes, remove_open_files};

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

/// Counts Ctrl-C: the first requests a stop after the current step, the second ends the program at once. Before the work that
/// can be stopped is begun, the first one ends the program.
#[derive(Debug, Clone)]
pub(super) struct Interrupt {
    count: Arc<AtomicUsize>,
    is_begun: Arc<AtomicBool>,
}

impl Interrupt {
    /// Handles Ctrl-C, SIGTERM and SIGHUP for the rest of the program.
    pub(super) fn listen() -> Result<Self, Failure> {
        Ok(Self::before_work("")?.begun())
    }

    /// As [`Interrupt::listen`], before the work that can be stopped is begun: until [`Interrupt::begun`] Ctrl-C ends the
    /// program, which says `how_far` it came.
    pub(super) fn before_work(how_far: &'static str) -> Result<Self, Failure> {
        let interrupt = Self { count: Arc::default(), is_begun: Arc::default() };
        let (count, is_begun) = (Arc::clone(&interrupt.count), Arc::clone(&interrupt.is_begun));
        let listening = ctrlc::set_handler(move || {
            if !is_begun.load(Ordering::SeqCst) {
                end_probes();
                let stopped = Failure::stopped(how_far, format!("to start again, type: {}", reproduce::line()));
                member::report(&stopped);
                remove_open_files();
                allocator::leave(stopped.exit_code().into());
            } else if count.fetch_add(1, Ordering::SeqCst) == 0 {
                console::note("stopping after the current step; Ctrl-C again stops at once");
            } else {
                remove_open_files();
                allocator::leave(130);
            }
        });
        // It listens on a thread of its own.
        listening.map_err(|_| Failure::no_threads())?;
        Ok(interrupt)
    }

    /// The same, from here on for work that finishes its step.
    pub(super) fn begun(self) -> Self {
        self.is_begun.store(true, Ordering::SeqCst);
        self
    }

    /// Whether a stop was requested.
    pub(super) fn is_asked(&self) -> bool {
        self.count.load(Ordering::SeqCst) > 0
    }
}
