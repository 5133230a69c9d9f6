//! A trained model as three files side by side.
//!
//! `director.json` describes the other two (sizes, hashes, names of all classes), `director.safetensors` holds the weights
//! as `f16`, and `director.tokenizer.json` holds the vocabulary.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

use candle_core::{Device, Tensor};
use cinesplat_files::{FileError, Limits, sha256_hex};
use half::f16;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use crate::calibration::Calibration;
use crate::error::DirectorError;
use crate::inputs::Vocabulary;
use crate::manifest::{MANIFEST_FILE, Manifest};
use crate::network::ModelConfig;

/// Name of the file with the weights.
const WEIGHTS_FILE: &str = "director.safetensors";
/// Name of the file with the vocabulary.
const TOKENIZER_FILE: &str = "director.tokenizer.json";

/// The bytes of the three files of a model. Nothing is checked before the parts are read.
#[derive(Debug, Clone)]
pub struct ModelFiles {
    manifest: Cow<'static, [u8]>,
    weights: Cow<'static, [u8]>,
    tokenizer: Cow<'static, [u8]>,
}

impl ModelFiles {
    /// Names of the files.
    pub const NAMES: [&str; 3] = [WEIGHTS_FILE, TOKENIZER_FILE, MANIFEST_FILE];

    /// The model that is compiled into the program.
    pub fn embedded() -> Self {
        Self {
            manifest: include_bytes!("../../models/director.json").into(),
            weights: include_bytes!("../../models/director.safetensors").into(),
            tokenizer: include_bytes!("../../models/director.tokenizer.json").into(),
        }
    }

    /// Reads a model; `path` is its folder, or the `director.json` in it.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] for a file above 256 MiB.
    pub fn read(path: &Path) -> Result<Self, DirectorError> {
        let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new(".")) };
        let manifest = if path.is_dir() { path.join(MANIFEST_FILE) } else { path.to_owned() };
        Ok(Self {
            manifest: read_capped(&manifest)?.into(),
            weights: read_capped(&folder.join(WEIGHTS_FILE))?.into(),
            tokenizer: read_capped(&folder.join(TOKENIZER_FILE))?.into(),
        })
    }

    /// The files of a network. `tensors` maps names to shapes and values; values are rounded to `f16`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a part cannot be serialized.
    pub fn pack(
        name: &str,
        config: &ModelConfig,
        vocabulary: &Vocabulary,
        tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>,
    ) -> Result<Self, DirectorError> {
        let weights = pack_tensors(tensors)?;
        let tokenizer = vocabulary.to_json()?.into_bytes();
        let manifest = Manifest::new(name, config, &weights, &tokenizer).to_json()?;
        Ok(Self { manifest: manifest.into(), weights: weights.into(), tokenizer: tokenizer.into() })
    }

    /// The same model with another name and calibration.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] for a bad description.
    pub fn described(self, name: &str, calibration: Calibration) -> Result<Self, DirectorError> {
        let mut manifest = self.manifest()?;
        name.clone_into(&mut manifest.name);
        manifest.calibration = calibration;
        let manifest = manifest.to_json()?;
        Ok(Self { manifest: manifest.into(), ..self })
    }

    /// The model whose weights are the means of those of `models`, which share a vocabulary: several trainings of one network
    /// that started from the same weights (Wortsman et al. 2022, "Model soups"). Not calibrated.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] without models, and for models of different vocabularies, sizes or tensors.
    pub fn mean(models: &[Self], name: &str) -> Result<Self, DirectorError> {
        let expected = &"models of one network and vocabulary";
        let first = models.first().ok_or_else(|| bad_weights(&"no model", expected))?;
        let config = first.manifest()?.config;
        let mut sums: BTreeMap<String, (Vec<usize>, Vec<f32>)> = BTreeMap::new();
        for model in models {
            if model.tokenizer != first.tokenizer || model.manifest()?.config != config {
                return Err(bad_weights(&"another vocabulary or size", expected));
            }
            for (name, tensor) in model.tensors()? {
                let values = tensor.flatten_all()?.to_vec1::<f32>()?;
                let (shape, sum) =
                    sums.entry(name.clone()).or_insert_with(|| (tensor.dims().to_vec(), vec![0.0; values.len()]));
                if shape != tensor.dims() {
                    return Err(bad_weights(&format!("{name} of another shape"), expected));
                }
                sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            }
        }
        for (_, sum) in sums.values_mut() {
            sum.iter_mut().for_each(|sum| *sum /= models.len() as f32);
        }
        Self::pack(name, &config, &first.vocabulary()?, &sums)
    }

    /// Name and bytes of each file, in the order in which they should be written: the description last, so that it never
    /// describes a file that is not there yet.
    pub fn named(&self) -> [(&'static str, &[u8]); 3] {
        [(WEIGHTS_FILE, &self.weights), (TOKENIZER_FILE, &self.tokenizer), (MANIFEST_FILE, &self.manifest)]
    }

    /// SHA-256 of the weights file, hexadecimal.
    pub fn weights_sha256(&self) -> String {
        sha256_hex(&self.weights)
    }

    /// Whether the model has the format and the choices of this program, so that it can run.
    pub fn is_current(&self) -> bool {
        Manifest::from_json(&self.manifest).is_ok()
    }

    /// The vocabulary.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the file is not a tokenizer of this program.
    pub fn vocabulary(&self) -> Result<Vocabulary, DirectorError> {
        Vocabulary::from_json(&self.tokenizer)
    }

    /// All tensors by name, as `f32`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the file is not a safetensors file, or a tensor is neither `f16` nor `f32` or holds
    /// a value that is not finite.
    pub fn tensors(&self) -> Result<BTreeMap<String, Tensor>, DirectorError> {
        read_tensors(&self.weights)
    }

    /// The description, checked against the bytes of the other two files.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] for a bad description, or a file whose hash differs from the described one.
    pub(crate) fn manifest(&self) -> Result<Manifest, DirectorError> {
        let manifest = Manifest::from_json(&self.manifest)?;
        check_hash(WEIGHTS_FILE, &self.weights, &manifest.weights_sha256)?;
        check_hash(TOKENIZER_FILE, &self.tokenizer, &manifest.tokenizer_sha256)?;
        Ok(manifest)
    }
}

