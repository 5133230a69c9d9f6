//! The vocabulary: training, JSON, special tokens.

use cinesplat::director::inputs::Vocabulary;
use serde_json::json;

fn trained() -> Vocabulary {
    let lines = ["push in on <obj-0> slowly", "pan left from <obj-0> to <obj-1>", "orbit <obj-1> in <qty-0>"];
    let lines: Vec<String> = lines.iter().cycle().take(60).map(|line| (*line).to_owned()).collect();
    Vocabulary::train(&lines, 300).unwrap()
}

#[test]
fn a_vocabulary_is_repeatable_and_survives_json() {
    let json = trained().to_json().unwrap();
    assert!(json == trained().to_json().unwrap(), "one corpus gave two vocabularies");
    let read = Vocabulary::from_json(json.as_bytes()).unwrap();
    assert_eq!(read.size(), trained().size());
    assert!(read.to_json().unwrap() == json, "the vocabulary changed in JSON");
}

#[test]
fn a_tokenizer_without_the_special_tokens_is_rejected() {
    let json = trained().to_json().unwrap().replace("<obj-7>", "<abc-7>");
    let error = Vocabulary::from_json(json.as_bytes()).unwrap_err();
    assert_eq!(error.code(), "MODEL-BAD");
    assert!(error.to_string().contains("<obj-7>"), "{error}");
    assert_eq!(Vocabulary::from_json(b"{}").unwrap_err().code(), "MODEL-BAD");
}

#[test]
fn a_tokenizer_with_parts_of_other_programs_is_rejected() {
    let json: serde_json::Value = serde_json::from_str(&trained().to_json().unwrap()).unwrap();
    let with = |place: &str, value: serde_json::Value| {
        let mut json = json.clone();
        *json.pointer_mut(place).unwrap() = value;
        Vocabulary::from_json(json.to_string().as_bytes()).unwrap_err().to_string()
    };
    let table = json!({"type": "Precompiled", "precompiled_charsmap": "AQAAAAA="});
    let padding = json!({"strategy": {"Fixed": 1_000_000_000}, "direction": "Right", "pad_to_multiple_of": null,
        "pad_id": 0, "pad_type_id": 0, "pad_token": "<pad>"});
    let expected =
        "director.tokenizer.json: /normalizer/type: found \"Precompiled\", expected Lowercase or BertNormalizer";
    assert_eq!(with("/normalizer", table.clone()), expected);
    assert!(with("/padding", padding).contains("/padding: found {"));
    assert!(with("/decoder", json!({"type": "Fuse"})).contains("/decoder"));
    assert!(with("/model/vocab/push", json!(4)).contains("/model/vocab: "), "an id twice");
    assert!(with("/model/merges/0", json!(["push", "u"])).contains("/model/merges/0: found [\"push\",\"u\"]"));
    assert!(with("/model/merges/0", json!(["slowly", "##q"])).contains("expected two tokens that make a third"));
    assert!(with("/model/type", json!("Unigram")).contains("/model/type"));
    // The package that reads tokenizers panics at this one.
    let damaged = include_bytes!("../fuzz/seeds/vocabulary/decoder.json");
    let error = Vocabulary::from_json(damaged).unwrap_err();
    assert!(error.to_string().starts_with("director.tokenizer.json: found key must be a string"), "{error}");
    // The first of two normalizers is not read.
    let twice = json.to_string().replacen('{', &format!("{{\"normalizer\":{table},"), 1);
    Vocabulary::from_json(twice.as_bytes()).unwrap();
}

#[test]
fn frequent_words_become_pieces() {
    let json = trained().to_json().unwrap();
    for piece in ["orbit", "push", "slowly", "pan", "left", "##q"] {
        assert!(json.contains(&format!("\"{piece}\":")), "{piece} is not a piece");
    }
}
