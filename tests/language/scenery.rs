//! Clauses about light, weather and mood.

use cinesplat::language::{Mention, blanked, scenery};
use proptest::prelude::*;

/// What is left of a prompt; `names` are the words in it that name objects.
fn left(prompt: &str, names: &[&str]) -> String {
    let mention = |name: &&str| {
        let start = prompt.find(name).unwrap_or_else(|| panic!("{name}"));
        Mention { bytes: [start, start + name.len()], ids: vec![1] }
    };
    let ranges = scenery(prompt, &names.iter().map(mention).collect::<Vec<_>>()).unwrap();
    blanked(prompt, &ranges).split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn light_and_weather_move_no_camera() {
    for (prompt, kept) in [
        ("push in on the mug, dust motes drifting upward, 35mm", "push in on the mug , 35mm"),
        ("circle the mug. Sunlight slides slowly up the wall.", "circle the mug. ."),
        ("pan right while golden light spills through the window", "pan right"),
        ("smoke curling to the left, tilt down to the mug", ", tilt down to the mug"),
        ("orbit the mug, melancholic, fairy-tale atmosphere", "orbit the mug"),
    ] {
        assert_eq!(
            left(prompt, &["mug"].iter().filter(|name| prompt.contains(**name)).copied().collect::<Vec<_>>()),
            kept
        );
    }
}

#[test]
fn what_is_said_of_the_camera_and_of_things_stays() {
    for prompt in [
        "push in on the mug, unhurried, please",
        "push in on the light",
        "pan to the light on the left, then tilt up",
        "slide along the ladles, R to L, thank you",
        "the light drifts to the left, then to the mug",
        "moody, atmospheric, golden light",
        "orbit the mug, constant height, no rotation, 0.1 m/s",
    ] {
        let names: Vec<&str> = ["mug", "light", "ladles"].into_iter().filter(|name| prompt.contains(name)).collect();
        assert_eq!(left(prompt, &names), prompt);
    }
}

proptest! {
    #[test]
    fn every_other_byte_stays_where_it_is(prompt in "[a-z ,.;:\u{e9}-]{0,60}(light drifting|dust)?[a-z ,]{0,20}") {
        let ranges = scenery(&prompt, &[]).unwrap();
        let blanked = blanked(&prompt, &ranges);
        prop_assert_eq!(blanked.len(), prompt.len());
        for [start, end] in ranges {
            prop_assert!(blanked[start..end].bytes().all(|byte| byte == b' '));
        }
    }
}
