//! Trained weights as files, and the checks before they are believed.
//!
//! A model is three files side by side: `director.json` says what the other two are (sizes, hashes, names of all
//! choices), `director.safetensors` holds the numbers in `f16`, `director.tokenizer.json` the vocabulary.

use std::collections::BTreeMap;
use std::path::Path;
use strum::VariantArray;

use candle_core::{Device, Tensor};
use cinesplat_files::sha256_hex;
use half::f16;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::{Deserialize, Serialize};

use super::DirectorError;
use super::model::{ModelConfig, Network, Parameters};
use super::vocabulary::Vocabulary;
use cinesplat_operator::{Pass, Speed, SubjectPart};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};

/// Name of the file that describes a model.
pub const MANIFEST_FILE: &str = "director.json";
/// Name of the file with the numbers.
pub const WEIGHTS_FILE: &str = "director.safetensors";
/// Name of the file with the vocabulary.
pub const TOKENIZER_FILE: &str = "director.tokenizer.json";
/// Version of the three files that this program reads and writes.
const VERSION: u32 = 1;
/// No file of a model is larger than this.
const MAX_FILE_BYTES: u64 = 256 << 20;

/// What a model's files are.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    format: String,
    version: u32,
    /// Name of the model, as shots carry it.
    pub name: String,
    /// Sizes of the network.
    pub config: ModelConfig,
    /// Names of all classes in order, so that weights of other choices are refused.
    choices: Vec<String>,
    /// SHA-256 of the file with the numbers, hex.
    pub weights_sha256: String,
    tokenizer_sha256: String,
}

/// The three files of a model in memory.
#[derive(Debug, Clone)]
pub struct ModelFiles<'a> {
    pub manifest: std::borrow::Cow<'a, [u8]>,
    pub weights: std::borrow::Cow<'a, [u8]>,
    pub tokenizer: std::borrow::Cow<'a, [u8]>,
}

/// The model that is part of the program.
pub fn embedded() -> ModelFiles<'static> {
    ModelFiles {
        manifest: include_bytes!("../../models/director.json").into(),
        weights: include_bytes!("../../models/director.safetensors").into(),
        tokenizer: include_bytes!("../../models/director.tokenizer.json").into(),
    }
}

impl ModelFiles<'static> {
    /// Reads a model: `path` is its folder, or its `director.json`.
    pub fn read(path: &Path) -> Result<Self, DirectorError> {
        let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new(".")) };
        let manifest = if path.is_dir() { path.join(MANIFEST_FILE) } else { path.to_owned() };
        Ok(Self {
            manifest: read_capped(&manifest)?.into(),
            weights: read_capped(&folder.join(WEIGHTS_FILE))?.into(),
            tokenizer: read_capped(&folder.join(TOKENIZER_FILE))?.into(),
        })
    }
}

fn read_capped(path: &Path) -> Result<Vec<u8>, DirectorError> {
    let failed = |source| DirectorError::Read { path: path.to_owned(), source };
    let num_bytes = std::fs::metadata(path).map_err(failed)?.len();
    if num_bytes > MAX_FILE_BYTES {
        return Err(bad(&path.display(), format!("{num_bytes} bytes"), format!("at most {MAX_FILE_BYTES}")));
    }
    std::fs::read(path).map_err(failed)
}

/// A network with its vocabulary and description.
#[derive(Debug, Clone)]
pub struct Model {
    pub manifest: Manifest,
    pub vocabulary: Vocabulary,
    pub network: Network,
}

impl Model {
    /// Builds the network that files describe, after checking all of them: format, version, hashes, choices, names,
    /// shapes, types and values of the tensors, and that no tensor is left over.
    pub fn load(files: &ModelFiles<'_>) -> Result<Self, DirectorError> {
        let manifest: Manifest = serde_json::from_slice(&files.manifest)
            .map_err(|error| bad(&MANIFEST_FILE, error, "a description of version 1"))?;
        check_manifest(&manifest)?;
        check_hash(WEIGHTS_FILE, &files.weights, &manifest.weights_sha256)?;
        check_hash(TOKENIZER_FILE, &files.tokenizer, &manifest.tokenizer_sha256)?;
        let vocabulary = Vocabulary::from_json(&files.tokenizer)?;
        if vocabulary.size() != manifest.config.vocabulary {
            let expected = format!("{} tokens", manifest.config.vocabulary);
            return Err(bad(&TOKENIZER_FILE, format!("{} tokens", vocabulary.size()), expected));
        }
        let mut parameters = Parameters::Stored { tensors: read_tensors(&files.weights)? };
        let network = Network::new(&mut parameters, &manifest.config)
            .map_err(|error| bad(&WEIGHTS_FILE, error, "the tensors that the description calls for"))?;
        match parameters {
            Parameters::Stored { tensors } if !tensors.is_empty() => {
                let names: Vec<String> = tensors.into_keys().collect();
                Err(bad(&WEIGHTS_FILE, format!("unknown tensors {names:?}"), "none beyond the description"))
            }
            _ => Ok(Self { manifest, vocabulary, network }),
        }
    }
}

