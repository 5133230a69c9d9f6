//! Sentences that call for effects, forbid them, or have nothing to do with them, written by others than the author of
//! the words.

use std::collections::BTreeSet;

use cinesplat::language::{are_effect_phrases, effect_mentions, link, without_camera_settings};
use cinesplat::lens::Degree::{Medium, Slight, Strong};
use cinesplat::lens::is_known;

/// Least share of the sentences that give exactly the right sets.
const LEAST: f64 = 0.95;
/// The same of sentences that were written before the table of phrases was last changed, and were not looked at since.
const LEAST_FRESH: f64 = 0.95;

/// Least share of the sentences of six voices that call for exactly the right set, and of variations on them.
const LEAST_VOICES: f64 = 0.97;
const LEAST_VARIATIONS: f64 = 0.95;

type Names = BTreeSet<String>;

/// The effects that a sentence calls for, and those that it forbids.
fn read(prompt: &str) -> [Names; 2] {
    let linked = link(prompt, &[]).unwrap_or_default();
    let mentions = effect_mentions(prompt, &linked).unwrap();
    [false, true].map(|is_forbidden| {
        let chosen = mentions.iter().filter(|mention| mention.is_forbidden == is_forbidden);
        chosen.map(|mention| mention.call.name.clone()).filter(|name| is_known(name)).collect()
    })
}

#[test]
fn sentences_of_others_call_for_exactly_the_right_effects() {
    check(include_str!("sentences.jsonl"), LEAST);
    check(include_str!("fresh_sentences.jsonl"), LEAST_FRESH);
}

fn check(sentences: &str, least: f64) {
    let (mut right, mut missed) = (0, Vec::new());
    for line in sentences.lines().filter(|line| !line.trim().is_empty()) {
        let sentence: serde_json::Value = serde_json::from_str(line).unwrap();
        let names = |field: &str| -> Names {
            sentence[field].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
        };
        let prompt = sentence["prompt"].as_str().unwrap();
        let (wanted, got) = ([names("effects"), names("forbids")], read(prompt));
        if wanted == got { right += 1 } else { missed.push(format!("{prompt}: {wanted:?}, read {got:?}")) }
    }
    let total = right + missed.len();
    assert!(total >= 60 && right as f64 >= least * total as f64, "{right} of {total}\n{}", missed.join("\n"));
}

/// Checks lines of a sentence and the effects that it calls for, requests that are none included.
fn check_table(lines: &str, least: f64) {
    let (mut right, mut missed) = (0, Vec::new());
    for line in lines.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (prompt, wanted) = line.split_once('\t').unwrap();
        let wanted: Names = wanted.split(',').filter(|name| !name.is_empty()).map(str::to_owned).collect();
        let mentions = effect_mentions(prompt, &link(prompt, &[]).unwrap_or_default()).unwrap();
        let called = mentions.into_iter().filter(|mention| !mention.is_forbidden).map(|mention| mention.call.name);
        let got: Names = called.collect();
        if wanted == got { right += 1 } else { missed.push(format!("{prompt}: {wanted:?}, read {got:?}")) }
    }
    let total = right + missed.len();
    assert!(total >= 200 && right as f64 >= least * total as f64, "{right} of {total}\n{}", missed.join("\n"));
}

#[test]
fn six_voices_call_for_exactly_the_right_effects() {
    check_table(include_str!("voices.tsv"), LEAST_VOICES);
    check_table(include_str!("variations.tsv"), LEAST_VARIATIONS);
}

#[test]
fn a_whip_pan_without_blur_stays_without_it_in_any_order() {
    for prompt in ["no motion blur, whip pan to the door", "whip pan to the door, no motion blur"] {
        assert_eq!(read(prompt), [Names::new(), Names::from(["motion-blur".to_owned()])], "{prompt}");
    }
    assert_eq!(read("whip pan to the door")[0], Names::from(["motion-blur".to_owned()]));
}

#[test]
fn words_that_only_look_like_an_effect_call_for_none() {
    for prompt in [
        "focus on the mug, then truck left",
        "circle the grain silo",
        "fly past the fog lamp",
        "go 360 around the vase",
        "a 360 degree orbit of the vase",
        "the wood grain of the table in close-up",
        "close the shutters and pull back",
        "a shaky ladder, pan right",
        "the handheld blender, push in",
        "orbit the whisky barrel",
        "a vintage radio on the shelf",
        "flowers in full bloom, crane down",
        "the bright lamp on the table",
        "shift our attention to the window",
        "from the server rack to the desk",
        "t=3 s pass between the posts",
        "start at the grainy old wood table",
        "a smear of paint on the wall, push in",
        "make the toy train look life size",
        "blow out the candles",
        "hold it at the end",
    ] {
        assert_eq!(read(prompt), [Names::new(), Names::new()], "{prompt}");
    }
}

#[test]
fn a_look_described_without_its_name_calls_for_the_effect() {
    for (prompt, wanted) in [
        ("make it look like small toys, push in", "tilt-shift"),
        ("like seen in a christmas ball, push in", "fisheye"),
        ("the cup is clear and all the rest stays without sharpness", "depth-of-field"),
        ("the colors separate at the edges, pan left", "chromatic-aberration"),
        ("coloured circles in the lens, pan left", "lens-flare"),
        ("the behind must be transparent, orbit the cup", "background"),
        ("the candle has a halo, push in", "bloom"),
        ("smoke in the hall, push in", "fog"),
        ("poles tilt when we pan", "rolling-shutter"),
        ("as if a person filmed it, push in", "handheld"),
        ("texture of old film, push in", "film-grain"),
        ("take it down a stop, push in", "exposure"),
        ("the walls bow out at the edges, push in", "lens-distortion"),
    ] {
        assert_eq!(read(prompt)[0], Names::from([wanted.to_owned()]), "{prompt}");
    }
}

