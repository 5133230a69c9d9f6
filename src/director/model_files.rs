//! A trained model as three files side by side.
//!
//! `director.json` describes the other two (sizes, hashes, names of all classes), `director.safetensors` holds the weights,
//! and `director.tokenizer.json` holds the vocabulary.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use candle_core::Tensor;
use cinesplat_files::{FileError, Limits, sha256_hex};

use crate::calibration::Calibration;
use crate::error::DirectorError;
use crate::inputs::{TOKENIZER_FILE, Vocabulary};
use crate::manifest::{MANIFEST_FILE, Manifest};
use crate::network::ModelConfig;
use crate::tensor_file::{Packing, WEIGHTS_FILE, bad, bad_weights, pack_tensors, read_tensors};

/// The bytes of the three files of a model. Nothing is checked before the parts are read.
#[derive(Debug, Clone)]
pub struct ModelFiles {
    manifest: Cow<'static, [u8]>,
    weights: Cow<'static, [u8]>,
    tokenizer: Cow<'static, [u8]>,
}

/// The files of a folder in `models` that are compiled into the program.
macro_rules! embedded {
    ($folder:literal) => {
        ModelFiles {
            manifest: include_bytes!(concat!("../../models/", $folder, "director.json")).into(),
            weights: include_bytes!(concat!("../../models/", $folder, "director.safetensors")).into(),
            tokenizer: include_bytes!(concat!("../../models/", $folder, "director.tokenizer.json")).into(),
        }
    };
}

impl ModelFiles {
    /// Names of the files.
    pub const NAMES: [&str; 3] = [WEIGHTS_FILE, TOKENIZER_FILE, MANIFEST_FILE];

    /// The model that is compiled into the program.
    pub fn embedded() -> Self {
        embedded!("")
    }

    /// The models that are compiled into the program, the first one first.
    pub fn embedded_all() -> [Self; 3] {
        [Self::embedded(), embedded!("director-6/"), embedded!("director-8/")]
    }

    /// Reads a model and those in the folders beside its files, in the order of their names; `path` is the folder, or the
    /// `director.json` in it.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn read_all(path: &Path) -> Result<Vec<Self>, DirectorError> {
        let folder = folder_of(path);
        let mut models = vec![Self::read(path)?];
        let failed = |source| DirectorError::Read { path: folder.to_owned(), source };
        let entries = std::fs::read_dir(folder).map_err(failed)?.collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let mut folders: Vec<PathBuf> =
            entries.iter().map(std::fs::DirEntry::path).filter(|path| path.join(MANIFEST_FILE).is_file()).collect();
        folders.sort();
        for folder in folders {
            models.push(Self::read(&folder)?);
        }
        Ok(models)
    }

    /// Reads a model; `path` is its folder, or the `director.json` in it.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] for a file above 256 MiB.
    pub fn read(path: &Path) -> Result<Self, DirectorError> {
        let folder = folder_of(path);
        let manifest = if path.is_dir() { path.join(MANIFEST_FILE) } else { path.to_owned() };
        Ok(Self {
            manifest: read_capped(&manifest)?.into(),
            weights: read_capped(&folder.join(WEIGHTS_FILE))?.into(),
            tokenizer: read_capped(&folder.join(TOKENIZER_FILE))?.into(),
        })
    }

    /// The files of a network. `tensors` maps names to shapes and values; values are rounded.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a part cannot be serialized.
    pub fn pack(
        name: &str,
        config: &ModelConfig,
        vocabulary: &Vocabulary,
        tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>,
    ) -> Result<Self, DirectorError> {
        let weights = pack_tensors(tensors, Packing::Training)?;
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

    /// The same model in about half the bytes: its matrices have 8.5 bits a number; those of BERT 4.5, and those above it 6.6.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] for a damaged model, or one whose tensors cannot be serialized.
    pub fn compact(self) -> Result<Self, DirectorError> {
        let mut manifest = self.manifest()?;
        let values = |(name, tensor): (String, Tensor)| {
            Ok((name, (tensor.dims().to_vec(), tensor.flatten_all()?.to_vec1::<f32>()?)))
        };
        let tensors = self.tensors()?.into_iter().map(values).collect::<Result<_, DirectorError>>()?;
        let weights = pack_tensors(&tensors, Packing::Compact)?;
        manifest.weights_sha256 = sha256_hex(&weights);
        Ok(Self { manifest: manifest.to_json()?.into(), weights: weights.into(), ..self })
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

    /// The sizes of the network.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] for a bad description, or files that it does not describe.
    pub fn config(&self) -> Result<ModelConfig, DirectorError> {
        Ok(self.manifest()?.config)
    }

    /// All tensors by name, as `f32`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the file is not a safetensors file, or a tensor has another type than this program
    /// writes, or holds a value that is not finite.
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

/// The folder of a model; `path` is that, or a file in it.
pub(crate) fn folder_of(path: &Path) -> &Path {
    if path.is_dir() { path } else { path.parent().unwrap_or(Path::new(".")) }
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

/// The error for a bad tokenizer file.
pub(crate) fn bad_tokenizer(found: &dyn std::fmt::Display, expected: &dyn std::fmt::Display) -> DirectorError {
    bad(&TOKENIZER_FILE, found, expected)
}
