use std::fs::File;
use std::hash::Hasher;
use std::io::{self, Read};
use std::path::Path;

use sha2::{Digest, Sha256};
use twox_hash::XxHash64;

/// SHA-256 of bytes as 64 lower-case hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::with_capacity(64), |hex, byte| hex + &format!("{byte:02x}"))
}

/// XXH64 of the concatenated parts. It detects damage, at several gigabytes per second; it is no protection against
/// forgery, as [`sha256_hex`] is.
pub fn checksum(parts: &[&[u8]]) -> u64 {
    let mut hasher = XxHash64::with_seed(0);
    parts.iter().for_each(|part| hasher.write(part));
    hasher.finish()
}

/// XXH64 of a file's bytes, of which one part at a time is in memory.
///
/// # Errors
/// Those of opening and reading the file.
pub fn file_checksum(path: &Path) -> io::Result<u64> {
    let (mut file, mut part, mut hasher) = (File::open(path)?, vec![0; 1 << 18], XxHash64::with_seed(0));
    loop {
        match file.read(&mut part) {
            Ok(0) => return Ok(hasher.finish()),
            Ok(num_bytes) => hasher.write(&part[..num_bytes]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}
