//! Large files that are written once and seldom read, past the system's cache of files.
//!
//! Such a file costs the system pages of its cache that it has to find, fill, write and free again, which takes more
//! time than the bytes themselves. Where the system allows it, whole blocks go to the disk directly.

use std::fs::File;
use std::io::{self, Write};

/// Bytes that the place and the length of a direct write are multiples of: a page.
const BLOCK: usize = 4096;

/// Collects the parts of a file and writes them past the cache. Its memory serves all files.
#[derive(Debug, Default)]
pub struct PastCache {
    /// The file's bytes, from the first aligned one on.
    bytes: Vec<u8>,
    /// Whether the disk refuses direct writes.
    is_refused: bool,
}

impl PastCache {
    /// Writes `parts` one after another to a new file. Where the disk refuses direct writes they go through the cache.
    ///
    /// # Errors
    /// Those of the writes.
    pub fn write(&mut self, mut file: &File, parts: &[&[u8]]) -> io::Result<()> {
        let len: usize = parts.iter().map(|part| part.len()).sum();
        let blocks = len - len % BLOCK;
        if self.is_refused || blocks == 0 || !set_direct(file, true) {
            return parts.iter().try_for_each(|part| file.write_all(part));
        }
        let first = self.collect(parts, len);
        let mut done = 0;
        while done < blocks {
            match file.write(&self.bytes[first + done..first + blocks]) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(written) if written % BLOCK == 0 => done += written,
                // A part of a block is written: the rest is not aligned any more.
                Ok(written) => {
                    done += written;
                    break;
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) if error.kind() == io::ErrorKind::InvalidInput => {
                    self.is_refused = true;
                    break;
                }
                Err(error) => return Err(error),
            }
        }
        set_direct(file, false);
        file.write_all(&self.bytes[first + done..first + len])
    }

    /// Copies the parts to memory that begins at a multiple of a block; the index of its first byte.
    fn collect(&mut self, parts: &[&[u8]], len: usize) -> usize {
        self.bytes.resize(len + BLOCK, 0);
        let first = self.bytes.as_ptr().align_offset(BLOCK).min(BLOCK);
        let mut at = first;
        for part in parts {
            self.bytes[at..at + part.len()].copy_from_slice(part);
            at += part.len();
        }
        first
    }
}

/// File systems of disks of this machine. Elsewhere, as on a network, a direct write waits for longer than it saves.
#[cfg(target_os = "linux")]
const DISKS: [i64; 3] = [0xEF53 /* ext */, 0x5846_5342 /* XFS */, 0x9123_683E /* Btrfs */];

/// Sends the writes to a file past the cache from now on, or through it; whether the system agrees.
#[cfg(target_os = "linux")]
#[allow(clippy::unnecessary_cast, reason = "the type of the number differs between processors")]
fn set_direct(file: &File, is_direct: bool) -> bool {
    use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl, fstatfs};
    let is_disk = || fstatfs(file).is_ok_and(|found| DISKS.contains(&(found.f_type as i64)));
    if is_direct && !is_disk() {
        return false;
    }
    let changed = |flags: OFlags| {
        let flags = if is_direct { flags | OFlags::DIRECT } else { flags - OFlags::DIRECT };
        fcntl_setfl(file, flags)
    };
    fcntl_getfl(file).and_then(changed).is_ok()
}

#[cfg(not(target_os = "linux"))]
fn set_direct(_file: &File, _is_direct: bool) -> bool {
    false
}
