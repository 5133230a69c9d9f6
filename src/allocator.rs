//! The allocator of the program: mimalloc, bounded by `--max-memory`, and with an orderly end where memory runs out.
//!
//! Enters: requests for memory. Leaves: memory, or the end of the program with exit code 71 and two lines on stderr, where
//! Rust would abort. Nothing finished is lost by it: files get their names last, and finished frames of films are in their
//! job folder. Under a limit on address space (`ulimit -v`) the system's allocator serves instead, because mimalloc takes a
//! gigabyte of addresses in advance, and FFmpeg's libraries would be left without.
#![allow(unsafe_code, reason = "an allocator cannot be written without: every call passes its layout on unchanged")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::fmt::{self, Write as _};
use std::io::Write as _;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU8, AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::Duration;

use cinesplat::files::remove_open_files;
use mimalloc::MiMalloc;

/// Exit code of a program that needs more memory than it may take.
const OVER_CAP: i32 = 71;

/// Which allocator serves: decided by the first request, because memory must go back to where it came from.
const UNDECIDED: u8 = 0;
const FAST: u8 = 1;
const SYSTEM: u8 = 2;
static CHOICE: AtomicU8 = AtomicU8::new(UNDECIDED);

/// Bytes that may be held while a cap is set; 0 = no cap.
static CAP_BYTES: AtomicU64 = AtomicU64::new(0);
/// Bytes that were requested and not given back since the cap was set.
static HELD_BYTES: AtomicI64 = AtomicI64::new(0);

/// The allocator; all instances are one.
pub(crate) struct BoundedAllocator;

/// Bounds the memory that is held beyond what is held now.
pub(crate) fn set_cap(bytes: u64) {
    CAP_BYTES.store(bytes.max(1), Relaxed);
}

/// Bytes that may still be requested; `None` without a cap.
pub(crate) fn left_bytes() -> Option<u64> {
    let cap = CAP_BYTES.load(Relaxed);
    (cap > 0).then(|| cap.saturating_add_signed(HELD_BYTES.load(Relaxed).saturating_neg()).min(cap))
}

// Each method passes its arguments on as it got them, and the allocator that made a block gets it back: the choice
// between the two never changes.
unsafe impl GlobalAlloc for BoundedAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        take(layout.size());
        let block = unsafe { if is_fast() { MiMalloc.alloc(layout) } else { System.alloc(layout) } };
        checked(block, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        take(layout.size());
        let block = unsafe { if is_fast() { MiMalloc.alloc_zeroed(layout) } else { System.alloc_zeroed(layout) } };
        checked(block, layout.size())
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        give_back(layout.size());
        unsafe { if is_fast() { MiMalloc.dealloc(block, layout) } else { System.dealloc(block, layout) } }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // What a block grows by, not both blocks: while bytes are moved, the new block's end is untouched yet.
        match size.checked_sub(layout.size()) {
            Some(more) => take(more),
            None => give_back(layout.size() - size),
        }
        let moved = unsafe {
            if is_fast() { MiMalloc.realloc(block, layout, size) } else { System.realloc(block, layout, size) }
        };
        checked(moved, size)
    }
}

fn is_fast() -> bool {
    match CHOICE.load(Relaxed) {
        UNDECIDED => choose(),
        choice => choice == FAST,
    }
}

/// Decides which allocator serves; two threads that decide at once agree.
#[cold]
fn choose() -> bool {
    let is_fast = !has_address_limit();
    CHOICE.store(if is_fast { FAST } else { SYSTEM }, Relaxed);
    is_fast
}

#[cfg(unix)]
fn has_address_limit() -> bool {
    use nix::sys::resource::{RLIM_INFINITY, Resource, getrlimit};
    getrlimit(Resource::RLIMIT_AS).is_ok_and(|(soft, _)| soft != RLIM_INFINITY)
}

#[cfg(not(unix))]
fn has_address_limit() -> bool {
    false
}

/// Counts a request, and ends the program where it exceeds the cap.
fn take(bytes: usize) {
    let cap = CAP_BYTES.load(Relaxed);
    if cap > 0 {
        let held = HELD_BYTES.fetch_add(bytes as i64, Relaxed).saturating_add(bytes as i64);
        if held > cap.cast_signed() {
            end(bytes);
        }
    }
}

fn give_back(bytes: usize) {
    if CAP_BYTES.load(Relaxed) > 0 {
        HELD_BYTES.fetch_sub(bytes as i64, Relaxed);
    }
}

fn checked(block: *mut u8, bytes: usize) -> *mut u8 {
    if block.is_null() && bytes > 0 {
        end(bytes);
    }
    block
}

/// Whether the program is being ended.
static IS_ENDING: AtomicBool = AtomicBool::new(false);
/// Time that the thread which ends the program has for it.
const TIME_TO_END: Duration = Duration::from_millis(500);

thread_local! {
    /// Whether this thread is the one that ends the program.
    static ENDS: Cell<bool> = const { Cell::new(false) };
}

/// Ends the program: says so, and removes the temporary files that are being written. Next to nothing here allocates.
#[cold]
fn end(bytes: usize) -> ! {
    // The report itself must not be bounded.
    CAP_BYTES.store(0, Relaxed);
    if IS_ENDING.swap(true, Relaxed) {
        // It is being said already: by another thread, or by this one where the system refuses even that.
        if !ENDS.get() {
            thread::sleep(TIME_TO_END);
        }
        leave(OVER_CAP);
    }
    ENDS.set(true);
    let mut text = ShortText { bytes: [0; 320], len: 0 };
    // What does not fit is cut off.
    let _ = write!(
        text,
        "error[MEM-CAP]: {} MB more memory are needed, expected to stay within --max-memory and the system's limits\n\
         help: raise --max-memory, and the limit of the shell (ulimit -v) where that is lower, or take smaller pictures and fewer threads\n",
        bytes.div_ceil(1 << 20)
    );
    // There is no other place to report a failed report.
    let _ = std::io::stderr().write_all(&text.bytes[..text.len]);
    remove_open_files();
    leave(OVER_CAP)
}

/// Ends the program with this exit code, without the handlers that libraries registered for its end: mimalloc's frees what
/// it could not take where the limit on address space is lower than its tables, and would end the program by a signal.
/// Nothing is lost by that: all files are written by now, and streams are flushed as they are written.
pub(crate) fn leave(code: i32) -> ! {
    #[cfg(unix)]
    // It takes a number and touches no memory of the program.
    unsafe {
        nix::libc::_exit(code)
    }
    #[cfg(not(unix))]
    std::process::exit(code)
}

/// A text on the stack.
struct ShortText {
    bytes: [u8; 320],
    len: usize,
}

impl fmt::Write for ShortText {
    fn write_str(&mut self, part: &str) -> fmt::Result {
        let len = part.len().min(self.bytes.len() - self.len);
        self.bytes[self.len..self.len + len].copy_from_slice(&part.as_bytes()[..len]);
        self.len += len;
        Ok(())
    }
}
