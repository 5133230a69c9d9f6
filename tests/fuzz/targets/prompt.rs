//! Prompts, by their words alone: objects, quantities, effects, shape of the frame, and the notation of programs.
#![no_main]

use cinesplat_language::{
    NamedObject, effect_mentions, forbidding_words, frame_shape, link, plain_words, program_from_notation,
    program_to_notation, scenery, tokenize, without_camera_settings, without_frame_shape, without_tolerances,
};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|prompt: &str| {
    let object = |id, label: &str| NamedObject { id, label: label.to_owned() };
    let objects = [object(1, "sofa"), object(2, "bottle 1"), object(3, "bottle 2"), object(4, "floor lamp")];
    let words = tokenize(prompt);
    for word in &words {
        assert!(prompt.get(word.span[0]..word.span[1]).is_some(), "words lie on characters");
    }
    let _ = plain_words(prompt, &words, &|_| false);
    let _ = (frame_shape(prompt, &objects), without_frame_shape(prompt, &objects), without_tolerances(prompt));
    let _ = (without_camera_settings(prompt), scenery(prompt, &[]));
    if let Ok(linked) = link(prompt, &objects)
        && let Ok(effects) = effect_mentions(prompt, &linked)
    {
        for effect in &effects {
            let [start, end] = forbidding_words(prompt, effect, &effects);
            assert!(prompt.get(start..end).is_some(), "spans lie on characters");
        }
    }
    if let Ok(program) = program_from_notation(prompt) {
        program_from_notation(&program_to_notation(&program)).expect("a written program is read");
    }
});
