use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use crate::cli::console;
use crate::cli::interrupt::Interrupt;
use cinesplat::pipeline;

/// Time between two looks at Ctrl-C.
const TICK: Duration = Duration::from_millis(50);
/// Time between two looks at the lock of a job folder.
const PAUSE: Duration = Duration::from_secs(1);

/// How the programs ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ended {
    /// The film can be made here.
    Done,
    /// By a stop.
    Stopped,
    /// Another program makes the film.
    LeftAlone,
}

/// Waits for programs that are still at work although nobody waits for them any more: those of a farm that was killed, and
/// tasks whose node does not answer. Returns false if a stop was asked for.
pub(super) fn wait_for_lost_programs(output: &Path, interrupt: &Interrupt) -> bool {
    let mut is_said = false;
    while let Err(pipeline::JobError::Locked { .. }) = pipeline::check_job(output) {
        if !is_said {
            console::note("waiting for programs that still work on the frames");
            is_said = true;
        }
        if !pause(PAUSE, interrupt) {
            return false;
        }
    }
    true
}

/// Waits; false if a stop was asked for.
pub(super) fn pause(time: Duration, interrupt: &Interrupt) -> bool {
    let start = Instant::now();
    while start.elapsed() < time && !interrupt.is_asked() {
        thread::sleep(TICK);
    }
    !interrupt.is_asked()
}
