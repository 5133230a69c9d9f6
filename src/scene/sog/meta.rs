use cinesplat_files::json_excess;
use glam::DVec3;
use serde::Deserialize;
use serde_json::Value;

use crate::error::SceneError;
use crate::filter::SplatFilter;
use crate::source_file::SourceFile;

/// Mapping from bytes to values.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Dequantizer {
    /// Version 2: one value per byte.
    Codebook(Vec<f64>),
    /// Version 1: one linear range per channel.
    Range {
        /// Value of byte 0.
        mins: Vec<f64>,
        /// Value of byte 255.
        maxs: Vec<f64>,
    },
}

impl Dequantizer {
    /// The value of every byte in a channel; NaN for bytes beyond a short codebook.
    pub(super) fn table(&self, channel: usize) -> [f64; 256] {
        std::array::from_fn(|byte| match self {
            // Writers that need fewer values write a shorter codebook and use no byte beyond it.
            Self::Codebook(values) => values.get(byte).copied().unwrap_or(f64::NAN),
            Self::Range { mins, maxs } => mins[channel] + (maxs[channel] - mins[channel]) * byte as f64 / 255.0,
        })
    }
}

/// Palette of coefficients above degree 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Palette {
    /// Bytes to coefficients.
    pub(super) dequantizer: Dequantizer,
    /// Degree, 1..=3; `None` in version 1, where the width of the picture decides.
    pub(super) degree: Option<u8>,
    /// Name of the picture that holds the entries.
    pub(super) entries: String,
    /// Name of the picture that holds the entry index of each Gaussian.
    pub(super) labels: String,
}

/// A validated `meta.json`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Meta {
    /// Version, 1 or 2.
    pub(super) version: u32,
    /// Number of Gaussians.
    pub(super) count: u64,
    /// Lowest and highest mean, in the logarithmic domain.
    pub(super) mean_bounds: [DVec3; 2],
    /// Names of the pictures of the low and of the high bytes of the means.
    pub(super) means: [String; 2],
    /// Bytes to log-scales.
    pub(super) scale_dequantizer: Dequantizer,
    /// Name of the picture of the scales.
    pub(super) scales: String,
    /// Name of the picture of the rotations.
    pub(super) quats: String,
    /// Bytes to coefficients of degree 0 and, in version 1, to opacity logits (channel 3).
    pub(super) color_dequantizer: Dequantizer,
    /// Name of the picture of colors and opacities.
    pub(super) sh0: String,
    /// Coefficients above degree 0; `None` without them.
    pub(super) palette: Option<Palette>,
    /// Filter that the file states.
    pub(super) filter: Option<SplatFilter>,
    /// Notes for [`Scene::notes`](crate::Scene::notes).
    pub(super) notes: Vec<String>,
}

/// `meta.json` as written; both versions.
#[derive(Deserialize)]
struct RawMeta {
    version: Option<u64>,
    count: Option<u64>,
    antialias: Option<bool>,
    model: Option<String>,
    means: RawPart,
    scales: RawPart,
    quats: RawPart,
    sh0: RawPart,
    #[serde(rename = "shN")]
    sh_rest: Option<RawPart>,
}

#[derive(Deserialize)]
struct RawPart {
    shape: Option<Vec<u64>>,
    mins: Option<Value>,
    maxs: Option<Value>,
    codebook: Option<Vec<f64>>,
    bands: Option<u64>,
    files: Vec<String>,
}

impl Meta {
    /// Parses and validates a `meta.json`.
    ///
    /// # Errors
    /// [`SceneError::SogMeta`] for invalid JSON, and for a missing or invalid field.
    pub(super) fn parse(source: &SourceFile, json: &[u8]) -> Result<Self, SceneError> {
        let fault = |reason: String| SceneError::SogMeta { path: source.path.to_path_buf(), reason };
        let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
        json_excess(json, &source.options.limits).map_or(Ok(()), |excess| Err(fault(excess)))?;
        let raw: RawMeta = serde_json::from_slice(json).map_err(|error| fault(error.to_string()))?;
        Self::checked(raw).map_err(fault)
    }

