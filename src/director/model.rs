//! A trained model in memory, built from checked files.

use crate::calibration::Calibration;
use crate::error::DirectorError;
use crate::inputs::Vocabulary;
use crate::model_files::{ModelFiles, bad_tokenizer};
use crate::network::{ModelConfig, Network, Parameters};
use crate::tensor_file::{bad_weights, reason};

/// A network with its vocabulary.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    /// Name, as shots store it.
    pub(crate) name: String,
    /// SHA-256 of the weights file, hexadecimal.
    pub(crate) weights_sha256: String,
    pub(crate) config: ModelConfig,
    pub(crate) vocabulary: Vocabulary,
    pub(crate) calibration: Calibration,
    pub(crate) network: Network,
}

impl Model {
    /// Builds the network that the files describe, after checking format, version, hashes, classes, and the names, shapes,
    /// types and values of all tensors. A tensor that the network does not use is an error.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] naming the file, field or tensor.
    pub(crate) fn load(files: &ModelFiles) -> Result<Self, DirectorError> {
        let manifest = files.manifest()?;
        let vocabulary = files.vocabulary()?;
        let (found, expected) = (vocabulary.size(), manifest.config.vocabulary);
        if found != expected {
            return Err(bad_tokenizer(&format!("{found} tokens"), &format!("{expected} tokens")));
        }
        let mut parameters = Parameters::Stored { tensors: files.tensors()? };
        let network = Network::new(&mut parameters, &manifest.config)
            .map_err(|error| bad_weights(&reason(&error), &"the tensors of the description"))?;
        match parameters {
            Parameters::Stored { tensors } if !tensors.is_empty() => {
                let names: Vec<String> = tensors.into_keys().collect();
                Err(bad_weights(&format!("unknown tensors {names:?}"), &"none beyond the description"))
            }
            _ => Ok(Self {
                name: manifest.name,
                weights_sha256: manifest.weights_sha256,
                config: manifest.config,
                vocabulary,
                calibration: manifest.calibration,
                network,
            }),
        }
    }
}
