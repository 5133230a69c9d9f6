//! Language models of `--reader`: a GGUF file behind a first byte; where that is odd, the rest after the first byte 0 is the
//! tokenizer.json beside it.
#![no_main]

use std::fs;
use std::path::PathBuf;

use cinesplat_reader::Reader;
use libfuzzer_sys::fuzz_target;

/// A model whose tokenizer is the one beside it: the header alone.
const HEADER: &[u8] = include_bytes!("../seeds/gguf/beside.gguf");

fuzz_target!(|input: &[u8]| {
    let Some((first, bytes)) = input.split_first() else { return };
    let folder = PathBuf::from(format!("/dev/shm/cinesplat-fuzz-gguf-{}", std::process::id()));
    let _ = fs::create_dir_all(&folder);
    let (model, tokenizer) = if first % 2 == 0 { (bytes, &b"{}"[..]) } else { (&HEADER[1..], bytes) };
    let (path, beside) = (folder.join("model.gguf"), folder.join("tokenizer.json"));
    if fs::write(&path, model).and_then(|()| fs::write(beside, tokenizer)).is_ok() {
        let _ = Reader::load(&path);
    }
});
