//! File output, `NumPy` arrays, hashes and relative paths for every stage.
//!
//! Enters: bytes and paths. Leaves: files that are complete or absent ([`NewFile`], [`write()`]), arrays for `NumPy`
//! ([`npy`]), base64, hashes, relative paths, warnings of unknown keys, the limits of every reader ([`Limits`]) and
//! those of a container. The one invariant: no file is replaced unless the caller passes [`Existing::Replace`].

pub mod base64;
mod disk;
mod error;
mod group_memory;
mod hash;
mod json;
mod limits;
mod moved;
mod new_file;
pub mod npy;
mod open_files;
mod past_cache;
mod paths;
mod probe;
mod read;
mod unknown_keys;

pub use disk::{free_bytes, has_no_locks, start_sync, sync_file, sync_folder};
pub use error::FileError;
pub use group_memory::{group_memory_left, group_memory_max};
pub use hash::{checksum, file_checksum, sha256_hex};
pub use json::json_excess;
pub use limits::Limits;
pub use moved::move_file;
pub use new_file::{Existing, NewFile, check_free, create_folder, holds, write};
pub use open_files::remove_open_files;
pub use past_cache::PastCache;
pub use paths::{beside, folder_of, is_same_file, relative_to};
pub use probe::{end_probes, probe};
pub use read::read;
pub use unknown_keys::{UnknownKeys, edits_between, misspelling};
