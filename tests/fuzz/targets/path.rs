//! Camera paths of every format. The first byte chooses the format, 0 leaves it to the content; the rest is the file.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_export::{Format, read};
use libfuzzer_sys::fuzz_target;
use strum::VariantArray;

fuzz_target!(|input: &[u8]| {
    let Some((first, bytes)) = input.split_first() else { return };
    let number = usize::from(first & 127) % (Format::VARIANTS.len() + 1);
    let format = number.checked_sub(1).map(|idx| Format::VARIANTS[idx]);
    let extension = if first & 128 == 0 { "txt" } else { "bin" };
    let folder = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-path-{}", std::process::id()));
    let _ = fs::create_dir_all(&folder);
    // Sequences of 7-Scenes are folders of files with such names; every other format has one file.
    let file = match format {
        Some(Format::SevenScenes) => folder.join("frame-000000.pose.txt"),
        _ => folder.join(format!("path.{extension}")),
    };
    if fs::write(&file, bytes).is_ok() {
        let _ = read(if format == Some(Format::SevenScenes) { &folder } else { &file }, format);
    }
});
