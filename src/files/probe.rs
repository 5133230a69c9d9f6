//! Checks that make something for a moment, such as a folder to see whether it can be made: a program that is stopped ends
//! after them, so that nothing of them stays.

use std::sync::{Mutex, PoisonError, TryLockError};
use std::thread;
use std::time::Duration;

static PROBING: Mutex<()> = Mutex::new(());

/// Time between two looks at whether a check is over, and their number: a disk may not answer.
const LOOK_TIME: Duration = Duration::from_millis(2);
const NUM_LOOKS: usize = 500;

/// The result of a check that takes back what it makes.
pub fn probe<T>(check: impl FnOnce() -> T) -> T {
    let _running = PROBING.lock().unwrap_or_else(PoisonError::into_inner);
    check()
}

/// Waits until no check runs, at most a second, and lets no other begin. Call it only right before the program ends.
pub fn end_probes() {
    for _ in 0..NUM_LOOKS {
        match PROBING.try_lock() {
            Err(TryLockError::WouldBlock) => thread::sleep(LOOK_TIME),
            Err(TryLockError::Poisoned(last)) => return std::mem::forget(last.into_inner()),
            Ok(last) => return std::mem::forget(last),
        }
    }
}
