//! Faults of the program itself, caught at its edge: two lines for people, and a file for who mends them.
//!
//! A panic of any thread is a fault, even one that nothing else noticed: it is never a success.

use std::backtrace::Backtrace;
use std::fmt::Write as _;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::failure::{Exit, Failure};
use super::reproduce;
use cinesplat::files::{self, Existing};
use cinesplat::pipeline;

/// What the standard library ("failed to spawn thread"), candle ("failed to spawn candle barrier pool worker") and rayon say
/// where the system refuses a thread: none of them returns it as an error everywhere.
const NO_THREADS: [&str; 2] = ["failed to spawn", "global thread pool has not been initialized"];

/// The first panic.
struct Panicked {
    /// Place in the code and message, on one line.
    place: String,
    thread: String,
    backtrace: String,
}

impl Panicked {
    fn of(panic: &PanicHookInfo<'_>) -> Self {
        Self {
            place: panic.to_string().replace('\n', " "),
            thread: std::thread::current().name().unwrap_or("without a name").to_owned(),
            backtrace: Backtrace::force_capture().to_string(),
        }
    }
}

/// Runs `work`. A fault becomes a [`Failure`] that names a report file, and the line that goes on where frames of the film
/// `output` are kept.
pub(super) fn catch(work: impl FnOnce() -> Result<(), Failure>, output: Option<&Path>) -> Result<(), Failure> {
    let first = Arc::new(Mutex::new(None));
    let seen = Arc::clone(&first);
    panic::set_hook(Box::new(move |panic| {
        if let Ok(mut first) = seen.lock() {
            first.get_or_insert_with(|| Panicked::of(panic));
        }
    }));
    let ended = panic::catch_unwind(AssertUnwindSafe(work));
    drop(panic::take_hook());
    let panicked = first.lock().ok().and_then(|mut first| first.take());
    let failure = match (ended, &panicked) {
        (Ok(Ok(())), None) => return Ok(()),
        (Ok(Err(failure)), _) if failure.exit() != Exit::Fault => return Err(failure),
        (Ok(Err(failure)), None) => failure,
        (_, Some(panicked)) if NO_THREADS.iter().any(|said| panicked.place.contains(said)) => {
            return Err(Failure::no_threads());
        }
        (_, Some(panicked)) => Failure::fault(&panicked.place),
        (Err(_), None) => Failure::fault("a panic at an unknown place"),
    };
    let failure = match write_report(&failure, panicked.as_ref()) {
        Some(report) => failure.with_report(&report),
        None => failure,
    };
    Err(match output.filter(|output| pipeline::has_job(output)) {
        Some(_) => failure.with_further_help(&format!(
            "finished frames are kept, this goes on from them: {}",
            reproduce::line_to_go_on()
        )),
        None => failure,
    })
}

/// Writes the report into the system's temporary folder; `None` where that is not possible.
fn write_report(failure: &Failure, panicked: Option<&Panicked>) -> Option<PathBuf> {
    let path = std::env::temp_dir().join(format!("cinesplat-fault-{}.txt", std::process::id()));
    let mut text = format!(
        "cinesplat {}\nsystem: {} {}, {} cores\ncommand: {}\n{failure}\n",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::OS,
        std::env::consts::ARCH,
        pipeline::num_cores(),
        reproduce::line_to_go_on()
    );
    if let Some(Panicked { place, thread, backtrace }) = panicked {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "place: {place}\nthread: {thread}\n{backtrace}");
    }
    files::write(&path, text.as_bytes(), Existing::Replace).ok()?;
    Some(path)
}
