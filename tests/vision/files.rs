//! Folders that hold no network that can be run, and pictures that do not fit.

use std::collections::HashMap;
use std::path::Path;

use candle_core::{DType, Device, Tensor};
use cinesplat::vision::Dino;

use super::{TINY, tensors};

/// Code and message of the refusal of the tiny network with a changed configuration and changed weights.
fn refusal(config: impl Fn(String) -> String, weights: impl Fn(&mut HashMap<String, Tensor>)) -> String {
    let folder = tempfile::tempdir().unwrap();
    let text = config(std::fs::read_to_string(Path::new(TINY).join("config.json")).unwrap());
    std::fs::write(folder.path().join("config.json"), text).unwrap();
    let mut tensors = tensors("model.safetensors");
    weights(&mut tensors);
    candle_core::safetensors::save(&tensors, folder.path().join("model.safetensors")).unwrap();
    told(folder.path())
}

/// Code and message of the refusal of a folder.
fn told(folder: &Path) -> String {
    let error = Dino::load(folder).err().expect("a refusal");
    format!("{}: {}", error.code(), error.to_string().replace(&folder.display().to_string(), "DIR"))
}

/// The refusal of a configuration in which one text is another one.
fn with(from: &str, to: &str) -> String {
    let changed = |text: String| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    };
    refusal(changed, |_| ())
}

#[test]
fn a_missing_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    assert!(told(folder.path()).contains("config.json"), "{}", told(folder.path()));
    std::fs::copy(Path::new(TINY).join("config.json"), folder.path().join("config.json")).unwrap();
    assert!(told(folder.path()).contains("model.safetensors"), "{}", told(folder.path()));
    std::fs::write(folder.path().join("model.safetensors"), "not weights at all").unwrap();
    assert!(
        told(folder.path()).starts_with("VISION-BAD: DIR/model.safetensors: the file is "),
        "{}",
        told(folder.path())
    );
}

#[test]
fn another_kind_of_network_is_refused_by_its_key() {
    insta::assert_snapshot!(refusal(|_| "{".to_owned(), |_| ()), @"VISION-BAD: DIR/config.json: the text is EOF while parsing an object at line 1 column 1, expected JSON of a network's sizes");
    insta::assert_snapshot!(refusal(|_| "[]".to_owned(), |_| ()), @r#"VISION-BAD: DIR/config.json: model_type is missing, expected "dinov2""#);
    insta::assert_snapshot!(with("\"dinov2\"", "\"dinov2_with_registers\""), @r#"VISION-BAD: DIR/config.json: model_type is "dinov2_with_registers", expected "dinov2""#);
    insta::assert_snapshot!(with("\"use_swiglu_ffn\": false", "\"use_swiglu_ffn\": true"), @"VISION-BAD: DIR/config.json: use_swiglu_ffn is true, expected false");
    insta::assert_snapshot!(with("\"num_attention_heads\": 2", "\"num_attention_heads\": 5"), @"VISION-BAD: DIR/config.json: num_attention_heads is 5, expected a divisor of hidden_size, 32");
    insta::assert_snapshot!(with("\"patch_size\": 14", "\"patch_size\": 0"), @"VISION-BAD: DIR/config.json: patch_size is 0, expected a whole number 1..16384");
    insta::assert_snapshot!(with("\"hidden_size\": 32", "\"hidden_size\": 1e30"), @"VISION-BAD: DIR/config.json: hidden_size is 1e+30, expected a whole number 1..16384");
    insta::assert_snapshot!(with("\"num_hidden_layers\"", "\"layers\""), @"VISION-BAD: DIR/config.json: num_hidden_layers is missing, expected a whole number 1..16384");
}

#[test]
fn weights_that_do_not_fit_are_refused_by_their_name() {
    let without = |name: &'static str| refusal(|text| text, |tensors| drop(tensors.remove(name).unwrap()));
    insta::assert_snapshot!(without("embeddings.cls_token"), @"VISION-BAD: DIR/model.safetensors: embeddings.cls_token is missing, expected a tensor [1, 1, 32]");
    insta::assert_snapshot!(without("encoder.layer.1.mlp.fc2.bias"), @"VISION-BAD: DIR/model.safetensors: encoder.layer.1.mlp.fc2.bias is missing, expected a tensor [32]");
    insta::assert_snapshot!(with("\"num_hidden_layers\": 2", "\"num_hidden_layers\": 3"), @"VISION-BAD: DIR/model.safetensors: encoder.layer.2.norm1.weight is missing, expected a tensor [32]");
    insta::assert_snapshot!(with("\"image_size\": 42", "\"image_size\": 518"), @"VISION-BAD: DIR/model.safetensors: embeddings.position_embeddings is [1, 10, 32], expected [1, 1370, 32] by config.json");
    let poisoned = |tensors: &mut HashMap<String, Tensor>| {
        let hole = Tensor::full(f32::NAN, 32, &Device::Cpu).unwrap().to_dtype(DType::F16).unwrap();
        tensors.insert("layernorm.bias".to_owned(), hole).unwrap();
    };
    insta::assert_snapshot!(refusal(|text| text, poisoned), @"VISION-BAD: DIR/model.safetensors: layernorm.bias is of absolute sum NaN, expected finite numbers");
}

#[test]
fn pictures_of_broken_patches_are_refused() {
    let dino = Dino::load(Path::new(TINY)).unwrap();
    let told = |num_bytes: usize, size_px| dino.patches(&vec![0; num_bytes], size_px).unwrap_err().to_string();
    insta::assert_snapshot!(told(28 * 30 * 3, [30, 28]), @"a picture of 30 x 28 px in 2520 bytes, expected sides of whole patches of 14 px");
    insta::assert_snapshot!(told(28 * 28, [28, 28]), @"a picture of 28 x 28 px in 784 bytes, expected sides of whole patches of 14 px");
    insta::assert_snapshot!(told(0, [0, 0]), @"a picture of 0 x 0 px in 0 bytes, expected sides of whole patches of 14 px");
}
