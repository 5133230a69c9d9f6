use glam::DVec3;
use serde::Deserialize;
use serde_json::Value;

use crate::error::SceneError;
use crate::filter::SplatFilter;
use crate::source_file::SourceFile;

/// How a byte becomes a value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Codes {
    /// Version 2: the byte is an index.
    Book(Vec<f64>),
    /// Version 1: the byte runs from `mins` to `maxs`, channel by channel.
    Range {
        /// Value of byte 0.
        mins: Vec<f64>,
        /// Value of byte 255.
        maxs: Vec<f64>,
    },
}

impl Codes {
    /// The values of all bytes of one channel.
    pub(super) fn table(&self, channel: usize) -> [f64; 256] {
        std::array::from_fn(|byte| match self {
            // A version 2 writer that found fewer values writes a shorter book; the bytes beyond it are not used.
            Self::Book(book) => book.get(byte).copied().unwrap_or(f64::NAN),
            Self::Range { mins, maxs } => mins[channel] + (maxs[channel] - mins[channel]) * byte as f64 / 255.0,
        })
    }
}

/// Coefficients above degree 0: a palette of them, and which entry each Gaussian takes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Palette {
    /// How a byte becomes a coefficient.
    pub(super) codes: Codes,
    /// Degree, 1..=3; `None` in version 1, where the width of the picture tells it.
    pub(super) degree: Option<u8>,
    /// Name of the picture of the entries.
    pub(super) entries: String,
    /// Name of the picture of the indices.
    pub(super) labels: String,
}

/// A checked `meta.json`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Meta {
    /// 1 or 2.
    pub(super) version: u32,
    /// Number of Gaussians.
    pub(super) count: u64,
    /// Bounds of the means, in the logarithmic domain.
    pub(super) mean_bounds: [DVec3; 2],
    /// Names of the pictures of the means' low and high bytes.
    pub(super) means: [String; 2],
    /// How a byte becomes a log-scale.
    pub(super) scale_codes: Codes,
    /// Name of the picture of the scales.
    pub(super) scales: String,
    /// Name of the picture of the rotations.
    pub(super) quats: String,
    /// How a byte becomes a degree-0 coefficient and, in version 1, an opacity logit (channel 3).
    pub(super) color_codes: Codes,
    /// Name of the picture of colors and opacities.
    pub(super) sh0: String,
    /// Coefficients above degree 0.
    pub(super) palette: Option<Palette>,
    /// Filter that the file asks for.
    pub(super) filter: Option<SplatFilter>,
    /// What was odd.
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
    /// Parses and checks a `meta.json`.
    ///
    /// # Errors
    /// [`SceneError::SogMeta`].
    pub(super) fn parse(source: &SourceFile, json: &[u8]) -> Result<Self, SceneError> {
        let fault = |reason: String| SceneError::SogMeta { path: source.path.to_path_buf(), reason };
        let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
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
            notes.push("model 2dgs: drawn as 3D Gaussians".to_owned());
        }
        let is_mip = raw.antialias == Some(true) || raw.model.as_deref() == Some("antialiased");
        let filter = if is_mip { Some(SplatFilter::Mip) } else { raw.antialias.map(|_| SplatFilter::Classic) };
        let num_colors = if version == 1 { 4 } else { 3 };
        Ok(Self {
            version,
            count,
            mean_bounds,
            means: [raw.means.file(0, "means")?, raw.means.file(1, "means")?],
            scale_codes: raw.scales.codes("scales", 3)?,
            scales: raw.scales.file(0, "scales")?,
            quats: raw.quats.file(0, "quats")?,
            color_codes: raw.sh0.codes("sh0", num_colors)?,
            sh0: raw.sh0.file(0, "sh0")?,
            palette: raw.sh_rest.map(|part| palette(&part, version)).transpose()?.flatten(),
            filter,
            notes,
        })
    }
}

fn palette(part: &RawPart, version: u32) -> Result<Option<Palette>, String> {
    let degree = match (version, part.bands) {
        (1, None) => None,
        (_, Some(0)) => return Ok(None),
        (_, Some(bands @ 1..=3)) => Some(bands as u8),
        (_, bands) => return Err(format!("shN.bands {bands:?}, expected 1, 2 or 3")),
    };
    let codes = part.codes("shN", 3)?;
    Ok(Some(Palette { codes, degree, entries: part.file(0, "shN")?, labels: part.file(1, "shN")? }))
}

impl RawPart {
    /// The code book where there is one, else the ranges.
    fn codes(&self, part: &str, channels: usize) -> Result<Codes, String> {
        if let Some(book) = &self.codebook {
            let good = !book.is_empty() && book.len() <= 256 && book.iter().all(|v| v.is_finite());
            return if good {
                Ok(Codes::Book(book.clone()))
            } else {
                Err(format!("{part}.codebook, expected 1 to 256 numbers"))
            };
        }
        let range = |value: &Option<Value>, name: &str| {
            numbers(value.as_ref(), channels)
                .ok_or(format!("{part}.{name}, expected {channels} numbers, or a codebook"))
        };
        Ok(Codes::Range { mins: range(&self.mins, "mins")?, maxs: range(&self.maxs, "maxs")? })
    }

    /// The name of a picture, which must lie in the same folder.
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

/// `count` finite numbers: an array of as many or more, or one number for all.
fn numbers(value: Option<&Value>, count: usize) -> Option<Vec<f64>> {
    let found: Vec<f64> = match value? {
        Value::Array(items) => items.iter().take(count).map(Value::as_f64).collect::<Option<_>>()?,
        single => vec![single.as_f64()?; count],
    };
    (found.len() == count && found.iter().all(|v| v.is_finite())).then_some(found)
}
