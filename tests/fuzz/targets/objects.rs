//! Objects files: the text, or behind a first byte of 255 a clouds file that a fixed text names.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_objects::read_boxes;
use libfuzzer_sys::fuzz_target;

const NAMES_CLOUDS: &str = r#"{"format":"cinesplat.objects","version":1,"clouds":"c.safetensors",
    "objects":[{"id":1,"label":"a","center":[0,0,0],"half_extents":[1,1,1]}]}"#;

fuzz_target!(|input: &[u8]| {
    let folder = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-objects-{}", std::process::id()));
    let _ = fs::create_dir_all(&folder);
    let (text, clouds) = match input.split_first() {
        Some((255, clouds)) => (NAMES_CLOUDS.as_bytes(), Some(clouds)),
        _ => (input, None),
    };
    let path = folder.join("objects.json");
    let written = fs::write(&path, text).and_then(|()| clouds.map_or(Ok(()), |clouds| fs::write(folder.join("c.safetensors"), clouds)));
    if written.is_ok() {
        let _ = read_boxes(&path);
    }
});