fn check_manifest(manifest: &Manifest) -> Result<(), DirectorError> {
    if manifest.format != "cinesplat.director" {
        return Err(bad(&MANIFEST_FILE, format!("format {:?}", manifest.format), "\"cinesplat.director\""));
    }
    if manifest.version != VERSION {
        return Err(bad(&MANIFEST_FILE, format!("version {}", manifest.version), format!("version {VERSION}")));
    }
    if !manifest.config.is_sound() {
        return Err(bad(&MANIFEST_FILE, format!("{:?}", manifest.config), "sizes of a network"));
    }
    if manifest.choices != choices() {
        return Err(bad(&MANIFEST_FILE, "choices of another version", "the moves, sizes and angles of this program"));
    }
    Ok(())
}

fn check_hash(part: &str, bytes: &[u8], expected: &str) -> Result<(), DirectorError> {
    let found = sha256_hex(bytes);
    if found == expected { Ok(()) } else { Err(bad(&part, format!("SHA-256 {found}"), expected)) }
}

/// Names of all classes, in the order in which the heads put them out.
fn choices() -> Vec<String> {
    let moves = Move::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let sizes = ShotSize::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let angles = ShotAngle::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let easings = Easing::VOCABULARY.iter().map(|choice| choice.as_ref().to_owned());
    let parts = SubjectPart::VARIANTS.iter().map(|choice| format!("{choice:?}"));
    let passes = Pass::VARIANTS.iter().map(|choice| format!("{choice:?}"));
    let speeds = Speed::VARIANTS.iter().map(|choice| format!("{choice:?}"));
    moves.chain(sizes).chain(angles).chain(easings).chain(parts).chain(passes).chain(speeds).collect()
}

/// The tensors of a model's files, after the checks of [`Model::load`].
pub fn read_weights(files: &ModelFiles<'_>) -> Result<BTreeMap<String, Tensor>, DirectorError> {
    Model::load(files)?;
    read_tensors(&files.weights)
}

/// The tensors of a file, `f16` or `f32`, every number finite.
fn read_tensors(bytes: &[u8]) -> Result<BTreeMap<String, Tensor>, DirectorError> {
    let file = SafeTensors::deserialize(bytes).map_err(|error| bad(&WEIGHTS_FILE, error, "a safetensors file"))?;
    file.iter().map(|(name, view)| Ok((name.to_owned(), read_tensor(name, &view)?))).collect()
}

fn read_tensor(name: &str, view: &TensorView<'_>) -> Result<Tensor, DirectorError> {
    let values: Vec<f32> = match view.dtype() {
        Dtype::F16 => view.data().as_chunks::<2>().0.iter().map(|b| f16::from_le_bytes(*b).to_f32()).collect(),
        Dtype::F32 => view.data().as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect(),
        other => return Err(bad(&name, format!("{other:?}"), "F16 or F32")),
    };
    if let Some(at) = values.iter().position(|value| !value.is_finite()) {
        return Err(bad(&name, format!("{} at {at}", values[at]), "finite numbers"));
    }
    Ok(Tensor::from_vec(values, view.shape(), &Device::Cpu)?)
}

#[allow(clippy::needless_pass_by_value, reason = "callers make the texts where they call")]
fn bad(part: &dyn std::fmt::Display, found: impl ToString, expected: impl ToString) -> DirectorError {
    DirectorError::BadModel { part: part.to_string(), found: found.to_string(), expected: expected.to_string() }
}

/// The three files of a network, its numbers rounded to `f16`.
pub fn pack(
    name: &str,
    config: &ModelConfig,
    vocabulary: &Vocabulary,
    tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>,
) -> Result<ModelFiles<'static>, DirectorError> {
    let halves: BTreeMap<&String, (&Vec<usize>, Vec<u8>)> = tensors
        .iter()
        .map(|(name, (shape, values))| {
            (name, (shape, values.iter().flat_map(|value| f16::from_f32(*value).to_le_bytes()).collect()))
        })
        .collect();
    let views = halves
        .iter()
        .map(|(name, (shape, bytes))| Ok((*name, TensorView::new(Dtype::F16, (*shape).clone(), bytes)?)))
        .collect::<Result<Vec<_>, safetensors::SafeTensorError>>();
    let weights = views
        .and_then(|views| safetensors::serialize(views, None))
        .map_err(|error| bad(&WEIGHTS_FILE, error, "tensors that can be written"))?;
    let tokenizer = vocabulary.to_json()?.into_bytes();
    let manifest = Manifest {
        format: "cinesplat.director".into(),
        version: VERSION,
        name: name.into(),
        config: config.clone(),
        choices: choices(),
        weights_sha256: sha256_hex(&weights),
        tokenizer_sha256: sha256_hex(&tokenizer),
    };
    let manifest = serde_json::to_vec_pretty(&manifest).map_err(|error| bad(&MANIFEST_FILE, error, "JSON"))?;
    Ok(ModelFiles { manifest: manifest.into(), weights: weights.into(), tokenizer: tokenizer.into() })
}
