//! Model files that are damaged, hostile or of another kind.

use std::fs;
use std::io::Cursor;

use candle_core::quantized::gguf_file::{Content, Value};
use cinesplat::language::program_to_notation;
use cinesplat::reader::{Question, Reader};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::reading::{qwen2, saved};
use super::tiny_model::gguf;
use crate::cli;

/// Code and message of the refusal of a file.
fn refusal(bytes: &[u8]) -> String {
    let (_folder, path) = saved(bytes);
    let error = Reader::load(&path).err().expect("a refusal");
    format!("{}: {}", error.code(), error.to_string().replace(&path.display().to_string(), "tiny.gguf"))
}

/// The model with some keys changed, or removed where the value is `None`.
fn with_keys(changes: &[(&str, Option<Value>)]) -> Vec<u8> {
    let mut file = Cursor::new(qwen2());
    let content = Content::read(&mut file).unwrap();
    let weights = content
        .tensor_infos
        .keys()
        .map(|name| {
            let device = candle_core::Device::Cpu;
            let tensor = content.tensor(&mut file, name, &device).unwrap().dequantize(&device).unwrap();
            (name.clone(), tensor)
        })
        .collect();
    let mut keys = content.metadata.into_iter().collect::<std::collections::BTreeMap<_, _>>();
    for (key, value) in changes {
        match value {
            Some(value) => keys.insert((*key).to_owned(), value.clone()),
            None => keys.remove(*key),
        };
    }
    gguf(&keys, &weights)
}

/// The bytes with others written at a place.
fn patched(at: usize, bytes: &[u8]) -> Vec<u8> {
    let mut file = qwen2().to_vec();
    file[at..at + bytes.len()].copy_from_slice(bytes);
    file
}