#[test]
fn what_a_picture_on_the_wall_shows_and_a_turn_of_the_head_call_for_no_effect() {
    for prompt in [
        "closer to the framed photo of a foggy harbour",
        "the dark picture on the wall, push in",
        "look through the peephole of the door",
        "turn your head slowly from the door to the window",
        "point the camera at the lamp and nothing else",
        "look into the doll's house from the front",
        "all black behind one pillar, then step out to the left",
        "turn round that street lamp, as if you were holding it",
    ] {
        assert_eq!(read(prompt), [Names::new(), Names::new()], "{prompt}");
    }
}

#[test]
fn flares_off_a_window_are_wanted() {
    assert_eq!(read("flares off the window, pan left")[0], Names::from(["lens-flare".to_owned()]));
    assert_eq!(read("flares off, pan left")[1], Names::from(["lens-flare".to_owned()]));
}

#[test]
fn what_sets_the_camera_is_no_move_and_leaves_every_other_byte_where_it_is() {
    let without = |prompt: &'static str| without_camera_settings(prompt).unwrap();
    let prompt = "orbit it with a slight dutch angle, then pull back";
    let blank = " ".repeat("with a slight dutch angle,".len());
    assert_eq!(without(prompt), format!("orbit it {blank} then pull back"));
    assert_eq!(without("dutch angle"), "dutch angle");
    assert_eq!(without("roll into a dutch angle"), "roll into a dutch angle");
    assert_eq!(without("orbit it with a 180 degree shutter").trim_end(), "orbit it");
    assert_eq!(without("35mm film grain, push in").trim_start(), ", push in");
    assert_eq!(without("orbit it 180 degrees on a 35 mm lens"), "orbit it 180 degrees on a 35 mm lens");
    assert!(are_effect_phrases("push in with bloom", &[[13, 18]]).unwrap()[0]);
    assert!(!are_effect_phrases("push in with Bob", &[[13, 16]]).unwrap()[0]);
}

#[test]
fn negations_reach_as_far_as_they_say() {
    let said = |prompt: &str| read(prompt).map(|names| names.into_iter().collect::<Vec<_>>().join(" "));
    assert_eq!(said("no motion blur, shallow depth of field"), ["depth-of-field", "motion-blur"]);
    assert_eq!(said("without fog, film grain or a vignette"), ["", "film-grain fog vignette"]);
    assert_eq!(said("not too much grain"), ["film-grain", ""]);
    assert_eq!(said("don't lose the bokeh"), ["depth-of-field", ""]);
    assert_eq!(said("crisp, no blur"), ["", "depth-of-field motion-blur"]);
    assert_eq!(said("film grain yes, flares no"), ["film-grain", "lens-flare"]);
    assert_eq!(said("locked off on a tripod"), ["", "handheld"]);
    assert_eq!(said("lens distortion and vignetting corrected"), ["", "lens-distortion vignette"]);
    assert_eq!(said("lose the vignette and the lens flares"), ["", "lens-flare vignette"]);
    assert_eq!(said("motion blur and a bit of vignette but no grain"), ["motion-blur vignette", "film-grain"]);
    assert_eq!(said("the lens distortion goes on in Nuke"), ["", "lens-distortion"]);
    assert_eq!(said("no cuts, slow push in with bloom"), ["bloom", ""]);
    assert_eq!(said("without blur of movement"), ["", "motion-blur"]);
}

#[test]
fn phrases_state_settings_and_degrees() {
    let setting = |prompt: &str, name: &str| {
        let mentions = effect_mentions(prompt, &link(prompt, &[]).unwrap()).unwrap();
        mentions[0].call.setting(name)
    };
    assert_eq!(setting("push in at f/1.8", "f_stop"), Some(1.8));
    assert_eq!(setting("pan right, 180 degree shutter", "shutter_angle_deg"), Some(180.0));
    assert_eq!(setting("two stops under, orbit", "stops"), Some(-2.0));
    assert_eq!(setting("-1 ev, orbit", "stops"), Some(-1.0));
    assert_eq!(setting("overexpose by a stop and a half", "stops"), Some(1.5));
    assert_eq!(setting("lift the exposure 0.7 of a stop", "stops"), Some(0.7));
    assert_eq!(setting("expose half a stop under", "stops"), Some(-0.5));
    assert_eq!(setting("EV -1, slow pan right", "stops"), Some(-1.0));
    assert_eq!(setting("dolly in at T1.4", "f_stop"), Some(1.4));
    assert_eq!(setting("motion blur at 1/15 s", "shutter_speed"), Some(15.0));
    assert_eq!(setting("jello of a 20 ms sensor readout", "readout_ms"), Some(20.0));
    assert_eq!(setting("barrel distortion, k1 around -0.1", "k1"), Some(-0.1));
    let degree = |prompt: &str| effect_mentions(prompt, &link(prompt, &[]).unwrap()).unwrap()[0].call.degree;
    assert_eq!(["a bit of fog", "fog", "very thick fog"].map(degree), [Slight, Medium, Strong]);
}

#[test]
fn a_number_of_the_lens_is_no_quantity_of_a_move() {
    assert_eq!(link("orbit it with a 180 degree shutter at f/2.8", &[]).unwrap().quantities, []);
    assert_eq!(link("orbit it 180 degrees", &[]).unwrap().quantities.len(), 1);
}
