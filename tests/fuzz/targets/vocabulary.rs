//! Vocabularies: the JSON of `tokenizers`. What is read is written and read again.
#![no_main]

use cinesplat_director::inputs::Vocabulary;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(vocabulary) = Vocabulary::from_json(bytes)
        && let Ok(json) = vocabulary.to_json()
    {
        let _ = (vocabulary.size(), vocabulary.pieces());
        let _ = Vocabulary::from_json(json.as_bytes());
    }
});