pub(crate) fn read_capped(path: &Path) -> Result<Vec<u8>, DirectorError> {
    let failed = |source| DirectorError::Read { path: path.to_owned(), source };
    cinesplat_files::read(path, Limits::DEFAULT.model_bytes).map_err(|error| match error {
        FileError::Read { path, source } => DirectorError::Read { path, source },
        FileError::NotAFile { found, .. } => bad(&path.display(), &found, &"a regular file"),
        FileError::TooLarge { found, expected, .. } => {
            bad(&path.display(), &format!("{found} bytes"), &format!("at most {expected}"))
        }
        error => failed(std::io::Error::other(error)),
    })
}

pub(crate) fn check_hash(file: &str, bytes: &[u8], expected: &str) -> Result<(), DirectorError> {
    let found = sha256_hex(bytes);
    if found == expected { Ok(()) } else { Err(bad(&file, &format!("SHA-256 {found}"), &expected)) }
}

/// All tensors of a safetensors file by name, as `f32`.
pub(crate) fn read_tensors(bytes: &[u8]) -> Result<BTreeMap<String, Tensor>, DirectorError> {
    let file = SafeTensors::deserialize(bytes).map_err(|error| bad_weights(&error, &"a safetensors file"))?;
    file.iter().map(|(name, view)| Ok((name.to_owned(), read_tensor(name, &view)?))).collect()
}

fn read_tensor(name: &str, view: &TensorView<'_>) -> Result<Tensor, DirectorError> {
    let values: Vec<f32> = match view.dtype() {
        Dtype::F16 => view.data().as_chunks::<2>().0.iter().map(|b| f16::from_le_bytes(*b).to_f32()).collect(),
        Dtype::F32 => view.data().as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect(),
        other => return Err(bad(&name, &format!("{other:?}"), &"F16 or F32")),
    };
    if let Some(at) = values.iter().position(|value| !value.is_finite()) {
        return Err(bad(&name, &format!("{} at {at}", values[at]), &"finite numbers"));
    }
    Ok(Tensor::from_vec(values, view.shape(), &Device::Cpu)?)
}

pub(crate) fn pack_tensors(tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>) -> Result<Vec<u8>, DirectorError> {
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
    views
        .and_then(|views| safetensors::serialize(views, None))
        .map_err(|error| bad_weights(&error, &"tensors that can be written"))
}

/// The error for a bad weights file.
pub(crate) fn bad_weights(found: &dyn std::fmt::Display, expected: &dyn std::fmt::Display) -> DirectorError {
    bad(&WEIGHTS_FILE, found, expected)
}

/// The error for a bad tokenizer file.
pub(crate) fn bad_tokenizer(found: &dyn std::fmt::Display, expected: &dyn std::fmt::Display) -> DirectorError {
    bad(&TOKENIZER_FILE, found, expected)
}

pub(crate) fn bad(
    part: &dyn std::fmt::Display,
    found: &dyn std::fmt::Display,
    expected: &dyn std::fmt::Display,
) -> DirectorError {
    DirectorError::BadModel { part: part.to_string(), found: found.to_string(), expected: expected.to_string() }
}
