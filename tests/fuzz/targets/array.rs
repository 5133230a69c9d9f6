//! Arrays of `NumPy`, and base64.
#![no_main]

use cinesplat_files::{base64, json_excess, npy, Limits};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(array) = npy::Array::parse(bytes) {
        let _ = (array.to_u32(), array.to_f32());
    }
    let _ = json_excess(bytes, &Limits::DEFAULT);
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = base64::decode(text);
    }
    assert_eq!(base64::decode(&base64::encode(bytes)).as_deref(), Some(bytes));
});
