//! Camera paths of every format. The first byte chooses the format, 0 leaves it to the content; the rest is the file.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_export::{Format, read};
use libfuzzer_sys::fuzz_target;

const FORMATS: [Option<Format>; 12] = [
    None,
    Some(Format::Tum),
    Some(Format::Kitti),
    Some(Format::Euroc),
    Some(Format::Nerfstudio),
    Some(Format::Transforms),
    Some(Format::Colmap),
    Some(Format::Supersplat),
    Some(Format::Lichtfeld),
    Some(Format::Gltf),
    Some(Format::Usd),
    Some(Format::Blender),
];

fuzz_target!(|input: &[u8]| {
    let Some((first, bytes)) = input.split_first() else { return };
    let extension = if first & 128 == 0 { "txt" } else { "bin" };
    let path = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-{}.{extension}", std::process::id()));
    if fs::write(&path, bytes).is_ok() {
        let _ = read(&path, FORMATS[usize::from(first & 127) % 12]);
    }
});
