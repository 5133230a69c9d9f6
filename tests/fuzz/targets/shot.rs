//! Texts as `shot.json`. What is read is written and read again.
#![no_main]

use cinesplat_export::shot_json;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(read) = shot_json::read(text) {
        let again = shot_json::read(&shot_json::write(&read.shot)).expect("a written shot is read");
        assert_eq!(again.shot.keyframes.len(), read.shot.keyframes.len());
    }
});
