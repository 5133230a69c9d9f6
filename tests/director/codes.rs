//! Keys to class numbers and pointers, and back.

use cinesplat::director::ModelFiles;
use cinesplat::director::codes::{Field, NUM_FIELDS, decode_key, encode_key};
use cinesplat::director::inputs::{Grounding, Vocabulary, encode_text};
use cinesplat::director::keys::{Key, Next, Segment, keys_of};
use cinesplat::language::link;
use cinesplat::training::PromptSampler;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use strum::VariantArray;

/// The prompts' keys with their grounding.
fn sampled_keys(seed: u64, count: usize, vocabulary: &Vocabulary) -> Vec<(Vec<Key>, Grounding)> {
    let sampler = PromptSampler::embedded().unwrap();
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut sample = |_| {
        let objects = sampler.invent_objects(6, &mut rng);
        let labeled = sampler.sample(&objects, &mut rng);
        let linked = link(&labeled.prompt, &objects).unwrap();
        let (_, grounding) = encode_text(&linked, &linked.senses().unwrap(), &[], vocabulary).unwrap();
        (keys_of(&labeled.program), grounding)
    };
    (0..count).map(&mut sample).collect()
}

/// The key without the fields that codes may change: amounts and durations need a quantity of the text, and words become
/// whole tokens.
fn without_text(mut key: Key) -> Key {
    if let Next::Segment(segment) = &mut key.next {
        *segment = Segment { amount: None, duration_secs: None, words: None, ..segment.clone() };
    }
    key
}

#[test]
fn sampled_keys_survive_their_codes() {
    let vocabulary = ModelFiles::embedded().vocabulary().unwrap();
    let mut num_encoded = 0;
    for (keys, grounding) in sampled_keys(4, 300, &vocabulary) {
        for (key_idx, key) in keys.iter().enumerate() {
            let Some(code) = encode_key(key, key_idx == 0, &[], &grounding) else { continue };
            assert_eq!(without_text(decode_key(&code, &grounding)), without_text(key.clone()));
            num_encoded += 1;
        }
    }
    assert!(num_encoded > 500, "only {num_encoded} keys have codes");
}

#[test]
fn fields_divide_the_classes_without_gaps() {
    let mut end = 0;
    for field in Field::VARIANTS {
        assert_eq!(field.offset(), end, "{field}");
        end += field.num_classes();
    }
    assert_eq!((Field::VARIANTS.len(), end), (NUM_FIELDS, Field::total_classes()));
}
