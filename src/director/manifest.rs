//! The description of a model: `director.json`.

use cinesplat_files::sha256_hex;
use cinesplat_language::sense_names;
use cinesplat_operator::{FramePlace, Pass, Speed, SubjectPart, SubjectSide};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use serde::{Deserialize, Serialize};
use strum::VariantArray;

use crate::calibration::Calibration;
use crate::codes::read_motions;
use crate::error::DirectorError;
use crate::network::ModelConfig;

/// Name of the file.
pub(crate) const MANIFEST_FILE: &str = "director.json";
/// `format` of the file.
const FORMAT: &str = "cinesplat.director";
/// Version of a model's files that this program reads and writes.
const VERSION: u32 = 2;

/// The description of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    format: String,
    version: u32,
    /// Name of the model, as shots store it.
    pub(crate) name: String,
    /// Sizes of the network.
    pub(crate) config: ModelConfig,
    /// Names of all classes in order, so that weights trained for other classes are rejected.
    choices: Vec<String>,
    /// Names of the senses of words in order, for the same reason; empty for a network that knows none.
    #[serde(default)]
    senses: Vec<String>,
    /// Calibration of the probabilities.
    #[serde(default)]
    pub(crate) calibration: Calibration,
    /// SHA-256 of the weights file, hexadecimal.
    pub(crate) weights_sha256: String,
    /// SHA-256 of the tokenizer file, hexadecimal.
    pub(crate) tokenizer_sha256: String,
}

impl Manifest {
    /// The description of a model that this program writes.
    pub(crate) fn new(name: &str, config: &ModelConfig, weights: &[u8], tokenizer: &[u8]) -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            name: name.into(),
            config: config.clone(),
            choices: choices(),
            senses: if config.senses > 0 { senses() } else { Vec::new() },
            calibration: Calibration::default(),
            weights_sha256: sha256_hex(weights),
            tokenizer_sha256: sha256_hex(tokenizer),
        }
    }

    /// Parses and checks a description.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] for other JSON, another format or version, invalid sizes, or other classes.
    pub(crate) fn from_json(bytes: &[u8]) -> Result<Self, DirectorError> {
        let manifest: Self =
            serde_json::from_slice(bytes).map_err(|error| bad(&error, &"a description of version 2"))?;
        if manifest.format != FORMAT {
            return Err(bad(&format!("format {:?}", manifest.format), &format!("{FORMAT:?}")));
        }
        if manifest.version != VERSION {
            return Err(bad(&format!("version {}", manifest.version), &format!("version {VERSION}")));
        }
        if !manifest.config.is_sound() {
            return Err(bad(&format!("{:?}", manifest.config), &"valid network sizes"));
        }
        if manifest.choices != choices() {
            return Err(bad(&"choices of another version", &"the moves, sizes and angles of this program"));
        }
        if manifest.senses.len() != manifest.config.senses || !manifest.senses.is_empty() && manifest.senses != senses()
        {
            return Err(bad(&"senses of words of another version", &"those of prompts/senses.txt"));
        }
        Ok(manifest)
    }

    /// The description as JSON.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when it cannot be serialized.
    pub(crate) fn to_json(&self) -> Result<Vec<u8>, DirectorError> {
        serde_json::to_vec_pretty(self).map_err(|error| bad(&error, &"JSON"))
    }
}

/// Names of all classes, in the order in which the heads output them. The files of trained models hold these names, so
/// they must never change.
fn choices() -> Vec<String> {
    let moves = Move::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let sizes = ShotSize::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let angles = ShotAngle::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let easings = Easing::VOCABULARY.iter().map(|choice| choice.as_ref().to_owned());
    let parts = SubjectPart::VARIANTS.iter().map(|choice| format!("{choice:?}"));
    let passes = Pass::VARIANTS.iter().map(|choice| format!("{choice:?}"));
    let speeds = Speed::VARIANTS.iter().map(|choice| format!("{choice:?}"));
    let places = FramePlace::VARIANTS.iter().map(|choice| choice.as_ref().to_owned());
    let sides = SubjectSide::READ.iter().map(|choice| choice.as_ref().to_owned());
    let motions = read_motions().map(|motion| motion.as_ref().to_owned());
    let of_moves = moves.chain(sizes).chain(angles).chain(easings).chain(parts).chain(passes).chain(speeds);
    of_moves.chain(places).chain(sides).chain(motions).collect()
}

/// Names of the senses of words that the network takes as input. A damaged list is reported where words are read.
fn senses() -> Vec<String> {
    sense_names().map(<[String]>::to_vec).unwrap_or_default()
}

fn bad(found: &dyn std::fmt::Display, expected: &dyn std::fmt::Display) -> DirectorError {
    DirectorError::BadModel { part: MANIFEST_FILE.to_owned(), found: found.to_string(), expected: expected.to_string() }
}
