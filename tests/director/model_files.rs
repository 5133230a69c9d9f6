//! The three files of a model: every kind of damage has an error that names it.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;

use cinesplat::director::inputs::Vocabulary;
use cinesplat::director::network::{BertConfig, ModelConfig, Network, Parameters};
use cinesplat::director::{Director, ModelFiles, SceneContext};
use cinesplat::files::sha256_hex;
use cinesplat::language::sense_names;
use cinesplat::training::{TrainSettings, train};
use glam::DVec3;

use crate::cli::run;

/// The folder of a model that was trained for one step.
fn model() -> tempfile::TempDir {
    let out = tempfile::tempdir().unwrap();
    let settings = TrainSettings {
        steps: 1,
        batch: 2,
        corpus: 60,
        vocabulary: 260,
        evaluation_prompts: 0,
        ..TrainSettings::default()
    };
    train(&settings, out.path(), &mut |_| ControlFlow::Continue(())).unwrap();
    out
}

/// Code and message of the error that loading gives after a change of one file. The file gets its old content back.
fn edit(folder: &Path, file: &str, change: impl Fn(&mut Vec<u8>)) -> (&'static str, String) {
    let path = folder.join(file);
    let kept = std::fs::read(&path).unwrap();
    let mut bytes = kept.clone();
    change(&mut bytes);
    std::fs::write(&path, &bytes).unwrap();
    let error = Director::load(folder).expect_err("a damaged model was loaded");
    std::fs::write(&path, kept).unwrap();
    (error.code(), error.to_string())
}

fn replace(bytes: &mut Vec<u8>, from: &str, to: &str) {
    *bytes = String::from_utf8(bytes.clone()).unwrap().replace(from, to).into_bytes();
}

#[test]
fn a_written_model_loads_and_damage_is_named() {
    let model = model();
    let folder = model.path();
    assert_eq!(
        Director::load(folder).unwrap().model_ref(),
        Director::load(&folder.join("director.json")).unwrap().model_ref()
    );
    let manifest =
        |from: &'static str, to: &'static str| edit(folder, "director.json", |bytes| replace(bytes, from, to));
    let (code, message) = manifest("\"version\": 2", "\"version\": 1");
    assert_eq!(code, "MODEL-BAD");
    assert!(message.contains("version 2") && message.contains("version 1"), "{message}");
    assert!(manifest("cinesplat.director", "other").1.contains("format"));
    assert!(manifest("push-in", "push-on").1.contains("choices"));
    assert!(manifest("\"heads\": 4", "\"heads\": 5").1.contains("sizes"));
    // The description disagrees with the weights.
    assert!(manifest("\"hidden\": 512", "\"hidden\": 256").1.contains("shape"));
    assert!(manifest("\"text_layers\": 3", "\"text_layers\": 2").1.contains("unknown tensors"));
    assert!(manifest("\"text_layers\": 3", "\"text_layers\": 4").1.contains("missing"));
    // One changed bit, a truncated file, an appended byte.
    assert!(edit(folder, "director.safetensors", |bytes| *bytes.last_mut().unwrap() ^= 1).1.contains("SHA-256"));
    assert!(edit(folder, "director.safetensors", |bytes| bytes.truncate(1000)).1.contains("SHA-256"));
    assert!(edit(folder, "director.tokenizer.json", |bytes| bytes.push(b' ')).1.contains("SHA-256"));
}

#[test]
fn weights_that_change_after_they_were_read_change_nothing() {
    let model = model();
    let (again, director) = (Director::load(model.path()).unwrap(), Director::load(model.path()).unwrap());
    for file in std::fs::read_dir(model.path()).unwrap() {
        std::fs::write(file.unwrap().path(), b"").unwrap();
    }
    assert!(Director::load(model.path()).is_err());
    let linked = |director: &Director| director.link("push in slowly, then pan left", &[]).unwrap();
    assert_eq!(director.model_ref(), again.model_ref());
    assert_eq!(format!("{:?}", linked(&director)), format!("{:?}", linked(&again)));
}

/// Writes a file of a model, and its hash into the description of the model.
fn write_with_hash(folder: &Path, file: &str, bytes: &[u8]) {
    let before = sha256_hex(&std::fs::read(folder.join(file)).unwrap());
    std::fs::write(folder.join(file), bytes).unwrap();
    let manifest = folder.join("director.json");
    let text = std::fs::read_to_string(&manifest).unwrap().replace(&before, &sha256_hex(bytes));
    std::fs::write(&manifest, text).unwrap();
}

#[test]
fn infinite_weights_are_rejected_even_if_the_hash_fits() {
    let model = model();
    let mut bytes = std::fs::read(model.path().join("director.safetensors")).unwrap();
    // The last value becomes infinity: 0x7c00 in half precision, little-endian.
    let end = bytes.len();
    bytes[end - 2..].copy_from_slice(&[0x00, 0x7c]);
    write_with_hash(model.path(), "director.safetensors", &bytes);
    let error = Director::load(model.path()).unwrap_err();
    assert!(error.to_string().contains("inf") && error.to_string().contains("finite"), "{error}");
}

