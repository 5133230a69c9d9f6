//! The vocabulary: training, JSON, special tokens.

use cinesplat::director::inputs::Vocabulary;

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
fn frequent_words_become_pieces() {
    let json = trained().to_json().unwrap();
    for piece in ["orbit", "push", "slowly", "pan", "left", "##q"] {
        assert!(json.contains(&format!("\"{piece}\":")), "{piece} is not a piece");
    }
}
