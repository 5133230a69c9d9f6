//! Scenes of every format. The first byte names the extension; the rest is the file.
#![no_main]

use std::path::Path;

use cinesplat_scene::{Limits, LoadOptions, load_bytes};
use libfuzzer_sys::fuzz_target;

const NAMES: [&str; 4] = ["/dev/null/a.ply", "/dev/null/a.splat", "/dev/null/a.spz", "/dev/null/meta.json"];

fuzz_target!(|input: &[u8]| {
    let Some((first, bytes)) = input.split_first() else { return };
    let limits = Limits { memory_bytes: 256 << 20, ..Limits::DEFAULT };
    // An error is as good as a scene; only a panic, a hang or too much memory is not.
    let _ = load_bytes(Path::new(NAMES[usize::from(*first) % 4]), bytes, &LoadOptions { up: None, limits });
});