#[test]
fn weights_whose_outputs_overflow_are_bad_data_and_no_program() {
    for (damaged, expected) in [("intent.", "scores of a key"), ("pose.", "poses")] {
        let model = model();
        let tensors = ModelFiles::read(model.path()).unwrap().tensors().unwrap();
        let changed = tensors.iter().map(|(name, tensor)| {
            let is_damaged = name.starts_with(damaged) && name.ends_with(".weight");
            (name.clone(), if is_damaged { (tensor.sign().unwrap() * 3e38).unwrap() } else { tensor.clone() })
        });
        let path = model.path().join("changed.safetensors");
        candle_core::safetensors::save(&changed.collect(), &path).unwrap();
        write_with_hash(model.path(), "director.safetensors", &std::fs::read(&path).unwrap());
        let director = Director::load(model.path()).unwrap();
        let linked = director.link("push in slowly, then pan left", &[]).unwrap();
        let scene = SceneContext { objects: &[], up: DVec3::Y, center: DVec3::ZERO, size: 4.0 };
        let error = director.direct(&linked, &scene).unwrap_err();
        assert_eq!(error.code(), "MODEL-NOT-FINITE");
        assert!(
            error.to_string().starts_with(&format!("director.safetensors: the network's {expected} hold")),
            "{error}"
        );
        let output = run(model.path(), &["read", "-p", "push in slowly, then pan left", "--model", "."]);
        assert_eq!(output.status.code(), Some(65));
    }
}

#[test]
fn a_missing_model_is_a_read_error() {
    let error = Director::load(Path::new("/nowhere/director.json")).unwrap_err();
    assert_eq!(error.code(), "MODEL-READ");
}

#[test]
fn the_mean_of_models_has_the_mean_weights() {
    let [one, other] = [3, 4].map(|seed| {
        let out = tempfile::tempdir().unwrap();
        let settings = TrainSettings {
            seed,
            steps: 1,
            batch: 2,
            corpus: 60,
            vocabulary: 260,
            evaluation_prompts: 0,
            from: Some("models".into()),
            ..TrainSettings::default()
        };
        train(&settings, out.path(), &mut |_| ControlFlow::Continue(())).unwrap();
        ModelFiles::read(out.path()).unwrap()
    });
    let mean = ModelFiles::mean(&[one.clone(), other.clone()], "mean").unwrap();
    let values = |files: &ModelFiles| {
        // The matrices of BERT are rounded more, with a bound of their own (see below).
        let tensors = files.tensors().unwrap().into_iter().filter(|(name, _)| !name.starts_with("bert."));
        let values = tensors.map(|(_, tensor)| tensor.flatten_all().unwrap().to_vec1::<f32>().unwrap());
        values.collect::<Vec<_>>().concat()
    };
    let (a, b, mean_values) = (values(&one), values(&other), values(&mean));
    assert!(a != b);
    for ((a, b), mean) in a.iter().zip(&b).zip(&mean_values) {
        // The weights are stored as f16.
        assert!((0.5 * (a + b) - mean).abs() <= 1e-7 + 1e-3 * mean.abs(), "{a}, {b}: {mean}");
    }
    Director::from_files(&mean).unwrap();
    let small = model();
    let small = ModelFiles::read(small.path()).unwrap();
    assert!(ModelFiles::mean(&[one, small], "mean").is_err());
    assert!(ModelFiles::mean(&[], "mean").is_err());
}

/// Shapes and values by name.
type Arrays = BTreeMap<String, (Vec<usize>, Vec<f32>)>;

/// Tensors of a network with BERT, its weights and a small vocabulary.
fn with_bert() -> (ModelConfig, Vocabulary, Arrays) {
    let vocabulary = Vocabulary::of_word_pieces(&["push".to_owned(), "##ing".to_owned()]).unwrap();
    let bert = BertConfig { width: 32, heads: 2, hidden: 64, layers: 1, positions: 256 };
    let config = ModelConfig { bert: Some(bert), ..ModelConfig::tiny(vocabulary.size(), sense_names().unwrap().len()) };
    let mut parameters = Parameters::seeded(3);
    Network::new(&mut parameters, &config).unwrap();
    let Parameters::Fresh { vars, .. } = parameters else { panic!("fresh parameters") };
    let values = |var: &candle_core::Var| var.flatten_all().unwrap().to_vec1().unwrap();
    let tensors = vars.iter().map(|(name, var)| (name.clone(), (var.dims().to_vec(), values(var)))).collect();
    (config, vocabulary, tensors)
}