    fn checked(raw: RawMeta) -> Result<Self, String> {
        let version = match raw.version {
            None | Some(1) => 1,
            Some(2) => 2,
            Some(other) => return Err(format!("version {other}, expected none, 1 or 2")),
        };
        let count = raw.count.or(raw.means.shape.as_ref().and_then(|shape| shape.first().copied()));
        let count = count.ok_or("no count, expected the number of Gaussians")?;
        let bounds = |value: &Option<Value>, name: &str| {
            numbers(value.as_ref(), 3).map(|v| DVec3::from_slice(&v)).ok_or(format!("means.{name}, expected 3 numbers"))
        };
        let mean_bounds = [bounds(&raw.means.mins, "mins")?, bounds(&raw.means.maxs, "maxs")?];
        let mut notes = Vec::new();
        if raw.model.as_deref() == Some("2dgs") {
            notes.push("model 2dgs: rendered as 3D Gaussians".to_owned());
        }
        let is_mip = raw.antialias == Some(true) || raw.model.as_deref() == Some("antialiased");
        let filter = if is_mip { Some(SplatFilter::Mip) } else { raw.antialias.map(|_| SplatFilter::Classic) };
        let num_colors = if version == 1 { 4 } else { 3 };
        Ok(Self {
            version,
            count,
            mean_bounds,
            means: [raw.means.file(0, "means")?, raw.means.file(1, "means")?],
            scale_dequantizer: raw.scales.dequantizer("scales", 3)?,
            scales: raw.scales.file(0, "scales")?,
            quats: raw.quats.file(0, "quats")?,
            color_dequantizer: raw.sh0.dequantizer("sh0", num_colors)?,
            sh0: raw.sh0.file(0, "sh0")?,
            palette: raw.sh_rest.map(|part| palette(&part, version)).transpose()?.flatten(),
            filter,
            notes,
        })
    }
}

/// The palette of the `shN` section; `None` for degree 0.
fn palette(part: &RawPart, version: u32) -> Result<Option<Palette>, String> {
    let degree = match (version, part.bands) {
        (1, None) => None,
        (_, Some(0)) => return Ok(None),
        (_, Some(bands @ 1..=3)) => Some(bands as u8),
        (_, bands) => return Err(format!("shN.bands {bands:?}, expected 1, 2 or 3")),
    };
    let dequantizer = part.dequantizer("shN", 3)?;
    Ok(Some(Palette { dequantizer, degree, entries: part.file(0, "shN")?, labels: part.file(1, "shN")? }))
}

impl RawPart {
    /// The codebook if there is one, else the ranges.
    fn dequantizer(&self, part: &str, channels: usize) -> Result<Dequantizer, String> {
        if let Some(values) = &self.codebook {
            let is_valid = !values.is_empty() && values.len() <= 256 && values.iter().all(|v| v.is_finite());
            return if is_valid {
                Ok(Dequantizer::Codebook(values.clone()))
            } else {
                Err(format!("{part}.codebook, expected 1 to 256 numbers"))
            };
        }
        let range = |value: &Option<Value>, name: &str| {
            numbers(value.as_ref(), channels)
                .ok_or(format!("{part}.{name}, expected {channels} numbers, or a codebook"))
        };
        Ok(Dequantizer::Range { mins: range(&self.mins, "mins")?, maxs: range(&self.maxs, "maxs")? })
    }

    /// The name of a picture: a plain file name, without a folder.
    fn file(&self, idx: usize, part: &str) -> Result<String, String> {
        let name = self.files.get(idx).ok_or(format!("{part}.files, expected {} names or more", idx + 1))?;
        let is_plain = !name.is_empty() && !name.contains(['/', '\\', ':', '\0']) && name != "." && name != "..";
        if is_plain {
            Ok(name.clone())
        } else {
            Err(format!("{part}.files names {name:?}, expected a plain file name"))
        }
    }
}

/// `count` finite numbers: the first ones of an array, or copies of a single number.
fn numbers(value: Option<&Value>, count: usize) -> Option<Vec<f64>> {
    let found: Vec<f64> = match value? {
        Value::Array(items) => items.iter().take(count).map(Value::as_f64).collect::<Option<_>>()?,
        single => vec![single.as_f64()?; count],
    };
    (found.len() == count && found.iter().all(|v| v.is_finite())).then_some(found)
}
