use std::collections::BTreeSet;

use cinesplat::language::{LanguageError, Linked, MAX_PROMPT_BYTES, NamedObject, link};
use proptest::prelude::*;

use crate::support::shared;

fn objects(labels: &[&str]) -> Vec<NamedObject> {
    labels.iter().enumerate().map(|(i, label)| NamedObject { id: i as u32 + 1, label: (*label).to_owned() }).collect()
}

fn room() -> Vec<NamedObject> {
    objects(&[
        "golden skull",
        "television",
        "wooden sideboard",
        "white armchair",
        "dining chair",
        "office chair",
        "stack of teal plates",
    ])
}

fn linked(prompt: &str) -> Linked {
    link(prompt, &room()).unwrap_or_else(|error| panic!("{prompt}: {error}"))
}

fn tokens(prompt: &str) -> String {
    linked(prompt).tokens_text
}

#[test]
fn names_become_slots_in_order_of_first_mention() {
    let found = linked("Pan from the television to the golden skull, then back to the television.");
    assert_eq!(found.tokens_text, "pan from <obj-0> to <obj-1> , then back to <obj-0> .");
    assert_eq!(found.slots, [2, 1]);
}

#[test]
fn a_mention_may_be_short_plural_possessive_a_synonym_or_misspelled() {
    for name in [
        "the skull",
        "skull",
        "that golden skull",
        "a big golden skull",
        "<obj-1>",
        "object 1",
        "obj #1",
        "#1",
        "the golden skul",
        "obj-1",
    ] {
        assert_eq!(linked(&format!("push in on {name}")).slots, [1], "{name}");
    }
    assert_eq!(linked("orbit the telly").slots, [2]);
    assert_eq!(linked("orbit the TV set").slots, [2]);
    assert_eq!(linked("slide past the credenza").slots, [3]);
    assert_eq!(linked("slide past the arm chair").slots, [4]);
    assert_eq!(linked("look at the plates").slots, [7]);
    assert_eq!(linked("look at the teal plates").slots, [7]);
    assert_eq!(tokens("tilt up to the skull's top"), "tilt up to <obj-0> 's top");
    assert_eq!(tokens("show the chairs"), "show <obj-0> and <obj-1>");
}

#[test]
fn an_ambiguous_name_links_to_the_first_object_with_a_warning_and_a_full_name_without() {
    let short = linked("orbit the chair");
    assert_eq!(short.slots, [5]);
    assert_eq!(short.warnings.len(), 1);
    let full = linked("orbit the office chair");
    assert_eq!(full.slots, [6]);
    assert!(full.warnings.is_empty());
}

#[test]
fn pronouns_and_scenery_stay_words() {
    assert_eq!(
        tokens("push in on it, then show them and the room from the front"),
        "push in on it , then show them and the room from the front"
    );
    assert!(linked("end wide on the room, camera level, top of the frame").unknown.is_empty());
}

#[test]
fn words_about_the_camera_never_name_an_object_alone() {
    let odd = objects(&["picture frame", "trash can", "dolly", "frying pan"]);
    let found =
        link("Can you dolly in, pan left, keep the frame level? Then the picture frame and the trash can.", &odd)
            .unwrap();
    assert_eq!(found.slots, [1, 2]);
}

#[test]
fn an_unknown_object_is_an_error_with_the_nearest_names() {
    for prompt in [
        "orbit <obj-99>",
        "orbit the elephant",
        "push in on the skull, then orbit the elephant",
        "look at object 12",
        "orbit <obj-N>",
    ] {
        let error = link(prompt, &room()).unwrap_err();
        assert_eq!(error.code(), "OBJ-UNKNOWN", "{prompt}");
        let LanguageError::UnknownObject { nearest, .. } = &error else { panic!("{error}") };
        assert!(nearest[0].starts_with("<obj-"), "{nearest:?}");
    }
    let LanguageError::UnknownObject { name, nearest } =
        link("orbit the skulls of doom and the tellyvision set", &objects(&["television"])).unwrap_err()
    else {
        panic!("not an unknown object")
    };
    assert!(name.starts_with("skulls"), "{name}");
    assert_eq!(nearest, ["<obj-1> television"]);
}

#[test]
fn an_unknown_name_that_says_where_a_known_object_is_is_no_error() {
    let found = linked("push in on the skull on the desk");
    assert_eq!(found.slots, [1]);
    assert_eq!(found.unknown.len(), 1);
    assert_eq!(found.unknown[0].name, "desk");
}

#[test]
fn typography_case_and_accents_make_no_difference() {
    let plain = tokens("push in on the golden skull, then orbit it counter-clockwise");
    for prompt in [
        "PUSH IN ON THE GOLDEN SKULL, THEN ORBIT IT COUNTER-CLOCKWISE",
        "Push\u{2011}in on the \u{201C}golden skull\u{201D}, then orbit it counter clockwise",
        "p\u{FA}sh in on the go\u{AD}lden sku\u{200D}ll,\tthen\norbit it counter\u{2010}clockwise"
            .replace('\u{AD}', "")
            .as_str(),
        "\u{FF50}\u{FF55}\u{FF53}\u{FF48} in on the golden skull \u{2014} then orbit it counter-clockwise",
    ] {
        assert_eq!(tokens(prompt), plain, "{prompt}");
    }
}

