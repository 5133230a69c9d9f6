//! Texts as `cameras.json`.
#![no_main]

use cinesplat_export::cameras_json;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = cameras_json::read(text);
});
