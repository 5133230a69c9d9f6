//! The three files of a trained network, one after the other, each behind its length as 4 bytes: description, vocabulary, weights.
//! The hashes of the description are set to those of the other two, so that more than the hash is tried.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_director::{Director, ModelFiles};
use cinesplat_files::sha256_hex;
use libfuzzer_sys::fuzz_target;

/// The next part of the input, and what follows it.
fn part(input: &[u8]) -> (&[u8], &[u8]) {
    let Some((length, rest)) = input.split_first_chunk::<4>() else { return (&[], &[]) };
    rest.split_at(rest.len().min(u32::from_le_bytes(*length) as usize))
}

/// The description with the hashes of these files, or as it is where it is no JSON object.
fn with_hashes(description: &[u8], files: [(&str, &[u8]); 2]) -> Vec<u8> {
    let Ok(mut json) = serde_json::from_slice::<serde_json::Value>(description) else { return description.to_vec() };
    if let Some(object) = json.as_object_mut() {
        object.extend(files.map(|(key, bytes)| (key.to_owned(), sha256_hex(bytes).into())));
    }
    json.to_string().into_bytes()
}

fuzz_target!(|input: &[u8]| {
    let (description, rest) = part(input);
    let (vocabulary, rest) = part(rest);
    let (weights, _) = part(rest);
    let description = with_hashes(description, [("weights_sha256", weights), ("tokenizer_sha256", vocabulary)]);
    let folder = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-model-{}", std::process::id()));
    let _ = fs::create_dir_all(&folder);
    let files =
        [("director.json", &*description), ("director.tokenizer.json", vocabulary), ("director.safetensors", weights)];
    if files.iter().all(|(name, bytes)| fs::write(folder.join(name), bytes).is_ok())
        && let Ok(files) = ModelFiles::read(&folder)
    {
        let _ = (files.is_current(), files.config(), files.vocabulary(), files.tensors());
        let _ = Director::from_files(&files);
    }
});
