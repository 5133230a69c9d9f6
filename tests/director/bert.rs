//! The text encoder that was trained beforehand, against NumPy (`bert/make.py`).

use std::path::Path;

use cinesplat::director::inputs::{Prompt, Vocabulary, encode_text};
use cinesplat::director::network::{ModelConfig, Network, Parameters, PromptBatch};
use cinesplat::language::{NamedObject, link, sense_names};
use cinesplat::training::Base;

const TEXT: &str = "slowly push in on <obj-3>, 5 seconds";

fn base() -> (Base, Vocabulary) {
    let base = Base::read(Path::new("tests/director/bert")).unwrap();
    let vocabulary = base.vocabulary(&[TEXT.to_owned()]).unwrap();
    (base, vocabulary)
}

#[test]
fn states_equal_those_of_numpy() {
    let (base, vocabulary) = base();
    let senses = sense_names().unwrap().len();
    let config = ModelConfig { bert: Some(base.config()), ..ModelConfig::tiny(vocabulary.size(), senses) };
    let mut parameters = Parameters::seeded(1);
    let network = Network::new(&mut parameters, &config).unwrap();
    let Parameters::Fresh { vars, .. } = parameters else { panic!("fresh parameters") };
    base.load(&vars, &vocabulary).unwrap();
    let linked = link(TEXT, &[NamedObject { id: 3, label: "vase".into() }]).unwrap();
    assert_eq!(linked.tokens_text, "slowly push in on <obj-0> , <qty-0>");
    let (tokens, _) = encode_text(&linked, &[], &[], &vocabulary).unwrap();
    let prompt = Prompt { tokens, num_quantities: 1, ..Prompt::default() };
    // A longer text in the batch: its padding changes nothing.
    let longer = Prompt { tokens: prompt.tokens.repeat(2), ..prompt.clone() };
    let batch = PromptBatch::new(&[&prompt, &longer], &config).unwrap();
    let found: Vec<Vec<Vec<f32>>> = network.bert_states(&batch).unwrap().unwrap().to_vec3().unwrap();
    let expected: Vec<Vec<f32>> =
        serde_json::from_slice(&std::fs::read("tests/director/bert/states.json").unwrap()).unwrap();
    assert_eq!(prompt.tokens.len(), expected.len());
    for (token, (found, expected)) in found[0].iter().zip(&expected).enumerate() {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-5, "token {token}: {found} instead of {expected}");
        }
    }
}

#[test]
fn only_pieces_of_plain_english_are_kept() {
    let (_, vocabulary) = base();
    let pieces = vocabulary.pieces();
    assert!(["slow", "##ly", ",", "<obj-99>", "<eos>"].iter().all(|piece| pieces.contains_key(*piece)));
    assert!(!pieces.contains_key("[CLS]"));
}

#[test]
fn a_folder_that_holds_no_bert_is_refused_with_the_file() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(Base::read(folder.path()).unwrap_err().code(), "FILE-READ");
    for name in ["config.json", "vocab.txt", "model.safetensors"] {
        std::fs::copy(Path::new("tests/director/bert").join(name), folder.path().join(name)).unwrap();
    }
    std::fs::write(folder.path().join("config.json"), "{\"hidden_size\": 12}").unwrap();
    let error = Base::read(folder.path()).unwrap_err();
    assert_eq!(error.code(), "TRAIN-BASE");
    assert!(error.to_string().contains("config.json"), "{error}");
}