#[test]
fn a_file_that_is_no_model_is_refused_with_what_was_found() {
    insta::assert_snapshot!(refusal(b"not a model at all"), @r#"READER-BAD: tiny.gguf: the start of the file is "not ", expected "GGUF""#);
    insta::assert_snapshot!(refusal(b""), @"READER-BAD: tiny.gguf: byte 0 of the header is beyond the end of the file, expected a whole header");
    insta::assert_snapshot!(refusal(&patched(4, &9_u32.to_le_bytes())), @"READER-BAD: tiny.gguf: the GGUF version is 9, expected 2 or 3");
    insta::assert_snapshot!(refusal(&patched(8, &u64::MAX.to_le_bytes())), @"READER-BAD: tiny.gguf: the number of tensors is 18446744073709551615, expected at most 16384");
    insta::assert_snapshot!(refusal(&patched(16, &(1_u64 << 40).to_le_bytes())), @"READER-BAD: tiny.gguf: the number of keys is 1099511627776, expected at most 16384");
    insta::assert_snapshot!(refusal(&patched(24, &(1_u64 << 60).to_le_bytes())), @"READER-BAD: tiny.gguf: the length of a name is 1152921504606846976, expected at most 4096");
    let cut = refusal(&qwen2()[..qwen2().len() - 64]);
    assert!(cut.contains("token_embd.weight is cut: it ends at byte"), "{cut}");
}

#[test]
fn a_model_that_cannot_be_run_is_refused_with_what_was_expected() {
    let text = |text: &str| Some(Value::String(text.to_owned()));
    insta::assert_snapshot!(refusal(&with_keys(&[("general.architecture", text("gemma2"))])), @"READER-BAD: tiny.gguf: general.architecture is gemma2, expected qwen2 or llama");
    insta::assert_snapshot!(refusal(&with_keys(&[("general.alignment", Some(Value::U32(0)))])), @"READER-BAD: tiny.gguf: general.alignment is 0, expected a power of two up to 65536");
    insta::assert_snapshot!(refusal(&with_keys(&[("qwen2.block_count", None)])), @"READER-BAD: tiny.gguf: qwen2.block_count is missing, expected a 32-bit number from 1 to 256");
    insta::assert_snapshot!(refusal(&with_keys(&[("qwen2.block_count", Some(Value::U32(3)))])), @"READER-BAD: tiny.gguf: blk.2.ffn_gate.weight is missing, expected a tensor of this name");
    insta::assert_snapshot!(refusal(&with_keys(&[("qwen2.attention.head_count", Some(Value::U32(0)))])), @"READER-BAD: tiny.gguf: qwen2.attention.head_count is 0 of type U32, expected a 32-bit number from 1 to 256");
    insta::assert_snapshot!(refusal(&with_keys(&[("qwen2.attention.head_count_kv", Some(Value::U32(1)))])), @"READER-BAD: tiny.gguf: blk.0.attn_k.weight is [32, 64], expected [16, 64]");
    insta::assert_snapshot!(refusal(&with_keys(&[("tokenizer.ggml.model", text("llama"))])), @"READER-BAD: tiny.gguf: tokenizer.ggml.model is llama, expected gpt2, or a file tokenizer.json beside the model");
    insta::assert_snapshot!(refusal(&with_keys(&[("tokenizer.ggml.tokens", Some(Value::Array(vec![])))])), @"READER-BAD: tiny.gguf: the tokenizer is with merge 0, which makes no token, expected tokens and merges of a byte-level tokenizer");
}

#[test]
fn every_cut_and_every_changed_byte_is_an_error_or_a_model_never_a_panic() {
    let file = qwen2();
    let mut rng = Pcg64::seed_from_u64(23);
    let header = Content::read(&mut Cursor::new(file)).unwrap().tensor_data_offset as usize;
    for _ in 0..150 {
        let (_folder, path) = saved(&file[..rng.random_range(0..file.len())]);
        assert!(Reader::load(&path).is_err(), "a cut file loads");
    }
    for _ in 0..150 {
        let mut changed = file.to_vec();
        for _ in 0..rng.random_range(1..4) {
            changed[rng.random_range(0..header)] ^= 1 << rng.random_range(0..8);
        }
        let (_folder, path) = saved(&changed);
        let _ = Reader::load(&path);
    }
}

#[test]
fn a_tokenizer_beside_the_model_is_used_where_the_model_has_none() {
    let (folder, path) = saved(&with_keys(&[("tokenizer.ggml.model", Some(Value::String("other".to_owned())))]));
    let (_kept, whole) = saved(qwen2());
    let content = Content::read(&mut fs::File::open(&whole).unwrap()).unwrap();
    let tokenizer =
        <tokenizers::Tokenizer as candle_core::quantized::tokenizer::TokenizerFromGguf>::from_gguf(&content).unwrap();
    tokenizer.save(folder.path().join("tokenizer.json"), false).unwrap();
    let objects = [cinesplat::language::NamedObject { id: 1, label: "sofa".to_owned() }];
    let question = Question::new("Push in on the sofa.", &objects, &[]);
    let read = |path| program_to_notation(&Reader::load(path).unwrap().read(&question).unwrap().program);
    assert_eq!(read(&path), read(&whole));
    fs::write(folder.path().join("tokenizer.json"), "{}").unwrap();
    assert_eq!(Reader::load(&path).err().unwrap().code(), "READER-BAD");
}

/// The package that reads tokenizers panics at both.
#[test]
fn a_tokenizer_that_is_damaged_in_its_decoder_or_has_a_damaged_table_is_refused() {
    let (folder, path) = saved(&with_keys(&[("tokenizer.ggml.model", Some(Value::String("other".to_owned())))]));
    let refusal = |json: &str| {
        fs::write(folder.path().join("tokenizer.json"), json).unwrap();
        let error = Reader::load(&path).err().expect("a refusal").to_string();
        error.replace(&format!("{}/", folder.path().display()), "")
    };
    let json =
        |parts: &str| format!(r#"{{"version":"1.0",{parts},"model":{{"type":"BPE","vocab":{{}},"merges":[]}}}}"#);
    let damaged = refusal(&json(r#""decoder":{"type":"ByteLevel",0}"#));
    assert!(
        damaged.starts_with("tokenizer.json: the tokenizer is damaged: key must be a string at line 1"),
        "{damaged}"
    );
    let table = r#""normalizer":{"type":"Precompiled","precompiled_charsmap":"AA=="}"#;
    insta::assert_snapshot!(refusal(&json(table)), @"tokenizer.json: the tokenizer is with a packed table of characters, expected a tokenizer.json of this model");
}

#[test]
fn the_command_says_what_is_wrong_with_a_reader() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("words.gguf"), "these are words").unwrap();
    insta::assert_snapshot!(cli::answer(folder.path(), &["read", "-p", "pan left", "--reader", "words.gguf"]), @r#"
    exit 65
    error[READER-BAD]: words.gguf: the start of the file is "thes", expected "GGUF"
    help: give --reader a GGUF file of a Qwen2 or Llama model, or leave it out
    "#);
    insta::assert_snapshot!(cli::answer(folder.path(), &["read", "-p", "pan left", "--reader", "none.gguf"]), @r"
    exit 66
    error[FILE-READ]: none.gguf: cannot read: No such file or directory (os error 2)
    help: check the path
    ");
}