#[test]
fn prompts_without_words_or_over_a_limit_are_errors() {
    let long = "orbit ".repeat(MAX_PROMPT_BYTES / 6 + 1);
    assert_eq!(link(&long, &room()).unwrap_err().code(), "PROMPT-TOO-LONG");
    for prompt in ["", "  \n", "...", "\u{200B}\u{202E}", "\0\0", "\u{301}", "?!"] {
        assert_eq!(link(prompt, &room()).unwrap_err().code(), "PROMPT-EMPTY", "{prompt:?}");
    }
    let many: Vec<NamedObject> = (1..=120).map(|id| NamedObject { id, label: String::new() }).collect();
    let prompt = (1..=120).map(|id| format!("<obj-{id}>")).collect::<Vec<_>>().join(" ");
    assert_eq!(link(&prompt, &many).unwrap_err().code(), "PROMPT-OBJECTS");
}

#[test]
fn repetitive_prompts_of_the_greatest_length_keep_one_span_per_word() {
    let many: Vec<NamedObject> = (1..=300).map(|id| NamedObject { id, label: "old chair".to_owned() }).collect();
    for unit in ["chair ", "a", "the old ", "<", "1 2 ", "a half of a ", "old ", "<obj-", "\u{301}", "second a "] {
        let prompt = unit.repeat(MAX_PROMPT_BYTES / unit.len());
        if let Ok(found) = link(&prompt, &many) {
            assert_eq!(found.tokens_text.split(' ').count(), found.spans.len(), "{unit:?}");
        }
    }
}

#[test]
fn public_prompts_link_to_the_objects_and_durations_of_their_checks() {
    let Some(file) = shared("data/prompts/public.jsonl") else { return };
    let text = std::fs::read_to_string(&file).unwrap();
    for line in text.lines() {
        let case: serde_json::Value = serde_json::from_str(line).unwrap();
        let path = file.with_file_name(case["objects"].as_str().unwrap());
        let scene: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let named = |object: &serde_json::Value| NamedObject {
            id: object["id"].as_u64().unwrap() as u32,
            label: object["label"].as_str().unwrap_or_default().to_owned(),
        };
        let objects: Vec<NamedObject> = scene["objects"].as_array().unwrap().iter().map(named).collect();
        let found = link(case["prompt"].as_str().unwrap(), &objects).unwrap();
        let mut checked = BTreeSet::new();
        collect_objects(&case["checks"], &mut checked);
        let slots: BTreeSet<u64> = found.slots.iter().map(|id| u64::from(*id)).collect();
        assert_eq!(slots, checked, "{}", case["prompt"]);
        assert!(found.unknown.is_empty() && found.warnings.is_empty(), "{found:?}");
        for check in case["checks"].as_array().unwrap().iter().filter(|check| check["kind"] == "duration") {
            let seconds = check["seconds"].as_f64().unwrap();
            assert!(found.quantities.iter().any(|q| (q.value - seconds).abs() < 1e-9), "{}", case["prompt"]);
        }
    }
}

fn collect_objects(value: &serde_json::Value, into: &mut BTreeSet<u64>) {
    match value {
        serde_json::Value::Object(map) => {
            into.extend(map.get("object").and_then(serde_json::Value::as_u64));
            into.extend(
                map.get("objects")
                    .and_then(|v| v.as_array())
                    .into_iter()
                    .flatten()
                    .filter_map(serde_json::Value::as_u64),
            );
            map.values().for_each(|inner| collect_objects(inner, into));
        }
        serde_json::Value::Array(items) => items.iter().for_each(|inner| collect_objects(inner, into)),
        _ => {}
    }
}

proptest! {
    #[test]
    fn spans_of_any_text_lie_in_it(prompt in ".{0,200}") {
        check_spans(&prompt)?;
    }

    #[test]
    fn spans_of_any_mix_of_known_pieces_lie_in_it(
        pieces in prop::collection::vec(prop::sample::select(vec![
            "the ", "golden ", "skull", "<obj-1>", "<obj-", "7>", " a ", "half ", "2.5", "s", "\u{B0}", "\u{200D}", "\u{202E}", "'s", "-",
            "second ", "twice as ", "close", "360", ".", ",", "\0", "e\u{301}", "\u{1F3A5}", "of a ", "three ", "quarters ", "#", "object ", "1/",
        ]), 0..40)
    ) {
        check_spans(&pieces.concat())?;
    }
}

fn check_spans(prompt: &str) -> Result<(), TestCaseError> {
    let Ok(found) = link(prompt, &room()) else { return Ok(()) };
    prop_assert_eq!(found.tokens_text.split(' ').count(), found.spans.len());
    let mut before = 0;
    for [start, end] in &found.spans {
        prop_assert!(start < end && prompt.get(*start..*end).is_some(), "{:?}", found);
        prop_assert!(*start >= before || found.tokens_text.contains(" and <obj-"), "{:?}", found);
        before = *start;
    }
    prop_assert!(found.quantities.iter().all(|q| q.value.is_finite() && q.value > 0.0));
    Ok(())
}

/// "one billion seconds" used to be dropped, and the film got a length of its own.
#[test]
fn a_number_that_is_too_large_to_be_read_is_a_warning() {
    let warnings = |prompt: &str| link(prompt, &room()).unwrap().warnings.join("; ");
    let expected = "expected digits below 1000000, or words below one thousand";
    assert_eq!(
        warnings("orbit the golden skull for one billion seconds"),
        format!("the number \"billion\" was ignored, {expected}")
    );
    assert_eq!(
        warnings("orbit the golden skull for 1000000000 seconds"),
        format!("the number \"1000000000\" was ignored, {expected}")
    );
    assert_eq!(warnings("orbit the golden skull for 999999 seconds"), "");
    assert_eq!(warnings("orbit the golden skull for two hundred seconds"), "");
}
