use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::console;
use super::failure::Failure;

/// Counts Ctrl-C: the first requests a stop after the current step, the second ends the program at once.
#[derive(Debug, Clone, Default)]
pub(super) struct Interrupt {
    count: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Handles Ctrl-C, SIGTERM and SIGHUP for the rest of the program.
    pub(super) fn listen() -> Result<Self, Failure> {
        let interrupt = Self::default();
        let count = Arc::clone(&interrupt.count);
        let listening = ctrlc::set_handler(move || {
            if count.fetch_add(1, Ordering::SeqCst) == 0 {
                console::note("stopping after the current step; Ctrl-C again stops at once");
            } else {
                std::process::exit(130);
            }
        });
        listening.map_err(|error| Failure::fault(&error.to_string()))?;
        Ok(interrupt)
    }

    /// Whether a stop was requested.
    pub(super) fn is_asked(&self) -> bool {
        self.count.load(Ordering::SeqCst) > 0
    }
}
