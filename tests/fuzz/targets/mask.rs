//! Masks: PNG files of ids.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_objects::read_mask;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let path = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-mask-{}.png", std::process::id()));
    if fs::write(&path, bytes).is_ok()
        && let Ok((width, height, ids)) = read_mask(&path)
    {
        assert_eq!(ids.len() as u64, u64::from(width) * u64::from(height));
    }
});
