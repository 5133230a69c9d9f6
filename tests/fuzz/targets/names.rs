//! The two files of the network of names, one after the other: the description behind its length as 4 bytes, then the weights.
//! The hash of the description is set to that of the weights, so that more than the hash is tried.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_director::{Names, NamesFiles};
use cinesplat_files::sha256_hex;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: &[u8]| {
    let Some((length, rest)) = input.split_first_chunk::<4>() else { return };
    let (description, weights) = rest.split_at(rest.len().min(u32::from_le_bytes(*length) as usize));
    let mut description = description.to_vec();
    if let Ok(serde_json::Value::Object(mut object)) = serde_json::from_slice(&description) {
        object.insert("weights_sha256".to_owned(), sha256_hex(weights).into());
        description = serde_json::Value::Object(object).to_string().into_bytes();
    }
    let folder = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-names-{}", std::process::id()));
    let _ = fs::create_dir_all(&folder);
    let files = [("names.json", &*description), ("names.safetensors", weights)];
    if files.iter().all(|(name, bytes)| fs::write(folder.join(name), bytes).is_ok())
        && let Ok(files) = NamesFiles::read(&folder)
    {
        let _ = files.tensors();
        let _ = Names::from_files(&files);
    }
});