#[test]
fn matrices_of_bert_are_kept_in_blocks_and_all_others_in_halves() {
    let (config, vocabulary, tensors) = with_bert();
    let files = ModelFiles::pack("small", &config, &vocabulary, &tensors).unwrap();
    let again = ModelFiles::pack("small", &config, &vocabulary, &tensors).unwrap();
    assert_eq!(files.weights_sha256(), again.weights_sha256());
    let read = files.tensors().unwrap();
    assert_eq!(read.len(), tensors.len());
    let mut in_blocks = 0;
    for (name, (shape, values)) in &tensors {
        assert_eq!(read[name].dims(), shape, "{name}");
        let found = read[name].flatten_all().unwrap().to_vec1::<f32>().unwrap();
        let largest = values.iter().fold(0.0_f32, |largest, value| largest.max(value.abs()));
        let off = values.iter().zip(&found).fold(0.0_f32, |off, (value, found)| off.max((value - found).abs()));
        // Blocks have 64 steps from end to end, halves 2048 from 0 to the value.
        let bound = if name.starts_with("bert.") && shape.len() == 2 { 1.0 / 30.0 } else { 1.0 / 2000.0 };
        in_blocks += usize::from(off > largest / 2000.0);
        assert!(off <= largest * bound, "{name}: {off} of {largest}");
    }
    assert!(in_blocks >= 5, "{in_blocks}");
}

#[test]
fn a_compact_model_keeps_its_values_in_about_half_the_bytes() {
    let (config, vocabulary, tensors) = with_bert();
    let files = ModelFiles::pack("small", &config, &vocabulary, &tensors).unwrap();
    let compact = files.clone().compact().unwrap();
    assert_eq!(compact.weights_sha256(), files.clone().compact().unwrap().weights_sha256());
    let bytes = |files: &ModelFiles| files.named()[0].1.len();
    assert!(bytes(&compact) * 10 < bytes(&files) * 7, "{} of {}", bytes(&compact), bytes(&files));
    assert_eq!(compact.config().unwrap(), config);
    let read = compact.tensors().unwrap();
    for (name, (shape, values)) in &tensors {
        assert_eq!(read[name].dims(), shape, "{name}");
        let found = read[name].flatten_all().unwrap().to_vec1::<f32>().unwrap();
        let largest = values.iter().fold(0.0_f32, |largest, value| largest.max(value.abs()));
        let off = values.iter().zip(&found).fold(0.0_f32, |off, (value, found)| off.max((value - found).abs()));
        // 16 steps from end to end in BERT, 64 above it.
        let bound = match shape.len() {
            2 if name.starts_with("bert.") => 1.0 / 7.0,
            2 => 1.0 / 30.0,
            _ => 1.0 / 2000.0,
        };
        assert!(off <= largest * bound, "{name}: {off} of {largest}");
    }
}

#[test]
fn folders_of_models_in_a_folder_are_further_networks() {
    let [first, second, ..] = ModelFiles::embedded_all();
    let folder = tempfile::tempdir().unwrap();
    let write = |folder: &Path, files: &ModelFiles| {
        std::fs::create_dir_all(folder).unwrap();
        files.named().iter().for_each(|(name, bytes)| std::fs::write(folder.join(name), bytes).unwrap());
    };
    write(folder.path(), &first);
    let alone = Director::load(folder.path()).unwrap();
    write(&folder.path().join("another"), &second);
    let both = Director::load(folder.path()).unwrap();
    let [alone_ref, both_ref] = [alone.model_ref(), both.model_ref()];
    assert_eq!(both_ref.name, format!("{}+director-6", alone_ref.name));
    assert_ne!(both_ref.sha256, alone_ref.sha256);
    std::fs::write(folder.path().join("another/director.safetensors"), b"damaged").unwrap();
    assert_eq!(Director::load(folder.path()).unwrap_err().code(), "MODEL-BAD");
}

#[test]
fn blocks_of_another_size_are_refused() {
    let (config, vocabulary, tensors) = with_bert();
    let files = ModelFiles::pack("small", &config, &vocabulary, &tensors).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files.named() {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let weights = folder.path().join("director.safetensors");
    for (from, to) in [
        ("[32,64]", "[32,99]"),
        ("[32,64]", "[32,32]"),
        ("\\\"bert.0.up.weight\\\"", "\\\"bert.0.un.weight\\\""),
        ("q6_k", "q9_k"),
    ] {
        let bytes = std::fs::read(&weights).unwrap();
        let changed = replaced(&bytes, from.as_bytes(), to.as_bytes());
        assert_ne!(bytes, changed, "{from}");
        let damaged = tempfile::tempdir().unwrap();
        for name in ModelFiles::NAMES {
            std::fs::copy(folder.path().join(name), damaged.path().join(name)).unwrap();
        }
        std::fs::write(damaged.path().join("director.safetensors"), changed).unwrap();
        let error = ModelFiles::read(damaged.path()).unwrap().tensors().unwrap_err();
        assert_eq!(error.code(), "MODEL-BAD", "{from}: {error}");
        assert!(error.to_string().contains("bert.0."), "{from}: {error}");
    }
}

/// The bytes with the first `from` replaced by `to`, which is as long.
fn replaced(bytes: &[u8], from: &[u8], to: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    if let Some(at) = bytes.windows(from.len()).position(|window| window == from) {
        bytes[at..at + from.len()].copy_from_slice(to);
    }
    bytes
}
