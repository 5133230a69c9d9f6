//! `cinesplat read`: what a sentence is understood as.

use serde_json::Value;

use super::{answer, data};

/// The JSON of a prompt about a sofa (1) and a floor lamp (2).
fn read(prompt: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    serde_json::from_str(&data(folder.path(), &["read", "-p", prompt, "--names", "sofa,floor lamp", "--json"])).unwrap()
}

#[test]
fn a_synonym_is_the_object_and_the_program_has_its_id() {
    let read = read("Push in on the couch.");
    assert_eq!(read["program"], "push-in end=1");
    assert_eq!(read["steps"][0]["move"], "push-in");
    assert_eq!(read["steps"][0]["words"][0], 0);
    let probability = read["steps"][0]["probability"].as_f64().unwrap();
    assert!((0.5..=1.0).contains(&probability), "{probability}");
    assert_eq!(read["missing"].as_array().unwrap().len(), 0);
}

#[test]
fn a_thing_that_the_scene_lacks_is_named_with_the_nearest() {
    let read = read("Push in on the elephant.");
    assert_eq!(read["missing"][0]["name"], "elephant");
    assert!(!read["missing"][0]["nearest"].as_array().unwrap().is_empty());
}

#[test]
fn without_names_every_thing_exists() {
    let folder = tempfile::tempdir().unwrap();
    let output = data(folder.path(), &["read", "-p", "push in on the elephant", "--json"]);
    let read: Value = serde_json::from_str(&output).unwrap();
    assert_eq!(read["objects"][0]["label"], "elephant");
    assert_eq!(read["program"], "push-in end=1");
}

#[test]
fn a_prompt_without_words_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    insta::assert_snapshot!(answer(folder.path(), &["read", "-p", " .. "]), @r#"
    exit 65
    error[PROMPT-EMPTY]: prompt without words, expected a sentence such as "push in on <obj-3>"
    help: say what the camera does, for example -p "orbit <obj-3> to the left"
    "#);
}

#[test]
fn a_timeline_without_verbs_lists_pictures() {
    let read = read("0-3s wide on the sofa, 3-6s the floor lamp close");
    let steps = read["steps"].as_array().unwrap();
    assert_eq!(steps.iter().map(|step| step["move"].as_str().unwrap()).collect::<Vec<_>>(), ["static", "follow"]);
    assert_eq!(read["program"], "static end=1:long dur=3s / follow end=2:close-up dur=3s | total=6s");
}

#[test]
fn an_effect_named_after_a_film_is_one_dolly_zoom() {
    for prompt in ["Jaws shot of the sofa", "Vertigo effect on the sofa", "do the Vertigo effect on the floor lamp"] {
        let read = read(prompt);
        let steps = read["steps"].as_array().unwrap();
        assert_eq!(steps.len(), 1, "{prompt}");
        assert!(steps[0]["move"].as_str().unwrap().starts_with("dolly-zoom"), "{prompt}: {}", steps[0]["move"]);
    }
}

#[test]
fn a_stated_direction_is_not_open() {
    let read = read("dutch angle on the floor lamp, slow zoom in");
    let zoom = read["steps"].as_array().unwrap().iter().find(|step| step["move"] == "zoom-in").unwrap().clone();
    assert_eq!(zoom["either"], false);
}

#[test]
fn an_entry_of_a_timeline_that_names_a_move_keeps_it() {
    let read = read("0-3 s: the sofa. 3-6 s: push in on the floor lamp");
    assert_eq!(read["program"], "static end=1 dur=3s / push-in end=2 dur=3s | total=6s");
}

/// The negation belongs to the effect that it forbids.
#[test]
fn the_no_of_no_depth_of_field_has_no_meaning_for_the_camera() {
    for prompt in [
        "push in on the sofa, no depth of field",
        "no depth of field, push in on the sofa",
        "whip pan to the sofa without motion blur",
        "push in on the sofa, don't use any motion blur, no fog or grain",
    ] {
        let folder = tempfile::tempdir().unwrap();
        let text = data(folder.path(), &["read", "-p", prompt, "--names", "sofa,floor lamp"]);
        assert!(text.contains(", forbidden") && !text.contains("without a meaning"), "{prompt}: {text}");
    }
}

#[test]
fn dictated_marks_are_no_words() {
    let read = read("push in on the sofa comma slowly full stop the banana stays put full stop");
    assert_eq!(read["steps"][0]["move"], "push-in");
    let unused: Vec<&str> = read["unused_words"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(unused.iter().all(|word| word.len() > 1), "{unused:?}");
}

#[test]
fn bench_readings_counts_the_sentences_that_are_read_as_meant() {
    let folder = tempfile::tempdir().unwrap();
    let line = |id: &str, prompt: &str, moves: &str, thing: u32| {
        let things = r#""things":["sofa","floor lamp"],"means":"as said""#;
        let steps = format!(r#"[{{"moves":[{moves}],"objs":[{thing}]}}]"#);
        format!(r#"{{"id":"{id}","prompt":"{prompt}",{things},"steps":{steps}}}"#)
    };
    let sentences = [
        line("a", "push in on the couch", r#""push-in","follow""#, 1),
        line("b", "orbit the floor lamp to the left", r#""orbit-left""#, 2),
        line("c", "tilt up the floor lamp", r#""tilt-up""#, 1),
    ];
    std::fs::write(folder.path().join("s.jsonl"), sentences.join("\n")).unwrap();
    let table = data(folder.path(), &["bench", "readings", "s.jsonl"]);
    assert_eq!(table, "file,right,sentences,percent\ns.jsonl,2,3,66.7\n");
    assert!(
        answer(folder.path(), &["bench", "readings", "s.jsonl", "--misses"]).contains("c: \"tilt up the floor lamp\"")
    );
    std::fs::write(folder.path().join("bad.jsonl"), line("d", "pan", r#""wander""#, 1)).unwrap();
    let error = answer(folder.path(), &["bench", "readings", "bad.jsonl"]);
    assert!(error.contains("bad.jsonl: line 1") && error.contains("there is no move \"wander\""), "{error}");
}
