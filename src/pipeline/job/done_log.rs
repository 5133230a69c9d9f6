use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use cinesplat_files::{FileError, has_no_locks};

use super::frame_files::{FrameFiles, Kept};

/// The append-only list of finished frames: one line `NUMBER CHECKSUM` per frame, the checksum as 16 hexadecimal digits.
/// The last line of a frame counts. Lines that are torn or of another form are skipped.
pub(super) struct DoneLog {
    path: PathBuf,
    file: File,
    checksums: BTreeMap<usize, u64>,
    /// Bytes of the file that were read or written by this program, up to the end of a line.
    num_read: u64,
}

impl DoneLog {
    /// Opens or creates the log of a folder.
    pub(super) fn open(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join("done.log");
        let opened = File::options().create(true).append(true).read(true).open(&path);
        let file = opened.map_err(|source| FileError::Create { path: path.clone(), source })?;
        let mut log = Self { path, file, checksums: BTreeMap::new(), num_read: 0 };
        if log.refresh()? {
            // The next line must not continue a torn one.
            log.write("\n")?;
        }
        Ok(log)
    }

    /// The frames that the log of a folder lists; none without a log.
    pub(super) fn listed(folder: &Path) -> BTreeSet<usize> {
        let text = std::fs::read(folder.join("done.log")).unwrap_or_default();
        text.split(|byte| *byte == b'\n').filter_map(parse).map(|(frame_idx, _)| frame_idx).collect()
    }

    /// Adds the lines of other programs. Returns whether the file ends within a line.
    pub(super) fn refresh(&mut self) -> Result<bool, FileError> {
        let mut text = Vec::new();
        let read = self.file.seek(SeekFrom::Start(self.num_read)).and_then(|_| self.file.read_to_end(&mut text));
        read.map_err(|source| FileError::Read { path: self.path.clone(), source })?;
        let whole = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        self.checksums.extend(text[..whole].split(|byte| *byte == b'\n').filter_map(parse));
        self.num_read += whole as u64;
        Ok(whole < text.len())
    }

    /// Appends a line.
    pub(super) fn append(&mut self, frame_idx: usize, checksum: u64) -> Result<(), FileError> {
        self.write(&format!("{frame_idx} {checksum:016x}\n"))?;
        self.checksums.insert(frame_idx, checksum);
        Ok(())
    }

    /// The frames that it lists.
    pub(super) fn kept(&self, files: &FrameFiles) -> Kept {
        Kept::new(self.checksums.clone(), files.clone())
    }

    /// Number of frames that it lists.
    pub(super) fn num_listed(&self) -> usize {
        self.checksums.len()
    }

    /// The checksum that it lists for a frame.
    pub(super) fn checksum(&self, frame_idx: usize) -> Option<u64> {
        self.checksums.get(&frame_idx).copied()
    }

    /// Whether it lists a frame.
    pub(super) fn lists(&self, frame_idx: usize) -> bool {
        self.checksums.contains_key(&frame_idx)
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The lock keeps the lines of several machines apart where appending is not one step, as on NFS.
    fn write(&mut self, text: &str) -> Result<(), FileError> {
        let allowed = |locked: io::Result<()>| match locked {
            // On a shared disk without locks a line may be torn: that frame is rendered again.
            Err(error) if has_no_locks(&error) => Ok(()),
            other => other,
        };
        let written = allowed(self.file.lock()).and_then(|()| {
            let written = self.file.write_all(text.as_bytes());
            allowed(self.file.unlock()).and(written)
        });
        written.map_err(|source: io::Error| FileError::Write { path: self.path.clone(), source })
    }
}

fn parse(line: &[u8]) -> Option<(usize, u64)> {
    let (number, checksum) = std::str::from_utf8(line).ok()?.split_once(' ')?;
    let is_whole = checksum.len() == 16;
    Some((number.parse().ok()?, u64::from_str_radix(checksum, 16).ok().filter(|_| is_whole)?))
}
