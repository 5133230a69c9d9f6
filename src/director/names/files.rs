//! A trained network of names as two files side by side: `names.json` describes `names.safetensors`.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

use candle_core::Tensor;
use cinesplat_files::sha256_hex;
use serde::{Deserialize, Serialize};

use super::network::{NamesConfig, NamesNetwork};
use crate::error::DirectorError;
use crate::model_files::{check_hash, folder_of, read_capped};
use crate::network::Parameters;
use crate::tensor_file::{Packing, bad, pack_tensors, read_tensors, reason};

/// Name of the file with the weights.
pub(super) const WEIGHTS_FILE: &str = "names.safetensors";
const MANIFEST_FILE: &str = "names.json";
/// `format` of the description.
const FORMAT: &str = "cinesplat.names";
/// Version of the files that this program reads and writes; it changes with the features of words and mentions.
const VERSION: u32 = 1;

/// The description.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct NamesManifest {
    format: String,
    version: u32,
    config: NamesConfig,
    weights_sha256: String,
}

/// The bytes of the two files. Nothing is checked before the network is built.
#[derive(Debug, Clone)]
pub struct NamesFiles {
    manifest: Cow<'static, [u8]>,
    weights: Cow<'static, [u8]>,
}

impl NamesFiles {
    /// Names of the files.
    pub const NAMES: [&str; 2] = [WEIGHTS_FILE, MANIFEST_FILE];

    /// The files that are compiled into the program.
    pub fn embedded() -> Self {
        Self {
            manifest: include_bytes!("../../../models/names.json").into(),
            weights: include_bytes!("../../../models/names.safetensors").into(),
        }
    }

    /// Reads the files; `path` is their folder, or any file in it.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] for a file above 256 MiB.
    pub fn read(path: &Path) -> Result<Self, DirectorError> {
        let folder = folder_of(path);
        Ok(Self {
            manifest: read_capped(&folder.join(MANIFEST_FILE))?.into(),
            weights: read_capped(&folder.join(WEIGHTS_FILE))?.into(),
        })
    }

    /// The files of a network. `tensors` maps names to shapes and values; values are rounded to `f16`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when a part cannot be serialized.
    pub fn pack(
        config: &NamesConfig,
        tensors: &BTreeMap<String, (Vec<usize>, Vec<f32>)>,
    ) -> Result<Self, DirectorError> {
        let weights = pack_tensors(tensors, Packing::Training)?;
        let manifest = NamesManifest {
            format: FORMAT.into(),
            version: VERSION,
            config: config.clone(),
            weights_sha256: sha256_hex(&weights),
        };
        let manifest = serde_json::to_vec_pretty(&manifest).map_err(|error| bad(&MANIFEST_FILE, &error, &"JSON"))?;
        Ok(Self { manifest: manifest.into(), weights: weights.into() })
    }

    /// Name and bytes of each file; the description last.
    pub fn named(&self) -> [(&'static str, &[u8]); 2] {
        [(WEIGHTS_FILE, &self.weights), (MANIFEST_FILE, &self.manifest)]
    }

    /// SHA-256 of the weights, hexadecimal.
    pub fn weights_sha256(&self) -> String {
        sha256_hex(&self.weights)
    }

    /// All tensors by name, as `f32`.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the file is not a safetensors file, or a tensor is neither `f16` nor `f32` or holds
    /// a value that is not finite.
    pub fn tensors(&self) -> Result<BTreeMap<String, Tensor>, DirectorError> {
        read_tensors(&self.weights)
    }

    /// Builds the network after checking format, version, hash, and the names, shapes and values of all tensors.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] naming the file, field or tensor.
    pub(super) fn network(&self) -> Result<NamesNetwork, DirectorError> {
        let manifest: NamesManifest = serde_json::from_slice(&self.manifest)
            .map_err(|error| bad(&MANIFEST_FILE, &error, &"a description of version 1"))?;
        let found = (manifest.format.as_str(), manifest.version);
        if found != (FORMAT, VERSION) || !manifest.config.is_sound() {
            return Err(bad(
                &MANIFEST_FILE,
                &format!("{found:?}"),
                &format!("{FORMAT} version {VERSION} with valid sizes"),
            ));
        }
        check_hash(WEIGHTS_FILE, &self.weights, &manifest.weights_sha256)?;
        let mut parameters = Parameters::Stored { tensors: self.tensors()? };
        let network = NamesNetwork::new(&mut parameters, &manifest.config)
            .map_err(|error| bad(&WEIGHTS_FILE, &reason(&error), &"the tensors of the description"))?;
        match parameters {
            Parameters::Stored { tensors } if !tensors.is_empty() => {
                let names: Vec<String> = tensors.into_keys().collect();
                Err(bad(&WEIGHTS_FILE, &format!("unknown tensors {names:?}"), &"none beyond the description"))
            }
            _ => Ok(network),
        }
    }
}
