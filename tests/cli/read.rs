//! `cinesplat read`: what a sentence is understood as.

use serde_json::{Value, json};

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

/// A line of `bench readings`: a sentence about a sofa (1) and a floor lamp (2), and the steps that it asks for.
fn sentence(prompt: &str, steps: &[(&str, u32)]) -> String {
    let steps: Vec<Value> = steps
        .iter()
        .map(|(moves, id)| json!({"moves": moves.split(' ').collect::<Vec<&str>>(), "objs": [id]}))
        .collect();
    let things = ["sofa", "floor lamp"];
    json!({"id": "a", "prompt": prompt, "things": things, "means": "as said", "steps": steps}).to_string()
}

#[test]
fn bench_readings_counts_the_sentences_that_are_read_as_meant() {
    let folder = tempfile::tempdir().unwrap();
    let right = |prompt: &str, steps: &[(&str, u32)]| {
        std::fs::write(folder.path().join("s.jsonl"), sentence(prompt, steps)).unwrap();
        let table = data(folder.path(), &["bench", "readings", "s.jsonl"]);
        table == "file,right,sentences,percent,right_with_warning,wrong_with_warning\ns.jsonl,1,1,100.0,0,0\n"
    };
    assert!(right("push in on the couch", &[("push-in follow", 1)]));
    assert!(right("orbit the floor lamp to the left", &[("orbit-left", 2)]));
    assert!(!right("orbit the floor lamp to the left", &[("orbit-right", 2)]), "the other way");
    assert!(right("orbit the floor lamp", &[("orbit-left", 2)]), "either way");
    assert!(!right("tilt up the floor lamp", &[("tilt-up", 1)]), "another thing");
    let pan = "pan left from the sofa to the floor lamp, then push in";
    assert!(right(pan, &[("pan-left", 2), ("push-in", 2)]));
    assert!(!right(pan, &[("push-in", 2), ("pan-left", 2)]), "another order");
    assert!(!right(pan, &[("pan-left", 2)]), "one step more");
    let misses = answer(folder.path(), &["bench", "readings", "s.jsonl", "--misses"]);
    assert!(misses.contains("a: \"pan left from the sofa"), "{misses}");
    std::fs::write(folder.path().join("bad.jsonl"), sentence("pan", &[("wander", 1)])).unwrap();
    let error = answer(folder.path(), &["bench", "readings", "bad.jsonl"]);
    assert!(error.contains("bad.jsonl: line 1") && error.contains("there is no move \"wander\""), "{error}");
}
