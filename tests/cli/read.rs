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
