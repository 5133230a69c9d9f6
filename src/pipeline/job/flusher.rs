use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use cinesplat_files::{FileError, folder_of, start_sync, sync_file, sync_folder};

use super::error::JobError;
use crate::pipeline::panic_point::panic_point;

/// Time between two flushes: the most work that a loss of power takes.
const INTERVAL: Duration = Duration::from_secs(1);

/// Flushes finished frames to the disk on a thread of its own, all of a second at once: waiting for the disk after every
/// frame would cost up to a third of a film's time.
pub(super) struct Flusher {
    log: PathBuf,
    sender: Option<Sender<PathBuf>>,
    thread: Option<JoinHandle<Result<(), FileError>>>,
    is_abandoned: Arc<AtomicBool>,
}

impl Flusher {
    /// `log` is flushed after the frames that it lists.
    pub(super) fn start(log: PathBuf) -> Self {
        let (sender, receiver) = channel();
        let is_abandoned = Arc::new(AtomicBool::new(false));
        let (path, abandoned) = (log.clone(), Arc::clone(&is_abandoned));
        let thread = thread::spawn(move || run(&receiver, &path, &abandoned));
        Self { log, sender: Some(sender), thread: Some(thread), is_abandoned }
    }

    /// Takes a file that has its final name.
    ///
    /// # Errors
    /// The error of an earlier flush.
    pub(super) fn add(&mut self, path: PathBuf) -> Result<(), JobError> {
        match self.sender.as_ref().map(|sender| sender.send(path)) {
            Some(Ok(())) => Ok(()),
            _ => self.finish().and(Err(JobError::Flushing { path: self.log.clone() })),
        }
    }

    /// Flushes what is left and ends the thread.
    ///
    /// # Errors
    /// [`JobError::File`]; [`JobError::Flushing`] if the thread panicked.
    pub(super) fn finish(&mut self) -> Result<(), JobError> {
        self.sender = None;
        let Some(thread) = self.thread.take() else { return Ok(()) };
        match thread.join() {
            Ok(flushed) => Ok(flushed?),
            Err(_) => Err(JobError::Flushing { path: self.log.clone() }),
        }
    }

    /// Ends the thread; what is not on the disk yet is not needed any more.
    pub(super) fn abandon(&mut self) {
        self.is_abandoned.store(true, Ordering::Relaxed);
        // The frames are about to be removed, so their errors do not matter.
        let _ = self.finish();
    }
}

impl Drop for Flusher {
    fn drop(&mut self) {
        // The caller that wants the error calls `finish` itself.
        let _ = self.finish();
    }
}

fn run(receiver: &Receiver<PathBuf>, log: &Path, is_abandoned: &AtomicBool) -> Result<(), FileError> {
    while let Ok(first) = receiver.recv() {
        let (mut paths, start) = (vec![first], Instant::now());
        while let Ok(path) = receiver.recv_timeout(INTERVAL.saturating_sub(start.elapsed())) {
            paths.push(path);
        }
        panic_point("flush", 0);
        paths.iter().for_each(|path| start_sync(path));
        for path in &paths {
            // The program waits for this thread: what nobody needs any more must not keep it.
            if is_abandoned.load(Ordering::Relaxed) {
                return Ok(());
            }
            sync_file(path)?;
        }
        sync_folder(folder_of(&paths[0]))?;
        sync_file(log)?;
    }
    Ok(())
}
